"""The layers of the stage overlay: how each stage of the pipeline is drawn into one pose's row.

A layer is a small record. Red and blue are drawn whole, and so is magenta, the result, on top of all.
Yellow and cyan appear only where they CHANGED something, with a light fill between before and after;
where a stage did nothing, nothing covers the curve below (figures 6 to 10).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
import pyqtgraph as pg
from numpy.typing import NDArray
from PySide6.QtCore import QLineF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from .. import theme
from ..theme import StageStyle
from .stage_lines import Line, PoseLines, change
from .time_axis import TimeAxis

Array = NDArray[np.float64]

#: Opacity (of 255) of the fill between a stage and the one before.
FILL = 40
#: Rows lower than this (pixels) have a thinner final line.
LOW = 30
#: So has a line whose knots are nearer than this (mean, pixels).
CROWDED = 3.0
#: With more knots per pixel than this, the area that a stage changed is not filled.
FILLED = 4.0


@dataclass(frozen=True)
class RowPlace:
    """Where a row's curves go: weight 0 at `base`, weight 1 `tall` pixels above it."""

    axis: TimeAxis
    base: float
    tall: float

    def seen(self, line: Line) -> Line:
        """What is visible of a line, thinned to what its pixels can show."""
        return line.seen(self.axis.left, self.axis.right).thinned(self.axis.left, 1.0 / self.axis.scale)

    def points(self, t: Array, v: Array) -> tuple[Array, Array]:
        """Pixels of knots."""
        # The raster engine cannot hold coordinates far outside the widget.
        return np.clip(self.axis.px(t), -4000.0, self.axis.x1 + 4000.0), self.base - self.tall * v


#: Another method's curve.
METHOD = theme.mix(theme.MUTED, theme.BRIGHT, 0.6)
#: The final curve before the last edit.
_GHOST = StageStyle("Before", theme.MUTED, 1.0, ())

Draw = Callable[[QPainter, RowPlace, PoseLines, StageStyle], None]


@dataclass(frozen=True)
class Layer:
    """One stage in the overlay.

    name        key of the stage's style in theme.STAGE_STYLES
    title       English; `style.label` is in the user's language
    z           drawn in rising order
    style       in the paper's colours; theme.STAGE_STYLES_CVD holds the others
    default_on  whether it is shown at first
    """

    name: str
    title: str
    z: int
    style: StageStyle
    default_on: bool
    draw: Draw


def _draw_red(painter: QPainter, place: RowPlace, lines: PoseLines, style: StageStyle) -> None:
    """Figure 6: every bigram's own curve, overlapping the next."""
    painter.setPen(style.pen())
    _draw_thin(painter, place, lines.red)


def _draw_green(painter: QPainter, place: RowPlace, lines: PoseLines, style: StageStyle) -> None:
    """Figure 7: the curves of the previous step, of which the stitched one keeps the highest."""
    pen = style.pen()
    pen.setColor(theme.mix(style.colour, theme.SUNKEN, 0.85))
    painter.setPen(pen)
    _draw_thin(painter, place, lines.red)


def _draw_blue(painter: QPainter, place: RowPlace, lines: PoseLines, style: StageStyle) -> None:
    painter.setPen(style.pen())
    _draw_thin(painter, place, [lines.stage["blue"]])


def _draw_yellow(painter: QPainter, place: RowPlace, lines: PoseLines, style: StageStyle) -> None:
    """Figure 8: the valleys that smoothing filled."""
    _draw_change(painter, place, lines.stage["blue"], lines.stage["yellow"], style)


def _draw_cyan(painter: QPainter, place: RowPlace, lines: PoseLines, style: StageStyle) -> None:
    """Figure 9: what a pose gave up for one of higher priority."""
    _draw_change(painter, place, lines.stage["yellow"], lines.stage["cyan"], style)


def _draw_magenta(painter: QPainter, place: RowPlace, lines: PoseLines, style: StageStyle) -> None:
    """Figure 10: the result, whole."""
    line = place.seen(lines.stage["magenta"])
    if line.t.size < 2:
        return
    crowded = line.t.size * CROWDED > place.axis.x1 - place.axis.x0
    width = 1.0 if crowded else style.width if place.tall >= LOW else max(style.width - 0.5, 1.0)
    _draw_bold(painter, place, line, QPen(style.colour, width))


