"""Bigram → Note…: a few words of the animator about the open bigram; they stand in the header and in the file."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QInputDialog

from core_pipeline.curve_set import Bigram
from core_pipeline.errors import UserError
from core_pipeline.phonemes import pair_name

from .open_bigram import OpenBigram
from .parts import Parts

#: As much as a file may hold.
LONGEST = 10_000


class Notes(QObject):
    """Asks for the note and shows it."""

    def __init__(self, parts: Parts, bigram: OpenBigram, parent: QObject) -> None:
        super().__init__(parent)
        self._document = parts.document
        self._window = parts.window
        self._bigram = bigram
        self._window.actions_.note.triggered.connect(self.ask)
        bigram.opened.connect(self._show)
        for signal in (self._document.bigram_changed, self._document.bigrams_changed, self._document.replaced):
            signal.connect(self._show)

    def ask(self) -> None:
        """Change the note of the open bigram, in one undo step."""
        pair = self._bigram.pair
        if pair is None:
            return
        text, chosen = QInputDialog.getMultiLineText(
            self._window, self.tr("Note"), self.tr("About {0}:").format(pair_name(pair)), self._open.note
        )
        note = text.strip()[:LONGEST]
        if chosen and note != self._open.note:
            try:
                self._document.put_bigram(pair, replace(self._open, note=note), self.tr("Note"))
            except UserError as error:
                self._window.hint_label.setText(str(error))

    @property
    def _open(self) -> Bigram:
        pair = self._bigram.pair
        found = self._document.curve_set.bigrams.get(pair) if pair is not None else None
        return found if found is not None else Bigram(status="empty")

    def _show(self) -> None:
        self._window.header.set_note(self._open.note)
