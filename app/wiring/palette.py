"""The command palette brought to life: the window's actions, the canvas's, poses, all bigrams, words and sentences."""

from __future__ import annotations

from collections.abc import Iterator

from PySide6.QtCore import QObject

from core_pipeline.phonemes import SILENCE, Pair
from core_pipeline.speech.utterance import Utterance
from widgets.canvas.canvas_keys import canvas_title
from widgets.canvas.keymaps import IN_GESTURE, KEYMAPS
from widgets.picker.bigram_model import spoken_pair
from widgets.window.command_palette import CommandPalette
from widgets.window.palette_choices import Choice

from ..shortcuts import native
from .open_bigram import OpenBigram
from .parts import Parts
from .sentence import RATE, Sentence

#: So many of what was chosen last come first.
RECENT = 8


class Palette(QObject):
    """Says what there is to choose, and does what was chosen."""

    def __init__(self, parts: Parts, bigram: OpenBigram, sentence: Sentence, parent: QObject) -> None:
        super().__init__(parent)
        self._window = parts.window
        self._document = parts.document
        self._session = parts.session
        self._search = parts.search
        self._state = parts.state
        self._bigram = bigram
        self._sentence = sentence
        self._recent = self._state.texts("recent commands")[:RECENT]
        self.view = CommandPalette(self._window)
        self.view.chosen.connect(self._do)
        self.view.query_changed.connect(self._look_up)
        self._search.spoken.connect(self._word_spoken)
        self._window.actions_.palette.triggered.connect(self.open)

    def open(self) -> None:
        """Show the palette."""
        kinds = (self._commands(), self._of_canvas(), self._poses(), self._sentences(), self._bigrams())
        self.view.open([choice for kind in kinds for choice in kind], self._recent)

    def _commands(self) -> Iterator[Choice]:
        for entry in self._window.actions_.registry:
            action = entry.action
            if action is not self._window.actions_.palette:
                yield Choice(
                    f"command:{entry.id}",
                    entry.title,
                    entry.group,
                    native(tuple(key.toString() for key in action.shortcuts()[:1])),
                    enabled=action.isEnabled(),
                    on=action.isCheckable() and action.isChecked(),
                )

    def _of_canvas(self) -> Iterator[Choice]:
        keymap = KEYMAPS[self._window.actions_.keymap]
        for action, keys in keymap.items():
            if action not in IN_GESTURE:
                yield Choice(f"canvas:{action}", canvas_title(action), self.tr("Canvas"), native(keys[:1]))

    def _poses(self) -> Iterator[Choice]:
        for pose in self._document.curve_set.poses:
            yield Choice(f"pose:{pose}", pose, self.tr("Pose"))

    def _sentences(self) -> Iterator[Choice]:
        for text in self._sentence.pinned.texts:
            yield Choice(f"sentence:{text}", text, self.tr("Pinned sentence"), prose=True)

    def _bigrams(self) -> Iterator[Choice]:
        curve_set = self._document.curve_set
        for first in curve_set.phonemes:
            for second in curve_set.phonemes:
                yield self._of_pair((first, second), f"{first} {second}")

    def _of_pair(self, pair: Pair, name: str = "", group: str = "") -> Choice:
        about = f"{group or self.tr('Bigram')} · {self._document.curve_set.status_of(pair)}"
        return Choice(f"bigram:{' '.join(pair)}", spoken_pair(pair), about, name=name)

    # ── words ────────────────────────────────────────────────────────────────────────────────────

    def _look_up(self, text: str) -> None:
        """What is typed may be a word with bigrams, or a sentence to say."""
        self.view.set_found(text, self._saying(text))
        if len(text) > 1 and text.isalpha():
            self._search.request(text, self._sentence.voice, RATE)

    def _saying(self, text: str) -> list[Choice]:
        say = Choice(f"say:{text}", self.tr("Say “{0}”").format(text), self.tr("Sentence"))
        known = any(text.casefold() in pinned.casefold() for pinned in self._sentence.pinned.texts)
        return [say] if " " in text and len(text) > 5 and not known else []

    def _word_spoken(self, utterance: Utterance) -> None:
        text = self.view.query
        if not self.view.isVisible() or utterance.text.casefold() != text.casefold():
            return
        curve_set = self._document.curve_set
        schedule = utterance.schedule.mapped(curve_set.phonemes, curve_set.phoneme_map)
        pairs = dict.fromkeys(p for p in schedule.pairs() if SILENCE not in p and curve_set.has_pair(p))
        self.view.set_found(text, [self._of_pair(pair, group=self.tr("in “{0}”").format(text)) for pair in pairs])

    # ── what was chosen ──────────────────────────────────────────────────────────────────────────

    def _do(self, choice: str) -> None:
        self._recent = [choice, *(other for other in self._recent if other != choice)][:RECENT]
        self._state.put("recent commands", self._recent)
        kind, _, what = choice.partition(":")
        w = self._window
        if kind == "command":
            w.actions_.registry[what].action.trigger()
        elif kind == "canvas":
            w.canvas.setFocus()
            w.canvas.act(what)
        elif kind == "pose":
            w.canvas.setFocus()
            w.pose_list.pose_picked.emit(what)  # as a click on it
        elif kind == "bigram":
            first, second = what.split(" ")
            self._bigram.open((first, second))
            w.canvas.setFocus()
        else:
            self._sentence.type(what)
