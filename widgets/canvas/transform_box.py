"""The box around two or more selected keys and its handles, by which they are scaled. No Qt."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import hypot
from typing import NamedTuple

import numpy as np

from core_pipeline.curves import Curve

from .curve_geometry import View

#: Which handle: −1 left, 1 right, 0 middle; −1 bottom, 1 top, 0 middle.
Handle = tuple[int, int]

#: Pixels from the outermost keys to the box: handles stay clear of keys.
PADDING = 14.0

#: How near the pointer must be to a handle, in pixels.
HANDLE_REACH = 7.0

#: Shorter sides in pixels have handles at their ends only.
LEAST_SIDE = 44.0


class Box(NamedTuple):
    """Times and weights from the least to the largest selected."""

    t0: float
    t1: float
    v0: float
    v1: float

    @classmethod
    def around(cls, curves: Mapping[str, Curve], chosen: Mapping[str, Sequence[int]]) -> Box | None:
        """Around the chosen keys; None when they all lie on one point, as a single one does."""
        if sum(map(len, chosen.values())) < 2:
            return None
        t = np.concatenate([curves[pose].t[list(at)] for pose, at in chosen.items()])
        v = np.concatenate([curves[pose].v[list(at)] for pose, at in chosen.items()])
        box = cls(float(t.min()), float(t.max()), float(v.min()), float(v.max()))
        return box if box.t1 > box.t0 or box.v1 > box.v0 else None

    @property
    def middle(self) -> tuple[float, float]:
        """Time and weight half way."""
        return (self.t0 + self.t1) / 2, (self.v0 + self.v1) / 2

    def edge(self, handle: Handle) -> tuple[float, float]:
        """Time and weight that the handle moves."""
        middle = self.middle
        return (self.t0, middle[0], self.t1)[handle[0] + 1], (self.v0, middle[1], self.v1)[handle[1] + 1]

    def opposite(self, handle: Handle) -> tuple[float, float]:
        """Time and weight that stay when the handle moves."""
        return self.edge((-handle[0], -handle[1]))

    def corners(self, view: View) -> tuple[float, float, float, float]:
        """Left, top, right, bottom in pixels, the padding included."""
        left, top = view.x(self.t0) - PADDING, view.y(self.v1) - PADDING
        return left, top, view.x(self.t1) + PADDING, view.y(self.v0) + PADDING

    def handles(self, view: View) -> dict[Handle, tuple[float, float]]:
        """Handle → pixel place; none that could not scale anything."""
        left, top, right, bottom = self.corners(view)
        x = (left, (left + right) / 2, right)
        y = (bottom, (top + bottom) / 2, top)
        wide, tall = self.t1 > self.t0, self.v1 > self.v0
        beside = wide and (bottom - top >= LEAST_SIDE or not tall)
        above = tall and (right - left >= LEAST_SIDE or not wide)
        corners = [(i, j) for i in (-1, 1) for j in (-1, 1)] if wide and tall else []
        sides = [(-1, 0), (1, 0)] * beside + [(0, -1), (0, 1)] * above
        return {(i, j): (x[i + 1], y[j + 1]) for i, j in corners + sides}

    def handle_at(self, view: View, x: float, y: float) -> Handle | None:
        """The nearest handle within reach."""
        near = {handle: hypot(px - x, py - y) for handle, (px, py) in self.handles(view).items()}
        best = min(near, key=lambda handle: near[handle], default=None)
        return best if best is not None and near[best] <= HANDLE_REACH else None
