"""Tracks: every pose over the whole utterance, all on ONE long time axis.

    pose 0               pose 1               pose 2
    |‾\\/\\_/‾\\____       |__/\\____/‾\\__       |___/‾‾\\______
    0        duration    stride               2·stride

x = (time − start) + pose·stride, with a stride of one second more than the utterance, wider than any
smoothing window. So each stage is one vectorised pass over one array, and poses never touch: every
pose begins and ends at weight 0, and between two poses the long function is 0.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

#: Knots nearer than this (seconds) are one knot.
NEAR = 1e-8
#: … unless their weights differ by more than this: then they are a step, at least WIDTH seconds wide.
STEP = 1e-6
WIDTH = 1e-9
#: A weight below this is exactly 0, so that "where the pose is active" is well defined.
ZERO = 1e-9
#: Two knots nearer than this (seconds) can hide a corner from the test of each with its neighbours.
CLOSE = 1e-5
#: A knot nearer than this (weight) to the line between its neighbours is left out.
COLLINEAR = 1e-9


@dataclass(frozen=True, eq=False)
class Track:
    """One pose: strictly rising times t (m,) in seconds, weights v (m,); straight between knots, 0 outside."""

    t: Array
    v: Array

    def at(self, t: Array) -> Array:
        """The weight at times t, any shape."""
        return np.asarray(np.interp(t, self.t, self.v, left=0.0, right=0.0))


@dataclass(frozen=True, eq=False)
class Tracks(Mapping[str, Track]):
    """One stage's result for all poses; `tracks["open"]` is a Track.

    x, v      (m,) knots on the long axis
    start     seconds, time of x = 0
    duration  seconds of the utterance
    """

    poses: tuple[str, ...]
    x: Array
    v: Array
    start: float
    duration: float

    @property
    def stride(self) -> float:
        """Distance of two poses on the long axis, in seconds."""
        return self.duration + 1.0

    @cached_property
    def cuts(self) -> NDArray[np.intp]:
        """(poses+1,) where each pose's knots begin in x and v."""
        return self.x.searchsorted(np.arange(len(self.poses) + 1) * self.stride - 0.5)

    def lane(self, pose: int) -> tuple[Array, Array]:
        """Knots of one pose, still on the long axis."""
        a, b = self.cuts[pose], self.cuts[pose + 1]
        return self.x[a:b], self.v[a:b]

    def with_knots(self, x: Array, v: Array) -> Tracks:
        """The same utterance with other knots."""
        return replace(self, x=x, v=v)

    def __getitem__(self, pose: str) -> Track:
        try:
            p = self.poses.index(pose)
        except ValueError:
            raise KeyError(pose) from None
        x, v = self.lane(p)
        if not x.size:  # nothing moves this pose: 0 from the first to the last moment
            ends = [self.start, self.start + self.duration] if self.duration else [self.start]
            return Track(np.array(ends), np.zeros(len(ends)))
        return Track(x - (p * self.stride - self.start), v)

    def __iter__(self) -> Iterator[str]:
        return iter(self.poses)

    def __len__(self) -> int:
        return len(self.poses)


def pick(keep: Mask, x: Array, v: Array) -> tuple[Array, Array]:
    """The knots at which `keep` holds. `take(nonzero)` beats boolean indexing four to one."""
    k = keep.nonzero()[0]
    return x.take(k), v.take(k)


def apart(x: Array, v: Array) -> tuple[Array, Array]:
    """One knot of each run of near-equal ones, x being sorted; of a step, however steep, both ends.

    A run that touches 0 becomes 0, so that a pose still ends at weight 0.
    """
    near = (x[1:] - x[:-1] <= NEAR).nonzero()[0] + 1
    if not near.size:
        return x, v
    step = np.abs(v[near] - v[near - 1]) > STEP
    touches = ((v[near] < ZERO) & (v[near - 1] >= ZERO)).any()
    keep = np.ones(x.size, bool)
    keep[near[~step]] = False
    k = keep.nonzero()[0]
    low = np.minimum.reduceat(v, k) if touches else None
    x, v = x.take(k), v.take(k)
    if low is not None:
        v[low < ZERO] = 0.0
    if step.any():
        room = WIDTH * np.arange(x.size)
        x = np.maximum.accumulate(x - room) + room
    return x, v


def minimal(x: Array, v: Array) -> tuple[Array, Array]:
    """The same function without collinear knots and without doubled zeros at either end.

    The final spline's shape depends on the knots, so a stage must not leave any that mean nothing.
    """
    if x.size < 3:
        return x, v
    dx = x[1:] - x[:-1]
    dv = v[1:] - v[:-1]
    area = dv[:-1] * dx[1:]  # of the triangle with both neighbours, twice
    area -= dv[1:] * dx[:-1]
    np.abs(area, out=area)
    width = x[2:] - x[:-2]
    width *= COLLINEAR
    keep = np.empty(x.size, bool)
    keep[0], keep[-1] = v[1] > 0, v[-2] > 0
    np.greater(area, width, out=keep[1:-1])
    moves = v > 0  # where a pose begins or ends to move is never left out, however gently it does
    keep[1:-1] |= (moves[:-2] != moves[2:]) & ~moves[1:-1]
    close = (dx < CLOSE).nonzero()[0]
    both = close[~(keep[close] | keep[close + 1]) & (moves[close] | moves[close + 1])]
    if both.size:
        _restore_corners(x, v, keep, np.union1d(both, both + 1))
    return pick(keep, x, v)


def _restore_corners(x: Array, v: Array, keep: Mask, gone: NDArray[np.intp]) -> None:
    """Keep again those of the knots `gone` that are a corner after all.

    Of two knots close together each is nearly on a line with the other, corner or not.
    """
    while gone.size:
        kept = keep.nonzero()[0]
        after = kept.searchsorted(gone)
        a, b = kept[after - 1], kept[after]
        chord = v[a] + (v[b] - v[a]) / (x[b] - x[a]) * (x[gone] - x[a])
        corner = np.abs(chord - v[gone]) > 10 * COLLINEAR
        if not corner.any():
            return
        keep[gone[corner]] = True
        gone = gone[~corner]


def inserted(x: Array, v: Array, i: NDArray[np.intp], xc: Array, vc: Array) -> tuple[Array, Array]:
    """The knots with one more, (xc, vc), behind each knot i; i must not fall."""
    at = i + np.arange(1, i.size + 1)
    old = np.ones(x.size + i.size, bool)
    old[at] = False
    xs, vs = np.empty(old.size), np.empty(old.size)
    xs[at], vs[at] = xc, vc
    xs[old], vs[old] = x, v
    return xs, vs


def joined(x: Array, v: Array, more_x: Array, more_v: Array) -> tuple[Array, Array]:
    """The knots of both, in order. Sorted runs merge fast; where two are at one time, those of x come first."""
    both = np.concatenate((x, more_x))
    order = both.argsort(kind="stable")
    return both.take(order), np.concatenate((v, more_v)).take(order)
