"""Yellow: a valley between two near peaks is filled to the straight line between them (section 3.2.1, figure 8).

    blue  /\\  /\\__        yellow  /‾‾‾‾\\__       while the peaks are at most 2·t_w apart
         /  \\/    \\              /      \\

Peaks are knots with no higher neighbour; a plateau is one peak, and its near edge counts. Filling can
make a peak vanish (its neighbour is higher and now joined to it), so rounds repeat until nothing
changes. Nothing is ever lowered.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .tracks import NEAR, ZERO, Array, Tracks, joined, minimal, pick

Ints = NDArray[np.intp]


def smooth(tracks: Tracks, windows: Array) -> Tracks:
    """Fill valleys between adjacent peaks no further apart than the pose's window.

    windows  (poses,) full width 2·t_w in seconds, at most 1
    """
    x, v = tracks.x, tracks.v
    filled = False
    while x.size >= 5:
        left, right, near = _near_peaks(x, v, windows, tracks.stride)
        if not near.size:
            break
        x, v = _fill(x, v, left, right)
        filled = True
        if not (near[1:] - near[:-1] == 1).any():
            break  # a wider pair can only appear where one peak took part in two fills
    return tracks.with_knots(*minimal(x, v)) if filled else tracks


def _near_peaks(x: Array, v: Array, windows: Array, stride: float) -> tuple[Ints, Ints, Ints]:
    """Knots (left, right) of adjacent peaks within the window, their edges that face each other; and which pairs."""
    dv = v[1:] - v[:-1]
    changes = (np.abs(dv) > ZERO).nonzero()[0]
    rises = dv.take(changes) > 0
    peak = (rises[:-1] & ~rises[1:]).nonzero()[0]  # up, then down: between them lies a peak or plateau
    left = changes.take(peak + 1)[:-1]  # where a peak's descent begins
    right = changes.take(peak)[1:] + 1  # where the next one's ascent ends
    window = windows.take((x.take(left) / stride).astype(np.intp))
    near = (x.take(right) - x.take(left) <= window + ZERO).nonzero()[0]
    return left.take(near), right.take(near), near


def _fill(x: Array, v: Array, left: Ints, right: Ints) -> tuple[Array, Array]:
    """l := max(l, chord) between each pair."""
    x0, v0 = x[left], v[left]
    slope = (v[right] - v0) / (x[right] - x0)
    inner = right - left - 1  # knots between the two peaks
    pair = np.repeat(np.arange(left.size), inner)
    k = np.arange(pair.size) + (left + 1 - inner.cumsum() + inner).take(pair)
    above = v[k] - (v0[pair] + slope[pair] * (x[k] - x0[pair]))
    low = above <= 1e-12
    keep = np.ones(x.size, bool)
    keep[k[low]] = False
    if low.all():
        return pick(keep, x, v)
    # The valley leaves the chord between knots k[i] and k[i+1]: a knot where it does.
    i = ((low[:-1] != low[1:]) & (pair[:-1] == pair[1:])).nonzero()[0]
    f = above[i] / (above[i] - above[i + 1])
    m = k[i]
    width = x[m + 1] - x[m]
    clear = np.minimum(f, 1 - f) * width > NEAR
    keep[m[~clear] + (f[~clear] > 0.5)] = True  # it leaves AT a knot: that knot stays
    m, f, width = m[clear], f[clear], width[clear]
    return joined(*pick(keep, x, v), x[m] + f * width, v[m] + f * (v[m + 1] - v[m]))
