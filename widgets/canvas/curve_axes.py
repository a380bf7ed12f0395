"""The canvas' axes: grid lines, their numbers, and where times and weights lie in pixels."""

from __future__ import annotations

from math import ceil, floor

import pyqtgraph as pg

from .. import theme
from .curve_geometry import View

#: Least pixels between two grid lines.
LEAST_GAP = 48.0


def grid_values(first: float, last: float, pixels: float) -> tuple[float, list[float]]:
    """(step, multiples of it within both [first, last] and [0, 1]) with lines LEAST_GAP or more apart."""
    span = max(last - first, 1e-6)
    step = next((s for s in (0.01, 0.02, 0.05, 0.1, 0.2) if s / span * pixels >= LEAST_GAP), 0.5)
    low, high = max(first, 0.0), min(last, 1.0)
    numbers = range(ceil(low / step - 1e-6), floor(high / step + 1e-6) + 1)
    return step, [round(n * step, 4) for n in numbers]


class UnitAxis(pg.AxisItem):
    """Numbers from 0 to 1 at the grid lines, none beyond."""

    def __init__(self, orientation: str) -> None:
        super().__init__(orientation, pen=pg.mkPen(theme.BORDER), textPen=pg.mkPen(theme.MUTED), maxTickLength=-4)
        self.enableAutoSIPrefix(False)
        self.setStyle(hideOverlappingLabels=False)  # or the last number goes when half of it stands beyond

    def tickValues(self, minVal: float, maxVal: float, size: float) -> list[tuple[float, list[float]]]:
        """The grid's values; size in pixels."""
        return [grid_values(minVal, maxVal, size)]

    def tickStrings(self, values: list[float], _scale: float, spacing: float) -> list[str]:
        """As few decimals as the step needs."""
        decimals = 1 if spacing >= 0.1 else 2
        return [f"{value:.{decimals}f}" if value else "0" for value in values]


def view_of(box: pg.ViewBox) -> View:
    """Where times and weights of a view box lie, in scene pixels, at once after any change of its range."""
    area = box.mapRectToScene(box.boundingRect())
    (t0, t1), (v0, v1) = box.viewRange()
    width, height = max(area.width(), 1.0) / (t1 - t0), max(area.height(), 1.0) / (v1 - v0)
    return View(area.left() - t0 * width, width, area.bottom() + v0 * height, height, t0, t1)
