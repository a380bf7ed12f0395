"""A curve set in flat arrays, so that the time-warp is one gather and no loop.

Every curve is closed first: a key at 0 and at 1 where it does not reach 0 by itself, because a track
must be a function that begins and ends at 0. The closing ramp lasts 1 ms INSIDE the bigram's span,
which normalised time cannot say; such keys carry what the warp needs to place the ramp.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple, Protocol
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from .curves import Curve
from .phonemes import SILENCE, Pair

Floats = NDArray[np.float64]
Ints = NDArray[np.intp]


#: Keys nearer than this in normalised time are moved apart.
GAP = 1e-6


class ClosedKeys(NamedTuple):
    """A closed curve's keys, all (m,).

    s, v   normalised time and weight
    ramp   +1 where a closing ramp rises to this key, −1 where one falls from it, else 0
    room   the longest such ramp in normalised time: a third of the way to the next key
    slope  weight per normalised time of the curve there, so that the ramp meets the curve ON it
    """

    s: Floats
    v: Floats
    ramp: Floats
    room: Floats
    slope: Floats


_EMPTY = ClosedKeys(*(np.zeros(0) for _ in ClosedKeys._fields))
_closed: WeakKeyDictionary[Curve, ClosedKeys] = WeakKeyDictionary()


def closed(curve: Curve) -> ClosedKeys:
    """The curve with closing keys; empty when it is 0 throughout. Cached, curves never change."""
    keys = _closed.get(curve)
    if keys is None:
        keys = _closed[curve] = _close(curve)
    return keys


def _close(curve: Curve) -> ClosedKeys:
    if not curve.v.any():
        return _EMPTY
    s, v = curve.t.tolist(), curve.v.tolist()
    if v[0] > 0 and s[0] > 0:  # held flat before the first key
        s.insert(0, 0.0)
        v.insert(0, v[0])
    if v[-1] > 0 and s[-1] < 1:
        s.append(1.0)
        v.append(v[-1])
    s = _spread(s)
    opens, closes = v[0] > 0, v[-1] > 0
    rows = [[a, b, 0.0, 0.0, 0.0] for a, b in zip(s, v, strict=True)]
    if opens:
        gap = s[1] - s[0]
        rows[0][2:] = [1.0, gap / 3, (v[1] - v[0]) / gap]
    if closes:
        gap = s[-1] - s[-2]
        rows[-1][2:] = [-1.0, gap / 3, (v[-1] - v[-2]) / gap]
    if opens:
        rows.insert(0, [0.0] * 5)
    if closes:
        rows.append([1.0, 0.0, 0.0, 0.0, 0.0])
    return ClosedKeys(*np.array(rows).T)


def _spread(s: list[float]) -> list[float]:
    """Key times at least GAP apart: of a step that takes no time, no slope can be told."""
    gap = min(GAP, 0.5 / len(s))
    if all(b - a >= gap for a, b in pairwise(s)):
        return s
    room = gap * np.arange(len(s))
    later = np.maximum.accumulate(np.array(s) - room) + room
    spread: list[float] = np.minimum(later, 1 - room[::-1]).tolist()
    return spread


class HasCurves(Protocol):
    """What is packed of a bigram."""

    @property
    def curves(self) -> Mapping[str, Curve]:
        """Pose → curve."""
        ...

    def __hash__(self) -> int: ...


class HasBigrams(Protocol):
    """What is packed of a curve set."""

    @property
    def phonemes(self) -> tuple[str, ...]:
        """Without `sil`."""
        ...

    @property
    def poses(self) -> tuple[str, ...]:
        """In the order of the set."""
        ...

    @property
    def bigrams(self) -> Mapping[Pair, HasCurves]:
        """(first, second) → its curves."""
        ...


@dataclass(frozen=True, eq=False)
class PackedSet:
    """All closed keys of a curve set, one behind the other.

    keys    of every (bigram, pose), concatenated
    ramps   which of them carry a closing ramp
    start   (poses, rows+1) where the keys of a pose of a bigram begin; row `rows` is the empty bigram
    count   (poses, rows+1) how many there are
    row_of  (phones+2, phones+2) bigram row of two phone numbers; `sil` and "unknown" come last
    number  phone → number
    """

    poses: tuple[str, ...]
    keys: ClosedKeys
    ramps: NDArray[np.bool_]
    start: Ints
    count: Ints
    row_of: Ints
    number: dict[str, int]

    @classmethod
    def of(cls, curve_set: HasBigrams) -> PackedSet:
        """Pack a set; 441 bigrams take about a millisecond once their curves have been closed."""
        number = {phone: i for i, phone in enumerate(dict.fromkeys((*curve_set.phonemes, SILENCE)))}
        rows = len(curve_set.bigrams)
        row_of = np.full((len(number) + 1, len(number) + 1), rows, np.intp)
        poses = curve_set.poses
        count = np.zeros((rows + 1, len(poses)), np.intp)
        parts: list[NDArray[np.float64]] = [np.zeros((len(ClosedKeys._fields), 0))]
        for row, ((first, second), bigram) in enumerate(curve_set.bigrams.items()):
            if first in number and second in number:
                row_of[number[first], number[second]] = row
                sizes, keys = _bigram_block(bigram, poses)
                count[row] = sizes
                parts.append(keys)
        start = np.cumsum(count).reshape(count.shape) - count
        packed = ClosedKeys(*np.concatenate(parts, axis=1))
        return cls(poses, packed, packed.ramp != 0, start.T.copy(), count.T.copy(), row_of, number)

    def with_bigram(self, pair: Pair, bigram: HasCurves) -> PackedSet | None:
        """With other curves for a bigram that has a row here, many times quicker than `of`; None when it has none."""
        first, second = (self.number.get(phone) for phone in pair)
        row = self.start.shape[1] - 1 if first is None or second is None else int(self.row_of[first, second])
        if row == self.start.shape[1] - 1:
            return None
        sizes, block = _bigram_block(bigram, self.poses)
        begin, before = int(self.start[0, row]), int(self.count[:, row].sum())
        keys = ClosedKeys(
            *(
                np.concatenate((old[:begin], new, old[begin + before :]))
                for old, new in zip(self.keys, block, strict=True)
            )
        )
        start, count = self.start.copy(), self.count.copy()
        count[:, row] = sizes
        start[:, row] = begin + np.cumsum(sizes) - sizes
        start[:, row + 1 :] += int(sizes.sum()) - before
        return PackedSet(self.poses, keys, keys.ramp != 0, start, count, self.row_of, self.number)

    def numbers(self, phones: tuple[str, ...]) -> Ints:
        """Phone numbers (n,); an unknown phone gets the number that has no bigrams."""
        unknown = len(self.number)
        return np.array([self.number.get(p, unknown) for p in phones], np.intp)


@lru_cache(maxsize=4096)
def _bigram_block(bigram: HasCurves, poses: tuple[str, ...]) -> tuple[Ints, NDArray[np.float64]]:
    """Keys per pose, and all of them as columns; cached because an edit changes one bigram of 441."""
    blocks = [closed(bigram.curves[pose]) if pose in bigram.curves else _EMPTY for pose in poses]
    sizes = np.array([block.s.size for block in blocks], np.intp)
    return sizes, np.concatenate([np.array(block) for block in blocks], axis=1) if blocks else np.zeros((5, 0))
