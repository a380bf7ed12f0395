"""The lists of sentences brought to life: pinned, imported, reordered, stepped through, and what was said lately."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QFileDialog

from ..pinned import read_lines
from .parts import Parts
from .sentence import Sentence

TEXTS = "Text files (*.txt);;All files (*)"


class Sentences(QObject):
    """Joins the dock of sentences, the Sentence menu and the field."""

    def __init__(self, parts: Parts, sentence: Sentence, parent: QObject) -> None:
        super().__init__(parent)
        self._window = parts.window
        self._files = parts.files
        self._state = parts.state
        self._sentence = sentence
        self._pinned = sentence.pinned
        view, bar, actions = self._window.sentence_list, self._window.sentence_bar, self._window.actions_
        bar.set_history(self._state.texts("sentences said"))
        bar.history_changed.connect(self._show_history)
        self._pinned.changed.connect(self._show_pinned)
        parts.session.stages_changed.connect(lambda _: view.set_current(bar.sentence))
        view.picked.connect(sentence.type)
        view.order_wanted.connect(self._pinned.set)
        view.pin_wanted.connect(self.pin)
        view.unpin_wanted.connect(self._pinned.remove)
        view.import_wanted.connect(self._ask_import)
        for action, act in (
            (actions.pin_sentence, self.pin),
            (actions.next_sentence, self.step),
            (actions.previous_sentence, lambda: self.step(-1)),
            (actions.import_sentences, self._ask_import),
        ):
            action.triggered.connect(lambda _=False, act=act: act())
        self._show_pinned()
        self._show_history()

    def pin(self, text: str = "") -> None:
        """Keep a sentence, by default the one in the field."""
        text = text or self._window.sentence_bar.sentence
        if self._pinned.add([text]):
            self._window.hint_label.setText(self.tr("Pinned: {0}").format(text))
        elif text:
            self._window.hint_label.setText(self.tr("This sentence is pinned already, or the list is full."))

    def step(self, step: int = 1) -> None:
        """Say the next pinned sentence, or the previous one with step −1."""
        text = self._pinned.after(self._window.sentence_bar.sentence, step)
        if text:
            self._sentence.type(text)
        else:
            self._window.hint_label.setText(self.tr("No sentence is pinned yet: Sentence → Pin This Sentence."))

    def import_from(self, path: Path) -> None:
        """Pin the lines of a text file; a refusal is told."""
        found: list[str] = []
        if self._files.attempt(lambda: found.extend(read_lines(path))):
            new = self._pinned.add(found)
            self._window.hint_label.setText(self.tr("{0} sentences pinned from {1}").format(new, path.name))

    def remember(self) -> None:
        """Keep what was said."""
        self._state.put("sentences said", list(self._window.sentence_bar.history))

    def _ask_import(self) -> None:
        name, _ = QFileDialog.getOpenFileName(
            self._window, self.tr("Pin the lines of a text file"), self._state.text("folder"), TEXTS
        )
        if name:
            self.import_from(Path(name))

    def _show_pinned(self) -> None:
        self._window.sentence_list.set_pinned(self._pinned.texts)
        self._window.sentence_list.set_current(self._window.sentence_bar.sentence)

    def _show_history(self) -> None:
        self._window.sentence_list.set_recent(self._window.sentence_bar.history[::-1])
