"""What every method of synthesis is: schedule in, weights out (the papers' systems, one interface)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ..errors import UserError
from ..phonemes import SILENCE, VOWELS
from ..schedule import Schedule
from ..weights import Weights

Array = NDArray[np.float64]

#: (share done 0…1, what is being done). It may raise `Cancelled` to end a fit.
Progress = Callable[[float, str], None]


class Cancelled(Exception):  # noqa: N818 - a wish, not an error
    """Raised by a progress function to end a fit; nothing has been changed anywhere."""


class Method(Protocol):
    """Weights for any schedule. `title` is for people, `poses` are the ones it can make."""

    @property
    def title(self) -> str:
        """For people."""
        ...

    @property
    def poses(self) -> tuple[str, ...]:
        """The poses it can make."""
        ...

    def synthesize(self, schedule: Schedule, poses: Sequence[str], fps: float) -> Weights:
        """Weights (f, poses) at even frames from start to end of the schedule, as `weights.bake` lays them.

        poses  which poses to give, in that order; UserError names those the method does not have
        fps    frames per second, 1…1000 (ValueError otherwise)
        """
        ...


def no_progress(_share: float, _what: str) -> None:
    """For callers that do not watch."""


def frame_times(schedule: Schedule, fps: float) -> Array:
    """(f,) seconds: the frames from the start to (at least) the end of a schedule."""
    if not 1 <= fps <= 1000:
        raise ValueError(f"{fps:g} frames per second: choose 1 to 1000")
    count = int(np.ceil(schedule.duration * fps - 1e-6)) + 1
    return np.asarray(schedule.start + np.arange(count) / fps)


def weights_of(
    frames: NDArray[np.floating], own: Sequence[str], poses: Sequence[str], schedule: Schedule, fps: float
) -> Weights:
    """Frames (f, own poses) as Weights over `poses`, clipped to [0, 1]."""
    clipped = np.clip(frames[:, columns_of(own, poses)], 0.0, 1.0).astype(np.float32)
    return Weights(tuple(poses), float(fps), schedule.start, clipped)


def columns_of(own: Sequence[str], wanted: Sequence[str]) -> list[int]:
    """Where the wanted poses stand among a method's own; UserError names those it does not have."""
    place = {pose: i for i, pose in enumerate(own)}
    lacking = [pose for pose in wanted if pose not in place]
    if lacking:
        raise UserError(
            f"This model does not know {named(lacking)}; it was learned for {named(own)}. "
            "Choose a model of the same poses, or learn one."
        )
    return [place[pose] for pose in wanted]


def check_phones(own: Sequence[str], wanted: Sequence[str], what: str) -> None:
    """UserError with names unless every wanted phoneme is one the model was made for."""
    lacking = [phone for phone in wanted if phone not in set(own) and phone != SILENCE]
    if lacking:
        raise UserError(
            f"{what} does not know {named(lacking)}; its phones are {named(own, 30)}. "
            "Choose a model of the same phonemes, or learn one."
        )


def class_of(phone: str) -> str:
    """Silence, vowel or consonant: whose mean stands in for a phone nothing is known of."""
    if phone == SILENCE:
        return SILENCE
    return "vowel" if phone in VOWELS else "consonant"


def numbers_of(schedule: Schedule, phones: Sequence[str], phone_map: Mapping[str, str]) -> NDArray[np.intp]:
    """(n,) each phone's number in a model's list; len(phones) for one it does not have."""
    number = {phone: i for i, phone in enumerate(phones)}
    known = schedule.mapped(phones, phone_map).phones
    return np.array([number.get(phone, len(number)) for phone in known], np.intp)


def named(names: Sequence[str], most: int = 8) -> str:
    """ "open, W, … (9 in all)" for a message."""
    shown = [name if len(name) <= 40 else name[:39] + "…" for name in names[:most]]
    more = f", … ({len(names)} in all)" if len(names) > most else ""
    return ", ".join("".join(c if c.isprintable() else "?" for c in name) for name in shown) + more
