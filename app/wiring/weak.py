"""What is weak: in the list, in the picker's colours and on the overlay; in the sentence or in a whole text."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject, QTimer, Signal
from PySide6.QtWidgets import QFileDialog

from core_pipeline.diagnose import HINTS, WeakBigram
from core_pipeline.phonemes import Pair
from core_pipeline.pipeline import Stages
from widgets.overlay.stage_marks import Mark
from widgets.picker.weak_list import WeakRow
from widgets.picker.weak_panel import CORPUS, SENTENCE

from ..workers.diagnosis import CorpusReader, CorpusReport, Diagnoser, Diagnosis
from .open_bigram import OpenBigram
from .parts import Parts
from .sentence import Sentence

#: What may lag a moment behind a drag does so for this long; a whole text, for longer.
LATE_MS, CORPUS_MS = 120, 1500
#: Nobody reads on from here.
MOST_ROWS = 400


class Weak(QObject):
    """Asks for diagnoses when nothing is being dragged, and shows them.

    diagnosed(Diagnosis)   the present curves and sentence have been looked at
    reported(CorpusReport) a text has been read
    """

    diagnosed = Signal(object)
    reported = Signal(object)

    def __init__(self, parts: Parts, bigram: OpenBigram, sentence: Sentence, parent: QObject) -> None:
        super().__init__(parent)
        self._window, self._session, self._state = parts.window, parts.session, parts.state
        self._document = parts.document
        self._bigram, self._sentence = bigram, sentence
        self._source = SENTENCE
        self._report: CorpusReport | None = None
        self.diagnosis: Diagnosis | None = None
        self._going: tuple[Pair, str, float | None] | None = None  # waits for its sentence to be spoken
        self._diagnoser = Diagnoser(self)
        self._reader = CorpusReader(parts.speaker, self)
        self._late = self._timer(LATE_MS, self._ask)
        self._later = self._timer(CORPUS_MS, self._ask_corpus)
        self._connect()

    def _timer(self, wait: int, act: object) -> QTimer:
        timer = QTimer(self)
        timer.setSingleShot(True)
        timer.setInterval(wait)
        timer.timeout.connect(act)
        return timer

    def _connect(self) -> None:
        panel, menu = self._window.weak_panel, self._window.actions_.work_menu
        for name, text, key, way in (
            ("weak.next", self.tr("Next &Weak One"), ".", 1),
            ("weak.previous", self.tr("Previous Wea&k One"), ",", -1),
        ):
            action = menu.add(name, text, key, self.tr("Step through the list of weak bigrams"))
            action.triggered.connect(lambda _=False, way=way: panel.list.step(way))
        look = menu.add(
            "weak.text", self.tr("Look for Weak Ones &in a Text…"), (), self.tr("Find what is weak in a whole script")
        )
        look.triggered.connect(lambda _=False: self._ask_file())
        self._session.stages_changed.connect(self._stages_changed)
        self._diagnoser.answered.connect(self._diagnosed)
        self._reader.progressed.connect(lambda done, total: panel.set_progress((done, total)))
        self._reader.reported.connect(self._reported)
        self._reader.failed.connect(self._failed)
        panel.source_picked.connect(self._pick_source)
        panel.load_wanted.connect(self._ask_file)
        panel.cancel_wanted.connect(self._cancel)
        panel.list.picked_in.connect(self._go)
        self._document.bigram_changed.connect(lambda _: self._later.start())
        self._document.bigrams_changed.connect(lambda _: self._later.start())
        self._document.replaced.connect(self._later.start)
        self._document.settings_changed.connect(self._later.start)

    def close(self) -> None:
        """Stop what this object runs."""
        self._late.stop()
        self._later.stop()
        self._diagnoser.stop()
        self._reader.stop()

    # ── the sentence ─────────────────────────────────────────────────────────────────────────────

    def _stages_changed(self, stages: Stages | None) -> None:
        if not self._late.isActive():
            self._late.start()
        utterance = self._session.utterance
        if self._going is not None and stages is not None and utterance is not None:
            pair, text, time = self._going
            if utterance.text == " ".join(text.split()):
                self._going = None
                self._bigram.open_in_sentence(pair, time)

    def _ask(self) -> None:
        session, w = self._session, self._window
        if session.in_gesture:  # the hand comes first, and when it ends there is a new result
            return
        stages = session.stages
        w.picker.set_used(session.used())
        pairs = stages.schedule.pairs() if stages is not None else []
        words = zip(reversed(pairs), reversed(self._bigram.examples), strict=False)  # of several, the first
        w.picker.set_words({pair: text for pair, (text, _) in words if text})
        if stages is not None and stages.poses != session.curve_set.poses:
            return  # another set has just been opened: its stages are on their way
        if not session.shows_other:  # when it ends there is a new result
            self._diagnoser.request((session.curve_set, stages))

    def _diagnosed(self, diagnosis: Diagnosis) -> None:
        self.diagnosis = diagnosis
        if diagnosis.stages is self._session.stages:
            self._window.stage_panel.set_marks(
                [
                    Mark(f.pair, f.time, f.pose, f.reason, f.kind not in HINTS)
                    for f in diagnosis.findings
                    if f.time is not None and f.kind != "mirror"
                ]
            )
        if self._source == SENTENCE:
            self._show(diagnosis.weak)
        self.diagnosed.emit(diagnosis)

    # ── a text ───────────────────────────────────────────────────────────────────────────────────

    def read(self, path: Path) -> None:
        """Look for what is weak in a text file."""
        self._window.weak_panel.set_progress((0, 1))
        self._reader.read(path, self._document.curve_set)

    def _ask_file(self) -> None:
        name, _ = QFileDialog.getOpenFileName(
            self._window,
            self.tr("Look in a text"),
            self._state.text("texts"),
            self.tr("Texts (*.txt *.md);;All files (*)"),
        )
        if name:
            self._state.put("texts", str(Path(name).parent))
            self.read(Path(name))

    def _ask_corpus(self) -> None:
        if self._report is not None and not self._session.in_gesture:
            self._reader.look_again(self._report, self._document.curve_set)

    def _reported(self, report: CorpusReport) -> None:
        panel = self._window.weak_panel
        panel.set_progress(None)
        if self._report is None or report.schedules is not self._report.schedules:
            panel.set_corpus(report.name)
            self._source = CORPUS
            panel.set_source(CORPUS)
        self._report = report
        if self._source == CORPUS:
            self._show(report.weak)
        self.reported.emit(report)

    def _failed(self, reason: str) -> None:
        self._window.weak_panel.set_progress(None)
        self._window.hint_label.setText(reason)

    def _cancel(self) -> None:
        self._reader.cancel()
        self._window.weak_panel.set_progress(None)

    def _pick_source(self, source: int) -> None:
        self._source = source
        if source == CORPUS and self._report is not None:
            self._show(self._report.weak)
        elif self.diagnosis is not None:
            self._show(self.diagnosis.weak)

    def _go(self, pair: Pair, text: str, time: float | None) -> None:
        """Open a bigram in a sentence of the text."""
        utterance = self._session.utterance
        if utterance is not None and utterance.text == " ".join(text.split()):
            self._bigram.open_in_sentence(pair, time)
            return
        self._going = pair, text, time
        self._sentence.type(text, play=False)

    # ── show ─────────────────────────────────────────────────────────────────────────────────────

    def _show(self, weak: tuple[WeakBigram, ...]) -> None:
        w = self._window
        w.weak_list.set_rows([row for one in weak for row in self._rows(one)][:MOST_ROWS])
        told = {one.pair: one for one in weak if not one.is_hint}
        most = max((one.score for one in told.values()), default=0.0)
        w.picker.set_weak(
            {pair: one.reason for pair, one in told.items()},
            {pair: one.score / most for pair, one in told.items() if most},
        )

    def _rows(self, weak: WeakBigram) -> list[WeakRow]:
        """One for each thing that is weak about it, each at its place."""
        rows = []
        for i, finding in enumerate(weak.findings):
            sentence = ""
            if self._source == CORPUS and self._report is not None:
                sentence = self._report.sentence_of(finding)
            uses = 0 if i else weak.uses
            rows.append(WeakRow(weak.pair, finding.reason, finding.time, uses, finding.kind not in HINTS, sentence))
        return rows
