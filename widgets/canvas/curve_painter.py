"""Draws the curve canvas: grid, phone boundary, ghost, curves, what is played, selection, marquee.

Everything is one graphics item that paints in pixels. An antialiased pen wider than one pixel costs
many times a thin one, so only the active curve is bold, and it is stroked in pieces; nothing but the
marquee is translucent.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPen, QPolygonF
from PySide6.QtWidgets import QStyleOptionGraphicsItem, QWidget

from core_pipeline.curves import Curve

from .. import theme
from .curve_axes import grid_values
from .curve_controller import CurveController
from .curve_geometry import Array, spline_points

#: Pixels between the dots of a played curve.
DOT_STEP = 5.0

BOLD = 2.4

#: Points of the bold line that are stroked in one go: the stroker's cost rises faster than their number.
PIECE = 32

_GHOST = theme.mix(theme.GHOST, theme.BACKGROUND, 0.85)
_BOUNDARY = QColor("#4a5058")
_MET = theme.mix(theme.HIGHLIGHT, theme.BACKGROUND, 0.5)
_BOX = theme.mix(theme.LINK, theme.BACKGROUND, 0.7)


def polygon(points: Array) -> QPolygonF:
    """A Qt polygon of pixels (n, 2)."""
    return QPolygonF(pg.functions.arrayToQPolygonF(points[:, 0], points[:, 1]))


def dots_along(points: Array) -> Array:
    """Points (m, 2) every DOT_STEP pixels along a polyline (n, 2)."""
    steps = np.hypot(*np.diff(points, axis=0).T)
    way = np.concatenate(([0.0], np.cumsum(steps)))
    at = np.arange(0.0, way[-1], DOT_STEP)
    return np.column_stack((np.interp(at, way, points[:, 0]), np.interp(at, way, points[:, 1])))


class CurveItem(pg.GraphicsObject):
    """The one item of the canvas. Reads the controller; is told ghost, played curves, labels, what to leave out."""

    def __init__(self, controller: CurveController) -> None:
        super().__init__()
        self.controller = controller
        self.ghost: Mapping[str, Curve] = {}
        self.played: Mapping[str, tuple[Array, Array]] = {}
        self.phones: tuple[str, str] = ("", "")
        self.empty_text = ""
        self.polygon = True

    def boundingRect(self) -> QRectF:
        """Constant, larger than any view: the scene index is never rebuilt and nothing rescales."""
        return QRectF(-1.0, -1.0, 3.0, 3.0)

    def paint(self, painter: QPainter, _option: QStyleOptionGraphicsItem, _widget: QWidget | None = None) -> None:
        """In scene pixels, whatever the zoom."""
        inverse, _ = self.sceneTransform().inverted()
        painter.setWorldTransform(inverse * painter.worldTransform())
        box = self.getViewBox()
        area = box.mapRectToScene(box.boundingRect())
        self._paint_grid(painter, area)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        self._paint_ghost(painter)
        drawn = self.controller.drawn()
        for pose in reversed(drawn):
            if pose != self.controller.active:
                self._paint_curve(painter, pose)
        self._paint_played(painter)
        if drawn and drawn[0] == self.controller.active:
            self._paint_active(painter, drawn[0])
        self._paint_met(painter, area)
        self._paint_box(painter)
        self._paint_selection(painter)
        self._paint_band(painter)
        if not self.controller.curves and self.empty_text:
            self._paint_empty(painter, area)

    def _paint_grid(self, painter: QPainter, area: QRectF) -> None:
        view = self.controller.view
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        _, times = grid_values(view.t(area.left()), view.t(area.right()), area.width())
        _, weights = grid_values(view.v(area.bottom()), view.v(area.top()), area.height())
        lines = [QLineF(view.x(t), area.top(), view.x(t), area.bottom()) for t in times]
        lines += [QLineF(area.left(), view.y(v), area.right(), view.y(v)) for v in weights]
        painter.setPen(theme.GRID)
        painter.drawLines(lines)
        x = round(view.x(self.controller.boundary))
        if not any(self.phones) or not area.left() < x < area.right():
            return
        painter.setPen(QPen(_BOUNDARY, 1, Qt.PenStyle.DashLine))
        painter.drawLine(QLineF(x, area.top(), x, area.bottom()))
        painter.setPen(theme.MUTED)
        height = QFontMetricsF(painter.font()).height() + 4
        first, second = self.phones
        left = QRectF(area.left(), area.top(), x - 7 - area.left(), height)
        right = QRectF(x + 8, area.top(), area.right() - x - 8, height)
        painter.drawText(left, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter, first)
        painter.drawText(right, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter, second)

    def _paint_empty(self, painter: QPainter, area: QRectF) -> None:
        where = Qt.AlignmentFlag.AlignTop if self.ghost else Qt.AlignmentFlag.AlignVCenter  # not over the ghost
        how = where | Qt.AlignmentFlag.AlignHCenter | Qt.TextFlag.TextWordWrap
        room = painter.boundingRect(area.adjusted(20, 20, -20, -20), how, self.empty_text)
        painter.fillRect(room.adjusted(-10, -6, 10, 6), theme.BACKGROUND)
        painter.setPen(theme.MUTED)
        painter.drawText(room, how, self.empty_text)

    def _paint_ghost(self, painter: QPainter) -> None:
        control = self.controller
        painter.setPen(QPen(_GHOST, 1))
        for pose, curve in self.ghost.items():
            if pose in control.visible and curve is not control.curves.get(pose):
                if not control.curves:  # a suggestion: nothing else tells which pose is which
                    colour = theme.mix(self._colour(pose), theme.BACKGROUND, 0.75)
                    painter.setPen(QPen(colour, 1, Qt.PenStyle.DashLine))
                painter.drawPolyline(polygon(spline_points(curve, control.spline, control.view)))

    def _colour(self, pose: str) -> QColor:
        control = self.controller
        colour = theme.pose_colour(pose, control.poses.index(pose))
        return theme.mix(colour, theme.BACKGROUND, 0.5) if pose in control.locked else colour

    def _paint_curve(self, painter: QPainter, pose: str) -> None:
        colour = self._colour(pose)
        keys = self.controller.keys_px(pose)
        self._paint_polygon(painter, keys, theme.mix(colour, theme.BACKGROUND, 0.35))
        painter.setPen(QPen(theme.mix(colour, theme.BACKGROUND, 0.8), 1))
        painter.drawPolyline(polygon(self.controller.spline_px(pose)))
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(colour)
        for x, y in keys:
            painter.drawEllipse(QPointF(x, y), 2.8, 2.8)
        painter.setBrush(Qt.BrushStyle.NoBrush)

    def _paint_polygon(self, painter: QPainter, keys: Array, colour: QColor) -> None:
        if self.polygon:
            painter.setPen(QPen(colour, 1))
            painter.drawPolyline(polygon(keys))

    def _paint_active(self, painter: QPainter, pose: str) -> None:
        colour = self._colour(pose)
        keys = self.controller.keys_px(pose)
        self._paint_polygon(painter, keys, theme.mix(colour, theme.BACKGROUND, 0.6))
        pen = QPen(colour, BOLD, Qt.PenStyle.SolidLine, Qt.PenCapStyle.SquareCap, Qt.PenJoinStyle.BevelJoin)
        painter.setPen(pen)
        points = self.controller.spline_px(pose)
        for start in range(0, len(points) - 1, PIECE):
            painter.drawPolyline(polygon(points[start : start + PIECE + 1]))
        painter.setPen(QPen(theme.BACKGROUND, 1))
        painter.setBrush(colour)
        for x, y in keys:
            painter.drawEllipse(QPointF(x, y), 4.5, 4.5)
        painter.setBrush(Qt.BrushStyle.NoBrush)

    def _paint_played(self, painter: QPainter) -> None:
        control = self.controller
        line = self.played.get(control.active)
        if line is None or control.active not in control.visible or len(line[0]) < 2:
            return
        pen = QPen(theme.mix(self._colour(control.active), theme.BRIGHT, 0.55), 1.6)
        pen.setCapStyle(Qt.PenCapStyle.RoundCap)
        painter.setPen(pen)
        painter.drawPoints(polygon(dots_along(control.view.points(*line))))

    def _paint_selection(self, painter: QPainter) -> None:
        control = self.controller
        painter.setPen(QPen(theme.BACKGROUND, 1))
        painter.setBrush(theme.BRIGHT)
        for pose, index in control.selection:
            x, y = control.keys_px(pose)[index]
            painter.drawEllipse(QPointF(x, y), 5.0, 5.0)
        if control.hover is not None:
            x, y = control.keys_px(control.hover[0])[control.hover[1]]
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(QPen(theme.BRIGHT, 1))
            painter.drawEllipse(QPointF(x, y), 8.0, 8.0)

    def _paint_met(self, painter: QPainter, area: QRectF) -> None:
        """A line along every magnet that holds a dragged key."""
        times, weights = self.controller.met()
        if not times and not weights:
            return
        view = self.controller.view
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        painter.setPen(_MET)
        for t in times:
            painter.drawLine(QLineF(round(view.x(t)), area.top(), round(view.x(t)), area.bottom()))
        for v in weights:
            painter.drawLine(QLineF(area.left(), round(view.y(v)), area.right(), round(view.y(v))))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)

    def _paint_box(self, painter: QPainter) -> None:
        control = self.controller
        box = control.box() if control.band is None else None
        if box is None:
            return
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        painter.setPen(QPen(_BOX, 1, Qt.PenStyle.DotLine))
        left, top, right, bottom = (round(side) for side in box.corners(control.view))
        painter.drawRect(left, top, right - left, bottom - top)
        painter.setPen(QPen(theme.BACKGROUND, 1))
        for handle, (x, y) in box.handles(control.view).items():
            painter.setBrush(theme.BRIGHT if handle == control.hover_handle else theme.LINK)
            painter.drawRect(round(x) - 4, round(y) - 4, 8, 8)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)

    def _paint_band(self, painter: QPainter) -> None:
        if self.controller.band is None:
            return
        x0, y0, x1, y1 = self.controller.band
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        painter.setPen(QPen(theme.LINK, 1, Qt.PenStyle.DashLine))
        fill = QColor(theme.ACCENT)
        fill.setAlpha(36)
        painter.setBrush(fill)
        painter.drawRect(QRectF(QPointF(x0, y0), QPointF(x1, y1)).normalized())
