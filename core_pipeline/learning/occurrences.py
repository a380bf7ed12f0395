"""Every bigram of a corpus as it was spoken: what the poses did from the start of one phone to the end of the next.

    clip   │  p0  │   p1   │  p2  │
    0      └──── bigram ───┘           read at NODES even places of its span
    1             └──── bigram ────┘   …

At each place one other bigram is under way too: the one before in the first phone, the one after in the second.
Stitching lets the higher of the two through (section 3.2.1), so learning must know the other.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from ..phonemes import Pair
from .corpus import Clip, Corpus

Array = NDArray[np.float64]
Ints = NDArray[np.intp]

NODES = 21
#: The normalised time of each node.
PLACES = np.linspace(0.0, 1.0, NODES)


@dataclass(frozen=True, eq=False)
class Occurrences:
    """o bigrams as spoken, of the pairs listed.

    pair    (o,) which of `pairs`
    motion  (o, NODES, poses) weights
    known   (o, NODES) 1.0 where the face was seen, else 0.0
    other   (o, NODES) the occurrence that is under way at the same time; −1 for none
    place   (o, NODES) where in its span that one is, 0…1
    """

    pairs: tuple[Pair, ...]
    pair: Ints
    motion: NDArray[np.float32]
    known: Array
    other: Ints
    place: Array

    @cached_property
    def counts(self) -> Ints:
        """(pairs,) occurrences of which at least half was seen."""
        seen = self.known.mean(1) >= 0.5
        return np.bincount(self.pair[seen], minlength=len(self.pairs))

    @cached_property
    def _by_pair(self) -> csr_array:
        n = self.pair.size
        return csr_array((np.ones(n), (self.pair, np.arange(n))), shape=(len(self.pairs), n))

    def summed(self, values: Array) -> Array:
        """(pairs, NODES) of values (o, NODES): the sum over a pair's occurrences."""
        return np.asarray(self._by_pair @ values)

    def rivals(self, curves: Array) -> Array:
        """(o, NODES) what the other bigram's curve is at each node, of curves (pairs, NODES); 0 where there is none."""
        at = self.place * (NODES - 1)
        lower = np.minimum(at.astype(np.intp), NODES - 2)
        part = at - lower
        row = self.pair[self.other]
        value = curves[row, lower] * (1 - part) + curves[row, lower + 1] * part
        return np.where(self.other >= 0, value, 0.0)


def occurrences_of(corpus: Corpus) -> Occurrences:
    """All bigrams of all clips, those with silence too."""
    number: dict[Pair, int] = {}
    parts = []
    total = 0
    for clip in corpus:
        if len(clip.schedule) < 2 or not clip.known.any():
            continue
        pair = np.array([number.setdefault(p, len(number)) for p in clip.schedule.pairs()], np.intp)
        motion, known, other, place = _of_clip(clip)
        parts.append((pair, motion, known, np.where(other >= 0, other + total, -1), place))
        total += pair.size
    if not parts:
        empty = np.zeros((0, NODES))
        motion = np.zeros((0, NODES, len(corpus.poses)), np.float32)
        return Occurrences((), np.zeros(0, np.intp), motion, empty, empty.astype(np.intp), empty)
    return Occurrences(tuple(number), *(np.concatenate(column) for column in zip(*parts, strict=True)))


def _of_clip(clip: Clip) -> tuple[NDArray[np.float32], Array, Ints, Array]:
    times, frame_times = clip.schedule.times, clip.frame_times
    n = len(clip.schedule) - 1
    start, end = times[:-2, None], times[2:, None]
    at = start + PLACES * (end - start)
    seen = clip.known.nonzero()[0]
    frames = clip.weights.frames[seen]
    motion = np.empty((n, NODES, frames.shape[1]), np.float32)
    for p in range(frames.shape[1]):
        motion[:, :, p] = np.interp(at, frame_times[seen], frames[:, p])
    step = 1.0 / clip.weights.fps
    inside = (at >= frame_times[0] - step) & (at <= frame_times[-1] + step)
    known = (np.interp(at, frame_times, clip.known.astype(np.float64)) > 0.5) & inside
    i = np.arange(n)[:, None]
    other = np.where(at < times[1:-1, None], i - 1, i + 1)
    there = (other >= 0) & (other < n)
    safe = np.clip(other, 0, n - 1)
    place = np.clip((at - times[safe]) / (times[safe + 2] - times[safe]), 0.0, 1.0)
    return motion, known.astype(np.float64), np.where(there, other, -1), place
