"""Sound as it comes → phones → the curves' tail: the bigram method while somebody speaks.

A phone counts as known 10 frames after its end. A bigram needs the next phone and its end too, so what
is shown lies two phones behind the sound. Only the last phones are computed again with each chunk.
"""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .. import pipeline
from ..curve_set import CurveSet
from ..phonemes import SILENCE
from ..weights import sample
from .spans import PhoneSpan, to_schedule
from .sphinx import RATE, Sphinx
from .transcript import our_name
from .utterance import Audio, Utterance

#: Samples of one chunk: 40 ms.
CHUNK = 640
#: Phones of the past that a new one can still change: the smoothing window reaches no further.
TAIL = 12
#: Seconds the picture follows behind the sound: ten frames until a phone is known, and most of the next one.
DELAY = 0.28
#: Seconds kept for "record as utterance".
LONGEST = 600.0


@dataclass(frozen=True)
class Moment:
    """What one chunk brought.

    weights  (poses,) for the face, now
    phone    the newest phone that is known
    shown    the second of the stream the weights belong to
    latency  seconds from sound to lips, the chunk's own length and computing included
    cost     seconds of computing for this chunk
    """

    weights: NDArray[np.float64]
    phone: str
    shown: float
    latency: float
    cost: float


class Live:
    """A stream of sound being lip-synced. One thread feeds it.

    keep  whether sound and phones are kept in memory, for `recorded`; never longer than LONGEST
    """

    def __init__(self, sphinx: Sphinx, curve_set: CurveSet, *, keep: bool = True) -> None:
        self._sphinx = sphinx
        self.curve_set = curve_set
        self._keep = keep
        self._phones: list[PhoneSpan] = []
        self._sound: list[NDArray[np.int16]] = []
        self._heard = 0
        self._stages: pipeline.Stages | None = None

    @property
    def seconds(self) -> float:
        """How much has been heard."""
        return self._heard / RATE

    def feed(self, chunk: NDArray[np.float32]) -> Moment:
        """The next samples at 16 kHz, usually CHUNK of them. UserError, `Cancelled` as `Sphinx`."""
        begin = time.perf_counter()
        samples = np.clip(np.rint(chunk * 32767 + _DITHER[: chunk.size]), -32768, 32767).astype(np.int16)
        phones, _ = self._sphinx.live(samples, first=self._heard == 0)
        self._heard += chunk.size
        if self._keep and self.seconds <= LONGEST:
            self._sound.append(samples)
        if phones:
            self._phones += [(our_name(name), max(0.0, start), end) for name, start, end in phones]
            self._stages = self._tail()
        known = self._phones[-1][2] if self._phones else 0.0
        shown = max(0.0, self.seconds - DELAY)
        weights = np.zeros(len(self.curve_set.poses))
        if self._stages is not None and known >= shown:
            weights = sample(self._stages.magenta, self.curve_set.effective_settings.spline, shown)[0]
        elif self._stages is not None:  # a long phone or a pause: it lasts until we hear otherwise
            held = max(self._stages.schedule.start, known - 0.03)
            weights = sample(self._stages.magenta, self.curve_set.effective_settings.spline, held)[0]
        cost = time.perf_counter() - begin
        phone = self._phones[-1][0] if self._phones else SILENCE
        return Moment(weights, phone, shown, DELAY + chunk.size / RATE + cost, cost)

    def recorded(self) -> Utterance | None:
        """What was said until now; None when no phone was heard."""
        if not self._sound or all(phone == SILENCE for phone, _, _ in self._phones):
            return None
        samples = np.concatenate(self._sound).astype(np.float32) / np.float32(32768)
        audio = Audio(samples, RATE)
        return Utterance("", to_schedule(self._phones, 0.0, audio.duration), audio)

    def _tail(self) -> pipeline.Stages:
        spans = self._phones[-TAIL:]
        if not self._keep:
            self._phones = spans
        end = spans[-1][2]
        # the silence stands for the phone that is not known yet
        return pipeline.run(to_schedule(spans, spans[0][1], end + 0.1), self.curve_set)


#: Digital silence breaks the recogniser.
_DITHER = np.random.default_rng(0).normal(0, 5, 1 << 16).astype(np.float32)
