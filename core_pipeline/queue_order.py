"""In which order to work through the bigrams: frequent ones first, but soon a few of every row and column.

A few drawn bigrams of a row teach the suggestions what its phone does, so that the rest of the row is
accepted instead of drawn (see suggest.py).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

from .curve_set import CurveSet
from .phonemes import Pair

#: So many drawn bigrams of each row and column are wanted early.
SPREAD = 3
#: Every so many bigrams the queue goes to the poorest row or column instead of the most frequent pair.
_EVERY = 3


def work_order(curve_set: CurveSet, frequency: Mapping[Pair, float]) -> list[Pair]:
    """Every pair of the set's phonemes, the whole list stable while statuses change.

    frequency  pair → share of running speech
    Of each three the first two are the most frequent left, the third is the most frequent of the rows and columns
    that have fewer than SPREAD so far, until none has.
    """
    phones = curve_set.phonemes
    rank = {phone: i for i, phone in enumerate(phones)}
    pairs = [(a, b) for a in phones for b in phones]
    pairs.sort(key=lambda p: (-frequency.get(p, 0.0), rank[p[0]], rank[p[1]]))
    order: list[Pair] = []
    rows: Counter[str] = Counter()
    columns: Counter[str] = Counter()
    left = dict.fromkeys(pairs)
    wanted = min(SPREAD, len(phones))
    while left:
        chosen = None
        if len(order) % _EVERY == _EVERY - 1:
            chosen = _poorest(left, rows, columns, wanted)
        pair = next(iter(left)) if chosen is None else chosen
        del left[pair]
        order.append(pair)
        rows[pair[0]] += 1
        columns[pair[1]] += 1
    return order


def _poorest(left: Mapping[Pair, None], rows: Counter[str], columns: Counter[str], wanted: int) -> Pair | None:
    """The most frequent pair that helps the poorest row or column most; None when all have enough."""
    best: tuple[int, Pair] | None = None
    for pair in left:
        help_ = max(wanted - rows[pair[0]], 0) + max(wanted - columns[pair[1]], 0)
        if help_ > (0 if best is None else best[0]):
            best = help_, pair
    return None if best is None else best[1]


def next_after(order: Sequence[Pair], curve_set: CurveSet, current: Pair | None) -> Pair | None:
    """The first pair after `current`, round the end, that is not approved yet; None when all others are."""
    start = order.index(current) + 1 if current in order else 0
    for pair in [*order[start:], *order[:start]]:
        if pair != current and curve_set.status_of(pair) != "approved":
            return pair
    return None
