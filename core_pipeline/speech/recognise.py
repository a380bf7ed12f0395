"""Recording alone → words with their probabilities, or phones directly. A draft for people to correct."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import UserError
from . import cut
from .align import Progress, levelled
from .audio_file import resampled
from .spans import PhoneSpan, to_schedule
from .sphinx import RATE, Span, Sphinx
from .transcript import our_name
from .utterance import Audio, Utterance

#: Seconds of sound recognised at once.
PIECE = 20.0
#: A word less probable than this is named as doubtful.
DOUBTFUL = 0.5


@dataclass(frozen=True)
class Heard:
    """The words that were heard; each span's score is its probability, 0…1."""

    words: tuple[Span, ...]

    @property
    def text(self) -> str:
        """All words in a row."""
        return " ".join(word.name for word in self.words)

    @property
    def confidence(self) -> float:
        """The words' mean probability, as the recogniser itself sees it."""
        return float(np.mean([word.score for word in self.words])) if self.words else 0.0

    @property
    def sentence(self) -> str:
        """How sure this is, for people."""
        doubtful = [word.name for word in self.words if word.score < DOUBTFUL]
        names = ", ".join(doubtful[:6]) + (" …" if len(doubtful) > 6 else "")
        sure = f"{len(self.words)} words heard, {self.confidence:.0%} sure by the recogniser's own account"
        return f"{sure}; doubtful: {names}. Correct the text." if doubtful else f"{sure}. Check the text."


def hear_words(audio: Audio, sphinx: Sphinx, progress: Progress | None = None) -> Heard:
    """What is said in the recording. UserError when it is silent or no word is found; `Cancelled`."""
    words: list[Span] = []
    for start, sound in _pieces(audio, progress):
        words += [w._replace(start=start + w.start, end=start + w.end) for w in sphinx.words(sound)]
    if not words:
        raise UserError("No words were recognised: type what is said, or take the phones alone.")
    return Heard(tuple(words))


def hear_phones(audio: Audio, sphinx: Sphinx, progress: Progress | None = None) -> Utterance:
    """The phones of the recording without any words: rough. UserError when it is silent; `Cancelled`."""
    spans: list[PhoneSpan] = []
    for start, sound in _pieces(audio, progress):
        spans += [(our_name(p.name), start + p.start, start + p.end) for p in sphinx.phones(sound)]
    if all(phone == our_name("SIL") for phone, _, _ in spans):
        raise UserError("No phones were recognised: choose a recording of speech.")
    note = "Phones were guessed from the sound alone, about half of them rightly: a transcript does far better."
    return Utterance("", to_schedule(spans, 0.0, audio.duration), audio, (), (note,))


def _pieces(audio: Audio, progress: Progress | None) -> Iterator[tuple[float, NDArray[np.float32]]]:
    """The sound at 16 kHz in pieces cut where it is quiet, each with its start in seconds; silent ones are left out."""
    cut.refuse_silence(audio.samples, audio.rate)
    sound = levelled(resampled(audio, RATE).samples)
    levels = cut.loudness(sound, RATE)
    for start, end in _spans(levels, sound.size / RATE):
        if progress:
            progress(start / (sound.size / RATE))
        part = sound[round(start * RATE) : round(end * RATE)]
        if cut.loudness(part, RATE).max() >= cut.SILENT:
            yield start, part
    if progress:
        progress(1.0)


def _spans(levels: NDArray[np.float64], total: float) -> Sequence[tuple[float, float]]:
    spans, start = [], 0.0
    while total - start > PIECE:
        end = cut.quietest(levels, start + PIECE / 2, start + PIECE)
        spans.append((start, end))
        start = end
    return [*spans, (start, total)]
