"""Dominance: how far a phone reaches into its neighbours (Chen et al., section III, equations 1 to 3).

Equation (1) is lost in the printed text; this is our reading of the words around it ("full influence" within the
phone, "exponential fall-off" outside, ε against division by zero):

    D(t) = 1                          for t in [0, 1]
    D(t) = exp(−o² / (σ² + ε))        outside, o = max(−t, t − 1) in units of the phone's own duration

An animeme A(t) is a polynomial; we write it in Legendre's, on [0, 1], because the powers of t that are printed make
the normal equations a million times worse, and hold t at the ends of [0, 1], so that outside its phone an animeme is
a constant: its value at 0 for frames before the phone, at 1 for frames after it. Frame i of phone j then is

    C(i) = A_j(t)  +  Σ_k D_k · (A_k(0) or A_k(1))           k = the three phones before j and the three after
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from ..schedule import Schedule

Array = NDArray[np.float64]
Ints = NDArray[np.intp]

#: The small constant of equation (1).
EPSILON = 1e-3
#: σ stays within these, in durations of the phone.
NARROWEST, WIDEST = 0.05, 3.0
#: Phones on either side that are felt.
WINDOW = 3
#: Squared distance that stands for "there is no such phone".
ABSENT = 1e6

_BEFORE, _AFTER = 0, 1


@dataclass(frozen=True, eq=False)
class Reach:
    """Which phones are felt at each of f frames.

    own     (f,) state of the phone that sounds; a state is a phone, or one mode of it
    basis   (f, M+1) Legendre polynomials at the frame's place in it
    other   (f, 2·WINDOW) states of its neighbours, nearest first
    side    (f, 2·WINDOW) 0 where the frame lies before that phone, 1 where after
    far     (f, 2·WINDOW) squared distance from it, in its own durations; ABSENT where there is none
    """

    own: Ints
    basis: Array
    other: Ints
    side: Ints
    far: Array

    def dominance(self, sigma: Array) -> Array:
        """Equation (1): (f, 2·WINDOW, …) for σ (states, …)."""
        shape = self.far.shape + (1,) * (sigma.ndim - 1)
        return np.asarray(np.exp(-self.far.reshape(shape) / (sigma[self.other] ** 2 + EPSILON)))


def reach_of(schedule: Schedule, states: Ints, times: Array, degree: int) -> Reach:
    """What is felt at `times` (f,), of a schedule of at least one phone; times outside it count to its end phones."""
    n = len(schedule)
    starts, lengths = schedule.times[:-1], np.diff(schedule.times)
    i = np.clip(schedule.times.searchsorted(times, side="right") - 1, 0, n - 1)
    local = np.clip((times - starts[i]) / lengths[i], 0.0, 1.0)
    steps = np.array([step for k in range(1, WINDOW + 1) for step in (-k, k)])
    j = i[:, None] + steps
    there = (j >= 0) & (j < n)
    j = np.clip(j, 0, n - 1)
    t = (times[:, None] - starts[j]) / lengths[j]
    far = np.where(there, np.maximum(np.maximum(-t, t - 1.0), 0.0) ** 2, ABSENT)
    side = np.broadcast_to(np.where(steps > 0, _BEFORE, _AFTER), far.shape)
    basis = np.asarray(legendre.legvander(2 * local - 1, degree), np.float64)
    return Reach(states[i], basis, states[j], side, np.minimum(far, ABSENT))


def ends(degree: int) -> Array:
    """(2, M+1) the basis at t = 0 and at t = 1."""
    return np.asarray(legendre.legvander(np.array([-1.0, 1.0]), degree))


def joined(parts: list[Reach]) -> Reach:
    """The frames of several clips as one."""
    return Reach(*(np.concatenate([getattr(part, name) for part in parts]) for name in Reach.__dataclass_fields__))


def blend(reach: Reach, coefficients: Array, sigma: Array, *, normalised: bool) -> Array:
    """Equation (2): weights (f, poses), not clipped.

    coefficients  (states, M+1, poses)
    sigma         (states, poses)
    normalised    divide by the sum of dominances, as Cohen and Massaro do
    """
    dominance = reach.dominance(sigma)
    degree = coefficients.shape[1] - 1
    at_ends = np.einsum("em,smp->esp", ends(degree), coefficients)
    frames = np.einsum("fm,fmp->fp", reach.basis, coefficients[reach.own])
    frames += np.einsum("fkp,fkp->fp", dominance, at_ends[reach.side, reach.other])
    return np.asarray(frames / (1.0 + dominance.sum(axis=1))) if normalised else np.asarray(frames)
