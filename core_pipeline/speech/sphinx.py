"""pocketsphinx in a process of its own (sphinx_process.py): sound → words and phones in frames of 10 ms.

The process is started at the first task and kept warm. Whoever cancels ends it; the next task starts
another.
"""

from __future__ import annotations

import importlib.util
import sys
import threading
import weakref
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..errors import UserError
from .child_process import ChildProcess

#: Samples per second that the acoustic model wants.
RATE = 16000
FRAME = 0.01  # seconds
#: Half the analysis window: a frame's sound lies this much later than its number says.
OFFSET = 0.0128
#: Silence put before and after the sound, in seconds.
PADDING = 0.2

_PROGRAM = Path(__file__).with_name("sphinx_process.py")


class Cancelled(Exception):  # noqa: N818 - a wish of the user's, no error
    """The task was given up on the user's wish."""


class Span(NamedTuple):
    """A word or phone, in seconds of the sound. score: a phone's fit (0 best), a word's probability."""

    name: str
    start: float
    end: float
    score: float = 0.0


class AlignedWord(NamedTuple):
    """A word with its phones."""

    name: str
    start: float
    end: float
    phones: tuple[Span, ...]


def is_installed() -> bool:
    """Whether pocketsphinx is here at all. Imports nothing."""
    return importlib.util.find_spec("pocketsphinx") is not None


class Sphinx:
    """Hears with a warm process; one task at a time. Any thread may call `cancel` and `close`."""

    def __init__(self, timeout: float = 300.0) -> None:
        self._timeout = timeout
        self._lock = threading.Lock()
        self._process: ChildProcess | None = None
        self._cancelled = self._closed = False

    @property
    def process_id(self) -> int | None:
        """Of the warm process; None before the first task and after its end."""
        process = self._process
        return process.id if process and process.alive else None

    def begin(self) -> None:
        """A new piece of work: an earlier `cancel` no longer counts."""
        self._cancelled = False

    def cancel(self) -> None:
        """Give up what is being done, at once: its caller gets `Cancelled`."""
        self._cancelled = True
        if process := self._process:
            process.stop()

    def close(self) -> None:
        """End the process for good."""
        self._closed = True
        self.cancel()

    def unknown(self, words: Sequence[str]) -> list[str]:
        """Those of the words that the dictionary does not list."""
        found: list[str] = self._ask({"task": "unknown", "words": list(words)})["words"]
        return found

    def align(
        self,
        sound: NDArray[np.float32],
        words: Sequence[str],
        spoken: Mapping[str, str],
        *,
        wide: bool = False,
        open_end: bool = False,
    ) -> list[AlignedWord]:
        """When each word and phone sounds; pauses are words named "<sil>". [] when the words do not fit.

        sound     (n,) at 16 kHz, at most about half a minute: memory grows with its square
        spoken    word → phones in capitals, for words the dictionary lacks
        wide      search nearly everywhere: finds something even in a wrong text
        open_end  the sound may end before the words do
        """
        request = {"task": "align", "words": list(words), "spoken": dict(spoken), "wide": wide, "open": open_end}
        found = self._ask(request, padded(sound))["words"]
        return [
            AlignedWord(_bare(name), *_seconds(first, frames), tuple(_span(phone) for phone in phones))
            for name, first, frames, phones in found
        ]

    def words(self, sound: NDArray[np.float32]) -> list[Span]:
        """What was said, as pocketsphinx's large vocabulary hears it, with probabilities; no pauses."""
        found = self._ask({"task": "words"}, padded(sound))["words"]
        spans = (Span(_bare(name), *_seconds(first, frames), score) for name, first, frames, score in found)
        return [span for span in spans if span.name[:1] not in "<[" and span.name]

    def phones(self, sound: NDArray[np.float32]) -> list[Span]:
        """The phones that are heard, "SIL" for pauses and noise, without any text."""
        found = self._ask({"task": "phones"}, padded(sound))["phones"]
        return [Span(name, *_seconds(first, frames)) for name, first, frames in found]

    def live(self, chunk: NDArray[np.int16], *, first: bool) -> tuple[list[tuple[str, float, float]], float]:
        """The next samples of a stream: phones that are now known, in seconds of the stream, and its present length."""
        answer = self._ask({"task": "live", "first": first}, chunk)
        phones = [
            (str(name), begin * FRAME + OFFSET, (begin + frames) * FRAME + OFFSET)
            for name, begin, frames in answer["phones"]
        ]
        return phones, answer["now"] * FRAME

    def _ask(self, request: dict[str, object], sound: NDArray[np.int16] | None = None) -> dict[str, Any]:
        data = sound.astype("<i2").tobytes() if sound is not None else b""
        with self._lock:
            try:
                answer, _ = self._running().ask({**request, "bytes": len(data)}, self._timeout, data)
            except EOFError as error:
                if self._cancelled:
                    raise Cancelled from None
                if process := self._process:
                    process.stop()
                raise UserError(
                    f"Speech recognition stopped unexpectedly ({error}): try again, or with a shorter recording."
                ) from None
            if self._cancelled:
                raise Cancelled
        if problem := answer.get("error"):
            raise UserError(f"Speech recognition failed ({problem}): try another recording.")
        return answer

    def _running(self) -> ChildProcess:
        if self._closed or self._cancelled:
            raise Cancelled
        if self._process and self._process.alive:
            return self._process
        if not is_installed():
            raise UserError(
                "Recordings need the package pocketsphinx, which exists for Python 3.11 and 3.13: "
                "use one of these, or open a label file instead."
            )
        if self._process:
            self._process.stop()
        try:
            self._process = ChildProcess([sys.executable, "-P", str(_PROGRAM)])
            weakref.finalize(self, self._process.stop)
            greeting, _ = self._process.receive(self._timeout)
        except (OSError, EOFError) as error:
            if self._cancelled:
                raise Cancelled from None
            raise UserError(f"Speech recognition does not start ({error}): install pocketsphinx anew.") from None
        if problem := greeting.get("error"):
            self._process.stop()
            raise UserError(f"Speech recognition does not start ({problem}): install pocketsphinx anew.")
        return self._process


def padded(sound: NDArray[np.float32]) -> NDArray[np.int16]:
    """16-bit samples with PADDING around and dither: digital silence breaks the recogniser."""
    loud = np.pad(sound * np.float32(32767), round(PADDING * RATE))
    noise = np.random.default_rng(0).normal(0, 5, loud.size)
    return np.clip(np.rint(loud + noise), -32768, 32767).astype(np.int16)


def _seconds(first: int, frames: int) -> tuple[float, float]:
    shift = OFFSET - PADDING
    return first * FRAME + shift, (first + frames) * FRAME + shift


def _span(phone: Sequence[Any]) -> Span:
    name, first, frames, score = phone
    return Span(str(name), *_seconds(first, frames), score / max(frames, 1))


def _bare(name: str) -> str:
    """ "the(2)" → the."""
    return name.split("(", 1)[0] if name.endswith(")") else name
