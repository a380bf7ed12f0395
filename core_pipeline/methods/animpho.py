"""AnimPhos: typical motions of one phone, chosen as phones arrive and blended (Wei and Deng, 2015).

    phone ─→ a_t, an AnimPho of that phone (animpho_select.py) ─→ b_t, which really follows a_{t−1} and moves like a_t
          ─→ b_t shifted to begin where a_{t−1} ends ─→ m_t, from b_t over to a_t ─→ Hermite ─→ frames

Only what has been heard is needed, so this is the method for live speech; "viterbi" alone looks at the whole sentence.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..schedule import Schedule
from ..weights import Weights
from .animpho_select import Choice, choose
from .method import Array, frame_times, numbers_of, weights_of
from .segments import SAMPLES

Mask = NDArray[np.bool_]

#: Equation (4): how much of a_t there is in each of the five frames; the rest is b_t.
_BLEND = np.linspace(0.0, 1.0, SAMPLES)[:, None]


@dataclass(frozen=True, eq=False)
class AnimPho:
    """A learned model of m AnimPhos over h phones.

    centres    (m, SAMPLES, poses) the motion of each
    follows    (m, m) T: whether the second came after the first somewhere in the corpus
    labels     (h+1, m) L: whether an AnimPho was seen with a phone; a phone never seen has those of its class, and
               the last row, all of them, is for phones it does not know
    selection  "naive", "priority" or "viterbi"
    """

    poses: tuple[str, ...]
    phones: tuple[str, ...]
    phone_map: Mapping[str, str]
    centres: Array
    follows: Mask
    labels: Mask
    selection: str = "priority"

    @property
    def title(self) -> str:
        """For people."""
        return f"AnimPho ({self.selection})"

    def with_selection(self, selection: str) -> AnimPho:
        """The same AnimPhos chosen in another way."""
        return replace(self, selection=selection)

    @cached_property
    def successors(self) -> tuple[NDArray[np.intp], ...]:
        """T(a) of every a."""
        return tuple(row.nonzero()[0] for row in self.follows)

    def choices(self, schedule: Schedule) -> list[Choice]:
        """a_t of every phone, and whether it was a miss."""
        return choose(self, numbers_of(schedule, self.phones, self.phone_map).tolist())

    def missing_rate(self, schedules: Sequence[Schedule]) -> float:
        """Misses by transitions, of all schedules together; 0 without a transition."""
        missed = [choice.missed for schedule in schedules for choice in self.choices(schedule)[1:]]
        return sum(missed) / max(len(missed), 1)

    def twin(self, previous: int | None, chosen: int) -> int:
        """b_t, equation (3): of all that followed `previous`, the nearest to `chosen` in motion.

        `chosen` itself where it followed, where nothing ever did (ours), and at the beginning.
        """
        if previous is None or self.follows[previous, chosen] or not self.successors[previous].size:
            return chosen
        after = self.successors[previous]
        return int(after[((self.centres[after] - self.centres[chosen]) ** 2).sum((1, 2)).argmin()])

    def motion(self, choices: Sequence[Choice]) -> Array:
        """m_t, equation (4): (n, SAMPLES, poses), each beginning where the one before it ends."""
        chosen = [choice.animpho for choice in choices]
        twins = [self.twin(previous, now) for previous, now in zip([None, *chosen[:-1]], chosen, strict=True)]
        a, b = self.centres[chosen], self.centres[twins].copy()
        b[1:] += a[:-1, -1:] - b[1:, :1]
        return np.asarray((1 - _BLEND) * b + _BLEND * a)

    def synthesize(self, schedule: Schedule, poses: Sequence[str], fps: float) -> Weights:
        """See `Method.synthesize`. No phone at all gives zeros."""
        times = frame_times(schedule, fps)
        frames = np.zeros((times.size, len(self.poses)))
        if len(schedule):
            frames = hermite_frames(self.motion(self.choices(schedule)), schedule.times, times)
        return weights_of(frames, self.poses, poses, schedule, fps)


def slopes(motion: Array, lengths: Array) -> Array:
    """d_t, equation (5): (n, SAMPLES, poses) per sample.

    The first frame's is the last one's of the phone before, which counts in that phone's samples: we scale it by the
    ratio of the durations, without which the motion would not be smooth (it is C¹, not C² as printed).
    """
    d = np.empty_like(motion)
    d[:, 1:-1] = (motion[:, 2:] - motion[:, :-2]) / 2
    d[:, -1] = motion[:, -1] - motion[:, -2]
    d[:1, 0] = motion[:1, 1] - motion[:1, 0]
    d[1:, 0] = d[:-1, -1] * (lengths[1:] / lengths[:-1])[:, None]
    return d


def hermite_frames(motion: Array, bounds: Array, times: Array) -> Array:
    """(f, poses) the motion of n phones at `times`, by cubic Hermite pieces (algorithm 1); bounds (n+1,) seconds."""
    lengths = np.diff(bounds)
    d = slopes(motion, lengths)
    phone = np.clip(bounds.searchsorted(times, side="right") - 1, 0, lengths.size - 1)
    at = np.clip((times - bounds[phone]) / lengths[phone], 0.0, 1.0) * (SAMPLES - 1)
    lower = np.minimum(at.astype(np.intp), SAMPLES - 2)
    s = (at - lower)[:, None]
    v0, v1 = motion[phone, lower], motion[phone, lower + 1]
    d0, d1 = d[phone, lower], d[phone, lower + 1]
    rise = v1 - v0
    return np.asarray(v0 + s * (d0 + s * (3 * rise - 2 * d0 - d1 + s * (d0 + d1 - 2 * rise))))
