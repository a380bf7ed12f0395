"""A sampled curve → one with few keys, as an animator would have drawn it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .curves import Array, Curve


def simplified(t: Array, v: Array, tolerance: float) -> Curve:
    """A curve with few keys near the points (t, v), (m,) each, t rising in [0, 1].

    The keys' times are those of Ramer, Douglas and Peucker (1972–73) with heights measured upright; their values
    are then the best fit to all points, so that the curve's area is kept. Rest at 0 stays rest.
    """
    if t.size == 1:
        return Curve(t, v)
    keep = np.zeros(t.size, bool)
    keep[[0, -1]] = True
    stretches = [(0, t.size - 1)]
    while stretches:
        a, b = stretches.pop()
        if b - a < 2:
            continue
        chord = v[a] + (v[b] - v[a]) / (t[b] - t[a]) * (t[a + 1 : b] - t[a])
        away = np.abs(v[a + 1 : b] - chord)
        k = int(away.argmax())
        if away[k] > tolerance:
            keep[a + 1 + k] = True
            stretches += [(a, a + 1 + k), (a + 1 + k, b)]
    return Curve(t[keep], _fitted(t, v, keep.nonzero()[0]))


def _fitted(t: Array, v: Array, keys: NDArray[np.intp]) -> Array:
    """Values at the keys so that straight lines between them come nearest to all points; keys at 0 stay there."""
    hats = np.array([np.interp(t, t[keys], row) for row in np.eye(keys.size)]).T
    moves = v[keys] > 0
    fit = np.zeros(keys.size)
    if moves.any():
        fit[moves] = np.linalg.lstsq(hats[:, moves], v, rcond=None)[0]
    return np.clip(fit, 0.0, 1.0)
