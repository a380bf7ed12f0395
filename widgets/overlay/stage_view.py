"""What the stage overlay shows: a row per pose on one time axis, the black rows below, the playhead.

Each row is a cached pixmap, redrawn only when its lines changed, and so is the ground behind and below them;
moving the playhead copies two narrow strips of these, an edit the rows it changed. How they look is in
stage_pictures.py.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QPen, QPixmap, QResizeEvent
from PySide6.QtWidgets import QWidget

from core_pipeline.phonemes import Pair
from core_pipeline.pipeline import Stages
from core_pipeline.weights import Weights

from .. import theme
from . import stage_backdrop as backdrop
from .stage_footer import ROW, Footer, Span
from .stage_layers import LAYERS
from .stage_lines import Line, PoseLines, pose_lines, weights_lines
from .stage_marks import HALF, Mark, draw_marks
from .stage_picking import Reading
from .stage_pictures import RIGHT, Backdrop, RowCurves, Sheet, draw_ground, draw_reading, draw_row
from .stage_rows import MODES, Row, lay_out
from .time_axis import TimeAxis


class StageView(QWidget):
    """Draws stages; takes values by set_… methods. Its child StageOverlay adds the hand."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setMinimumHeight(120)
        self._stages: Stages | None = None
        self._lines: dict[str, PoseLines] = {}
        self._ghost: dict[str, PoseLines] = {}
        self._other: dict[str, PoseLines] = {}
        self._method: dict[str, Line] = {}
        self._marks: tuple[Mark, ...] = ()
        self._sources: tuple[str, ...] = ()
        self._words: tuple[Span, ...] = ()
        self._active = ""
        self._index: int | None = None
        self._pair: Pair | None = None
        self._playhead = 0.0
        self._following = False
        self._loop: tuple[float, float] | None = None
        self._mode = MODES[0]
        self._styles = theme.STAGE_STYLES
        self._shown = frozenset(layer.name for layer in LAYERS if layer.default_on)
        self._reading: Reading | None = None
        self._names = backdrop.RowNames()
        self._footer = Footer()
        self._axis = TimeAxis()
        self._rows: tuple[Row, ...] = ()
        self._row_pixmaps: dict[str, tuple[object, QPixmap]] = {}
        self._ground: QPixmap | None = None

    # Values come down

    def set_stages(self, stages: Stages | None) -> None:
        """Show another result; only the rows that look different are drawn anew."""
        before, lines_before = self._stages, self._lines
        self._stages = stages if stages is not None and len(stages.schedule) else None
        self._lines = {} if self._stages is None else pose_lines(self._stages)
        changed = [pose for pose, lines in self._lines.items() if not lines.same_as(lines_before.get(pose))]
        for pose in [pose for pose in self._row_pixmaps if pose in changed or pose not in self._lines]:
            del self._row_pixmaps[pose]
        if self._stages is not None:
            self._axis = self._axis.with_content(self._stages.schedule.start, self._stages.schedule.end)
        if list(lines_before) != list(self._lines) or not _same_ground(before, self._stages):
            self._redraw()
        self._lay_out()
        for pose in changed:
            self._update_row(pose)

    def set_source_phones(self, phones: Sequence[str] | None) -> None:
        """The language's phone for each phone of the schedule, such as "ae" for "ah"."""
        sources = tuple(phones or ())
        if sources != self._sources:
            self._sources = sources
            self._redraw()

    def set_words(self, words: Sequence[Span]) -> None:
        """The words of the utterance: text, start and end in seconds; without any there is no row for them."""
        if tuple(words) != self._words:
            self._words = tuple(words)
            self._redraw()
            self._lay_out()

    def set_active_pose(self, pose: str) -> None:
        """The pose whose row is tall."""
        if pose != self._active:
            self._active = pose
            self._lay_out()

    def set_current(self, index: int | None, pair: Pair | None = None) -> None:
        """The open bigram: its number in the utterance, and its pair, of which every occurrence is tinted."""
        if (index, pair) == (self._index, self._pair):
            return
        moved = index != self._index
        self._index, self._pair = index, pair
        span = self._span(index)
        # One that is partly seen stays put: it may have been clicked right there.
        if moved and span is not None and not self._following and not self._axis.shows_any(*span):
            self._set_axis(self._axis.revealing(*span))
        self._redraw()

    def set_playhead(self, t: float) -> None:
        """Seconds; costs two narrow strips, unless the view has to turn the page."""
        old = self._strips()
        self._playhead = t
        if self._following:
            self._set_axis(self._axis.following(t))
        for strip in (*old, *self._strips()):
            self.update(strip)

    def set_following(self, on: bool) -> None:
        """Whether the view turns the page with the playhead."""
        self._following = on

    def set_ghost(self, stages: Stages | None) -> None:
        """Another result, whose final curves are drawn grey below where they differ; None for none."""
        before, self._ghost = self._ghost, {} if stages is None else pose_lines(stages)
        for pose in {*before, *self._ghost}:
            now = self._ghost.get(pose)
            if (now is None) != (pose not in before) or (now is not None and not now.same_as(before.get(pose))):
                self._row_pixmaps.pop(pose, None)
                self._update_row(pose)

    def set_other(self, stages: Stages | None) -> None:
        """What another curve set makes of the sentence, its final curves dashed; None for none."""
        if stages is not None or self._other:
            self._other = {} if stages is None else pose_lines(stages)
            self._row_pixmaps.clear()
            self._redraw()

    def set_method(self, weights: Weights | None) -> None:
        """What another method makes of the sentence, grey and dashed; None for none."""
        if weights is not None or self._method:
            self._method = {} if weights is None else weights_lines(weights)
            self._row_pixmaps.clear()
            self._redraw()

    def set_marks(self, marks: Sequence[Mark]) -> None:
        """What is weak, where it is."""
        if tuple(marks) != self._marks:
            self._marks = tuple(marks)
            self.update()

    def set_loop_range(self, loop: tuple[float, float] | None) -> None:
        """The part that is played in a loop, in seconds."""
        if loop != self._loop:
            self._loop = loop
            self._redraw()

    def set_palette_safe(self, safe: bool) -> None:
        """Whether the stages have colours that remain apart without full colour vision."""
        self._styles = theme.STAGE_STYLES_CVD if safe else theme.STAGE_STYLES
        self._row_pixmaps.clear()
        self._redraw()

    def set_shown(self, names: Iterable[str]) -> None:
        """Which layers are drawn, by their names."""
        shown = frozenset(names)
        if shown != self._shown:
            self._shown = shown
            self._row_pixmaps.clear()
            self._redraw()

    def set_mode(self, mode: str) -> None:
        """One of stage_rows.MODES."""
        if mode not in MODES:
            raise ValueError(f"no view mode {mode!r}")
        self._mode = mode
        self._lay_out()

    # What is seen

    @property
    def axis(self) -> TimeAxis:
        """Seconds and pixels."""
        return self._axis

    @property
    def rows(self) -> tuple[Row, ...]:
        """The rows that have room."""
        return self._rows

    @property
    def active_pose(self) -> str:
        """The tall row; the first pose of the set where the wanted one is not in it."""
        return self._active if self._active in self._lines else next(iter(self._lines), "")

    def row_of(self, pose: str) -> Row | None:
        """A pose's row; None when it has no room."""
        return next((row for row in self._rows if row.pose == pose), None)

    def row_pixmap(self, row: Row) -> QPixmap:
        """The row's curves on transparent ground, from the cache if nothing changed."""
        key = (row.height, row.active, row.idle, self._axis, self.width(), self.devicePixelRatioF())
        cached = self._row_pixmaps.get(row.pose)
        if cached is None or cached[0] != key:
            cached = self._row_pixmaps[row.pose] = (key, self._drawn_row(row))
        return cached[1]

    @property
    def rows_height(self) -> int:
        """Pixels above the black rows."""
        return self.height() - self.footer_rows * ROW

    @property
    def footer_rows(self) -> int:
        """Time, Phoneme and Start, and Word where there are any; fewer where the overlay is very low."""
        return (3 + bool(self._words)) if self.height() >= 130 else 2

    # Layout

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Qt's hook."""
        super().resizeEvent(event)
        self._redraw()
        self._lay_out()

    def _lay_out(self) -> None:
        peaks = {pose: lines.peak for pose, lines in self._lines.items()}
        rows = lay_out(tuple(self._lines), self.active_pose, peaks, self._mode, self.rows_height)
        gutter = self._names.width([*self._lines, *(title + "  +9" for title in self._footer.titles(4))])
        axis = self._axis.with_pixels(float(min(gutter, self.width() // 3)), float(self.width() - RIGHT))
        if (rows, axis) != (self._rows, self._axis):
            self._rows, self._axis = rows, axis
            self._redraw()

    def _set_axis(self, axis: TimeAxis) -> None:
        if axis != self._axis:
            self._axis = axis
            self._redraw()

    def _redraw(self) -> None:
        """The ground is out of date."""
        self._ground = None
        self.update()

    def _update_row(self, pose: str) -> None:
        if (row := self.row_of(pose)) is not None:
            self.update(0, row.top, self.width(), row.height)

    def _span(self, index: int | None) -> tuple[float, float] | None:
        """Seconds of bigram `index`; None where this utterance has no such bigram."""
        if self._stages is None or index is None or not 0 <= index < len(self._stages.schedule) - 1:
            return None
        times = self._stages.schedule.times
        return float(times[index]), float(times[index + 2])

    def _strips(self) -> tuple[QRect, ...]:
        """Where the playhead is painted."""
        if self._stages is None or not self._axis.sees(self._playhead):
            return ()
        x = round(self._axis.px(self._playhead))
        return QRect(x - 1, 0, 3, self.height()), QRect(x - 5, 0, 11, 8)

    # Painting

    def paintEvent(self, event: QPaintEvent) -> None:
        """Qt's hook: copies ground and rows, then paints what moves."""
        painter = QPainter(self)
        if self._stages is None:
            text = self.tr("Type a sentence above to see what the pipeline makes of your curves")
            backdrop.draw_hint(painter, self.rect(), text)
        else:
            if self._ground is None or self._ground.devicePixelRatio() != self.devicePixelRatioF():
                self._ground = self._drawn_ground(self._stages)
            painter.drawPixmap(0, 0, self._ground)
            for row in self._rows:
                if event.rect().intersects(QRect(0, row.top, self.width(), row.height)):
                    painter.drawPixmap(0, row.top, self.row_pixmap(row))
            first, last = (self._axis.left + (x - self._axis.x0) / self._axis.scale for x in _around(event.rect()))
            marks = [mark for mark in self._marks if first <= mark.time <= last]
            draw_marks(painter, marks, self._axis, self.row_of)
            reading = self._reading
            if reading is not None and (under := self.row_of(reading.pose)) is not None:
                draw_reading(painter, under, self._axis, self._stages, reading, self._styles["red"])
            backdrop.draw_playhead(painter, self._axis, self._playhead, self.height())
        if self.hasFocus():
            painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
            painter.setPen(QPen(theme.ACCENT, 1))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRect(self.rect().adjusted(0, 0, -1, -1))
        painter.end()

    def _sheet(self) -> Sheet:
        return Sheet(self.width(), self.height(), self.devicePixelRatioF(), self._axis)

    def _drawn_ground(self, stages: Stages) -> QPixmap:
        hidden = len(self._lines) - len(self._rows) if self._mode != "one" else 0
        sources = self._sources if len(self._sources) == len(stages.schedule) else ()
        span, index = self._span(self._index), self._index
        what = Backdrop(
            stages, self._rows, self.rows_height, hidden, self._pair, index, span, self._loop, sources, self._words
        )
        return draw_ground(self._sheet(), what, self._names, self._footer)

    def _drawn_row(self, row: Row) -> QPixmap:
        pose = row.pose
        curves = RowCurves(self._lines[pose], self._ghost.get(pose), self._other.get(pose), self._method.get(pose))
        return draw_row(self._sheet(), row, curves, self._names, self._shown, self._styles)


def _around(rect: QRect) -> tuple[int, int]:
    """The columns from which a mark reaches into `rect`."""
    return rect.left() - HALF - 1, rect.right() + HALF + 1


def _same_ground(one: Stages | None, other: Stages | None) -> bool:
    """Whether nothing but curves differs."""
    if one is None or other is None:
        return one is other
    a, b = one.schedule, other.schedule
    known = (one.missing, one.unknown, a.phones) == (other.missing, other.unknown, b.phones)
    return known and np.array_equal(a.times, b.times)
