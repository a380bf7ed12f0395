"""Which AnimPho a phone gets: naive, by priority, or by Viterbi (Wei and Deng, "AnimPho Selection", figures 4 and 5).

A miss is a phone whose AnimPho either never followed the one before it or was never seen with that phone.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .viterbi import cheapest_path

if TYPE_CHECKING:
    from .animpho import AnimPho

Ints = NDArray[np.intp]

SELECTIONS = ("naive", "priority", "viterbi")

#: What a missing transition costs the path; more than all the distance a sentence can add up to.
MISS = 1e6


class Choice(NamedTuple):
    """An AnimPho for a phone. The first phone of an utterance is never a miss."""

    animpho: int
    missed: bool


def choose(model: AnimPho, phones: Sequence[int]) -> list[Choice]:
    """One choice a phone; phones are numbers of the model's list."""
    chosen = _RULES[model.selection](model, phones)
    first = [Choice(chosen[0], False)] if chosen else []
    return first + [
        Choice(now, not (model.follows[before, now] and model.labels[phone, now]))
        for before, now, phone in zip(chosen[:-1], chosen[1:], phones[1:], strict=True)
    ]


def _nearest(model: AnimPho, previous: int | None, among: Ints) -> int:
    """Equation (1): the smoothest, from where `previous` ends; at the beginning, from a mouth at rest."""
    end = np.zeros(len(model.poses)) if previous is None else model.centres[previous, -1]
    return int(among[((model.centres[among, 0] - end) ** 2).sum(1).argmin()])


def naive(model: AnimPho, phones: Sequence[int]) -> list[int]:
    """The smoothest of those of the phone that follow; when there is none, the smoothest of all, whatever its phone."""
    chosen: list[int] = []
    for phone in phones:
        previous = chosen[-1] if chosen else None
        able = model.labels[phone] if previous is None else model.labels[phone] & model.follows[previous]
        if not able.any():
            able = np.ones(able.size, bool)
        chosen.append(_nearest(model, previous, able.nonzero()[0]))
    return chosen


class Priority:
    """Live selection, one phone at a time: the end of the longest sequence that was really spoken (equation 2)."""

    def __init__(self, model: AnimPho) -> None:
        self._model = model
        self._before: tuple[Ints, Ints] | None = None
        self._previous: int | None = None

    def step(self, phone: int) -> int:
        """The AnimPho for the phone that has just arrived."""
        model = self._model
        mine = model.labels[phone].nonzero()[0]
        value = np.ones(mine.size, np.intp)
        if self._before is not None:
            others, values = self._before
            reached = np.where(model.follows[np.ix_(others, mine)], values[:, None] + 1, 1)
            value = reached.max(axis=0, initial=1)
        best = mine[value == value.max()]
        if self._previous is not None:  # of equals, those that follow; of those, the smoothest
            following = best[model.follows[self._previous, best]]
            best = following if following.size else best
        self._before = mine, value
        self._previous = _nearest(model, self._previous, best)
        return self._previous


def priority(model: AnimPho, phones: Sequence[int]) -> list[int]:
    """`Priority`, phone by phone."""
    live = Priority(model)
    return [live.step(phone) for phone in phones]


def viterbi(model: AnimPho, phones: Sequence[int]) -> list[int]:
    """The path with the fewest misses, and of those the smoothest (ours). It needs the whole sentence."""
    mine = [model.labels[phone].nonzero()[0] for phone in phones]
    start = np.sqrt((model.centres[:, 0] ** 2).sum(1))
    nodes = [start[among] if i == 0 else np.zeros(among.size) for i, among in enumerate(mine)]

    def edges(i: int) -> NDArray[np.float64]:
        from_, to = mine[i - 1], mine[i]
        ends, starts = model.centres[from_, -1], model.centres[to, 0]
        squares = (ends**2).sum(1)[:, None] + (starts**2).sum(1)[None] - 2 * ends @ starts.T
        smooth = np.sqrt(np.maximum(squares, 0.0))
        return np.asarray(smooth + MISS * ~model.follows[np.ix_(from_, to)])

    path = cheapest_path(nodes, edges)
    return [int(among[k]) for among, k in zip(mine, path, strict=True)]


_RULES: Mapping[str, Callable[[AnimPho, Sequence[int]], list[int]]] = {
    "naive": naive,
    "priority": priority,
    "viterbi": viterbi,
}
