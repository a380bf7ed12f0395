"""Reads, aligns and recognises recordings on a thread; only the newest wish counts, and it can be given up."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from core_pipeline.files.labels.label_file import LabelFile
from core_pipeline.files.labels.read import read as read_labels
from core_pipeline.speech.align import align
from core_pipeline.speech.audio_file import read_audio
from core_pipeline.speech.labels import Named, utterance_of
from core_pipeline.speech.recognise import Heard, hear_phones, hear_words
from core_pipeline.speech.speaker import Speaker
from core_pipeline.speech.sphinx import Cancelled, Sphinx
from core_pipeline.speech.utterance import Audio, Utterance

from .latest import Latest


@dataclass(frozen=True)
class Opened:
    """A recording that was read."""

    path: Path
    audio: Audio


@dataclass(frozen=True)
class Labelled:
    """A label file that was read, and what became of it; kept, so that names can be assigned later."""

    path: Path
    labels: LabelFile
    named: Named


Outcome = Opened | Utterance | Heard | Labelled


#: Work that tells its progress, 0…1.
Work = Callable[[Callable[[float], None]], Outcome]


class Hearing(QObject):
    """One piece of work at a time. Call `stop` at the end.

    opened(Opened), aligned(Utterance), heard(Heard), labelled(Labelled)
    progressed(fraction)  0…1
    failed(sentence)
    busy_changed(busy)
    """

    opened = Signal(object)
    aligned = Signal(object)
    heard = Signal(object)
    labelled = Signal(object)
    progressed = Signal(float)
    failed = Signal(str)
    busy_changed = Signal(bool)

    def __init__(self, speaker: Speaker, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._speaker = speaker
        self._sphinx = Sphinx()
        self._busy = False
        self._latest = Latest("hearing", self._work, self)
        self._latest.answered.connect(self._answered)
        self._latest.failed.connect(self._failed)

    def open(self, path: Path) -> None:
        """Read a recording."""
        self._begin(lambda _: Opened(path, read_audio(path)))

    def align(self, audio: Audio, text: str, voice: str) -> None:
        """Find when the words of `text` sound."""
        self._begin(lambda tell: align(audio, text, self._sphinx, self._speaker.espeak, tell, voice))

    def recognise(self, audio: Audio) -> None:
        """What is said?"""
        self._begin(lambda tell: hear_words(audio, self._sphinx, tell))

    def phones(self, audio: Audio) -> None:
        """Phones without words."""
        self._begin(lambda tell: hear_phones(audio, self._sphinx, tell))

    def labels(self, path: Path, audio: Audio | None, assigned: Mapping[str, str], known: tuple[str, ...]) -> None:
        """Read a label file."""

        def work(_: Callable[[float], None]) -> Labelled:
            found = read_labels(path, audio.rate if audio else None)
            return Labelled(path, found, utterance_of(found, audio, assigned, known))

        self._begin(work)

    def cancel(self) -> None:
        """Give up what is under way."""
        self._latest.cancel()
        self._sphinx.cancel()
        self._set_busy(False)

    def stop(self) -> None:
        """End thread and process; nothing is emitted afterwards."""
        self._sphinx.close()
        self._latest.stop()

    def _begin(self, work: Work) -> None:
        if self._busy:
            self._sphinx.cancel()  # what is under way is no longer wanted
        self._set_busy(True)
        self._latest.request(work)

    def _work(self, work: Work, is_old: Callable[[], bool]) -> Outcome | None:
        self._sphinx.begin()
        if is_old():
            return None

        def tell(done: float) -> None:
            if is_old():
                raise Cancelled
            self.progressed.emit(done)

        try:
            return work(tell)
        except Cancelled:
            return None

    def _set_busy(self, busy: bool) -> None:
        self._busy = busy
        self.busy_changed.emit(busy)

    def _answered(self, outcome: Outcome | None) -> None:
        self._set_busy(False)
        for kind, signal in (
            (Opened, self.opened),
            (Utterance, self.aligned),
            (Heard, self.heard),
            (Labelled, self.labelled),
        ):
            if isinstance(outcome, kind):
                signal.emit(outcome)

    def _failed(self, sentence: str) -> None:
        self._set_busy(False)
        self.failed.emit(sentence)
