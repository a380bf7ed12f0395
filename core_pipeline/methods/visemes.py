"""Viseme interpolation: one mouth shape per phone, straight from the middle of one phone to that of the next.

The plain method that both papers take as their floor (Wei and Deng's sidebar; Xu et al., section 2.1).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..learning.corpus import Corpus
from ..schedule import Schedule
from ..weights import Weights
from .method import Array, Progress, class_of, frame_times, no_progress, numbers_of, weights_of


@dataclass(frozen=True, eq=False)
class Visemes:
    """shapes (phones+1, poses): the mean weights in the middle of each phone; the last row is for unknown ones."""

    poses: tuple[str, ...]
    phones: tuple[str, ...]
    phone_map: Mapping[str, str]
    shapes: Array
    title: str = "Viseme interpolation"

    def synthesize(self, schedule: Schedule, poses: Sequence[str], fps: float) -> Weights:
        """See `Method.synthesize`."""
        times = frame_times(schedule, fps)
        frames = np.zeros((times.size, len(self.poses)))
        if len(schedule):
            shapes = self.shapes[numbers_of(schedule, self.phones, self.phone_map)]
            middles = (schedule.times[:-1] + schedule.times[1:]) / 2
            for p in range(len(self.poses)):
                frames[:, p] = np.interp(times, middles, shapes[:, p])
        return weights_of(frames, self.poses, poses, schedule, fps)


def fit(corpus: Corpus, _options: None = None, progress: Progress = no_progress) -> Visemes:
    """The mean over the middle third of every occurrence. A phone never heard gets its class's mean, else all's."""
    phones = corpus.phones
    number = {phone: i for i, phone in enumerate(phones)}
    total, count = np.zeros((len(phones), len(corpus.poses))), np.zeros(len(phones))
    for done, clip in enumerate(corpus):
        progress(done / len(corpus), "visemes")
        times, schedule = clip.frame_times, clip.schedule
        i = np.clip(schedule.times.searchsorted(times, side="right") - 1, 0, max(len(schedule) - 1, 0))
        use = clip.usable() if len(schedule) else np.zeros(times.size, bool)
        if use.any():
            starts, lengths = schedule.times[:-1], np.diff(schedule.times)
            use &= np.abs((times - starts[i]) / lengths[i] - 0.5) <= 1 / 6
            of = np.array([number[phone] for phone in schedule.phones])[i[use]]
            np.add.at(total, of, clip.weights.frames[use].astype(np.float64))
            np.add.at(count, of, 1.0)
    return Visemes(corpus.poses, phones, corpus.phoneme_map, filled_in(total, count, phones))


def filled_in(total: Array, count: Array, phones: Sequence[str]) -> Array:
    """(phones+1, …) means of sums and counts: unseen phones get the mean of their class, and the last row that of all.

    total  (phones, …), count (phones,) how many were summed
    """
    shape = (-1,) + (1,) * (total.ndim - 1)
    everything = total.sum(0) / max(count.sum(), 1.0)
    made = np.concatenate([total / np.maximum(count, 1.0).reshape(shape), everything[None]])
    classes = np.array([class_of(phone) for phone in phones])
    for i in (count == 0).nonzero()[0]:
        alike = (classes == classes[i]) & (count > 0)
        made[i] = total[alike].sum(0) / count[alike].sum() if alike.any() else everything
    return made
