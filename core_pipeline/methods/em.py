"""The two steps that learn one pose's animemes and dominances (Chen et al., equations 4 to 9).

Outside its phone an animeme is one of its two end values (dominance.py), so a frame has M+1 entries of its own phone
and 6 of its neighbours. The normal matrix is summed up from those alone, and only then spread over the coefficients:
a corpus of 80 sentences takes a second per pose where the paper's took an hour.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve

from .dominance import EPSILON, NARROWEST, WIDEST, Reach, ends

Array = NDArray[np.float64]
Ints = NDArray[np.intp]

#: Levenberg's damping: where it begins, and how it moves.
DAMPING, EASED, TIGHTENED = 1e-2, 0.3, 5.0
#: Steps tried in one M step before it is given up.
TRIES = 4


@dataclass(frozen=True, eq=False)
class Fit:
    """coefficients (states, M+1), log_sigma (states,), error: RMSE over the frames."""

    coefficients: Array
    log_sigma: Array
    error: float


@dataclass(frozen=True, eq=False)
class Shared:
    """What the fits of all poses have in common: which states meet in which frame.

    slot      (f, K) 2·state + side, of the neighbours
    own_slot  (f, M+1, K) flat index into (states, M+1, slots)
    pairs     (f, K(K+1)/2) flat index into (slots, slots)
    left, right  which two neighbours each of those pairs are
    """

    reach: Reach
    states: int
    normalised: bool
    slot: Ints
    own_slot: Ints
    pairs: Ints
    left: Ints
    right: Ints

    @classmethod
    def of(cls, reach: Reach, states: int, *, normalised: bool) -> Shared:
        """Index arrays made once; they are most of the work."""
        terms = reach.basis.shape[1]
        slot = 2 * reach.other + reach.side
        left, right = np.triu_indices(slot.shape[1])
        own = reach.own[:, None] * terms + np.arange(terms)
        own_slot = own[:, :, None] * (2 * states) + slot[:, None, :]
        pairs = slot[:, left] * (2 * states) + slot[:, right]
        return cls(reach, states, normalised, slot, own_slot, pairs, left, right)


class Control:
    """The fit of one pose: target (f,) its weights."""

    def __init__(self, shared: Shared, target: Array, ridge: float) -> None:
        self._shared = shared
        self._target = target
        self._ridge = ridge
        self._ends = ends(shared.reach.basis.shape[1] - 1)

    def learn(self, rounds: int, still: float, progress: Callable[[float], None]) -> Fit:
        """E and M in turn from σ = 1 until the error stands still."""
        log_sigma = np.zeros(self._shared.states)
        coefficients = self._animemes(log_sigma)
        error, damping = self._error(coefficients, log_sigma), DAMPING
        best = Fit(coefficients, log_sigma, error)
        for done in range(rounds):
            progress(done / rounds)
            log_sigma, damping = self._dominances(coefficients, log_sigma, damping)
            coefficients = self._animemes(log_sigma)
            before, error = error, self._error(coefficients, log_sigma)
            if error < best.error:
                best = Fit(coefficients, log_sigma, error)
            if before - error < still * before:
                break
        return best

    def _parts(self, log_sigma: Array) -> tuple[Array, Array, Array]:
        """Dominances (f, K), the divisor (f, 1), and the dominances divided."""
        dominance = self._shared.reach.dominance(np.exp(log_sigma))
        divisor = 1.0 + dominance.sum(1, keepdims=True) if self._shared.normalised else np.ones((len(dominance), 1))
        return dominance, divisor, dominance / divisor

    def _predicted(self, coefficients: Array, divisor: Array, shares: Array) -> tuple[Array, Array]:
        """The weights (f,), and (f, K) the end values of the neighbours' animemes."""
        at_ends = (coefficients @ self._ends.T).ravel().take(self._shared.slot)
        own = np.einsum("fm,fm->f", self._shared.reach.basis, coefficients[self._shared.reach.own])
        return own / divisor[:, 0] + np.einsum("fk,fk->f", shares, at_ends), at_ends

    def _error(self, coefficients: Array, log_sigma: Array) -> float:
        _, divisor, shares = self._parts(log_sigma)
        gap = self._target - self._predicted(coefficients, divisor, shares)[0]
        return float(np.sqrt(np.mean(gap**2))) if gap.size else 0.0

    def _animemes(self, log_sigma: Array) -> Array:
        """E: (states, M+1) by the normal equations (5), tied over all occurrences (7), with a ridge (ours)."""
        s, reach = self._shared, self._shared.reach
        S, terms = s.states, reach.basis.shape[1]
        _, divisor, shares = self._parts(log_sigma)
        own = reach.basis / divisor
        own_own = np.zeros((S, terms, terms))
        for a in range(terms):
            for b in range(a, terms):
                sums = _sums(reach.own, own[:, a] * own[:, b], S)
                own_own[:, a, b] = own_own[:, b, a] = sums
        own_slot = _sums(s.own_slot, own[:, :, None] * shares[:, None, :], S * terms * 2 * S)
        half = _sums(s.pairs, self._halved(shares[:, s.left] * shares[:, s.right]), 4 * S * S).reshape(2 * S, 2 * S)
        # Spread over coefficients: an end value is a fixed sum of them.
        by_end = own_slot.reshape(S, terms, S, 2)
        cross = np.einsum("amse,en->amsn", by_end, self._ends).reshape(S * terms, S * terms)
        quads = (half + half.T).reshape(S, 2, S, 2)
        matrix: Array = np.einsum("aebf,em,fn->ambn", quads, self._ends, self._ends, optimize=True).reshape(cross.shape)
        matrix += cross + cross.T
        blocks = matrix.reshape(S, terms, S, terms)
        blocks[np.arange(S), :, np.arange(S), :] += own_own
        right: Array = np.stack([_sums(reach.own, own[:, m] * self._target, S) for m in range(terms)], axis=1)
        at_slots = _sums(s.slot, shares * self._target[:, None], 2 * S)
        right += at_slots.reshape(S, 2) @ self._ends
        return self._solved(matrix, right)

    def _halved(self, products: Array) -> Array:
        """Each pair stands for both orders; the pair of a neighbour with itself must not count twice."""
        products[:, self._shared.left == self._shared.right] *= 0.5
        return products

    def _solved(self, matrix: Array, right: Array) -> Array:
        """With the ridge relative to an average state's entry; states without a frame come out 0."""
        diagonal = np.diagonal(matrix)
        used = diagonal > 0
        ridge = self._ridge * (diagonal[used].mean() if used.any() else 1.0)
        matrix[np.diag_indices_from(matrix)] += ridge
        return _solve(matrix, right.ravel()).reshape(right.shape)

    def _dominances(self, coefficients: Array, log_sigma: Array, damping: float) -> tuple[Array, float]:
        """M: one damped Gauss–Newton step on θ = log σ (9), tried more carefully until the error falls."""
        s, reach = self._shared, self._shared.reach
        dominance, divisor, shares = self._parts(log_sigma)
        predicted, at_ends = self._predicted(coefficients, divisor, shares)
        gap = self._target - predicted
        square = np.exp(2 * log_sigma)[reach.other]
        slope = dominance * 2 * reach.far * square / (square + EPSILON) ** 2
        slope *= (at_ends - predicted[:, None]) / divisor if s.normalised else at_ends
        S = s.states
        half = _sums(
            reach.other[:, s.left] * S + reach.other[:, s.right],
            self._halved(slope[:, s.left] * slope[:, s.right]),
            S * S,
        ).reshape(S, S)
        matrix = half + half.T
        right = _sums(reach.other, slope * gap[:, None], S)
        error = float(np.sqrt(np.mean(gap**2)))
        floor = 1e-9 + 1e-6 * float(np.diagonal(matrix).max(initial=0.0))
        for _ in range(TRIES):
            damped = matrix + np.diag(damping * np.diagonal(matrix) + floor)
            step = np.clip(_solve(damped, right), -1.0, 1.0)
            tried = np.clip(log_sigma + step, np.log(NARROWEST), np.log(WIDEST))
            if self._error(coefficients, tried) < error:
                return tried, damping * EASED
            damping *= TIGHTENED
        return log_sigma, damping


def _sums(index: Ints, values: Array, size: int) -> Array:
    """(size,) the values of each index, summed."""
    return np.bincount(index.ravel(), values.ravel(), size).astype(np.float64, copy=False)


def _solve(matrix: Array, right: Array) -> Array:
    """The solution of a positive definite system."""
    return np.asarray(cho_solve(cho_factor(matrix, overwrite_a=True, check_finite=False), right, check_finite=False))
