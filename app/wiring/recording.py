"""A recording: opened, aligned with its words or recognised, its label file read, its phones saved."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QFileDialog, QMessageBox

from core_pipeline.errors import UserError
from core_pipeline.files.labels.read import ENDINGS
from core_pipeline.phonemes import SILENCE
from core_pipeline.schedule import Schedule
from core_pipeline.speech.audio_file import SOUND_FILES, VIDEO_FILES
from core_pipeline.speech.espeak import VOICES
from core_pipeline.speech.intake import transcript_of
from core_pipeline.speech.recognise import Heard
from core_pipeline.speech.utterance import Audio, Utterance
from widgets.speech.assign_dialog import AssignDialog

from ..spoken_files import from_zero, is_spoken, recording_of, save_spoken, saved_beside
from ..workers.hearing import Hearing, Labelled, Opened
from .parts import Parts
from .phones import Phones
from .sentence import Sentence

#: Letters of a text that is said as one sentence.
LONGEST = 500

_Button = QMessageBox.StandardButton
_UTTERANCE, _TEXTGRID, _SCHEDULE = (
    "Phones and words (*.utterance.json)",
    "Praat TextGrid (*.TextGrid)",
    "Schedule (*.json)",
)


class Recording(QObject):
    """The recording that is open, what is known of its words, and edits of its phones that are not saved.

    path, audio  None while no recording is open
    """

    def __init__(self, parts: Parts, sentence: Sentence, phones: Phones, parent: QObject) -> None:
        super().__init__(parent)
        self._window = parts.window
        self._panel = parts.window.recording_panel
        self._session = parts.session
        self._document = parts.document
        self._files = parts.files
        self._state = parts.state
        self._sentence = sentence
        self.path: Path | None = None
        self.audio: Audio | None = None
        self._unsaved: Utterance | None = None  # edited by hand, and not kept
        self._next: Path | None = None  # the file whose phones belong to the recording that is being read
        self.hearing = Hearing(parts.speaker, self)
        hearing, panel = self.hearing, self._panel
        hearing.opened.connect(self._opened)
        hearing.aligned.connect(self._aligned)
        hearing.heard.connect(self._heard)
        hearing.labelled.connect(self._labelled)
        hearing.progressed.connect(panel.set_progress)
        hearing.busy_changed.connect(panel.set_busy)
        hearing.failed.connect(self._failed)
        panel.open_wanted.connect(self.ask_open)
        panel.labels_wanted.connect(self.ask_labels)
        panel.align_wanted.connect(self.align)
        panel.recognise_wanted.connect(self._recognise)
        panel.phones_wanted.connect(self._phones)
        panel.cancelled.connect(self._cancel)
        panel.save_wanted.connect(self.ask_save)
        phones.edited.connect(self._was_edited)
        parts.session.stages_changed.connect(lambda _: panel.set_can_save(parts.session.utterance is not None))

    # ── in ───────────────────────────────────────────────────────────────────────────────────────

    def ask_open(self) -> None:
        """Choose a recording."""
        kinds = " ".join(f"*{ending}" for ending in (*SOUND_FILES, *VIDEO_FILES))
        filters = self.tr("Recordings ({0});;All files (*)").format(kinds)
        name, _ = QFileDialog.getOpenFileName(
            self._window, self.tr("Open a recording"), self._state.text("recordings"), filters
        )
        if name:
            self.open(Path(name))

    def ask_labels(self) -> None:
        """Choose a label file."""
        kinds = " ".join(f"*{ending}" for ending in (".TextGrid", *ENDINGS, ".json"))
        filters = self.tr("Label files ({0});;All files (*)").format(kinds)
        name, _ = QFileDialog.getOpenFileName(
            self._window, self.tr("Open a label file"), self._state.text("recordings"), filters
        )
        if name:
            self.open_labels(Path(name))

    def take(self, path: Path) -> bool:
        """Open what was dropped, if it is a recording, a transcript or a label file; whether it was."""
        ending = path.suffix.lower()
        if ending in (*SOUND_FILES, *VIDEO_FILES):
            self.open(path)
        elif ending == ".txt":
            self.open_transcript(path)
        elif ending in ENDINGS or (ending == ".json" and is_spoken(path)):
            self.open_labels(path)
        else:
            return False
        return True

    def open(self, path: Path) -> None:
        """Read a recording; it is played as it is until its words are known: what is typed next are those."""
        if not self.may_discard():
            return
        self._show()
        self._panel.transcript.setFocus()
        self._state.put("recordings", str(path.parent))
        self._panel.set_message(self.tr("Reading {0} …").format(path.name))
        self.hearing.open(path)

    def open_transcript(self, path: Path) -> None:
        """The words of a text file: of the recording that is open, else a sentence to say."""
        try:
            text = transcript_of(str(path))
            if self.audio is None and len(text) > LONGEST:
                told = self.tr("{0} is too long for one sentence: drop its recording first, or a shorter text.")
                raise UserError(told.format(path.name))
        except UserError as error:
            self._window.hint_label.setText(str(error))
            self._panel.set_message(str(error), "error")
            return
        if self.audio is None:
            self._sentence.type(" ".join(text.split()), play=False)
            return
        self._show()
        self._panel.set_transcript(text)
        self._panel.set_message(self.tr("Press Align to find when these words sound."))

    def open_labels(self, path: Path) -> None:
        """Read a label file, for the open recording or for the one beside it."""
        if not self.may_discard():
            return
        self._show()
        recording = recording_of(path)
        if recording is not None and recording != self.path:
            self._next = path  # an utterance of ours: its sound first
            self.open(recording)
            return
        curve_set = self._document.curve_set
        known = (*curve_set.phonemes, *curve_set.phoneme_map)
        self.hearing.labels(path, self.audio, self._assigned(), known)

    def _opened(self, opened: Opened) -> None:
        self.path, self.audio = opened.path, opened.audio
        self._panel.set_recording(opened.path.name, opened.audio.duration)
        self._panel.set_transcript("")
        self._panel.set_message(self.tr("Type what is said and press Align, or let it be recognised."))
        self._window.live_panel.set_can_replay(True)
        self._take(Utterance("", Schedule([SILENCE], [0.0, opened.audio.duration]), opened.audio), play=False)
        beside = opened.path.with_suffix(".txt")
        saved, self._next = self._next or saved_beside(opened.path), None
        if saved.is_file():
            self.hearing.labels(saved, self.audio, {}, ())
        elif beside.is_file():
            self.open_transcript(beside)

    # ── words and phones ─────────────────────────────────────────────────────────────────────────

    def align(self, text: str) -> None:
        """Find when the words sound."""
        if self.audio is not None and self.may_discard():
            self._panel.set_message(self.tr("Aligning …"))
            voice = self._sentence.voice if self._sentence.voice in VOICES else next(iter(VOICES))
            self.hearing.align(self.audio, text, voice)

    def _recognise(self) -> None:
        if self.audio is not None:
            self._panel.set_message(self.tr("Recognising …"))
            self.hearing.recognise(self.audio)

    def _phones(self) -> None:
        if self.audio is not None and self.may_discard():
            self._panel.set_message(self.tr("Listening for phones …"))
            self.hearing.phones(self.audio)

    def _cancel(self) -> None:
        self.hearing.cancel()
        self._panel.set_message(self.tr("Given up."))

    def _failed(self, sentence: str) -> None:
        self._next = None
        self._panel.set_message(sentence, "error")

    def _aligned(self, utterance: Utterance) -> None:
        count = sum(phone != SILENCE for phone in utterance.schedule.phones)
        told = self.tr("{0} words, {1} phones.").format(len(utterance.words), count)
        self._panel.set_message(" ".join((told, *utterance.notes)))
        self._take(utterance, play=True)

    def _heard(self, heard: Heard) -> None:
        self._panel.set_transcript(heard.text)
        self._panel.set_message(heard.sentence)
        self._panel.transcript.setFocus()

    def _labelled(self, labelled: Labelled) -> None:
        utterance = labelled.named.utterance
        told = self.tr("{0}: {1} phones.").format(labelled.labels.kind, len(utterance.schedule))
        self._panel.set_message(" ".join((told, *utterance.notes)))
        if utterance.text:
            self._panel.set_transcript(utterance.text)
        if self.audio is None and utterance.schedule.start != 0:
            utterance = from_zero(utterance)
        self._take(utterance, play=self.audio is not None)
        if labelled.named.unknown:
            self._ask_names(labelled)

    def _ask_names(self, labelled: Labelled) -> None:
        """What the names nobody knows stand for; remembered for the next file."""
        curve_set = self._document.curve_set
        phones = sorted({*curve_set.phoneme_map, *curve_set.phonemes})
        choices = [(SILENCE, self.tr("silence")), *((phone, phone) for phone in phones)]
        dialog = AssignDialog(
            self.tr("Unknown phone names"),
            self.tr("These names of {0} are in no table. What do they stand for?").format(labelled.path.name),
            (self.tr("Name"), self.tr("Phone")),
            dict.fromkeys(labelled.named.unknown[:200], SILENCE),
            choices,
            self._window,
        )
        if dialog.exec():
            assigned = self._assigned() | dialog.answers
            self._state.put("phone names", [f"{name}\t{phone}" for name, phone in assigned.items()])
            self.open_labels(labelled.path)

    def _assigned(self) -> dict[str, str]:
        pairs = (line.split("\t") for line in self._state.texts("phone names"))
        return {pair[0]: pair[1] for pair in pairs if len(pair) == 2}

    # ── out ──────────────────────────────────────────────────────────────────────────────────────

    def ask_save(self) -> bool:
        """Choose a file and keep phones and words there; whether they were kept."""
        utterance = self._unsaved or self._session.utterance
        if utterance is None:
            return False
        folder = Path(self._files.folder or ".")
        start = saved_beside(self.path) if self.path is not None else folder / "sentence.utterance.json"
        name, _ = QFileDialog.getSaveFileName(
            self._window,
            self.tr("Save phones and words"),
            str(start),
            f"{_UTTERANCE};;{_TEXTGRID};;{_SCHEDULE}",
        )
        return bool(name) and self.save(Path(name), utterance)

    def save(self, path: Path, utterance: Utterance) -> bool:
        """Keep phones and words; what has no recording yet gets its sound beside it. Whether it worked."""

        mine = self.path if self.path is not None and utterance.audio is self.audio else None
        if not self._files.attempt(lambda: save_spoken(path, utterance, mine)):
            return False
        self._unsaved = None
        self._panel.set_message(self.tr("Saved in {0}.").format(path.name))
        return True

    def may_discard(self) -> bool:
        """Whether edits of the phones may go: there are none, they were saved, or the user said so."""
        if self._unsaved is None:
            return True
        answer = QMessageBox.question(
            self._window,
            self.tr("Save the phones?"),
            self.tr("Phones and boundaries were edited by hand and are not saved. Save them?"),
            _Button.Save | _Button.Discard | _Button.Cancel,
            _Button.Save,
        )
        if answer == _Button.Discard:
            self._unsaved = None
        return self.ask_save() if answer == _Button.Save else answer == _Button.Discard

    def close(self) -> None:
        """Stop what this object runs."""
        self.hearing.stop()

    def _was_edited(self) -> None:
        self._unsaved = self._session.utterance

    def _take(self, utterance: Utterance, *, play: bool) -> None:
        self._unsaved = None
        self._sentence.take(utterance, play=play)

    def _show(self) -> None:
        dock = self._window.recording_dock
        dock.show()
        dock.raise_()
