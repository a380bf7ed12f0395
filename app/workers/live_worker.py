"""Listens on a thread: the microphone, or a recording replayed at its own pace, becomes weights as it comes."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QObject, Qt, Signal

from core_pipeline.curve_set import CurveSet
from core_pipeline.errors import UserError
from core_pipeline.speech.audio_file import resampled
from core_pipeline.speech.live import CHUNK, Live, Moment
from core_pipeline.speech.sphinx import RATE, Cancelled, Sphinx
from core_pipeline.speech.utterance import Audio, Utterance

#: Samples of the longest chunk: what has waited on a busy machine is taken at once.
MOST = 16 * CHUNK
#: A chunk, and how many seconds ago its last sample was spoken.
_Chunk = tuple[NDArray[np.float32], float]


@dataclass(frozen=True)
class Heard:
    """A moment, how loud its chunk was (0…1), and how late all of it is by now, in seconds."""

    moment: Moment
    loudness: float
    latency: float


class LiveWorker(QObject):
    """One stream at a time. Call `close` at the end.

    heard(Heard)    40 ms more
    ended(sentence) it is over; the sentence says why, "" when it was wished for or the recording ended
    """

    heard = Signal(object)
    ended = Signal(str)
    _over = Signal(int, str)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._sphinx = Sphinx()
        self._thread: threading.Thread | None = None
        self._halt = threading.Event()
        self._number = 0
        self._live: Live | None = None
        self._over.connect(self._finish, Qt.ConnectionType.QueuedConnection)

    @property
    def running(self) -> bool:
        """Whether a stream is being heard."""
        return self._thread is not None

    def listen(self, device: int | None, curve_set: CurveSet) -> None:
        """Hear a microphone."""
        self._start(lambda halt: _microphone(device, halt), curve_set)

    def replay(self, audio: Audio, curve_set: CurveSet) -> None:
        """Hear a recording at its own pace."""
        self._start(lambda halt: _replayed(audio, halt), curve_set)

    def set_curve_set(self, curve_set: CurveSet) -> None:
        """Other curves from the next chunk on."""
        if self._live is not None:
            self._live.curve_set = curve_set

    def recorded(self) -> Utterance | None:
        """What was said until now; None when nothing was."""
        return self._live.recorded() if self._live is not None else None

    def stop(self) -> None:
        """Stop hearing; what was said is kept."""
        self._halt.set()
        if self._thread is not None:
            self._thread.join(10)
            self._finish(self._number, "")

    def close(self) -> None:
        """End thread and process."""
        self._halt.set()
        self._sphinx.close()
        if self._thread is not None:
            self._thread.join(10)
        self._thread = None

    def _start(self, source: Callable[[threading.Event], Iterator[_Chunk]], curve_set: CurveSet) -> None:
        self.stop()
        self._halt = threading.Event()
        self._number += 1
        self._live = Live(self._sphinx, curve_set)
        work = (source, self._live, self._halt, self._number)
        self._thread = threading.Thread(target=self._run, args=work, name="live", daemon=True)
        self._thread.start()

    def _run(
        self, source: Callable[[threading.Event], Iterator[_Chunk]], live: Live, halt: threading.Event, number: int
    ) -> None:
        reason = ""
        try:
            for chunk, age in source(halt):
                moment = live.feed(chunk)
                loudness = float(np.sqrt(np.mean(np.square(chunk)))) * 4
                self.heard.emit(Heard(moment, loudness, moment.latency + age))
        except UserError as error:
            reason = str(error)
        except Cancelled:
            return
        self._over.emit(number, reason)

    def _finish(self, number: int, reason: str) -> None:
        if number == self._number and self._thread is not None:
            self._thread.join(10)
            self._thread = None
            self.ended.emit(reason)


def _replayed(audio: Audio, halt: threading.Event) -> Iterator[_Chunk]:
    sound = resampled(audio, RATE).samples
    begin, i = time.monotonic(), 0
    while i + CHUNK <= sound.size:
        due = begin + (i + CHUNK) / RATE
        if halt.wait(max(0.0, due - time.monotonic())):
            return
        waiting = int((time.monotonic() - due) * RATE)
        size = min(CHUNK + max(0, waiting), MOST, sound.size - i)
        i += size
        yield sound[i - size : i], max(0.0, time.monotonic() - (begin + i / RATE))


def _microphone(device: int | None, halt: threading.Event) -> Iterator[_Chunk]:
    """UserError when it cannot be opened, or is unplugged."""
    sounddevice = _sounddevice()
    try:
        rate = round(sounddevice.query_devices(device, "input")["default_samplerate"])
        size = round(CHUNK * rate / RATE)
        with sounddevice.InputStream(rate, size, device, 1, "float32", latency="low") as stream:
            while not halt.is_set():
                times = min(1 + stream.read_available // size, MOST // CHUNK)
                data, _ = stream.read(times * size)
                waiting = stream.read_available / rate
                at = np.arange(times * CHUNK) * rate / RATE
                sound = data[:, 0] if rate == RATE else np.interp(at, np.arange(times * size), data[:, 0])
                yield sound.astype(np.float32), waiting
    except (sounddevice.PortAudioError, ValueError) as error:
        raise UserError(f"The microphone cannot be heard ({error}): choose another one.") from None


def microphones() -> tuple[list[tuple[int, str]], str]:
    """(number, name) of all; without any, why, as the beginning of a sentence."""
    try:
        devices = _sounddevice().query_devices()
    except UserError as error:
        return [], str(error).rstrip(".")
    except Exception as error:  # noqa: BLE001 - PortAudio says this in many ways
        return [], f"No sound device can be used ({error})"
    found = [(i, str(d["name"])) for i, d in enumerate(devices) if d["max_input_channels"] > 0]
    return found, "" if found else "No microphone was found"


def _sounddevice() -> Any:
    try:
        import sounddevice
    except (ImportError, OSError):
        raise UserError("The microphone needs PortAudio (Linux: the package libportaudio2).") from None
    return sounddevice
