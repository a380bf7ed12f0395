"""Time: which moment of the utterance is shown and heard.

The picture follows the sound. While a device plays, its clock is the time; without one, the clock of
the machine is. A timer asks for the time and never counts frames, so a slow picture drops frames and
stays in step.
"""

from __future__ import annotations

import time as system_time
from collections.abc import Callable

from PySide6.QtCore import QObject, Qt, QTimer, Signal

from core_pipeline.speech.utterance import Audio

from .audio_output import AudioOutput, Loop, advanced

SLOWEST, FASTEST = 0.25, 1.0
#: Seconds; a shorter loop would only buzz.
SHORTEST_LOOP = 0.05
_TICK = 16  # milliseconds
#: How long a moment is heard while it is scrubbed over, in milliseconds.
GRAIN = 70


class Player(QObject):
    """Plays, pauses and seeks; emits the time in seconds whenever it changed.

    output  where sound goes; None: silent
    clock   seconds that only rise
    """

    time_changed = Signal(float)
    playing_changed = Signal(bool)
    ended = Signal()

    def __init__(
        self,
        output: AudioOutput | None = None,
        clock: Callable[[], float] = system_time.monotonic,
        parent: QObject | None = None,
    ) -> None:
        super().__init__(parent)
        self._output, self._clock = output, clock
        self._audio: Audio | None = None
        self._duration = 0.0
        self._time = 0.0
        self._since = 0.0  # the clock when the time was self._time
        self._playing = False
        self._audible = False  # the sound's clock counts
        self._speed = 1.0
        self._looping = False
        self._range: Loop | None = None
        self._timer = QTimer(self)
        self._timer.setTimerType(Qt.TimerType.PreciseTimer)
        self._timer.setInterval(_TICK)
        self._timer.timeout.connect(self.update)
        self._grain = QTimer(self)
        self._grain.setSingleShot(True)
        self._grain.setInterval(GRAIN)
        self._grain.timeout.connect(self._grain_over)
        self._grain_at = 0.0

    @property
    def time(self) -> float:
        """Seconds from the start of the utterance, as last emitted."""
        return self._time

    @property
    def duration(self) -> float:
        """Seconds."""
        return self._duration

    @property
    def playing(self) -> bool:
        """Does time pass?"""
        return self._playing

    @property
    def speed(self) -> float:
        """1 is as spoken."""
        return self._speed

    @property
    def looping(self) -> bool:
        """Does it start again at the end?"""
        return self._looping

    @property
    def loop_range(self) -> Loop | None:
        """What is repeated, in seconds; None: all."""
        return self._range

    def set_utterance(self, duration: float, audio: Audio | None) -> None:
        """Another utterance, of `duration` seconds; stops, and goes to its start."""
        self.pause()
        if self._grain.isActive():
            self._grain.stop()
            self._silence()
        self._duration, self._audio, self._range = max(0.0, duration), audio, None
        self._move_to(0.0)

    def play(self) -> None:
        """From here on; from the start (of the loop) when it stands at the end."""
        if self._playing or self._duration <= 0:
            return
        if self._time >= self._duration:
            self._move_to(self._loop[0] if self._loop else 0.0)
        self._playing = True
        self._go()
        self._timer.start()
        self.playing_changed.emit(True)

    def pause(self) -> None:
        """Hold the time."""
        if not self._playing:
            return
        self.update()
        if self._playing:  # it may just have ended
            self._halt()

    def toggle(self) -> None:
        """Play or pause."""
        self.pause() if self._playing else self.play()

    def seek(self, time: float) -> None:
        """Go to a time; playing goes on from there."""
        self._move_to(min(max(time, 0.0), self._duration))
        if self._playing:
            self._go()

    def scrub(self, time: float) -> None:
        """Go to a time by hand: while nothing plays, each moment passed is heard shortly."""
        self.seek(time)
        if not self._playing and not self._grain.isActive():
            self._sound_here()

    def _sound_here(self) -> None:
        if self._output is not None and self._audio is not None:
            self._grain_at = self._time
            end = min(self._time + 2e-3 * GRAIN, self._duration)  # should nobody come to stop it
            self._output.play(self._audio, self._time, end)
            self._grain.start()

    def _grain_over(self) -> None:
        if self._playing:
            return
        if self._time != self._grain_at:  # the hand has gone on meanwhile
            self._sound_here()
        else:
            self._silence()

    def _silence(self) -> None:
        if self._output is not None:
            self._output.stop()

    def set_speed(self, speed: float) -> None:
        """0.25…1, clamped."""
        self.update()
        self._speed = min(max(speed, SLOWEST), FASTEST)
        self._again()

    def set_looping(self, looping: bool) -> None:
        """Repeat at the end, or stop there."""
        self.update()
        self._looping = looping
        self._again()

    def set_loop_range(self, loop: Loop | None) -> None:
        """What is repeated when looping: start and end in seconds, clamped; None or too short: all."""
        self.update()
        if loop is not None:
            first, last = max(0.0, min(loop)), min(self._duration, max(loop))
            loop = (first, last) if last - first >= SHORTEST_LOOP else None
        self._range = loop
        self._again()

    def update(self) -> None:
        """Read the clock now; the timer does it 60 times a second."""
        if not self._playing:
            return
        time = self._output.position() if self._audible and self._output else None
        now = self._clock()
        if time is None:  # no sound, or no longer: on with the machine's clock from where it stood
            self._audible = False
            time = float(advanced(self._time, (now - self._since) * self._speed, self._duration, self._loop))
        self._since = now
        self._move_to(time)
        if self._loop is None and time >= self._duration:
            self._halt()
            self.ended.emit()

    @property
    def _loop(self) -> Loop | None:
        return (self._range or (0.0, self._duration)) if self._looping else None

    def _move_to(self, time: float) -> None:
        if time != self._time:
            self._time = time
            self.time_changed.emit(time)

    def _again(self) -> None:
        if self._playing:
            self._go()

    def _go(self) -> None:
        """Let sound and clock start from the present time."""
        self._since = self._clock()
        self._audible = self._output is not None and self._audio is not None
        if self._output is not None and self._audio is not None:
            self._output.play(self._audio, self._time, self._duration, self._speed, self._loop)

    def _halt(self) -> None:
        self._timer.stop()
        self._playing = False
        self._silence()
        self.playing_changed.emit(False)
