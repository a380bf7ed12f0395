"""The stage overlay: every step of the pipeline over time, and the way back from any point to its bigram.

"There are no black-box components" (section 3.2.4): hover to read a place, click to open the bigram that made it.

    press or drag in Time   scrub            wheel                  zoom about the mouse
    Shift+drag in Time      loop range       Shift+wheel, middle    pan
    double-click Time       see everything   click a row            open the bigram
"""

from __future__ import annotations

from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QHelpEvent, QKeyEvent, QMouseEvent, QWheelEvent
from PySide6.QtWidgets import QToolTip, QWidget

from core_pipeline.pipeline import Stages
from core_pipeline.poses import MEANING

from .stage_footer import ROW, phone_tip
from .stage_keyboard import NOTCH, StageKeyboard
from .stage_marks import Mark, mark_at
from .stage_picking import phone_at, read
from .stage_rows import Row

#: A press that moves no further than this many pixels is a click.
CLICK = 3
_LEFT, _MIDDLE = Qt.MouseButton.LeftButton, Qt.MouseButton.MiddleButton


class StageOverlay(StageKeyboard):
    """Rows of stages under the mouse, and what the keyboard adds."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setMouseTracking(True)
        self._gesture = ""
        self._from = QPoint()
        self._loop_before: tuple[float, float] | None = None

    def set_stages(self, stages: Stages | None) -> None:
        """Show another result, and read anew what is under the mouse."""
        super().set_stages(stages)
        if self._stages is None or self._mouse is None:
            self._show_reading(None)
        else:
            self._hover(self._mouse)

    # Where is the mouse?

    def _zone(self, at: QPoint) -> str:
        """ "row", "name", or one of the black rows "time", "phone", "start", "word"."""
        if at.y() < self.rows_height:
            return "name" if at.x() < self.axis.x0 - 2 else "row"
        return ("time", "phone", "start", "word")[min((at.y() - self.rows_height) // ROW, self.footer_rows - 1)]

    def _row_at(self, at: QPoint) -> Row | None:
        return next((row for row in self.rows if row.top <= at.y() < row.bottom), None)

    # Mouse

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Qt's hook: begins scrubbing, a loop range, panning or a click."""
        if self._stages is None or self._gesture:
            return
        self._from = event.position().toPoint()
        zone = self._zone(self._from)
        if event.button() == _MIDDLE:
            self._gesture = "pan"
            self.setCursor(Qt.CursorShape.ClosedHandCursor)
        elif event.button() == _LEFT:
            if zone == "time" and event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
                self._gesture, self._loop_before = "loop", self._loop
            elif zone == "time":
                self._gesture = "scrub"
                self.scrubbed.emit(self.axis.time(self._from.x()))
            else:
                self._gesture = zone

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Qt's hook: goes on with the gesture, or reads what is under the mouse."""
        at = event.position().toPoint()
        if self._stages is None:
            return
        self._mouse = at
        if not self._gesture:
            self._hover(at)
        elif self._gesture == "scrub":
            self.scrubbed.emit(self.axis.time(at.x()))
        elif self._gesture == "pan":
            self._set_axis(self.axis.panned(at.x() - self._from.x()))
            self._from = at
        elif self._gesture == "loop":
            self.set_loop_range(self._swept(at))
        elif self._gesture == "phone" and abs(at.x() - self._from.x()) > CLICK:
            self._gesture = "scrub"
            self.scrubbed.emit(self.axis.time(at.x()))

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Qt's hook: ends the gesture; a press that did not move was a click."""
        if not self._gesture or event.button() != (_MIDDLE if self._gesture == "pan" else _LEFT):
            return
        gesture, self._gesture = self._gesture, ""
        at = event.position().toPoint()
        if gesture == "pan":
            self.unsetCursor()
        if self._stages is None:
            return
        if gesture == "scrub":
            self.scrub_finished.emit(self.axis.time(at.x()))
        elif gesture == "loop":
            swept = self._swept(at)
            self.set_loop_range(self._loop_before)
            self.loop_range_changed.emit(swept)
        elif gesture != "pan" and (at - self._from).manhattanLength() <= 2 * CLICK:
            self._click(gesture, at)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Qt's hook: a double-click on Time shows everything."""
        if event.button() == _LEFT and self._zone(event.position().toPoint()) == "time":
            self.fit()

    def leaveEvent(self, event: QEvent) -> None:
        """Qt's hook."""
        super().leaveEvent(event)
        self._mouse = None
        self._show_reading(None)

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Qt's hook: zooms about the mouse; with Shift, or turned sideways, pans."""
        event.accept()
        if self._stages is None:
            return
        turn = event.angleDelta()
        aside = turn.x() or (turn.y() if event.modifiers() & Qt.KeyboardModifier.ShiftModifier else 0)
        if aside:
            self._set_axis(self.axis.panned(aside / 120 * 0.1 * (self.axis.x1 - self.axis.x0)))
        elif turn.y():
            about = self.axis.time(max(event.position().x(), self.axis.x0))
            self._set_axis(self.axis.zoomed(NOTCH ** (turn.y() / 120), about))
        self._hover(event.position().toPoint())

    def _click(self, zone: str, at: QPoint) -> None:
        row = self._row_at(at)
        if marks := mark_at(QPointF(at), self._marks, self.axis, self.row_of):
            self._open_mark(marks[0])
        elif zone == "name" and row is not None:
            self.pose_activated.emit(row.pose)
        elif zone == "row" and row is not None:
            self._open(row.pose, self.axis.time(at.x()))
        elif zone in {"phone", "start", "word"} and self._stages is not None:
            phone = phone_at(self._stages, self.axis.time(at.x()))
            self._scrub_to(float(self._stages.schedule.times[phone]))

    def _swept(self, at: QPoint) -> tuple[float, float] | None:
        """The loop range from the press to here; none when the mouse did not move."""
        if abs(at.x() - self._from.x()) <= CLICK:
            return None
        a, b = sorted((self.axis.time(self._from.x()), self.axis.time(at.x())))
        return (a, b) if b > a else None

    def _open_mark(self, mark: Mark) -> None:
        if self._stages is None:
            return
        times, pairs = self._stages.schedule.times, self._stages.schedule.pairs()
        places = [i for i, pair in enumerate(pairs) if pair == mark.pair]
        if places:
            index = min(places, key=lambda i: abs(float(times[i + 1]) - mark.time))
            self.bigram_picked.emit(index, mark.time, mark.pose or self.active_pose)

    # Reading

    def _hover(self, at: QPoint) -> None:
        zone, row = self._zone(at), self._row_at(at)
        cursors = {"row": Qt.CursorShape.PointingHandCursor, "name": Qt.CursorShape.PointingHandCursor}
        self.setCursor(cursors.get(zone, Qt.CursorShape.SplitHCursor if zone == "time" else Qt.CursorShape.ArrowCursor))
        if self._stages is None or zone != "row" or row is None or at.x() > self.axis.x1:
            self._show_reading(None)
        else:
            self._show_reading(read(self._stages, row.pose, self.axis.time(at.x())))

    def event(self, event: QEvent) -> bool:
        """Qt's hook: tooltips for pose names and phones."""
        if event.type() == QEvent.Type.ToolTip and isinstance(event, QHelpEvent):
            text = self._tip(event.pos())
            if text:
                QToolTip.showText(event.globalPos(), text, self)
            else:
                QToolTip.hideText()
            return True
        return super().event(event)

    def _tip(self, at: QPoint) -> str:
        zone, row = self._zone(at), self._row_at(at)
        if self._stages is None:
            return ""
        if marks := mark_at(QPointF(at), self._marks, self.axis, self.row_of):
            return "\n".join(f"{' – '.join(mark.pair)}: {mark.reason}" for mark in marks)
        if zone == "name" and row is not None:
            meaning = MEANING.get(row.pose, "")
            return f"{row.pose}: {meaning}" if meaning else row.pose
        if zone == "time":
            hidden = [pose for pose in self._lines if self.row_of(pose) is None] if self._mode != "one" else []
            if at.x() < self.axis.x0 and hidden:
                return self.tr("Not shown for want of room: %1").replace("%1", ", ".join(hidden))
            return self.tr("Drag to scrub, Shift+drag for a loop range, double-click to see everything")
        if zone == "phone" and at.x() >= self.axis.x0:
            return phone_tip(self._stages, phone_at(self._stages, self.axis.time(at.x())), self._sources)
        return ""

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Qt's hook: Escape gives a loop drag up; the rest is StageKeyboard's."""
        if event.key() == Qt.Key.Key_Escape and self._gesture == "loop":
            self._gesture = ""
            self.set_loop_range(self._loop_before)
        else:
            super().keyPressEvent(event)
