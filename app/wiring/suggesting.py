"""Suggestions: a ghost in the canvas of an empty bigram, Tab accepts it; and one command that fills them all."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtCore import QObject, Qt
from PySide6.QtWidgets import QApplication

from core_pipeline.curve_set import Bigram
from core_pipeline.errors import UserError
from core_pipeline.phonemes import SILENCE, Pair, pair_name
from core_pipeline.suggest import fill

from ..priors import prior_for
from ..workers.diagnosis import Diagnosis
from .open_bigram import OpenBigram
from .parts import Parts
from .weak import Weak


class Suggesting(QObject):
    """Offers what the drawn bigrams suggest for the open one, and puts it in place when the user says so."""

    def __init__(self, parts: Parts, bigram: OpenBigram, weak: Weak, parent: QObject) -> None:
        super().__init__(parent)
        self._window, self._document = parts.window, parts.document
        self._bigram, self._weak = bigram, weak
        self._offered: Bigram | None = None  # for the open bigram, and only while it is empty
        menu = self._window.actions_.work_menu
        menu.line()
        self.accept_action = menu.add(
            "bigram.accept", self.tr("&Accept the Suggestion"), "Tab", self.tr("Take what is shown in grey as a draft")
        )
        self.accept_action.setShortcutContext(Qt.ShortcutContext.WidgetWithChildrenShortcut)
        self._window.canvas.addAction(self.accept_action)  # elsewhere Tab goes to the next field
        self.accept_action.triggered.connect(lambda _=False: self.accept())
        self.fill_action = menu.add(
            "bigram.fill",
            self.tr("Fill A&ll Empty as Suggestions"),
            "Ctrl+Alt+F",
            self.tr("Give every empty bigram what the drawn ones suggest, marked until you have reviewed it"),
        )
        self.fill_action.triggered.connect(lambda _=False: self.fill())
        bigram.opened.connect(self._show)
        weak.diagnosed.connect(self._show)
        self._document.bigram_changed.connect(self._show)
        self._document.bigrams_changed.connect(self._show)

    def accept(self) -> None:
        """Put the suggestion in place, as a draft, in one step."""
        pair, offered = self._bigram.pair, self._offered
        if pair is None or offered is None:
            return
        old = self._document.curve_set.bigrams.get(pair, Bigram())
        accepted = replace(offered, status="draft", note=old.note, extra=old.extra)
        try:
            self._document.put_bigram(pair, accepted, self.tr("Accept the suggestion for {0}").format(pair_name(pair)))
        except UserError as error:
            self._window.hint_label.setText(str(error))

    def fill(self) -> None:
        """Fill every empty bigram, in one step."""
        curve_set, hint = self._document.curve_set, self._window.hint_label
        QApplication.setOverrideCursor(Qt.CursorShape.WaitCursor)
        try:
            filled = {pair: b for pair, b in fill(curve_set, prior_for(curve_set)).items() if not b.is_empty}
            self._document.put_bigrams(filled, self.tr("Fill all empty bigrams"))
        except UserError as error:
            hint.setText(str(error))
            return
        finally:
            QApplication.restoreOverrideCursor()
        if filled:
            hint.setText(self.tr("{0} bigrams filled as suggestions: review them one by one").format(len(filled)))
        else:
            hint.setText(self.tr("No bigram is empty, or nothing drawn says what the empty ones should do"))

    def _fits(self, pair: Pair, diagnosis: Diagnosis) -> bool:
        """Whether it is of this set, not of the one that was open a moment ago."""
        known = diagnosis.suggestions
        same = known.poses == self._document.curve_set.poses
        return same and SILENCE not in pair and set(pair) <= {*known.phones}

    def _show(self, _: Pair | Diagnosis | None = None) -> None:
        """What is suggested for the open bigram: its ghost while it is empty, else something to slide to."""
        pair, canvas = self._bigram.pair, self._window.canvas
        diagnosis = self._weak.diagnosis
        was_offered, self._offered = self._offered, None
        name = self.tr("suggestion")
        if pair is None or diagnosis is None or not self._fits(pair, diagnosis):
            canvas.set_blend_target(name, None)
        else:
            suggested = diagnosis.suggestions.bigram(pair)
            canvas.set_blend_target(name, suggested.curves or None)
            if self._document.curve_set.status_of(pair) == "empty" and not suggested.is_empty:
                self._offered = suggested
                canvas.set_ghost(suggested.curves)
        if self._offered is None:
            canvas.set_suggestion("")
            if was_offered is not None and pair is not None and self._document.curve_set.status_of(pair) == "empty":
                canvas.set_ghost(None)
        else:
            canvas.set_suggestion(self._offered.source)
        self.accept_action.setEnabled(self._offered is not None)