def _draw_bold(painter: QPainter, place: RowPlace, line: Line, pen: QPen) -> None:
    # Separate square-capped segments: a wide antialiased polyline is twenty times as dear.
    pen.setCosmetic(True)
    pen.setCapStyle(Qt.PenCapStyle.SquareCap)
    painter.setPen(pen)
    x, y = place.points(line.t, line.v)
    k = line.rising().nonzero()[0]
    ends = zip(x[k].tolist(), y[k].tolist(), x[k + 1].tolist(), y[k + 1].tolist(), strict=True)
    painter.drawLines([QLineF(*end) for end in ends])


def _draw_thin(painter: QPainter, place: RowPlace, lines: Iterable[Line]) -> None:
    for whole in lines:
        line = place.seen(whole)
        if line.t.size > 1:
            x, y = place.points(line.t, line.v)
            painter.drawPath(pg.arrayToQPath(x, y, connect=np.append(line.rising(), False)))


def _draw_change(painter: QPainter, place: RowPlace, before: Line, after: Line, style: StageStyle) -> None:
    axis = place.axis
    # Not thinned: the extremes of two lines in a column differ even where the lines do not.
    changed = change(before.seen(axis.left, axis.right), after.seen(axis.left, axis.right))
    if not changed:
        return
    x, upper = place.points(changed.t, changed.after)
    if changed.t.size < FILLED * (axis.x1 - axis.x0):
        fill = QColor(style.colour)
        fill.setAlpha(FILL)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(fill)
        # The edges are drawn as lines anyway, and without antialiasing a fill costs a tenth.
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        lower = place.base - place.tall * changed.before
        for a, b in _runs(changed.differs):
            there = slice(a, b + 1)
            xs = np.concatenate((x[there], x[there][::-1]))
            ys = np.concatenate((upper[there], lower[there][::-1]))
            painter.drawPolygon(pg.functions.arrayToQPolygonF(xs, ys))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
    painter.setPen(style.pen())
    painter.drawPath(pg.arrayToQPath(x, upper, connect=np.append(changed.differs, False)))


def _runs(mask: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Begin and end (exclusive) of each run of True."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], mask, [False])).astype(np.int8)))
    return list(zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True))


def _layer(z: int, name: str, draw: Draw, *, default_on: bool = True) -> Layer:
    style = theme.STAGE_STYLES[name]
    return Layer(name, style.title, z, style, default_on, draw)


#: In pipeline order.
LAYERS: tuple[Layer, ...] = (
    _layer(0, "red", _draw_red),
    _layer(1, "green", _draw_green, default_on=False),  # the same curves as red: for figure 7, instead of red
    _layer(2, "blue", _draw_blue),
    _layer(3, "yellow", _draw_yellow),
    _layer(4, "cyan", _draw_cyan),
    _layer(5, "magenta", _draw_magenta),
)


def draw_ghost(painter: QPainter, place: RowPlace, before: PoseLines, now: PoseLines) -> None:
    """Under everything, the final curve as it was before, in grey where it was another one."""
    _draw_change(painter, place, now.stage["magenta"], before.stage["magenta"], _GHOST)


def draw_other(painter: QPainter, place: RowPlace, lines: PoseLines, style: StageStyle) -> None:
    """The final curve of another curve set, dashed beside the present one's solid line."""
    pen = QPen(theme.mix(style.colour, theme.BRIGHT, 0.45), 1)
    pen.setDashPattern([5, 4])
    painter.setPen(pen)
    _draw_thin(painter, place, [lines.stage["magenta"]])


def draw_method(painter: QPainter, place: RowPlace, line: Line) -> None:
    """What another method makes of the sentence: grey, dashed, under the stages' own colours."""
    pen = QPen(METHOD, 1.4)
    pen.setDashPattern([4, 3])
    painter.setPen(pen)
    _draw_thin(painter, place, [line])


def draw_origin(painter: QPainter, place: RowPlace, curve: Line, style: StageStyle) -> None:
    """The one red curve that made the place under the mouse, brighter than the others."""
    _draw_bold(painter, place, curve, QPen(theme.mix(style.colour, theme.BRIGHT, 0.75), 2))
