"""What was said: phones with times, the words, the sound."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..schedule import Schedule


@dataclass(frozen=True, eq=False)
class Audio:
    """Mono sound: samples (n,) float32 in [−1, 1], rate in samples per second."""

    samples: NDArray[np.float32]
    rate: int

    @property
    def duration(self) -> float:
        """Seconds."""
        return self.samples.size / self.rate


@dataclass(frozen=True)
class Word:
    """One word of the text and when it sounds, in seconds."""

    text: str
    start: float
    end: float


@dataclass(frozen=True, eq=False)
class Utterance:
    """A schedule of the language's own phones (ARPAbet), with the sound it was taken from, if any.

    notes  one sentence each about what the user should know: an unknown sound, no voice
    """

    text: str
    schedule: Schedule
    audio: Audio | None = None
    words: tuple[Word, ...] = ()
    notes: tuple[str, ...] = ()
