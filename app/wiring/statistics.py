"""The statistics of our corpus, or of the text that was read last, in a window of their own."""

from __future__ import annotations

from PySide6.QtCore import QObject

from core_pipeline.statistics import progress
from widgets.window.statistics_view import StatisticsView

from .parts import Parts
from .queue import Queue


class Statistics(QObject):
    """Opens the view and keeps it up to date while it is seen."""

    def __init__(self, parts: Parts, queue: Queue, parent: QObject) -> None:
        super().__init__(parent)
        self._window, self._document, self._queue = parts.window, parts.document, queue
        self.view: StatisticsView | None = None
        action = self._window.actions_.tools_menu.add(
            "tools.statistics",
            self.tr("Corpus &Statistics…"),
            (),
            self.tr("How often each pair is said, beside the tables of the paper"),
        )
        action.triggered.connect(lambda _=False: self.open())
        queue.frequencies_changed.connect(self._show)
        for signal in (self._document.bigram_changed, self._document.bigrams_changed, self._document.replaced):
            signal.connect(self._show)

    def open(self) -> None:
        """Show the view."""
        if self.view is None:
            self.view = StatisticsView(self._window)
        self.view.show()
        self.view.raise_()
        self._show()

    def _show(self, _: object = None) -> None:
        if self.view is not None and self.view.isVisible():
            said = self._queue.frequencies
            self.view.set_frequencies(self._queue.corpus, said, progress(self._document.curve_set, said))
