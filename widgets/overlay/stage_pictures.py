"""The pictures that the stage overlay keeps: the ground behind and below its rows, and the curves of each row."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

from PySide6.QtCore import QPointF, QRect, QRectF, Qt
from PySide6.QtGui import QPainter, QPen, QPixmap

from core_pipeline.phonemes import Pair
from core_pipeline.pipeline import Stages

from .. import theme
from . import stage_backdrop as backdrop
from .stage_footer import ROW, Footer, Span
from .stage_layers import LAYERS, RowPlace, draw_ghost, draw_method, draw_origin, draw_other
from .stage_lines import Line, PoseLines
from .stage_picking import Reading, curve_of
from .stage_rows import Row
from .time_axis import TimeAxis

#: Pixels right of the axis.
RIGHT = 10


@dataclass(frozen=True)
class Sheet:
    """What is drawn on: the overlay's size in pixels, device pixels to one of these, and seconds across."""

    width: int
    height: int
    ratio: float
    axis: TimeAxis

    def pixmap(self, height: int) -> QPixmap:
        """As wide as the overlay."""
        pixmap = QPixmap(round(self.width * self.ratio), round(height * self.ratio))
        pixmap.setDevicePixelRatio(self.ratio)
        return pixmap


@dataclass(frozen=True, eq=False)
class Backdrop:
    """What stands behind and below the rows.

    rows_height  pixels above the black rows
    hidden       how many poses have no row for want of room
    pair         every occurrence of it is tinted, and the one at `index`, over `span` in seconds, more so
    sources      the language's phone for each of the schedule, or none
    """

    stages: Stages
    rows: Sequence[Row]
    rows_height: int
    hidden: int
    pair: Pair | None
    index: int | None
    span: tuple[float, float] | None
    loop: tuple[float, float] | None
    sources: Sequence[str]
    words: Sequence[Span]


@dataclass(frozen=True, eq=False)
class RowCurves:
    """What one row has: its pose at all stages; and before, by another set, by another method, where there is any."""

    lines: PoseLines
    ghost: PoseLines | None
    other: PoseLines | None
    method: Line | None


def place_of(row: Row, axis: TimeAxis) -> RowPlace:
    """Where 0 and 1 are in a row."""
    above = min(max(row.height // 10, 2), 8)
    below = 3 if row.height < 40 else 5
    return RowPlace(axis, row.bottom - below - 0.5, float(row.height - above - below))


def draw_ground(sheet: Sheet, what: Backdrop, names: backdrop.RowNames, footer: Footer) -> QPixmap:
    """Stripes, spans and boundaries; below them the black rows."""
    ground, axis, tall = sheet.pixmap(sheet.height), sheet.axis, what.rows_height
    ground.fill(theme.BACKGROUND)
    painter = QPainter(ground)
    for row in what.rows[1::2]:
        painter.fillRect(0, row.top, sheet.width, row.height, backdrop.STRIPE)
    wide = round(axis.x1 - axis.x0) + RIGHT
    painter.setClipRect(QRect(round(axis.x0) - 4, 0, wide + 4, tall))
    backdrop.draw_spans(painter, axis, what.stages.schedule, what.pair, what.span, tall)
    backdrop.draw_boundaries(painter, axis, what.stages.schedule, tall)
    painter.setClipping(False)
    if what.loop is not None:
        backdrop.draw_loop(painter, axis, what.loop, tall + ROW)
    box = QRect(0, tall, sheet.width, sheet.height - tall)
    lit = frozenset() if what.span is None or what.index is None else frozenset((what.index, what.index + 1))
    footer.draw(painter, box, axis, what.stages, what.sources, lit, what.loop, what.words)
    if what.hidden:
        painter.setFont(names.small)
        painter.setPen(theme.WEAK)
        aside = QRect(0, tall, round(axis.x0) - 8, ROW - 1)
        painter.drawText(aside, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight, f"+{what.hidden}")
    painter.end()
    return ground


def draw_row(
    sheet: Sheet,
    row: Row,
    curves: RowCurves,
    names: backdrop.RowNames,
    shown: Collection[str],
    styles: Mapping[str, theme.StageStyle],
) -> QPixmap:
    """A row's curves on transparent ground.

    shown   names of the layers
    styles  a layer's name → how its line looks
    """
    pixmap, axis = sheet.pixmap(row.height), sheet.axis
    pixmap.fill(Qt.GlobalColor.transparent)
    place = place_of(row, axis)
    painter = QPainter(pixmap)
    names.draw(painter, row, axis.x0)
    painter.translate(0, -row.top)
    if not row.idle:
        base = round(place.base + 0.5)
        painter.fillRect(QRect(round(axis.x0), base, round(axis.x1 - axis.x0), 1), backdrop.BASE)
    if row.height >= backdrop.SCALED:
        names.draw_scale(painter, place)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
    _clip(painter, row, axis)
    if curves.ghost is not None:
        draw_ghost(painter, place, curves.ghost, curves.lines)
    for layer in LAYERS:
        if layer.name in shown:
            layer.draw(painter, place, curves.lines, styles[layer.name])
    if curves.other is not None:
        draw_other(painter, place, curves.other, styles["magenta"])
    if curves.method is not None:
        draw_method(painter, place, curves.method)
    painter.end()
    return pixmap


def draw_reading(
    painter: QPainter, row: Row, axis: TimeAxis, stages: Stages, reading: Reading, style: theme.StageStyle
) -> None:
    """Under the mouse: the curve that made this place, and the final weight."""
    place = place_of(row, axis)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
    _clip(painter, row, axis)
    curve = None if reading.index is None else curve_of(stages, reading.index, reading.pose)
    if curve is not None:
        draw_origin(painter, place, Line(curve.t, curve.v), style)
    at = QPointF(axis.px(reading.time), place.base - place.tall * reading.values[-1])
    painter.setPen(QPen(theme.BACKGROUND, 1))
    painter.setBrush(theme.BRIGHT)
    painter.drawEllipse(at, 3.2, 3.2)
    painter.setClipping(False)


def _clip(painter: QPainter, row: Row, axis: TimeAxis) -> None:
    painter.setClipRect(QRectF(axis.x0 - 2, row.top, axis.x1 - axis.x0 + 4, row.height))
