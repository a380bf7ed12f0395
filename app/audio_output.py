"""The loudspeaker: plays an utterance and says which moment of it is heard right now.

PortAudio opens and starts on a thread of its own, because that may take a second; nothing here waits.
Without a device, or without PortAudio, `available` is False, `reason` says why, and the player keeps
silent time.
"""

from __future__ import annotations

import ctypes
import queue
import sys
import threading
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from PySide6.QtCore import QObject, Signal

from core_pipeline.speech.utterance import Audio

#: Start and end in seconds of what repeats.
Loop = tuple[float, float]

#: Seconds between filling a buffer and hearing it: enough for a busy interface.
_LATENCY = 0.06
#: Seconds over which sound fades in and out, against clicks.
_FADE = 0.004
#: Buffers remembered; more than lie between filling and hearing.
_REMEMBERED = 64


def advanced(time: float, by: ArrayLike, duration: float, loop: Loop | None) -> NDArray[np.float64]:
    """Where an utterance stands when it has played on for `by` seconds (any shape) from `time`.

    Without a loop it stays at its end. A loop jumps back from its end, or, when `time` lies behind that,
    from the end of the utterance.
    """
    ahead = time + np.asarray(by, np.float64)
    if loop is None:
        return np.minimum(ahead, duration)
    first, last = loop
    over = ahead - (last if time < last else duration)
    return np.where(over < 0, ahead, first + np.mod(over, last - first))


class Playback:
    """An utterance on its way out: hands out sound, buffer by buffer, at any speed (varispeed).

    time      seconds of the utterance, of the next sample
    duration  seconds; the sound may be shorter, then silence follows
    """

    def __init__(self, audio: Audio, time: float, duration: float, speed: float, loop: Loop | None) -> None:
        self.start = self.time = time
        self.speed = speed
        self.duration = duration
        self.loop = loop
        self._samples, self._rate = audio.samples, audio.rate
        self._fresh = True

    def fill(self, out: NDArray[np.float32], rate: float) -> None:
        """The next samples into out (n,), interpolated straight between those of the sound."""
        n = out.size
        at = self.after(self.time, np.arange(n + 1) / rate)
        x = at[:-1] * self._rate
        i = x.astype(np.intp)
        size = self._samples.size
        inside = (i + 1 < size) & (at[:-1] < self.duration)
        i = np.where(inside, i, 0)
        if size > 1:
            low = self._samples[i]
            out[:] = np.where(inside, low + (x - i) * (self._samples[i + 1] - low), 0)
        else:
            out[:] = 0
        if self._fresh:
            fade = min(n, max(1, round(_FADE * rate)))
            out[:fade] *= np.linspace(0, 1, fade, endpoint=False, dtype=np.float32)
            self._fresh = False
        self.time = float(at[-1])

    def after(self, time: float, seconds: ArrayLike) -> NDArray[np.float64]:
        """Where it stands `seconds` of the listener's time after `time`."""
        return advanced(time, np.multiply(seconds, self.speed), self.duration, self.loop)


