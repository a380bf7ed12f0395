"""Speaks on a thread: a sentence goes in, an Utterance comes back as a signal; only the latest counts."""

from __future__ import annotations

import threading

from PySide6.QtCore import QObject, Qt, Signal, Slot

from core_pipeline.errors import UserError
from core_pipeline.speech.espeak import PITCH
from core_pipeline.speech.speaker import Speaker
from core_pipeline.speech.utterance import Utterance

_Wish = tuple[int, str, str, int, int]


class SpeechWorker(QObject):
    """Answers each `request` with `spoken` or `failed`, unless a newer one came. Call `stop` at the end."""

    spoken = Signal(object)  # Utterance
    failed = Signal(str)
    _done = Signal(int, object)  # number of the request; Utterance or exception

    def __init__(self, speaker: Speaker | None = None, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._speaker = speaker or Speaker()
        self._number = 0
        self._wish: _Wish | None = None
        self._stopped = False
        self._changed = threading.Condition()
        self._done.connect(self._deliver, Qt.ConnectionType.QueuedConnection)
        self._thread = threading.Thread(target=self._work, name="speech", daemon=True)
        self._thread.start()

    def request(self, text: str, voice: str = "en-us", rate: int = 175, pitch: int = PITCH) -> None:
        """Speak this; answers to earlier requests will not come any more."""
        with self._changed:
            self._number += 1
            self._wish = (self._number, text, voice, rate, pitch)
            self._changed.notify()

    def stop(self) -> None:
        """End thread and voice, even in the middle of a sentence; nothing is emitted afterwards."""
        with self._changed:
            self._stopped = True
            self._wish = None
            self._changed.notify()
        self._speaker.close()
        self._thread.join(5)

    def _work(self) -> None:
        self._speaker.warm_up()
        while wish := self._next():
            number, text, voice, rate, pitch = wish
            result: Utterance | Exception
            try:
                result = self._speaker.speak(text, voice, rate, pitch)
            except Exception as error:  # noqa: BLE001 - told or raised on the thread of the interface
                result = error
            if not self._stopped:
                self._done.emit(number, result)

    def _next(self) -> _Wish | None:
        """Wait for the newest request; None at the end."""
        with self._changed:
            self._changed.wait_for(lambda: self._wish or self._stopped)
            wish, self._wish = self._wish, None
            return wish

    @Slot(int, object)
    def _deliver(self, number: int, result: Utterance | Exception) -> None:
        if number != self._number or self._stopped:
            return
        if isinstance(result, UserError):
            self.failed.emit(str(result))
        elif isinstance(result, Exception):
            raise result
        else:
            self.spoken.emit(result)
