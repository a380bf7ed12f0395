"""Behind and beside the curves of the stage overlay: spans, phone boundaries, the loop range, row names and scales."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from PySide6.QtCore import QLine, QPointF, QRect, Qt
from PySide6.QtGui import QColor, QFontMetrics, QPainter, QPen, QPolygonF

from core_pipeline.phonemes import SILENCE, Pair
from core_pipeline.schedule import Schedule

from .. import theme
from .stage_layers import RowPlace
from .stage_rows import Row
from .time_axis import TimeAxis

#: A row's line of weight 0.
BASE = theme.mix(theme.BORDER, theme.BACKGROUND, 0.75)
#: Every second row's ground.
STRIPE = theme.mix(theme.PANEL, theme.BACKGROUND, 0.9)
#: A row this tall (pixels) shows its scale.
SCALED = 70

_BOUNDARY = theme.mix(theme.BORDER, theme.BACKGROUND, 0.5)
_GRID = theme.mix(theme.BORDER, theme.BACKGROUND, 0.45)
_SILENT = theme.mix(theme.SUNKEN, theme.BACKGROUND, 0.8)
_CURRENT = theme.mix(theme.ACCENT, theme.BACKGROUND, 0.22)
_SAME = theme.mix(theme.ACCENT, theme.BACKGROUND, 0.10)
_RIGHT_MIDDLE = Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight


def draw_spans(
    painter: QPainter,
    axis: TimeAxis,
    schedule: Schedule,
    pair: Pair | None,
    current: tuple[float, float] | None,
    tall: int,
) -> None:
    """Silence, every occurrence of the open bigram, and the open one (seconds), over the upper `tall` pixels."""

    def shade(a: float, b: float, colour: QColor) -> None:
        if b > axis.left and a < axis.right:
            x0, x1 = round(axis.px(a)), round(axis.px(b))
            painter.fillRect(x0, 0, max(x1 - x0, 1), tall, colour)

    times = schedule.times
    for i, phone in enumerate(schedule.phones):
        if phone == SILENCE:
            shade(times[i], times[i + 1], _SILENT)
    if pair is not None:
        for i, other in enumerate(schedule.pairs()):
            if other == pair:
                shade(times[i], times[i + 2], _SAME)
    if current is not None:
        shade(*current, _CURRENT)


def draw_boundaries(painter: QPainter, axis: TimeAxis, schedule: Schedule, tall: int) -> None:
    """A vertical line where each phone begins; none where they would merge into a grey area."""
    times = schedule.times
    seen = times[(times >= axis.left) & (times <= axis.right)]
    x = np.unique(np.rint(axis.px(seen))).astype(int)
    if x.size and x.size * 4 < axis.x1 - axis.x0:
        painter.setPen(_BOUNDARY)
        painter.drawLines([QLine(k, 0, k, tall) for k in x.tolist()])


def draw_loop(painter: QPainter, axis: TimeAxis, loop: tuple[float, float], tall: int) -> None:
    """Where the loop range (seconds) begins and ends."""
    pen = QPen(theme.LINK, 1)
    pen.setDashPattern([2, 3])
    painter.setPen(pen)
    for t in loop:
        if axis.sees(t):
            x = round(axis.px(t))
            painter.drawLine(x, 0, x, tall)


def draw_playhead(painter: QPainter, axis: TimeAxis, t: float, tall: int) -> None:
    """A line at `t` with a wedge at its top; at most 3 and 11 pixels wide."""
    if axis.sees(t):
        x = round(axis.px(t))
        painter.fillRect(x, 0, 1, tall, theme.PLAYHEAD)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(theme.PLAYHEAD)
        painter.drawPolygon(QPolygonF([QPointF(x - 4, 0), QPointF(x + 5, 0), QPointF(x + 0.5, 7)]))


def draw_hint(painter: QPainter, box: QRect, text: str) -> None:
    """A friendly sentence where there is nothing to show yet."""
    painter.fillRect(box, theme.BACKGROUND)
    painter.setFont(theme.font(11.0))
    painter.setPen(theme.MUTED)
    painter.drawText(box, Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap, text)


class RowNames:
    """Draws what stands left of a row's curves; holds fonts only."""

    def __init__(self) -> None:
        self.small = theme.font(7.5)
        self._usual = theme.font(8.5)
        self._bold = theme.font(9.0, bold=True)

    def width(self, names: Iterable[str]) -> int:
        """Pixels that the longest of the names needs, with the colour bar and the scale."""
        metrics = QFontMetrics(self._bold)
        return 14 + max(metrics.horizontalAdvance(name) for name in names) + 14

    def draw(self, painter: QPainter, row: Row, width: float) -> None:
        """The pose's colour and name in a pixmap of the row alone, left of `width`."""
        colour = theme.pose_colour(row.pose, row.index)
        inset = 8 if row.height > 40 else 3
        dim = theme.mix(colour, theme.BACKGROUND, 0.3) if row.idle and not row.active else colour
        painter.fillRect(5, inset, 3, row.height - 2 * inset - 1, dim)
        painter.setFont(self._bold if row.active else self.small if row.height < 17 else self._usual)
        painter.setPen(theme.BRIGHT if row.active else theme.FAINT if row.idle else theme.TEXT)
        box = QRect(14, 0, round(width) - 16, row.height - 1)
        painter.drawText(box, Qt.AlignmentFlag.AlignVCenter, row.pose)

    def draw_scale(self, painter: QPainter, place: RowPlace) -> None:
        """Lines at half and at full weight, with their values beside the axis."""
        painter.setFont(self.small)
        left, right = round(place.axis.x0), round(place.axis.x1)
        for value, text in ((0.5, ".5"), (1.0, "1")):
            y = round(place.base - value * place.tall)
            painter.fillRect(QRect(left, y, right - left, 1), _GRID)
            painter.setPen(theme.FAINT)
            painter.drawText(QRect(left - 24, y - 7, 20, 14), _RIGHT_MIDDLE, text)
