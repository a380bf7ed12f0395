"""Every way in but typing, together: recordings and label files, the microphone, the voice and its phoneme map."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject

from .microphone import Microphone
from .parts import Parts
from .phones import Phones
from .recording import Recording
from .sentence import Sentence
from .voice import Voice


class SpeechIn(QObject):
    """Makes them, and passes on what concerns them all."""

    def __init__(self, parts: Parts, sentence: Sentence, parent: QObject) -> None:
        super().__init__(parent)
        self.phones = Phones(parts, sentence, self)
        self.recording = Recording(parts, sentence, self.phones, self)
        self.voice = Voice(parts, sentence, self)
        self.microphone = Microphone(parts, sentence, self.recording, self)
        actions = parts.window.actions_
        actions.open_recording.triggered.connect(self.recording.ask_open)
        actions.open_labels.triggered.connect(self.recording.ask_labels)
        actions.save_utterance.triggered.connect(self.recording.ask_save)

    def take(self, path: Path) -> bool:
        """Open what was dropped, if it is of ours; whether it was."""
        return self.voice.take(path) or self.recording.take(path)

    def may_close(self) -> bool:
        """Whether the window may close."""
        return self.recording.may_discard()

    def restore(self) -> None:
        """Last time's rate and pitch."""
        self.voice.restore()

    def close(self) -> None:
        """Remember, and stop what runs."""
        self.voice.remember()
        self.recording.close()
        self.microphone.close()
