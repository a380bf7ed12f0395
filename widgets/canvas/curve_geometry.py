"""Curves in pixels: where they lie on the canvas and how far they may be moved. No Qt."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from core_pipeline.curves import MIN_GAP, Curve
from core_pipeline.spline import interpolate

Array = NDArray[np.float64]

#: Pixels between two points of a drawn spline.
SAMPLE_STEP = 3.0


@dataclass(frozen=True)
class View:
    """Normalised time and weight → pixels: x = left + width·t, y = bottom − height·v.

    width and height are pixels per unit, > 0; `first` and `last` bound the visible times.
    """

    left: float = 0.0
    width: float = 1.0
    bottom: float = 0.0
    height: float = 1.0
    first: float = 0.0
    last: float = 1.0

    def points(self, t: Array, v: Array) -> Array:
        """Pixels (n, 2) of n values."""
        return np.column_stack((self.left + self.width * t, self.bottom - self.height * v))

    def x(self, t: float) -> float:
        """Pixel column of a time."""
        return self.left + self.width * t

    def y(self, v: float) -> float:
        """Pixel row of a weight."""
        return self.bottom - self.height * v

    def t(self, x: float) -> float:
        """Time at a pixel column; may lie outside [0, 1]."""
        return (x - self.left) / self.width

    def v(self, y: float) -> float:
        """Weight at a pixel row; may lie outside [0, 1]."""
        return (self.bottom - y) / self.height


def spline_points(curve: Curve, kind: str, view: View) -> Array:
    """Pixels (n, 2) of the visible part of the smooth curve, held flat outside its keys."""
    lo, hi = np.clip((view.first, view.last), 0.0, 1.0)
    count = max(2, int((hi - lo) * view.width / SAMPLE_STEP))
    # The keys are among the samples, or a peak would flicker while it is dragged.
    inside = curve.t[(curve.t > lo) & (curve.t < hi)]
    at = np.sort(np.concatenate((np.linspace(lo, hi, count), inside)))
    return view.points(at, interpolate(curve.t, curve.v, kind, at))


def distance_to_line(points: Array, x: float, y: float) -> float:
    """Pixels from (x, y) to the polyline through `points` (n, 2); infinite for none."""
    if len(points) == 0:
        return float("inf")
    target = np.array((x, y))
    start, along = points[:-1], np.diff(points, axis=0)
    if len(along) == 0:
        return float(np.hypot(*(points[0] - target)))
    length = np.maximum((along * along).sum(axis=1), 1e-12)
    share = np.clip(((target - start) * along).sum(axis=1) / length, 0.0, 1.0)
    offset = start + share[:, None] * along - target
    return float(np.sqrt((offset * offset).sum(axis=1).min()))


def nearest_key(points: Array, x: float, y: float) -> tuple[float, int]:
    """(distance in pixels, index) of the point nearest to (x, y); `points` is not empty."""
    distances = np.hypot(points[:, 0] - x, points[:, 1] - y)
    index = int(distances.argmin())
    return float(distances[index]), index


def feasible(curves: Mapping[str, Curve], chosen: Mapping[str, Sequence[int]]) -> tuple[float, float, float, float]:
    """How far the chosen keys may move as one body: (least dt, most dt, least dv, most dv).

    They keep MIN_GAP from every key that stays, and remain within 0 and 1. No shift is always feasible,
    even where keys already stand nearer than MIN_GAP.
    """
    dt_lo, dt_hi, dv_lo, dv_hi = -1.0, 1.0, -1.0, 1.0
    for pose, indices in chosen.items():
        t, v = curves[pose].t, curves[pose].v
        moving = np.zeros(t.size + 2, dtype=bool)
        moving[np.asarray(indices, dtype=np.intp) + 1] = True
        # Walls: the neighbours that stay, and 0 and 1 beyond the ends.
        left = np.concatenate(([0.0], t[:-1] + MIN_GAP))
        right = np.concatenate((t[1:] - MIN_GAP, [1.0]))
        at_left = moving[1:-1] & ~moving[:-2]
        at_right = moving[1:-1] & ~moving[2:]
        dt_lo = max(dt_lo, float(np.minimum(left - t, 0.0)[at_left].max()))
        dt_hi = min(dt_hi, float(np.maximum(right - t, 0.0)[at_right].min()))
        heights = v[moving[1:-1]]
        dv_lo, dv_hi = max(dv_lo, -float(heights.min())), min(dv_hi, 1.0 - float(heights.max()))
    return dt_lo, dt_hi, dv_lo, dv_hi


def feasible_scale(
    curves: Mapping[str, Curve], chosen: Mapping[str, Sequence[int]], pivot: tuple[float, float]
) -> tuple[float, float, float, float]:
    """How far the chosen keys may be stretched about `pivot` (t, v): (least, most in time, least, most in weight).

    The same walls as `feasible`, and chosen keys keep MIN_GAP among themselves; factor 1 is always feasible.
    """
    time, weight = (0.0, np.inf), (0.0, np.inf)
    for pose, indices in chosen.items():
        t, v = curves[pose].t, curves[pose].v
        at = np.asarray(indices, dtype=np.intp)
        moving = np.zeros(t.size + 2, dtype=bool)
        moving[at + 1] = True
        left = np.minimum(np.concatenate(([0.0], t[:-1] + MIN_GAP)), t)
        right = np.maximum(np.concatenate((t[1:] - MIN_GAP, [1.0])), t)
        at_left = moving[1:-1] & ~moving[:-2]
        at_right = moving[1:-1] & ~moving[2:]
        time = _narrowed(time, t[at_left] - pivot[0], left[at_left] - pivot[0], above=True)
        time = _narrowed(time, t[at_right] - pivot[0], right[at_right] - pivot[0], above=False)
        gaps = np.diff(t)[moving[1:-2] & moving[2:-1]]
        time = _narrowed(time, gaps, np.minimum(gaps, MIN_GAP), above=True)
        weight = _narrowed(weight, v[at] - pivot[1], np.full(at.size, -pivot[1]), above=True)
        weight = _narrowed(weight, v[at] - pivot[1], np.full(at.size, 1.0 - pivot[1]), above=False)
    return min(time[0], 1.0), max(time[1], 1.0), min(weight[0], 1.0), max(weight[1], 1.0)


def _narrowed(span: tuple[float, float], distance: Array, wall: Array, *, above: bool) -> tuple[float, float]:
    """The factors s of `span` with s·distance ≥ wall (`above`) or ≤ wall, for every one."""
    lo, hi = span
    for d, w in zip(distance.tolist(), wall.tolist(), strict=True):
        if abs(d) < 1e-9:
            continue
        if (d > 0) == above:
            lo = max(lo, w / d)
        else:
            hi = min(hi, w / d)
    return lo, hi


def placed(curve: Curve, indices: Sequence[int], t: Array, v: Array) -> Curve:
    """With the keys at `indices` at feasible new places; values come out tidy, to six decimals."""
    times, values = curve.t.copy(), curve.v.copy()
    at = np.asarray(indices, dtype=np.intp)
    times[at] = np.clip(t, 0.0, 1.0)
    values[at] = np.round(np.clip(v, 0.0, 1.0), 6)
    tidy = times.copy()
    tidy[at] = np.round(times[at], 6)
    # Keys of an imported curve may stand too near for six decimals.
    return Curve(tidy if (np.diff(tidy) > 0).all() else times, values)


def shifted(curve: Curve, indices: Sequence[int], dt: float, dv: float) -> Curve:
    """With the keys at `indices` moved by a feasible shift."""
    at = np.asarray(indices, dtype=np.intp)
    return placed(curve, indices, curve.t[at] + dt, curve.v[at] + dv)


def scaled(curve: Curve, indices: Sequence[int], pivot: tuple[float, float], factor_t: float, factor_v: float) -> Curve:
    """With the keys at `indices` stretched about `pivot` by feasible factors."""
    at = np.asarray(indices, dtype=np.intp)
    t, v = curve.t[at], curve.v[at]
    # Factor 1 leaves the very numbers, whatever rounding would do to them.
    new_t = t if factor_t == 1 else pivot[0] + factor_t * (t - pivot[0])
    new_v = v if factor_v == 1 else pivot[1] + factor_v * (v - pivot[1])
    return placed(curve, indices, new_t, new_v)
