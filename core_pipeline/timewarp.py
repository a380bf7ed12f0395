"""Red: each bigram's curves stretched over the time it spans (section 3.2.1, figure 6).

    phones      t0 ── p0 ── t1 ── p1 ── t2 ── p2 ── t3
    bigram 0    |___________/‾‾\\______|
    bigram 1                |______/‾‾\\______|

Bigram i = (p_i, p_i+1) spans t_i … t_i+2. Even bigrams never overlap each other, nor do odd ones, so
the red curves of a pose are two functions; the cells are laid out (even | odd, pose, bigram) and both
halves come out sorted on the long axis.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .packed import PackedSet
from .tracks import Array

#: A curve that does not begin or end at 0 is closed by a ramp this long, in seconds.
RAMP = 1e-3


@dataclass(frozen=True, eq=False)
class WarpedCurve:
    """One pose of bigram number `index` in the utterance: t (m,) seconds, v (m,), closed to 0 at both ends."""

    index: int
    bigram: tuple[str, str]
    pose: str
    t: Array
    v: Array


@dataclass(frozen=True, eq=False)
class Warped:
    """All red curves on the long axis.

    x, v   (m,) knots, first all even bigrams, then all odd ones
    even   how many knots belong to even bigrams
    absent (k,) numbers of the bigrams that the set does not have
    ends   (2·poses·half,) where each cell's knots end; a cell is (even | odd, pose, bigram // 2)
    """

    poses: tuple[str, ...]
    phones: tuple[str, ...]
    x: Array
    v: Array
    even: int
    ends: NDArray[np.intp]
    absent: NDArray[np.intp]
    start: float
    duration: float

    def curves(self) -> Iterator[WarpedCurve]:
        """One curve per bigram and pose that moves, in the order of bigrams, then poses."""
        poses = len(self.poses)
        half = self.ends.size // (2 * poses) if poses else 0
        begins = np.concatenate(([0], self.ends[:-1]))
        for i in range(max(len(self.phones) - 1, 0)):
            for p, pose in enumerate(self.poses):
                cell = (i % 2 * poses + p) * half + i // 2
                a, b = begins[cell], self.ends[cell]
                if b > a:
                    shift = p * (self.duration + 1.0) - self.start
                    yield WarpedCurve(i, (self.phones[i], self.phones[i + 1]), pose, self.x[a:b] - shift, self.v[a:b])


def timewarp(packed: PackedSet, phones: tuple[str, ...], times: Array) -> Warped:
    """Place every bigram's closed keys: (s, v) → (t_i + s·(t_i+2 − t_i), v).

    phones  n common phonemes; an unknown phone or a missing bigram contributes nothing
    times   (n+1,) rising, seconds
    """
    poses, bigrams = len(packed.poses), max(len(phones) - 1, 0)
    start, duration = float(times[0]), float(times[-1] - times[0])
    if not bigrams or not poses:
        nothing = np.zeros(0)
        none = np.zeros(0, np.intp)
        return Warped(packed.poses, phones, nothing, nothing, 0, np.zeros(2 * poses, np.intp), none, start, duration)

    # Per bigram, padded to an even number so that it splits into (even, odd) × half.
    half = (bigrams + 1) // 2
    numbers = packed.numbers(phones)
    empty = packed.count.shape[1] - 1
    row = np.full(2 * half, empty, np.intp)
    row[:bigrams] = packed.row_of[numbers[:-1], numbers[1:]]
    begin, span = np.zeros(2 * half), np.zeros(2 * half)
    begin[:bigrams] = times[:-2] - start
    span[:bigrams] = times[2:] - times[:-2]

    # Per cell (even | odd, pose, bigram // 2).
    def cells(per_bigram: NDArray[Any], step: float) -> NDArray[Any]:
        lanes = np.arange(poses)[:, None] * step
        per_cell: NDArray[Any] = (per_bigram.reshape(half, 2).T[:, None, :] + lanes).ravel()
        return per_cell

    place = cells(row, empty + 1)  # in the packed tables (poses, rows+1)
    first_key, count = packed.start.take(place), packed.count.take(place)
    origin = cells(begin, duration + 1.0)
    ends = count.cumsum()

    # Per key.
    total, even = int(ends[-1]), int(ends[poses * half - 1])
    cell = np.repeat(np.arange(count.size), count)
    key = (first_key - ends + count).take(cell)
    key += np.arange(total)
    width = cells(span, 0).take(cell)
    x = packed.keys.s.take(key)
    x *= width
    x += origin.take(cell)
    v = packed.keys.v.take(key)

    ramps = packed.ramps.take(key).nonzero()[0]
    if ramps.size:  # the ramp's upper key moves inside, along the curve
        k, w = key[ramps], width[ramps]
        shift = np.minimum(RAMP, packed.keys.room[k] * w) * packed.keys.ramp[k]
        x[ramps] += shift
        v[ramps] += shift / w * packed.keys.slope[k]
    absent = (row[:bigrams] == empty).nonzero()[0]
    return Warped(packed.poses, phones, x, v, even, ends, absent, start, duration)
