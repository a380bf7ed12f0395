"""A character's set over its base: which layer a bigram comes from, the way back, and the phonemes themselves."""

from __future__ import annotations

from PySide6.QtCore import QObject

from core_pipeline.errors import UserError
from core_pipeline.files.curve_set_merge import with_theirs
from core_pipeline.phonemes import Pair

from .open_bigram import OpenBigram
from .parts import Parts


class Layers(QObject):
    """Dots in the picker for what is the character's own, the layer in the header, and "revert to base"."""

    def __init__(self, parts: Parts, bigram: OpenBigram, parent: QObject) -> None:
        super().__init__(parent)
        self._document = parts.document
        self._window = parts.window
        self._bigram = bigram
        self._dotted: frozenset[Pair] = frozenset()
        self._window.actions_.revert.triggered.connect(self.revert)
        self._window.header.revert_wanted.connect(self.revert)
        self._window.actions_.theirs.triggered.connect(self.swap_sides)
        bigram.opened.connect(self._show)
        for signal in (self._document.bigram_changed, self._document.bigrams_changed, self._document.replaced):
            signal.connect(self._show)

    def revert(self) -> None:
        """The open bigram as the base has it, in one undo step."""
        pair = self._bigram.pair
        if pair is not None:
            try:
                self._document.revert(pair, self.tr("Revert to base"))
            except UserError as error:
                self._window.hint_label.setText(str(error))

    def swap_sides(self) -> None:
        """The other side's curves in the open bigram, where a merge left it undecided; in one undo step."""
        pair = self._bigram.pair
        if pair is not None and pair in self._document.curve_set.bigrams:
            bigram = self._document.curve_set.bigrams[pair]
            try:
                self._document.put_bigram(pair, with_theirs(bigram), self.tr("Swap with the other side"))
            except UserError as error:
                self._window.hint_label.setText(str(error))

    def _show(self) -> None:
        curve_set, pair = self._document.curve_set, self._bigram.pair
        own = frozenset[Pair]() if curve_set.below is None else frozenset(curve_set.own)
        if own != self._dotted:
            self._dotted = own
            self._window.picker.set_overridden(own)
        mine = pair in own
        self._window.actions_.revert.setEnabled(mine)
        layer = "" if curve_set.below is None or pair is None else curve_set.layer_of(pair)
        text = self.tr("own curves of {0}").format(layer) if mine else self.tr("from {0}").format(layer)
        bigram = curve_set.bigrams.get(pair) if pair is not None else None
        undecided = bigram is not None and with_theirs(bigram) is not bigram
        self._window.actions_.theirs.setEnabled(undecided)
        parts = [text] * bool(layer) + [self.tr("undecided since a merge")] * undecided
        self._window.header.set_layer(" · ".join(parts), mine)
