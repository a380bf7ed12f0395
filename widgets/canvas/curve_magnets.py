"""Where dragged times and weights come to lie: on the grid, on a magnet that is near, or where the hand is. No Qt.

Magnets are 0, 1 and, in time, the boundary between the two phones.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from .curve_geometry import View

#: Grid of snapping, in normalised time and in weight.
SNAP_STEP = 0.05

#: Grid of a scale factor while snapping.
FACTOR_STEP = 0.1

#: How near a magnet must be without snapping, in pixels.
PULL = 5.0


def snapped(value: float, magnets: Iterable[float]) -> float:
    """The nearest of the grid lines and the magnets."""
    return min((round(value / SNAP_STEP) * SNAP_STEP, *magnets), key=lambda candidate: abs(candidate - value))


class Landing(NamedTuple):
    """How one step of a gesture lands.

    snap      everything keeps to the grid or to a magnet
    fine      nothing attracts
    boundary  normalised time between the two phones
    """

    view: View
    boundary: float
    snap: bool = False
    fine: bool = False

    @property
    def times(self) -> tuple[float, ...]:
        """Magnets in time."""
        return 0.0, 1.0, self.boundary

    @property
    def weights(self) -> tuple[float, ...]:
        """Magnets in weight."""
        return 0.0, 1.0

    def time(self, t: float) -> float:
        """Where a time lands."""
        return self._place(t, self.times, self.view.width)

    def weight(self, v: float) -> float:
        """Where a weight lands."""
        return self._place(v, self.weights, self.view.height)

    def _place(self, value: float, magnets: Sequence[float], scale: float) -> float:
        if self.fine:
            return value
        if self.snap:
            return snapped(value, magnets)
        nearest = min(magnets, key=lambda magnet: abs(magnet - value))
        return nearest if abs(nearest - value) * scale <= PULL else value

    def factor(self, factor: float, arms: Sequence[tuple[float, float, bool]]) -> float:
        """Where a scale factor lands.

        arms  of each edge of what is scaled: the pivot's place, how far the edge was from it, whether it is in time
        """
        if self.fine:
            return factor
        met = []
        for pivot, arm, in_time in arms:
            for magnet in (self.times if in_time else self.weights) if arm else ():
                wanted = (magnet - pivot) / arm
                pixels = abs((wanted - factor) * arm) * (self.view.width if in_time else self.view.height)
                if wanted > 0:
                    met.append((pixels, wanted))
        if self.snap:
            grid = round(factor / FACTOR_STEP) * FACTOR_STEP
            return min((grid, *(wanted for _, wanted in met)), key=lambda candidate: abs(candidate - factor))
        return min(((pixels, wanted) for pixels, wanted in met if pixels <= PULL), default=(0.0, factor))[1]
