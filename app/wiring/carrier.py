"""Hearing a bigram: when one is opened that the sentence does not have, a word that has it is said in a loop."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from PySide6.QtCore import QObject, Signal

from core_pipeline.curve_set import CurveSet
from core_pipeline.errors import UserError
from core_pipeline.phonemes import Pair
from core_pipeline.pipeline import Stages
from core_pipeline.speech.carrier_words import carrier_words, words_of
from core_pipeline.speech.dictionary import installed
from core_pipeline.speech.sentence import clean

from .. import resources
from ..workers.latest import Latest
from .parts import Parts
from .sentence import Sentence

#: Pinned sentences that are said after the word, at most.
PINNED = 2


@dataclass(frozen=True, eq=False)
class Carriers:
    """For a phoneme set: pair → words that have it; and pinned sentence → the pairs it has."""

    phonemes: tuple[str, ...]
    pinned: tuple[str, ...]
    words: dict[Pair, tuple[str, ...]]
    pairs: dict[str, frozenset[Pair]]


def _find(wish: tuple[CurveSet, tuple[str, ...]], is_old: Callable[[], bool]) -> Carriers | None:
    curve_set, pinned = wish
    dictionary = installed()
    known = words_of((resources.corpus() / "utterances.txt").read_text("utf-8") + " ".join(pinned))
    words = carrier_words(dictionary.entries(), curve_set.phonemes, curve_set.phoneme_map, known)
    pairs = {}
    for text in pinned:
        if is_old():
            return None
        try:
            schedule = dictionary.speak(clean(text)).schedule
        except UserError:
            continue
        pairs[text] = frozenset(schedule.mapped(curve_set.phonemes, curve_set.phoneme_map).pairs())
    return Carriers(curve_set.phonemes, pinned, words, pairs)


class Carrier(QObject):
    """Says the carrier word of a bigram and the pinned sentences that have it, looping, unless it is switched off.

    known()  which words have which bigrams
    """

    known = Signal()

    def __init__(self, parts: Parts, sentence: Sentence, parent: QObject) -> None:
        super().__init__(parent)
        self._window, self._session, self._state = parts.window, parts.session, parts.state
        self._document, self._sentence = parts.document, sentence
        self._carriers: Carriers | None = None
        self._wanted: Pair | None = None  # said as soon as words are known
        self._saying: tuple[Pair, str, tuple[str, ...]] | None = None  # pair, text, words to try when it lacks the pair
        self._worker = Latest("carrier words", _find, self)
        self._worker.answered.connect(self._found)
        self.action = self._window.actions_.work_menu.add(
            "bigram.carrier",
            self.tr("L&oop a Word That Has It"),
            (),
            self.tr("When a bigram is opened that the sentence does not have, say a short word and pinned sentences"),
            checked=self._state.flag("carrier words", True),
        )
        self.action.toggled.connect(lambda on: self._state.put("carrier words", on))
        self._window.picker.picked.connect(self.say)
        self._window.sentence_bar.field.textEdited.connect(self._forget)
        self._session.stages_changed.connect(self._spoken)

    def close(self) -> None:
        """Stop what this object runs."""
        self._worker.stop()

    def say(self, pair: Pair) -> None:
        """Loop what has this bigram, if the sentence has not."""
        self._forget()
        if not self.action.isChecked() or pair in self._session.used():
            return
        curve_set, pinned = self._document.curve_set, self._sentence.pinned.texts
        known = self._carriers
        if known is None or (known.phonemes, known.pinned) != (curve_set.phonemes, pinned):
            self._wanted = pair
            self._worker.request((curve_set, pinned))
            return
        self._try(pair, known.words.get(pair, ()), [text for text, pairs in known.pairs.items() if pair in pairs])

    def _forget(self) -> None:
        """What the user types is never overwritten by a word that was looked for before."""
        self._wanted = self._saying = None

    def _found(self, carriers: Carriers) -> None:
        self._carriers = carriers
        if self._wanted is not None:
            self.say(self._wanted)
        self.known.emit()

    def _try(self, pair: Pair, words: tuple[str, ...], pinned: list[str]) -> None:
        texts = [*(f"{word.capitalize()}." for word in words[:1]), *pinned[:PINNED]]
        if not texts:
            self._window.hint_label.setText(self.tr("No word of the dictionary has this bigram in this voice"))
            return
        text = " ".join(texts)
        self._saying = pair, text, words[1:]
        self._sentence.set_loop(True)
        self._sentence.type(text)

    def _spoken(self, stages: Stages | None) -> None:
        """A voice may speak a word otherwise than the dictionary says: then another is tried."""
        utterance = self._session.utterance
        if self._saying is None or stages is None or utterance is None:
            return
        pair, text, others = self._saying
        if utterance.text == text:
            self._saying = None
            if pair not in stages.schedule.pairs():
                self._try(pair, others, [])
