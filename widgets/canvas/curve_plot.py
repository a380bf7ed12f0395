"""The plot under the hand: axes, zoom, pan, playhead and focus ring around the one item that draws the curves."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFocusEvent, QPainter, QPaintEvent, QPen, QWheelEvent
from PySide6.QtWidgets import QGraphicsLineItem, QWidget

from .. import theme
from .curve_axes import UnitAxis, view_of
from .curve_controller import CurveController
from .curve_geometry import Array
from .curve_painter import CurveItem

#: The view at rest: times and weights.
HOME = QRectF(-0.03, -0.05, 1.06, 1.10)

#: No further out than this, no nearer than LEAST.
LIMITS = QRectF(-0.25, -0.25, 1.5, 1.5)
LEAST = 0.02


class CurvePlot(pg.PlotWidget):
    """Shows what stands in a controller and tells it where things lie; the wheel zooms."""

    def __init__(self, control: CurveController, parent: QWidget | None = None) -> None:
        axes = {"left": UnitAxis("left"), "bottom": UnitAxis("bottom")}
        super().__init__(parent, background=theme.BACKGROUND, axisItems=axes, enableMenu=False)
        self._control = control
        self._item = CurveItem(control)
        self.set_suggestion("")
        self._playhead: float | None = None
        self._line = QGraphicsLineItem()
        self._line.setPen(QPen(theme.PLAYHEAD, 1))
        self._line.setZValue(100)
        self._line.hide()
        self.scene().addItem(self._line)
        self.hideButtons()
        self.getPlotItem().layout.setContentsMargins(2, 0, 12, 2)  # room for half a number at the right
        self.setLabel("left", self.tr("weight"))
        self.getAxis("left").setWidth(46)
        self._show_phones("", "")
        box = self.getViewBox()
        box.disableAutoRange()
        box.setMouseEnabled(x=False, y=False)
        box.addItem(self._item, ignoreBounds=True)
        box.sigRangeChanged.connect(self._place)
        box.sigResized.connect(self._place)
        self.frame_all()
        self.setMinimumSize(240, 160)

    def set_spline(self, kind: str) -> None:
        """How keys are joined: "pchip", "bspline", "cardinal" or "linear"."""
        self._control.set_spline(kind)
        self._item.update()

    def set_polygon(self, on: bool) -> None:
        """Whether the straight lines between keys are drawn."""
        self._item.polygon = on
        self._item.update()

    def set_suggestion(self, source: str) -> None:
        """Where the ghost of an empty bigram comes from, to be told there; "" when it is no suggestion."""
        if source:
            self._item.empty_text = self.tr("%1. Tab accepts it as a draft; or double-click to draw.").replace(
                "%1", source[:1].upper() + source[1:]
            )
        else:
            self._item.empty_text = self.tr("No curves yet: pick a pose and double-click to draw one.")
        self._item.update()

    def set_played(self, lines: Mapping[str, tuple[Array, Array]] | None) -> None:
        """What the sentence makes of the bigram: pose → (normalised times, weights); the active one is dotted."""
        self._item.played = dict(lines or {})
        self._item.update()

    def set_playhead(self, t: float | None) -> None:
        """A thin line at a normalised time; None or a time out of view hides it."""
        if t != self._playhead:
            self._playhead = t
            self._place_playhead()

    def set_boundary(self, t: float = 0.5) -> None:
        """Normalised time at which the first phone ends."""
        self._control.boundary = t
        self._item.update()

    def frame_all(self) -> None:
        """The whole bigram."""
        self._set_view(HOME)

    def frame(self) -> None:
        """The selected keys; without a selection, all."""
        control = self._control
        if not control.selection:
            self.frame_all()
            return
        keys = np.array([(control.curves[p].t[i], control.curves[p].v[i]) for p, i in control.selection])
        (t0, v0), (t1, v1) = keys.min(axis=0), keys.max(axis=0)
        wide, tall = max(t1 - t0, 0.15) * 1.3, max(v1 - v0, 0.15) * 1.3
        self._set_view(QRectF((t0 + t1 - wide) / 2, (v0 + v1 - tall) / 2, wide, tall))

    def point_of(self, t: float, v: float) -> QPointF:
        """Where a time and a weight lie on the viewport, in pixels."""
        view = self._control.view
        return QPointF(self.viewportTransform().map(QPointF(view.x(t), view.y(v))))

    @property
    def shown(self) -> QRectF:
        """The times and weights in view; y rises."""
        (t0, t1), (v0, v1) = self.getViewBox().viewRange()
        return QRectF(t0, v0, t1 - t0, v1 - v0)

    def wheelEvent(self, ev: QWheelEvent) -> None:
        """Zooms about the pointer; Ctrl only time, Shift only weight. Not while keys are held."""
        ev.accept()
        turn = ev.angleDelta().y() or ev.angleDelta().x()  # Alt turns the wheel sideways
        if not turn or self._control.busy:
            return
        held = ev.modifiers()
        factor = 0.85 ** (turn / 120)
        x, y = self._scene(ev.position())
        t, v = self._control.view.t(x), self._control.view.v(y)
        area = self.shown
        across = min(max(factor, LEAST / area.width()), LIMITS.width() / area.width())
        up = min(max(factor, LEAST / area.height()), LIMITS.height() / area.height())
        across = 1.0 if held & Qt.KeyboardModifier.ShiftModifier else across
        up = 1.0 if held & Qt.KeyboardModifier.ControlModifier else up
        left, top = t + (area.x() - t) * across, v + (area.y() - v) * up
        self._set_view(QRectF(left, top, area.width() * across, area.height() * up))

    def _pan(self, step: QPointF) -> None:
        """Moves the view by pixels."""
        view = self._control.view
        self._set_view(self.shown.translated(-step.x() / view.width, step.y() / view.height))

    def _set_view(self, area: QRectF) -> None:
        if self._control.busy:
            return
        width, height = min(area.width(), LIMITS.width()), min(area.height(), LIMITS.height())
        t = min(max(area.x(), LIMITS.left()), LIMITS.right() - width)
        v = min(max(area.y(), LIMITS.top()), LIMITS.bottom() - height)
        self.getViewBox().setRange(xRange=(t, t + width), yRange=(v, v + height), padding=0)

    def _show_phones(self, first: str, second: str) -> None:
        self._item.phones = (first, second)
        span = self.tr("normalised time  ({0} start → {1} end)").format(first, second)
        self.setLabel("bottom", span if first or second else self.tr("normalised time"))

    def _place(self, *_: object) -> None:
        self._control.set_view(view_of(self.getViewBox()))
        self._item.update()
        self._place_playhead()

    def _place_playhead(self) -> None:
        area = self._area()
        x = -1.0 if self._playhead is None else round(self._control.view.x(self._playhead))
        self._line.setVisible(area.left() <= x <= area.right())
        self._line.setLine(0, area.top(), 0, area.bottom())
        self._line.setX(x)
        # While the line runs the curves come from a cache: 0.2 ms instead of 1.0. Without it drags are faster.
        mode = self._item.CacheMode.NoCache if x < 0 else self._item.CacheMode.DeviceCoordinateCache
        if self._item.cacheMode() != mode:
            self._item.setCacheMode(mode)

    def _area(self) -> QRectF:
        box = self.getViewBox()
        return QRectF(box.mapRectToScene(box.boundingRect()))

    def _scene(self, position: QPointF) -> tuple[float, float]:
        inverse, _ = self.viewportTransform().inverted()
        point = inverse.map(position)
        return point.x(), point.y()

    def focusInEvent(self, ev: QFocusEvent) -> None:
        """Shows the focus ring."""
        super().focusInEvent(ev)
        self.viewport().update()

    def focusOutEvent(self, ev: QFocusEvent) -> None:
        """Hides the focus ring."""
        super().focusOutEvent(ev)
        self.viewport().update()

    def paintEvent(self, ev: QPaintEvent) -> None:
        """The plot, and a ring while the canvas has the keyboard."""
        super().paintEvent(ev)
        if self.hasFocus():
            painter = QPainter(self.viewport())
            painter.setPen(theme.ACCENT)
            painter.drawRect(self.viewport().rect().adjusted(0, 0, -1, -1))
