"""What a phone does in all its pairs: a pair's curve as the first phone's part plus the second's.

Animators' sets are nearly such sums (phone_parts.py). Fitted to the pairs that were seen, they steady those seen
rarely and give a first guess for those never seen.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..phonemes import SILENCE, Pair

Array = NDArray[np.float64]

#: Occurrences above which a pair has no more to say about its phones.
MOST = 5
RIDGE = 0.3


@dataclass(frozen=True, eq=False)
class Parts:
    """The seen pairs as rows of phones, and the unseen ones.

    design   (pairs, 2·phones) 1 for the first phone and for the second
    counts   (pairs,) occurrences
    unseen   pairs of the phoneme set of which both phones were seen in that position
    wanted   (unseen, 2·phones) the same for those
    """

    design: Array
    counts: NDArray[np.intp]
    unseen: tuple[Pair, ...]
    wanted: Array

    @classmethod
    def of(cls, pairs: Sequence[Pair], counts: NDArray[np.intp], phonemes: Sequence[str]) -> Parts:
        """Rows of the pairs; a pair never seen well enough counts as unseen."""
        number = {
            phone: i for i, phone in enumerate(dict.fromkeys([*phonemes, SILENCE, *(q for p in pairs for q in p)]))
        }
        seen = {pair for pair, count in zip(pairs, counts.tolist(), strict=True) if count}
        first, second = {pair[0] for pair in seen}, {pair[1] for pair in seen}
        everything = [
            (a, b) for a in (*phonemes, SILENCE) for b in (*phonemes, SILENCE) if (a, b) != (SILENCE, SILENCE)
        ]
        unseen = tuple((a, b) for a, b in everything if (a, b) not in seen and a in first and b in second)
        return cls(_rows(pairs, number), counts, unseen, _rows(unseen, number))

    def steadied(self, curves: Array, lean: float) -> tuple[Array, Array]:
        """The seen pairs' curves (pairs, nodes) leaning on their phones, and guesses for the unseen (unseen, nodes).

        lean  occurrences that the phones' opinion counts as
        """
        weight = np.minimum(self.counts, MOST).astype(np.float64)
        matrix = self.design.T @ (weight[:, None] * self.design) + RIDGE * np.eye(self.design.shape[1])
        solved = np.linalg.solve(matrix, self.design.T @ (weight[:, None] * curves))
        opinion, guess = (np.clip(rows @ solved, 0.0, 1.0) for rows in (self.design, self.wanted))
        own = self.counts / (self.counts + lean) if lean else np.ones(self.counts.size)
        return own[:, None] * curves + (1 - own[:, None]) * opinion, guess


def _rows(pairs: Sequence[Pair], number: dict[str, int]) -> Array:
    rows = np.zeros((len(pairs), 2 * len(number)))
    for i, (first, second) in enumerate(pairs):
        rows[i, number[first]] = rows[i, len(number) + number[second]] = 1.0
    return rows
