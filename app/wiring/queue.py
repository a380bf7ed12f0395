"""The fast way through all bigrams: approve and open the next, in the order that serves most speech soonest."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from PySide6.QtCore import QObject, Signal

from core_pipeline.errors import UserError
from core_pipeline.files import frequencies_json
from core_pipeline.phonemes import Pair, pair_name
from core_pipeline.queue_order import next_after, work_order
from core_pipeline.statistics import Frequencies, progress

from .. import resources
from ..workers.diagnosis import CorpusReport
from .carrier import Carrier
from .open_bigram import OpenBigram
from .parts import Parts
from .weak import Weak


class Queue(QObject):
    """Which bigram is next, and how far the work has come.

    frequencies  how often pairs are said: of our corpus, or of the text that was read last
    corpus       its name
    frequencies_changed()
    """

    frequencies_changed = Signal()

    def __init__(self, parts: Parts, bigram: OpenBigram, weak: Weak, carrier: Carrier, parent: QObject) -> None:
        super().__init__(parent)
        self._window, self._document = parts.window, parts.document
        self._bigram, self._carrier = bigram, carrier
        self.frequencies: Frequencies = frequencies_json.load(resources.corpus() / "frequencies.json")
        self.corpus = self.tr("Our corpus")
        self.shares: Mapping[Pair, float] = self.frequencies.shares
        self._order: list[Pair] = []
        self._ordered_for: tuple[object, object] = (None, None)
        menu = self._window.actions_.work_menu
        menu.line()
        self.approve_action = menu.add(
            "bigram.approve",
            self.tr("Approv&e and Open the Next"),
            ("Ctrl+Return", "Ctrl+Enter"),
            self.tr("Mark the open bigram as approved and go on with the next in the queue"),
        )
        self.approve_action.triggered.connect(lambda _=False: self.approve())
        self.next_action = menu.add(
            "bigram.queue",
            self.tr("Open the Next in the &Queue"),
            "Ctrl+Shift+Return",
            self.tr("The most frequent bigram that is not approved, with some of every row and column early"),
        )
        self.next_action.triggered.connect(lambda _=False: self.open_next())
        weak.reported.connect(self._use_text)
        for signal in (self._document.bigram_changed, self._document.bigrams_changed, self._document.replaced):
            signal.connect(self.show_progress)
        self.show_progress()

    @property
    def order(self) -> list[Pair]:
        """All pairs in the order of work."""
        phonemes = self._document.curve_set.phonemes
        if self._ordered_for != (phonemes, self.shares):
            self._order = work_order(self._document.curve_set, self.shares)
            self._ordered_for = phonemes, self.shares
        return self._order

    def approve(self) -> None:
        """The open bigram is as it should be: say so in one step, and go on."""
        pair, hint = self._bigram.pair, self._window.hint_label
        if pair is None:
            return
        bigram = self._document.curve_set.bigrams.get(pair)
        if bigram is None or bigram.is_empty:
            hint.setText(self.tr("Nothing is drawn here yet: draw a curve, or accept the suggestion with Tab"))
            return
        if bigram.status != "approved":
            try:
                label = self.tr("Approve {0}").format(pair_name(pair))
                self._document.put_bigram(pair, replace(bigram, status="approved"), label)
            except UserError as error:
                hint.setText(str(error))
                return
        self.open_next()

    def open_next(self) -> None:
        """Go on in the queue, and hear the next bigram in a word."""
        pair = next_after(self.order, self._document.curve_set, self._bigram.pair)
        if pair is None:
            self._window.hint_label.setText(self.tr("All bigrams are approved"))
            return
        self._bigram.open(pair)
        self._carrier.say(pair)

    def show_progress(self, _: object = None) -> None:
        """Counts, and the share of running speech that they are."""
        now = progress(self._document.curve_set, self.frequencies)
        text = self.tr("{0} of {1} · {2:.1f} % of running speech").format(now.drawn, now.possible, 100 * now.speech)
        if now.approved:
            text += self.tr(" · {0} approved").format(now.approved)
        self._window.picker.set_coverage(text, now.speech)

    def _use_text(self, report: CorpusReport) -> None:
        self.frequencies, self.shares, self.corpus = report.frequencies, report.frequencies.shares, report.name
        self.show_progress()
        self.frequencies_changed.emit()
