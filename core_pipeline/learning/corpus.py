"""A corpus: clips of speech of which both the phones and the pose weights are known.

Every fit learns from one: the dominated animemes, the AnimPhos, and bigram curves (section 5.1).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from ..errors import UserError
from ..phonemes import COMMON, SILENCE, TABLE_1
from ..schedule import Schedule
from ..weights import Weights

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

#: Frames of all clips together; three hours at 60 frames a second.
MAX_FRAMES = 650_000


@dataclass(frozen=True, eq=False)
class Clip:
    """One recording: its phones and, on the same clock, its weights.

    known     (f,) frames that were really seen; False where the face was lost
    residual  what the poses leave unexplained of the captured motion, as a share of it (0…1); 0 when it was weights
    blind     poses that the recording cannot show, such as the tongue's
    notes     one sentence each on what had to be repaired
    """

    name: str
    schedule: Schedule
    weights: Weights
    known: Mask
    residual: float = 0.0
    blind: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()

    @classmethod
    def of(cls, name: str, schedule: Schedule, weights: Weights) -> Clip:
        """A clip of which every frame is known."""
        return cls(name, schedule, weights, np.ones(len(weights.frames), bool))

    @property
    def frame_times(self) -> Array:
        """(f,) seconds."""
        return self.weights.start + np.arange(len(self.weights.frames)) / self.weights.fps

    def usable(self) -> Mask:
        """(f,) known frames within the schedule."""
        times = self.frame_times
        return self.known & (times >= self.schedule.start) & (times <= self.schedule.end)


@dataclass(frozen=True, eq=False)
class Corpus:
    """Clips over one pose set and one phoneme set.

    phonemes     as of a curve set; `sil` is not listed
    phoneme_map  language phone → phoneme; the clips' schedules are mapped already
    notes        one sentence each on clips left out or repaired
    """

    clips: tuple[Clip, ...]
    poses: tuple[str, ...]
    phonemes: tuple[str, ...] = COMMON
    phoneme_map: Mapping[str, str] = field(default_factory=lambda: TABLE_1)
    notes: tuple[str, ...] = ()

    @classmethod
    def of(
        cls,
        clips: Iterable[Clip],
        phonemes: Sequence[str] = COMMON,
        phoneme_map: Mapping[str, str] = TABLE_1,
        notes: Iterable[str] = (),
    ) -> Corpus:
        """Clips put together: schedules in common phones, every clip with the first one's poses.

        UserError when there is no clip, clips have different poses, or there is more than fits a fit.
        """
        mapped = [replace(clip, schedule=clip.schedule.mapped(phonemes, phoneme_map)) for clip in clips]
        if not mapped:
            raise UserError("There is nothing to learn from: a corpus needs at least one clip of weights and phones.")
        poses = mapped[0].weights.poses
        for clip in mapped:
            _check_poses(clip, mapped[0])
        total = sum(len(clip.weights.frames) for clip in mapped)
        if total > MAX_FRAMES:
            raise UserError(
                f"The corpus has {total:,} frames, at most {MAX_FRAMES:,} can be learned from: use fewer clips."
            )
        return cls(tuple(mapped), poses, tuple(phonemes), phoneme_map, tuple(notes))

    def __iter__(self) -> Iterator[Clip]:
        return iter(self.clips)

    def __len__(self) -> int:
        return len(self.clips)

    @property
    def seconds(self) -> float:
        """Length of all clips together."""
        return sum(clip.schedule.duration for clip in self.clips)

    @property
    def phones(self) -> tuple[str, ...]:
        """The phoneme set, silence, and whatever else the clips hold, in that order."""
        found = dict.fromkeys([*self.phonemes, SILENCE])
        for clip in self.clips:
            found.update(dict.fromkeys(clip.schedule.phones))
        return tuple(found)

    @property
    def blind(self) -> tuple[str, ...]:
        """Poses that no clip can show."""
        return tuple(pose for pose in self.poses if all(pose in clip.blind for clip in self.clips))

    def counts(self) -> dict[str, int]:
        """Phone → how often it occurs."""
        found: dict[str, int] = {}
        for clip in self.clips:
            for phone in clip.schedule.phones:
                found[phone] = found.get(phone, 0) + 1
        return found


def _check_poses(clip: Clip, first: Clip) -> None:
    ours, theirs = first.weights.poses, clip.weights.poses
    if ours == theirs:
        return
    odd = sorted(set(ours) ^ set(theirs))
    told = f"{', '.join(odd[:6])} only in one of them" if odd else "the same ones in another order"
    raise UserError(f"The clips {first.name} and {clip.name} have different poses ({told}): learn from them apart.")
