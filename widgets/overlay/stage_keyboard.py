"""The stage overlay by keyboard: everything the mouse can do there.

Left, Right         phone by phone        Shift+Left, Right     by hundredths of a second
Up, Down            the poses             Enter                 open the bigram under the playhead
I, O                a loop from, to       B, Delete             loop the open bigram, nothing
plus, minus, Home   zoom, see everything  Page Up, Page Down    turn the page, where it is zoomed
"""

from __future__ import annotations

from PySide6.QtCore import QPoint, Qt, Signal
from PySide6.QtGui import QFocusEvent, QKeyEvent
from PySide6.QtWidgets import QWidget

from .stage_picking import Reading, bigram_at, read
from .stage_view import StageView

#: One notch of the wheel, or plus, zooms by this factor.
NOTCH = 1.25
#: Seconds that Shift and an arrow key move the playhead.
FINE = 0.01
#: Share of the view that a page turns.
PAGE = 0.9

_Key = Qt.Key
_STEPS = {_Key.Key_Left: -1, _Key.Key_Right: 1}
_POSES = {_Key.Key_Up: -1, _Key.Key_Down: 1}
_ZOOMS = {_Key.Key_Plus: NOTCH, _Key.Key_Equal: NOTCH, _Key.Key_Minus: 1 / NOTCH}
_PAGES = {_Key.Key_PageUp: 1, _Key.Key_PageDown: -1}
_LOOPS = (_Key.Key_I, _Key.Key_O, _Key.Key_B, _Key.Key_Delete, _Key.Key_Backspace)


class StageKeyboard(StageView):
    """Rows of stages that keys walk, read, zoom and loop.

    bigram_picked(index, time, pose)  a row was clicked where bigram `index` made the curve
    scrubbed(time), scrub_finished(time)
    pose_activated(pose)              a row's name was clicked
    loop_range_changed(range)         (from, to) in seconds, or None
    read_out(reading)                 a stage_picking.Reading under the mouse, or None
    """

    bigram_picked = Signal(int, float, str)
    scrubbed = Signal(float)
    scrub_finished = Signal(float)
    pose_activated = Signal(str)
    loop_range_changed = Signal(object)
    read_out = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAccessibleName(self.tr("Pipeline stages"))
        self.setAccessibleDescription(
            self.tr(
                "The curves of every pose after each stage. Left and Right step through the phones, Up and Down "
                "through the poses, Enter opens the bigram under the playhead, plus and minus zoom, Home shows all, "
                "I and O set where a loop begins and ends, B loops the open bigram, Delete ends the loop."
            )
        )
        self._mouse: QPoint | None = None  # where it is, while it is over the overlay

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Qt's hook; see the module's picture."""
        if self._stages is None or not self._obey(Qt.Key(event.key()), event.modifiers()):
            super().keyPressEvent(event)

    def _obey(self, key: Qt.Key, held: Qt.KeyboardModifier) -> bool:
        if held & (Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.AltModifier):
            return False
        if key in _STEPS:
            if held & Qt.KeyboardModifier.ShiftModifier:
                self._scrub_to(min(max(self._playhead + FINE * _STEPS[key], self.axis.start), self.axis.end))
            else:
                self._step(_STEPS[key])
        elif key in _POSES:
            names = list(self._lines)
            if names:
                here = names.index(self.active_pose) + _POSES[key]
                self.pose_activated.emit(names[min(max(here, 0), len(names) - 1)])
                self._read_playhead()
        elif key in {Qt.Key.Key_Return, Qt.Key.Key_Enter}:
            self._open(self.active_pose, self._playhead)
        elif key in _ZOOMS:
            axis = self.axis
            about = self._playhead if axis.sees(self._playhead) else (axis.left + axis.right) / 2
            self._set_axis(axis.zoomed(_ZOOMS[key], about))
        elif key in _PAGES:
            self._set_axis(self.axis.panned(_PAGES[key] * PAGE * (self.axis.x1 - self.axis.x0)))
        elif key == Qt.Key.Key_Home:
            self.fit()
        elif key in _LOOPS:
            self.loop_range_changed.emit(self._loop_by(key))
        else:
            return False
        return True

    def _loop_by(self, key: Qt.Key) -> tuple[float, float] | None:
        """The loop range that a key wishes."""
        here, axis = self._playhead, self.axis
        first, last = self._loop or (axis.start, axis.end)
        if key == Qt.Key.Key_I:
            return here, last if last > here else axis.end
        if key == Qt.Key.Key_O:
            return first if first < here else axis.start, here
        return self._span(self._index) if key == Qt.Key.Key_B else None

    def _step(self, way: int) -> None:
        """To the next or the previous phone boundary."""
        if self._stages is None:
            return
        times = self._stages.schedule.times.tolist()
        if way > 0:
            self._scrub_to(next((t for t in times if t > self._playhead + 1e-4), times[-1]))
        else:
            self._scrub_to(next((t for t in reversed(times) if t < self._playhead - 1e-4), times[0]))

    def fit(self) -> None:
        """See the whole utterance."""
        self._set_axis(self.axis.fitted())

    def focusInEvent(self, event: QFocusEvent) -> None:
        """Qt's hook: the focus ring."""
        super().focusInEvent(event)
        self.update()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """Qt's hook: the focus ring."""
        super().focusOutEvent(event)
        self.update()

    # What mouse and keyboard share

    def _open(self, pose: str, time: float) -> None:
        if self._stages is not None and (index := bigram_at(self._stages, pose, time)) is not None:
            self.bigram_picked.emit(index, time, pose)

    def _scrub_to(self, time: float) -> None:
        self._set_axis(self.axis.revealing(time, time))
        self.scrubbed.emit(time)
        self.scrub_finished.emit(time)
        self._read_playhead()

    def _read_playhead(self) -> None:
        """By keyboard: the active pose where the playhead is, while the mouse is elsewhere."""
        if self._stages is not None and self._mouse is None:
            self._show_reading(read(self._stages, self.active_pose, self._playhead))

    def _show_reading(self, reading: Reading | None) -> None:
        if reading == self._reading:
            return
        old, self._reading = self._reading, reading
        for pose in {r.pose for r in (old, reading) if r is not None}:
            if (row := self.row_of(pose)) is not None:
                self.update(0, row.top, self.width(), row.height)
        self.read_out.emit(reading)
