"""Blue: where two bigrams overlap, the larger curve is kept (section 3.2.1, figure 7).

    even   /\\    /\\          blue  /\\  /\\
    odd      \\/\\/  \\               /  \\/  \\_/\\     = max, with a knot where they cross

The even bigrams' red curves are one function, the odd ones' another; their maximum is exact.
"""

from __future__ import annotations

import numpy as np

from .timewarp import Warped
from .tracks import WIDTH, ZERO, Array, Tracks, apart, inserted, minimal


def stitch(red: Warped) -> Tracks:
    """The maximum of the (at most two) red curves at every moment, as one track per pose."""
    x, v = _maximum(red.x, red.v, red.even)
    tracks = Tracks(red.poses, x, v, red.start, red.duration)
    return tracks.with_knots(*minimal(x, v))


def _maximum(x: Array, v: Array, even: int) -> tuple[Array, Array]:
    if not 0 < even < x.size:
        return apart(x, np.where(v < ZERO, 0.0, v)) if x.size else (x, v)
    # Each function's value at its own knots is known; only at the other's it must be looked up.
    order = x.argsort(kind="stable")  # two sorted runs: a merge
    xs = x.take(order)
    a = np.concatenate((v[:even], np.interp(x[even:], x[:even], v[:even]))).take(order)
    b = np.concatenate((np.interp(x[:even], x[even:], v[even:]), v[even:])).take(order)
    d = a - b
    top = np.maximum(a, b)
    i = (d[:-1] * d[1:] < 0).nonzero()[0]  # they cross between knots i and i+1
    if i.size:
        f = d[i] / (d[i] - d[i + 1])
        width = xs[i + 1] - xs[i]
        clear = np.minimum(f, 1 - f) * width > WIDTH
        i, f, width = i[clear], f[clear], width[clear]
        xs, top = inserted(xs, top, i, xs[i] + f * width, a[i] + f * (a[i + 1] - a[i]))
    top *= top >= ZERO
    return apart(xs, top)
