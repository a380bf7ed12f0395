"""Cyan: where two poses clash, the one of lower priority gives way (section 3.2.2, figure 9).

    upper      ___/‾\\___       cap = C − upper where upper > 0, none elsewhere
    lower      ‾‾‾\\_/‾‾‾       lower := min(lower, max(0, cap))

The printed formula, c_b − (C − c_a − c_b), has the wrong sign: it would raise c_b. We subtract the
excess, so that the sum is C. See README, "Where the paper leaves room".

Where the upper pose becomes active the cap begins with a step. A step is drawn as a ramp OUTSIDE the
upper pose's support, at most 1 ms wide, so that the sum never exceeds C where both are active.
One pass over the poses in descending priority is enough: a pose is final before it limits others.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

from .settings import Settings
from .timewarp import RAMP
from .tracks import WIDTH, ZERO, Array, Tracks, apart, joined, minimal

#: The cap where the upper pose is not active; weights are at most 1.
FREE = 1.0


def constrain(tracks: Tracks, settings: Settings) -> Tracks:
    """Lower the lower-priority pose of each constrained pair until c_a + c_b ≤ C wherever both are active."""
    changed: dict[int, tuple[Array, Array]] = {}

    def lane(pose: int) -> tuple[Array, Array]:
        return changed.get(pose) or tracks.lane(pose)

    for pose in reversed(settings.priorities):
        if pose not in tracks.poses:
            continue
        low = tracks.poses.index(pose)
        x, v = lane(low)
        if x.size < 3:
            continue
        caps = []
        for other, limit in settings.clashes.get(pose, ()):
            if other not in tracks.poses:
                continue
            high = tracks.poses.index(other)
            xa, va = lane(high)
            if xa.size >= 3:
                caps.append(_cap(xa + (low - high) * tracks.stride, va, limit))
        if caps:
            changed[low] = minimal(*_lower_envelope([(x, v), *caps]))
    if not changed:
        return tracks
    lanes = [lane(p) for p in range(len(tracks.poses))]
    return tracks.with_knots(np.concatenate([x for x, _ in lanes]), np.concatenate([v for _, v in lanes]))


def _cap(x: Array, v: Array, limit: float) -> tuple[Array, Array]:
    """What the lower pose may reach at most: limit − v where v > 0, FREE elsewhere; within 0 and FREE."""
    cap = np.clip(limit - v, 0.0, FREE)
    xs: list[Array] = [x, np.array([x[0] - RAMP, x[-1] + RAMP])]
    caps: list[Array] = [cap, np.array([FREE, FREE])]
    for corner in (limit - FREE, limit):  # where v passes these inside a segment the clipped cap has a corner
        over = v > corner
        i = (over[1:] != over[:-1]).nonzero()[0]
        if i.size:
            xs.append(x[i] + (corner - v[i]) / (v[i + 1] - v[i]) * (x[i + 1] - x[i]))
            caps.append(np.full(i.size, min(limit - corner, FREE)))
    # Every gap in the support (two zero knots in a row) is free, but for a ramp at either end.
    zero = v <= ZERO
    j = (zero[1:] & zero[:-1]).nonzero()[0]
    ramp = np.minimum(RAMP, (x[j + 1] - x[j]) / 3)
    xs += [x[j] + ramp, x[j + 1] - ramp]
    caps.append(np.full(2 * j.size, FREE))
    at = np.concatenate(xs)
    order = at.argsort(kind="stable")
    return at[order], np.concatenate(caps)[order]


def _lower_envelope(curves: list[tuple[Array, Array]]) -> tuple[Array, Array]:
    """The minimum of the first curve and the others, over the first one's knots' range."""
    first = curves[0][0]
    x = np.sort(np.concatenate([xs for xs, _ in curves]), kind="stable")
    x = x[x.searchsorted(first[0]) : x.searchsorted(first[-1], side="right")]
    values = np.array([np.interp(x, xs, vs) for xs, vs in curves])
    lowest = values.argmin(0)
    i = (lowest[1:] != lowest[:-1]).nonzero()[0]
    if i.size:  # another curve is the lowest at knot i+1 than at knot i: candidates are all crossings between them
        here, there = values[:, i], values[:, i + 1]
        one, two = _pairs(len(curves))
        d0, d1 = here[one] - here[two], there[one] - there[two]
        pair, k = (d0 * d1 < 0).nonzero()
        f = d0[pair, k] / (d0[pair, k] - d1[pair, k])
        left, width = x[i[k]], x[i[k] + 1] - x[i[k]]
        clear = np.minimum(f, 1 - f) * width > WIDTH
        crossing = (here[:, k] + f * (there[:, k] - here[:, k])).min(0)
        x, v = joined(x, values.min(0), (left + f * width)[clear], crossing[clear])
    else:
        v = values.min(0)
    v[v < ZERO] = 0.0
    return apart(x, v)


@cache
def _pairs(count: int) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Every pair of `count` curves."""
    return np.triu_indices(count, 1)