class AudioOutput(QObject):
    """One stream to the default device, opened when first needed; call `close` at the end.

    `ready` comes once, on the thread of this object, when `available` and `reason` are known; `lost` when
    the device went away afterwards.
    """

    ready = Signal(bool)
    lost = Signal(str)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._available = False
        self._reason = self.tr("the audio device is being opened")
        self._stream: Any = None
        self._rate = 48000.0
        self._playback: Playback | None = None
        self._sounding: Playback | None = None
        # (playback, when its first sample is heard, the utterance's time there, seconds), replaced as a whole
        self._blocks: tuple[tuple[Playback, float, float, float], ...] = ()
        self._jobs: queue.SimpleQueue[Callable[[], None] | None] = queue.SimpleQueue()
        self._thread: threading.Thread | None = None
        self._opened = threading.Event()
        self._closed = False
        self._starting = False
        self._lost = False

    @property
    def available(self) -> bool:
        """Can sound be heard? False until the device is open."""
        return self._available

    @property
    def reason(self) -> str:
        """Why not, as a part of a sentence; empty when available."""
        return self._reason

    def open(self) -> None:
        """Begin to open the device; `ready` follows."""
        if self._thread is None and not self._closed:
            self._thread = threading.Thread(target=self._work, name="audio output", daemon=True)
            self._thread.start()
            self._jobs.put(self._open)

    def play(
        self, audio: Audio, time: float, duration: float | None = None, speed: float = 1.0, loop: Loop | None = None
    ) -> None:
        """Play from `time` (seconds) on, instead of what played before.

        duration  seconds of the utterance, by default those of the sound
        speed     0.25…1; the pitch sinks with it
        """
        self.open()
        self._playback = Playback(audio, time, audio.duration if duration is None else duration, speed, loop)
        self._starting = True
        self._jobs.put(self._start)

    def stop(self) -> None:
        """Silence."""
        self._playback = None
        if self._thread is not None:
            self._jobs.put(self._rest)

    def position(self) -> float | None:
        """The utterance's time that is heard right now, by the clock of the stream; None without sound."""
        playback, stream = self._playback, self._stream
        if playback is None or (self._opened.is_set() and not self._available):
            return None
        blocks = [block for block in self._blocks if block[0] is playback]
        if stream is None or not blocks:
            return playback.start  # nothing of it has been handed out yet
        if not stream.active:
            if self._starting:  # the stop of what played before is still under way
                return playback.start
            self._lose()
            return None
        return heard(blocks, stream.time)

    def close(self) -> None:
        """Stop and give the device back; waits for the thread."""
        self._playback, self._closed = None, True
        thread, self._thread = self._thread, None
        if thread is not None:
            self._jobs.put(self._shut)
            self._jobs.put(None)
            thread.join(2)
        self._available, self._reason = False, self.tr("the audio device is closed")
        self._opened.set()

    # on the thread

    def _work(self) -> None:
        while (job := self._jobs.get()) is not None:
            job()

    def _open(self) -> None:
        _silence_alsa()
        try:
            import sounddevice
        except OSError:
            self._know(self.tr("PortAudio is missing (on Debian: libportaudio2)"))
            return
        except ImportError:
            self._know(self.tr("the package sounddevice is missing"))
            return
        try:
            device = sounddevice.query_devices(kind="output")
            self._rate = float(device["default_samplerate"])
            self._stream = sounddevice.OutputStream(
                samplerate=self._rate,
                channels=min(2, device["max_output_channels"]),
                dtype="float32",
                latency=_LATENCY,
                callback=self._fill,
            )
        except (sounddevice.PortAudioError, ValueError):
            self._know(self.tr("no audio device"))
            return
        self._know("")

    def _know(self, reason: str) -> None:
        self._available, self._reason = not reason, reason
        self._opened.set()
        self.ready.emit(not reason)

    def _start(self) -> None:
        stream = self._stream
        if stream is not None and not stream.active and self._playback is not None:
            import sounddevice

            try:
                stream.stop()  # what ended by itself must be stopped before it can start again
                stream.start()
            except sounddevice.PortAudioError:
                self._lose()
        self._starting = False

    def _rest(self) -> None:
        if self._stream is not None and self._playback is None and self._stream.active:
            self._stream.stop()  # lets the fade be heard
            self._blocks = ()
            self._sounding = None

    def _shut(self) -> None:
        stream, self._stream = self._stream, None
        if stream is not None and not self._lost:  # closing a lost device may never return
            stream.close()

    def _lose(self) -> None:
        if self._available:
            self._lost = True
            self._available, self._reason = False, self.tr("the audio device stopped")
            self.lost.emit(self._reason)

    # on PortAudio's thread

    def _fill(self, out: NDArray[np.float32], frames: int, times: Any, _status: object) -> None:
        """PortAudio wants `frames` samples in out (frames, channels)."""
        playback, before = self._playback, self._sounding
        sound = np.zeros(frames, np.float32)
        if playback is not None:
            begin = playback.time
            playback.fill(sound, self._rate)
            # some drivers do not tell when a buffer will be heard
            at = times.outputBufferDacTime
            at = at if at >= times.currentTime > 0 else times.currentTime + _LATENCY
            self._blocks = (*self._blocks[1 - _REMEMBERED :], (playback, at, begin, frames / self._rate))
        if before is not None and before is not playback:  # cut off: fade it out below the new one
            fade = min(frames, round(_FADE * self._rate))
            rest = np.zeros(fade, np.float32)
            before.fill(rest, self._rate)
            sound[:fade] += rest * np.linspace(1, 0, fade, dtype=np.float32)
        self._sounding = playback
        out[:] = sound[:, None]


def heard(blocks: list[tuple[Playback, float, float, float]], now: float) -> float:
    """The utterance's time that is heard at `now`.

    blocks  in order: playback, when the first sample is heard, the utterance's time there, seconds
    """
    for playback, at, begin, seconds in reversed(blocks):
        if at <= now:
            return float(playback.after(begin, min(now - at, seconds)))
    return blocks[0][2]


_Handler = ctypes.CFUNCTYPE(None, ctypes.c_char_p, ctypes.c_int, ctypes.c_char_p, ctypes.c_int, ctypes.c_char_p)
_quiet = _Handler(lambda *_: None)


def _silence_alsa() -> None:
    """ALSA prints a page to stderr for every device it does not find."""
    if sys.platform == "linux":
        try:
            ctypes.CDLL("libasound.so.2").snd_lib_error_set_handler(_quiet)
        except (OSError, AttributeError):
            return  # no ALSA, no noise
