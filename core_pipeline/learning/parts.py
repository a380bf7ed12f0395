"""What a phone does in all its pairs: a pair's curve as the first phone's part plus the second's.

Animators' sets are nearly such sums (phone_parts.py). Fitted to the pairs that were seen, they steady those seen
rarely. (Pairs never seen at all get a suggestion, see suggest.py.)
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..phonemes import Pair

Array = NDArray[np.float64]

#: Occurrences above which a pair has no more to say about its phones.
MOST = 5
RIDGE = 0.3


class Parts:
    """Pairs as rows of two phones, with how often each was seen, counts (pairs,)."""

    def __init__(self, pairs: Sequence[Pair], counts: NDArray[np.intp]) -> None:
        number = {phone: i for i, phone in enumerate(dict.fromkeys(phone for pair in pairs for phone in pair))}
        self._rows = np.zeros((len(pairs), 2 * len(number)))
        for i, (first, second) in enumerate(pairs):
            self._rows[i, number[first]] = self._rows[i, len(number) + number[second]] = 1.0
        self._counts = counts

    def steadied(self, curves: Array, lean: float) -> Array:
        """The pairs' curves (pairs, nodes), each drawn towards the sum of its phones' parts.

        lean  occurrences that the phones' opinion counts as; 0: none
        """
        if not lean:
            return curves
        weight = np.minimum(self._counts, MOST).astype(np.float64)
        matrix = self._rows.T @ (weight[:, None] * self._rows) + RIDGE * np.eye(self._rows.shape[1])
        opinion = np.clip(self._rows @ np.linalg.solve(matrix, self._rows.T @ (weight[:, None] * curves)), 0.0, 1.0)
        own = (self._counts / (self._counts + lean))[:, None]
        return np.asarray(own * curves + (1 - own) * opinion)
