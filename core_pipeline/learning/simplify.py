"""Many samples to few keys: the keys an animator would have set."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def simplified(t: Array, v: Array, tolerance: float) -> NDArray[np.intp]:
    """Indices of the points to keep, so that straight lines stay within `tolerance` of all (Douglas and Peucker, 1973).

    Distance is measured in v alone, as weights are. The first and the last point stay.
    """
    keep = np.zeros(t.size, bool)
    keep[[0, -1]] = True
    open_ends = [(0, t.size - 1)]
    while open_ends:
        first, last = open_ends.pop()
        if last - first < 2:
            continue
        inner = np.arange(first + 1, last)
        line = np.interp(t[inner], [t[first], t[last]], [v[first], v[last]])
        gap = np.abs(v[inner] - line)
        worst = int(gap.argmax())
        if gap[worst] > tolerance:
            middle = first + 1 + worst
            keep[middle] = True
            open_ends += [(first, middle), (middle, last)]
    return keep.nonzero()[0]
