"""Dominated animeme models, and Cohen and Massaro's as their simplest case (Chen et al., 2012).

    schedule ─→ a mode for each phone (modes.py) ─→ Σ dominance · animeme (dominance.py) ─→ weights

With polynomials of degree M = 4 the sum stands as it is: the animemes learn what their neighbours add. With M = 0 an
animeme is one number, and the sum is divided by that of the dominances: Cohen and Massaro's model, as the paper
itself implements it (section VII).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..schedule import Schedule
from ..weights import Weights
from .dominance import blend, reach_of
from .method import Array, frame_times, numbers_of, weights_of
from .modes import ModeTable, choose_modes, joint_mismatch

Ints = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Dam:
    """A learned model. A state is one mode of one phone; the states of a phone stand one behind the other.

    phones        those it was learned for, silence among them
    first         (phones+2,) the first state of each phone; one state more, the mean of all, is for unknown phones
    coefficients  (states, M+1, poses) of the animemes, in Legendre polynomials on [0, 1]
    sigma         (states, poses) of the dominances
    modes         how often each mode was seen in which context
    error         (poses,) RMSE on the clips it was learned from
    """

    poses: tuple[str, ...]
    phones: tuple[str, ...]
    phone_map: Mapping[str, str]
    first: Ints
    coefficients: Array
    sigma: Array
    modes: ModeTable
    error: Array

    @property
    def degree(self) -> int:
        """M, of the polynomials."""
        return int(self.coefficients.shape[1]) - 1

    @property
    def normalised(self) -> bool:
        """Whether the sum is divided by that of the dominances."""
        return self.degree == 0

    @property
    def title(self) -> str:
        """For people."""
        return "Cohen–Massaro" if self.degree == 0 else "Dominated animemes"

    @cached_property
    def _mismatch(self) -> Array:
        return joint_mismatch(self.coefficients)

    def states_of(self, schedule: Schedule) -> Ints:
        """(n,) the state of each phone: its mode by Viterbi (section VI, figure 2)."""
        phones = numbers_of(schedule, self.phones, self.phone_map)
        return choose_modes(phones, self.first, self.modes, self._mismatch)

    def synthesize(self, schedule: Schedule, poses: Sequence[str], fps: float) -> Weights:
        """See `Method.synthesize`. No phone at all gives zeros."""
        times = frame_times(schedule, fps)
        frames = np.zeros((times.size, len(self.poses)))
        if len(schedule):
            reach = reach_of(schedule, self.states_of(schedule), times, self.degree)
            frames = blend(reach, self.coefficients, self.sigma, normalised=self.normalised)
        return weights_of(frames, self.poses, poses, schedule, fps)
