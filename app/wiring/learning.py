"""Learn bigrams from animation: a folder is read on a thread, and each bigram waits for the user to accept it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QFileDialog, QMessageBox

from core_pipeline.curve_set import Bigram
from core_pipeline.errors import UserError
from core_pipeline.learning.bigram_curves import LEARNED
from core_pipeline.phonemes import Pair, pair_name
from widgets.window.learn_view import LearnRow, LearnView

from ..workers.corpus_learner import CorpusLearner, Lesson
from .parts import Parts


class Learning(QObject):
    """Opens the dialog, and puts what is accepted into the document: drawn curves only after asking."""

    def __init__(self, parts: Parts, parent: QObject) -> None:
        super().__init__(parent)
        self._window, self._document, self._state = parts.window, parts.document, parts.state
        self.view: LearnView | None = None
        self.lesson: Lesson | None = None
        self._learner: CorpusLearner | None = None
        action = self._window.actions_.tools_menu.add(
            "tools.learn",
            self.tr("&Learn Bigrams from Animation…"),
            (),
            self.tr("Curves from captured or hand-made animation with its labels"),
        )
        action.triggered.connect(lambda _=False: self.open())
        for signal in (self._document.bigram_changed, self._document.bigrams_changed):
            signal.connect(self._show_rows)
        self._document.replaced.connect(self._forget)

    def open(self) -> None:
        """Show the dialog."""
        if self.view is None:
            view = self.view = LearnView(self._window)
            view.folder_wanted.connect(self._ask_folder)
            view.cancel_wanted.connect(self.cancel)
            view.accept_wanted.connect(self.accept)
            view.empty_wanted.connect(self.accept_empty)
            view.picked.connect(self._show_plot)
            view.plot.pose_picked.connect(lambda _: self._show_plot())
        self.view.show()
        self.view.raise_()

    def learn(self, folder: Path) -> None:
        """Read a corpus and learn from it."""
        if self._learner is None:
            self._learner = CorpusLearner(self)
            self._learner.progressed.connect(self._progressed)
            self._learner.answered.connect(self._answered)
            self._learner.failed.connect(self._failed)
        if self.view is not None:
            self.view.set_progress(0.0, folder.name)
        self._learner.request((folder, self._document.curve_set))

    def cancel(self) -> None:
        """Stop learning; nothing has changed."""
        if self._learner is not None:
            self._learner.cancel()
        if self.view is not None:
            self.view.set_progress(None)

    def close(self) -> None:
        """End the thread."""
        if self._learner is not None:
            self._learner.stop()

    # ── accepting ────────────────────────────────────────────────────────────────────────────────

    def accept(self, pairs: list[Pair]) -> None:
        """Put these into the set in one step; what somebody drew is replaced only when the user says so."""
        if self.lesson is None or not pairs:
            return
        drawn = [pair for pair in pairs if self._is_drawn(pair)]
        if drawn and not self._may_replace(drawn):
            pairs = [pair for pair in pairs if pair not in drawn]
        self._put(pairs)

    def accept_empty(self) -> None:
        """Put every heard bigram where the set has nothing."""
        if self.lesson is not None:
            self._put([pair for pair in self.lesson.learned.found if self._now(pair) == "empty"])

    def _put(self, pairs: list[Pair]) -> None:
        if self.lesson is None:
            return
        learned, curve_set = self.lesson.learned, self._document.curve_set
        new = {}
        for pair in pairs:
            old = curve_set.bigrams.get(pair)
            if pair in learned.found:
                new[pair] = learned.beside(pair, old)
            else:
                new[pair] = replace(learned.offered[pair], note=old.note if old is not None else "")
        what = pair_name(pairs[0]) if len(pairs) == 1 else self.tr("{0} bigrams").format(len(pairs))
        try:
            self._document.put_bigrams(new, self.tr("Accept learned {0}").format(what))
        except UserError as error:
            self._window.hint_label.setText(str(error))
            if self.view is not None:
                self.view.set_summary(str(error))

    def _is_drawn(self, pair: Pair) -> bool:
        bigram = self._document.curve_set.bigrams.get(pair)
        return bigram is not None and not bigram.is_empty and bigram.status != "suggestion" and bigram.source != LEARNED

    def _may_replace(self, drawn: list[Pair]) -> bool:
        names = ", ".join(pair_name(pair) for pair in drawn[:6]) + (" …" if len(drawn) > 6 else "")
        text = self.tr("{0} already drawn: {1}. Replace with what was learned? Undo brings it back.")
        answer = QMessageBox.question(
            self.view or self._window, self.tr("Replace drawn curves?"), text.format(len(drawn), names)
        )
        return answer == QMessageBox.StandardButton.Yes

    def _now(self, pair: Pair) -> str:
        return self._document.curve_set.status_of(pair)

    # ── the view ─────────────────────────────────────────────────────────────────────────────────

    def _ask_folder(self) -> None:
        folder = QFileDialog.getExistingDirectory(
            self.view, self.tr("Animation with its labels"), self._state.text("corpus folder")
        )
        if folder:
            self._state.put("corpus folder", folder)
            self.learn(Path(folder))

    def _progressed(self, share: float, what: str) -> None:
        if self.view is not None and self.view.progress.isVisible():
            self.view.set_progress(share, what)

    def _answered(self, lesson: Lesson) -> None:
        self.lesson = lesson
        if self.view is None:
            return
        self.view.set_progress(None)
        learned = lesson.learned
        text = self.tr("{0} (clips: {1}, {2:.0f} s): {3} bigrams heard, {4} only suggested.").format(
            lesson.folder.name, lesson.clips, lesson.seconds, len(learned.found), len(learned.offered)
        )
        if lesson.residual:
            text += " " + self.tr("The poses leave {0:.0%} of the motion unexplained.").format(lesson.residual)
        if learned.blind:
            text += " " + self.tr("Not to be seen, and kept as drawn: {0}.").format(", ".join(learned.blind))
        self.view.set_summary(text, lesson.notes)
        self.view.plot.set_poses(learned.poses)
        self._show_rows()

    def _failed(self, sentence: str) -> None:
        if self.view is not None:
            self.view.set_progress(None)
            self.view.set_summary(sentence)

    def _forget(self) -> None:
        """Another set may have other poses and phonemes."""
        self.cancel()
        self.lesson = None
        if self.view is not None:
            self.view.set_rows(())
            self.view.set_summary(self.tr("Another set is open: choose a folder again."))

    def _show_rows(self, _: object = None) -> None:
        if self.view is None or self.lesson is None:
            return
        learned, bigrams = self.lesson.learned, self._document.curve_set.bigrams
        rows = [
            LearnRow(
                pair, found.occurrences, found.residual, self._now(pair), self._is_accepted(pair, bigrams.get(pair))
            )
            for pair, found in learned.found.items()
        ]
        rows += [LearnRow(pair, 0, 0.0, self._now(pair)) for pair in learned.offered]
        self.view.set_rows(rows)

    def _is_accepted(self, pair: Pair, now: Bigram | None) -> bool:
        found = self.lesson.learned.found[pair].bigram if self.lesson is not None else None
        if now is None or found is None or now.source != LEARNED:
            return False
        return all(curve.same_as(now.curves.get(pose)) for pose, curve in found.curves.items())

    def _show_plot(self, pair: Pair | None = None) -> None:
        if self.view is None or self.lesson is None:
            return
        pairs = [pair] if pair is not None else self.view.selected()[-1:]
        if not pairs:
            return
        learned, plot = self.lesson.learned, self.view.plot
        chosen = pairs[0]
        now = self._document.curve_set.bigrams.get(chosen, Bigram())
        if chosen in learned.found:
            found = learned.found[chosen]
            title = self.tr("{0}   heard {1}×, residual {2:.3f}").format(
                "–".join(chosen), found.occurrences, found.residual
            )
            plot.set_bigram(title, learned.spoken(chosen, plot.pose), found.bigram.curves, now.curves)
        else:
            title = self.tr("{0}   never heard, suggested").format("–".join(chosen))
            plot.set_bigram(title, (), learned.offered[chosen].curves, now.curves)
