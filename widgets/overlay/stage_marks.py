"""Marks in the stage overlay: small orange signs where a bigram is weak, each with its reason.

A mark stands in the row of its pose, on its final curve's ground line; without a pose, or with a pose that has
no row, it stands at the top of the overlay.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QColor, QPainter, QPolygonF

from core_pipeline.phonemes import Pair

from .. import theme
from .stage_rows import Row
from .time_axis import TimeAxis

#: Half a mark's width, and its height, in pixels.
HALF, TALL = 4, 7
#: The pointer need not hit it exactly.
NEAR = 6


@dataclass(frozen=True)
class Mark:
    """Something to look at.

    time     seconds
    pose     the row it stands in, "" for the top of all
    serious  drawn full; a mere hint is drawn as an outline
    """

    pair: Pair
    time: float
    pose: str
    reason: str
    serious: bool = True


RowOf = Callable[[str], Row | None]


def place_of(mark: Mark, axis: TimeAxis, row_of: RowOf) -> QPointF | None:
    """Where a mark's point is; None when its time is out of sight."""
    if not axis.sees(mark.time):
        return None
    row = row_of(mark.pose) if mark.pose else None
    return QPointF(axis.px(mark.time), float(row.bottom - 2) if row is not None else float(TALL + 2))


def draw_marks(painter: QPainter, marks: Sequence[Mark], axis: TimeAxis, row_of: RowOf) -> None:
    """Triangles; those without a row point down from the top, the others up from the row's foot."""
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
    for mark in marks:
        at = place_of(mark, axis, row_of)
        if at is None:
            continue
        way = -TALL if mark.pose and row_of(mark.pose) is not None else TALL
        base = at.y() if way < 0 else at.y() - TALL
        corners = (QPointF(at.x() - HALF, base), QPointF(at.x() + HALF, base), QPointF(at.x(), base + way))
        painter.setPen(theme.WEAK if mark.serious else theme.MUTED)
        painter.setBrush(theme.WEAK if mark.serious else QColor(Qt.GlobalColor.transparent))
        painter.drawPolygon(QPolygonF(corners))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)


def mark_at(at: QPointF, marks: Sequence[Mark], axis: TimeAxis, row_of: RowOf) -> list[Mark]:
    """The marks under the pointer, the nearest first."""
    found = []
    for mark in marks:
        place = place_of(mark, axis, row_of)
        if place is not None:
            dx, dy = abs(place.x() - at.x()), abs(place.y() - TALL / 2 - at.y())
            if dx <= NEAR and dy <= NEAR + TALL / 2:
                found.append((dx + dy, mark))
    return [mark for _, mark in sorted(found, key=lambda item: item[0])]
