"""Modes: a phone moves in one of several ways, and its context tells which (Chen et al., sections V.A and VI).

Which mode each phone takes is the cheapest path through the animeme graph (equation 10), w_c : w_s = 1000 : 1:

    E_c = −log P(mode | previous phone, phone, next phone), from counts, backing off to less context
    E_s = how badly value, slope and curvature of two animemes meet at the joint (our reading of "C² smoothness":
          squared differences in the phones' own time, so that it is a table over pairs of states)
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from .viterbi import cheapest_path

Array = NDArray[np.float64]
Ints = NDArray[np.intp]

#: The weights of equation (10).
CONTEXT, SMOOTHNESS = 1000.0, 1.0
#: Of the estimate with less context, in occurrences.
BACK_OFF = 2.0


@dataclass(frozen=True, eq=False)
class ModeTable:
    """What was seen: previous phone, phone, next phone, mode, and how often (r,) each.

    A phone that is not there (before the first, after the last) has the number −1.
    """

    before: Ints
    phone: Ints
    after: Ints
    mode: Ints
    count: Ints

    @classmethod
    def of(cls, rows: list[tuple[int, int, int, int]]) -> ModeTable:
        """From (before, phone, after, mode) of every occurrence."""
        table = np.array(rows, np.intp).reshape(-1, 4)
        unique, count = np.unique(table, axis=0, return_counts=True)
        before, phone, after, mode = (np.ascontiguousarray(column) for column in unique.T)
        return cls(before, phone, after, mode, count.astype(np.intp))

    @cached_property
    def _seen(self) -> dict[tuple[int | None, int, int | None], dict[int, float]]:
        """Context (None: any) → mode → count."""
        seen: dict[tuple[int | None, int, int | None], dict[int, float]] = {}
        columns = (self.before, self.phone, self.after, self.mode, self.count)
        for before, phone, after, mode, count in zip(*(c.tolist() for c in columns), strict=True):
            for context in ((before, phone, after), (before, phone, None), (None, phone, after), (None, phone, None)):
                modes = seen.setdefault(context, {})
                modes[mode] = modes.get(mode, 0.0) + count
        return seen

    def cost(self, before: int, phone: int, after: int, modes: int) -> Array:
        """E_c of each of a phone's modes (modes,), in nats; the same context is asked for again and again."""
        asked = before, phone, after, modes
        if asked not in self._costs:
            self._costs[asked] = self._cost(*asked)
        return self._costs[asked]

    @cached_property
    def _costs(self) -> dict[tuple[int, int, int, int], Array]:
        return {}

    def _cost(self, before: int, phone: int, after: int, modes: int) -> Array:
        alone = self._blended((None, phone, None), np.full(modes, 1.0 / modes))
        left = self._blended((before, phone, None), alone)
        right = self._blended((None, phone, after), alone)
        return np.asarray(-np.log(self._blended((before, phone, after), (left + right) / 2)))

    def _blended(self, context: tuple[int | None, int, int | None], prior: Array) -> Array:
        """P(mode | context): the counts, and BACK_OFF occurrences distributed as `prior` says."""
        counts = np.zeros(prior.size)
        for mode, count in self._seen.get(context, {}).items():
            counts[mode] = count
        return np.asarray((counts + BACK_OFF * prior) / (counts.sum() + BACK_OFF))


def joint_mismatch(coefficients: Array) -> Array:
    """E_s: (states, states) of the end of the first and the start of the second, over all poses."""
    order = np.arange(3)
    at_end, at_start = (
        np.stack([_derivative(coefficients, int(k), x) for k in order], axis=1).reshape(len(coefficients), -1)
        for x in (1.0, -1.0)
    )
    squares = (at_end**2).sum(1)[:, None] + (at_start**2).sum(1)[None, :] - 2 * at_end @ at_start.T
    return np.asarray(np.maximum(squares, 0.0))


def _derivative(coefficients: Array, order: int, x: float) -> Array:
    """(states, poses) the k-th derivative in t at x = 2t − 1."""
    c: Array = np.moveaxis(coefficients, 1, 0)
    for _ in range(order):
        c = np.asarray(2.0 * legendre.legder(c) if len(c) > 1 else np.zeros_like(c), np.float64)
    return np.asarray(legendre.legval(x, c))


def choose_modes(phones: Ints, first: Ints, table: ModeTable, mismatch: Array) -> Ints:
    """(n,) the state of each phone on the cheapest path of equation (10).

    phones    (n,) numbers; first (phones+2,) as in `Dam`
    mismatch  (states, states) E_s
    """
    count = np.diff(first)[phones]
    if (count == 1).all():
        return first[phones]
    around = [-1, *phones.tolist(), -1]
    nodes = [
        CONTEXT * table.cost(around[i], around[i + 1], around[i + 2], int(count[i])) if count[i] > 1 else np.zeros(1)
        for i in range(phones.size)
    ]
    states = [slice(int(first[p]), int(first[p + 1])) for p in phones]
    path = cheapest_path(nodes, lambda i: SMOOTHNESS * mismatch[states[i - 1], states[i]])
    return first[phones] + np.array(path, np.intp)
