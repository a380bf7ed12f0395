"""From control polygon to smooth curve: the last step to weights, and what the editor draws (section 3.1.2).

The paper calls the straight lines "control curves of a smooth B-spline curve". Taken literally, as
`bspline`, a cubic cuts a three-key peak to half its height and undoes lip closures. So `pchip` is the
default: it passes through every knot and never overshoots. See README, "Where the paper leaves room".
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .settings import SPLINES

Array = NDArray[np.float64]


def interpolate(t: Array, v: Array, kind: str, at: ArrayLike) -> Array:
    """Heights at times `at` of the curve of `kind` through (or near) the knots; flat outside them.

    t     (m,) strictly rising, v (m,) in [0, 1]
    kind  "pchip", "bspline", "cardinal" or "linear" (ValueError otherwise)
    """
    x: Array = np.clip(np.asarray(at, dtype=np.float64), t[0], t[-1])
    if t.size < 2:
        return np.full(x.shape, v[0])
    if kind == "linear" or (t.size == 2 and kind in SPLINES):
        return np.asarray(np.interp(x, t, v))
    if kind == "pchip":
        return hermite(t, v, pchip_slopes(t, v), x)
    if kind == "cardinal":
        return _cardinal(t, v, x)
    if kind == "bspline":
        return _bspline(t, v, x)
    raise ValueError(f"no spline {kind!r}")


def pchip_slopes(t: Array, v: Array, first: ArrayLike = 0, last: ArrayLike = -1) -> Array:
    """Fritsch and Butland's slopes at the knots, monotone between any two of them.

    `first` and `last` hold the indices of the knots at which a curve begins and ends; several curves
    may stand one behind the other in t. Each needs at least two knots.
    """
    h = t[1:] - t[:-1]
    secant = (v[1:] - v[:-1]) / h
    a, b = secant[:-1], secant[1:]
    w1, w2 = 2 * h[1:] + h[:-1], h[1:] + 2 * h[:-1]
    slopes = np.zeros(t.size)
    # Elsewhere the curve turns, or is flat to the last digit: slope 0.
    i = ((a * b > 0) & (np.minimum(np.abs(a), np.abs(b)) > 1e-12)).nonzero()[0]
    slopes[i + 1] = (w1[i] + w2[i]) / (w1[i] / a[i] + w2[i] / b[i])
    first, last = np.atleast_1d(first), np.atleast_1d(last) % t.size
    second = np.minimum(first + 1, last - 1)  # equals `first` where there are only two knots
    slopes[first] = _end_slope(h[first], h[second], secant[first], secant[second])
    second = np.maximum(last - 2, first)
    slopes[last] = _end_slope(h[last - 1], h[second], secant[last - 1], secant[second])
    return slopes


def _end_slope(h0: Array, h1: Array, s0: Array, s1: Array) -> Array:
    """Three-point end slope that keeps the shape (Moler, Numerical Computing with MATLAB, 3.6)."""
    slope = ((2 * h0 + h1) * s0 - h0 * s1) / (h0 + h1)
    slope = np.where(slope * s0 <= 0, 0.0, slope)
    steep = (s0 * s1 <= 0) & (np.abs(slope) > 3 * np.abs(s0))
    return np.where(steep, 3 * s0, slope)


def hermite(t: Array, v: Array, slopes: Array, x: Array) -> Array:
    """Cubic Hermite through the knots with the given slopes, at x within [t[0], t[-1]]."""
    i = np.minimum(t.searchsorted(x, side="right"), t.size - 1) - 1
    h = (t[1:] - t[:-1]).take(i)
    s = (x - t.take(i)) / h
    v0, v1, d0, d1 = v.take(i), v.take(i + 1), slopes.take(i) * h, slopes.take(i + 1) * h
    rise = v1 - v0
    # v0 + s·(d0 + s·((3·rise − 2·d0 − d1) + s·(d0 + d1 − 2·rise)))
    return v0 + s * (d0 + s * ((3 * rise - 2 * d0 - d1) + s * (d0 + d1 - 2 * rise)))


def _bspline(t: Array, v: Array, x: Array) -> Array:
    """Clamped cubic B-spline, knots as control points, parametrised by time through Greville abscissae.

    Both t and v are splines of one parameter u; u(x) is found by bisection, for t(u) rises.
    """
    from scipy.interpolate import BSpline

    k = min(3, t.size - 1)
    inner = np.arange(1, t.size - k)
    knots = np.concatenate((np.zeros(k + 1), inner, np.full(k + 1, t.size - k)))
    curve = BSpline(knots, np.column_stack((t, v)), k)
    grid = np.linspace(0, t.size - k, 24 * t.size)
    points = curve(grid)
    # t(u) rises but may stand still for a moment; interp needs no more
    return np.asarray(np.interp(x, points[:, 0], points[:, 1]))


def _cardinal(t: Array, v: Array, x: Array) -> Array:
    """Cardinal spline of tension 0.5 (Catmull–Rom), clipped to [0, 1] because it overshoots."""
    slopes = np.zeros(t.size)
    slopes[1:-1] = (v[2:] - v[:-2]) / (t[2:] - t[:-2])
    return np.clip(hermite(t, v, slopes, x), 0.0, 1.0)
