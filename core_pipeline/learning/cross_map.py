"""A capture → weights over a pose set: a retarget preset read backwards.

A preset says which channels make a pose. Here the channels are known and the poses are looked for: the bounded fit of
frame_fit.py, against a resting face taken from the silences. What the poses cannot explain is told as the residual.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from ..errors import UserError
from ..faces import retarget
from ..phonemes import SILENCE
from ..schedule import Schedule
from ..weights import Weights
from .capture import Capture
from .corpus import Clip
from .frame_fit import pose_weights, unexplained

Array = NDArray[np.float64]

#: Frames of silence from which a resting face can be told; with fewer, the lowest tenth of each channel.
RESTING = 10


def clip_of(
    name: str, capture: Capture, schedule: Schedule, poses: Sequence[str], presets: Iterable[retarget.Preset]
) -> Clip:
    """A capture with its phones as a clip over `poses`; UserError when no preset knows its channels.

    Channels that are the poses themselves are taken as they are.
    """
    found = retarget.best(capture.channels, presets, poses)
    if not found.poses:
        raise UserError(f"{name}: {found.notes[0]} Retarget presets know ARKit, MetaHuman, VRM and others.")
    channels = sorted({channel for mix in found.poses.values() for channel in mix})
    column = {channel: i for i, channel in enumerate(capture.channels)}
    place = {channel: i for i, channel in enumerate(channels)}
    basis = np.zeros((len(channels), len(poses)))
    for p, pose in enumerate(poses):
        for channel, amount in found.poses.get(pose, {}).items():
            basis[place[channel], p] = amount
    values = capture.values[:, [column[channel] for channel in channels]]
    offsets = values if _are_poses(found.poses) else values - resting(values, capture, schedule)
    weights = pose_weights(basis, offsets, upper=1.0)
    residual = unexplained(basis, offsets[capture.seen], weights[capture.seen])
    notes = [*capture.notes, *found.notes]
    if found.missing:  # said of a face; here it is a recording
        notes[-1] = f"{', '.join(found.missing)} cannot be seen in it and stay at rest."
    if residual > 0.5:
        notes.append(f"The poses explain only {1 - residual:.0%} of the captured motion.")
    made = Weights(tuple(poses), capture.fps, capture.start, weights.astype(np.float32))
    return Clip(name, schedule, made, capture.seen, residual, found.missing, tuple(notes))


def _are_poses(poses: Mapping[str, retarget.Mix]) -> bool:
    """Whether every channel is a pose itself; then 0 is rest and nothing is to be taken off."""
    return all(
        list(mix.values()) == [1.0] and retarget.normalised(next(iter(mix))) == retarget.normalised(pose)
        for pose, mix in poses.items()
    )


def resting(values: Array, capture: Capture, schedule: Schedule) -> Array:
    """(channels,) the face at rest: the median of the silences, else a low value of each channel."""
    times = capture.start + np.arange(len(values)) / capture.fps
    silent = np.zeros(len(values), bool)
    for phone, start, end in zip(schedule.phones, schedule.times[:-1], schedule.times[1:], strict=True):
        if phone == SILENCE:
            third = (end - start) / 3  # lips leave and come before the sound does
            silent |= (times >= start + third) & (times <= end - third)
    silent &= capture.seen
    if silent.sum() >= RESTING:
        return np.asarray(np.median(values[silent], axis=0))
    return np.asarray(np.percentile(values[capture.seen], 10, axis=0))
