"""How the voice speaks, and which phoneme of the curves each of its phones counts as."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QFileDialog

from core_pipeline.files import phoneme_map_json
from core_pipeline.files.atomic import open_to_read
from core_pipeline.files.phoneme_map_json import PhonemeMap
from core_pipeline.phonemes import SILENCE
from widgets.speech.assign_dialog import AssignDialog

from .. import resources
from ..phoneme_maps import check_fits
from .parts import Parts
from .sentence import Sentence

_MAPS = "Phoneme maps (*.json)"


class Voice(QObject):
    """Joins the voice's panel, the sentence and the document's phoneme map."""

    def __init__(self, parts: Parts, sentence: Sentence, parent: QObject) -> None:
        super().__init__(parent)
        self._window = parts.window
        self._document = parts.document
        self._files = parts.files
        self._state = parts.state
        self._sentence = sentence
        panel = self._window.voice_panel
        panel.set_voice(self._sentence.rate, self._sentence.pitch)
        panel.rate_changed.connect(lambda value: self._speak_anew("rate", value))
        panel.pitch_changed.connect(lambda value: self._speak_anew("pitch", value))
        panel.map_chosen.connect(self._choose_map)
        panel.map_edit_wanted.connect(self._edit_map)
        panel.map_open_wanted.connect(self._open_map)
        self._maps = [(path, phoneme_map_json.load(path)) for path in resources.phoneme_maps()]
        self._document.replaced.connect(self._show_maps)
        self._show_maps()

    def take(self, path: Path) -> bool:
        """Use what was dropped, if it is a phoneme map; whether it was."""
        if path.suffix.lower() != ".json" or not _is_map(path):
            return False
        self._files.attempt(lambda: self._use_map(phoneme_map_json.load(path)))
        return True

    def restore(self) -> None:
        """Last time's rate and pitch."""
        self._sentence.rate = round(min(max(self._state.number("rate", self._sentence.rate), 80), 450))
        self._sentence.pitch = round(min(max(self._state.number("pitch", self._sentence.pitch), 0), 99))
        self._window.voice_panel.set_voice(self._sentence.rate, self._sentence.pitch)

    def remember(self) -> None:
        """Keep this time's."""
        self._state.put("rate", self._sentence.rate)
        self._state.put("pitch", self._sentence.pitch)

    def _speak_anew(self, what: str, value: int) -> None:
        setattr(self._sentence, what, value)
        self._sentence.type(self._window.sentence_bar.sentence)

    def _show_maps(self) -> None:
        curve_set = self._document.curve_set
        fitting = [(path, m) for path, m in self._maps if set(m.phonemes) <= set(curve_set.phonemes)]
        current = next((path.stem for path, m in fitting if dict(m.table) == dict(curve_set.phoneme_map)), "")
        self._window.voice_panel.set_maps([(path.stem, m.name, m.note) for path, m in fitting], current)

    def _choose_map(self, name: str) -> None:
        found = next((m for path, m in self._maps if path.stem == name), None)
        if found is not None:
            self._files.attempt(lambda: self._use_map(found))
        self._show_maps()

    def _open_map(self) -> None:
        name, _ = QFileDialog.getOpenFileName(self._window, self.tr("Open a phoneme map"), "", _MAPS)
        if name:
            self._files.attempt(lambda: self._use_map(phoneme_map_json.load(name)))

    def _edit_map(self) -> None:
        curve_set = self._document.curve_set
        choices = [*((phone, phone) for phone in curve_set.phonemes), (SILENCE, self.tr("silence"))]
        dialog = AssignDialog(
            self.tr("Phoneme map"),
            self.tr("Which phone of the voice counts as which phoneme of the curves. One undo step takes it back."),
            (self.tr("Phone"), self.tr("Phoneme")),
            dict(sorted(curve_set.phoneme_map.items())),
            choices,
            self._window,
        )
        if dialog.exec():
            table = PhonemeMap(self.tr("edited"), curve_set.phonemes, dialog.answers)
            self._files.attempt(lambda: self._use_map(table))

    def _use_map(self, found: PhonemeMap) -> None:
        """One undo step; UserError when it does not fit the set."""
        document = self._document
        check_fits(document.curve_set, found)
        if dict(found.table) != dict(document.curve_set.phoneme_map):
            label = self.tr("Use the phoneme map “{0}”").format(found.name)
            document.change_set(replace(document.curve_set, phoneme_map=found.table), label)


def _is_map(path: Path) -> bool:
    try:
        with open_to_read(path) as file:
            return phoneme_map_json.SCHEMA.encode() in file.read(2000)
    except OSError:
        return False
