"""Bigrams learned from animation: what was heard and what not, how well it fits, and accepting it one by one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QItemSelectionModel, Qt, Signal
from PySide6.QtGui import QCloseEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QDialog,
    QHBoxLayout,
    QLabel,
    QProgressBar,
    QPushButton,
    QSplitter,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from core_pipeline.phonemes import Pair

from .. import theme
from .residual_plot import ResidualPlot

_PAIR = Qt.ItemDataRole.UserRole


@dataclass(frozen=True)
class LearnRow:
    """One pair.

    occurrences  0: never heard, a suggestion is offered
    residual     RMS that the learned curves leave unexplained
    now          what the open set has: its status, "empty" where there is nothing
    accepted     the set has what was learned
    """

    pair: Pair
    occurrences: int
    residual: float
    now: str
    accepted: bool = False


class LearnView(QDialog):
    """Shows a lesson; changes nothing itself.

    folder_wanted()         another corpus
    cancel_wanted()         stop learning
    accept_wanted(pairs)    put these into the set
    empty_wanted()          put all that were heard where the set has nothing
    picked(pair)            show how this one fits
    """

    folder_wanted = Signal()
    cancel_wanted = Signal()
    accept_wanted = Signal(object)
    empty_wanted = Signal()
    picked = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(self.tr("Learn bigrams from animation"))
        self.summary = QLabel(self.tr("Choose a folder: animation, each with its labels or recording and text."))
        self.summary.setWordWrap(True)
        self.summary.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.folder = QPushButton(self.tr("Choose &Folder…"))
        self.folder.clicked.connect(self.folder_wanted)
        self.progress = QProgressBar()
        self.progress.setRange(0, 1000)
        self.progress.setAccessibleName(self.tr("Progress of learning"))
        self.cancel = QPushButton(self.tr("&Cancel"))
        self.cancel.clicked.connect(self.cancel_wanted)
        self.table = self._table()
        self.plot = ResidualPlot()
        self.accept_one = QPushButton(self.tr("&Accept Selected"))
        self.accept_one.setToolTip(self.tr("Put the selected bigrams into the set, as drafts, in one step"))
        self.accept_one.clicked.connect(lambda: self.accept_wanted.emit(self.selected()))
        self.accept_empty = QPushButton(self.tr("Accept All &Heard Where Empty"))
        self.accept_empty.setToolTip(self.tr("Never replaces what was drawn"))
        self.accept_empty.clicked.connect(self.empty_wanted)
        close = QPushButton(self.tr("C&lose"))
        close.clicked.connect(self.close)
        for button in (self.folder, self.cancel, self.accept_one, self.accept_empty, close):
            button.setAutoDefault(False)
        self._lay_out(close)
        self.set_progress(None)
        self.set_rows(())
        self.resize(1080, 640)

    def set_summary(self, text: str, notes: Sequence[str] = ()) -> None:
        """One paragraph; what was left out stands in its tooltip."""
        more = self.tr(" (Notes: {0}; point here.)").format(len(notes)) if notes else ""
        self.summary.setText(text + more)
        self.summary.setToolTip("\n".join(notes[:40]))

    def set_progress(self, share: float | None, what: str = "") -> None:
        """How far learning has come, 0…1; None when nothing is learned."""
        busy = share is not None
        self.progress.setVisible(busy)
        self.cancel.setVisible(busy)
        self.folder.setEnabled(not busy)
        if share is not None:
            self.progress.setValue(round(1000 * share))
            self.progress.setFormat(what.replace("%", "%%") + "  %p%")

    def set_rows(self, rows: Sequence[LearnRow]) -> None:
        """All pairs; the selection stays."""
        before = set(self.selected())
        table = self.table
        table.setSortingEnabled(False)
        table.setRowCount(len(rows))
        for i, row in enumerate(rows):
            for column, item in enumerate(self._items(row)):
                table.setItem(i, column, item)
        table.setSortingEnabled(True)
        model = table.selectionModel()
        flags = QItemSelectionModel.SelectionFlag.Select | QItemSelectionModel.SelectionFlag.Rows
        for i in range(table.rowCount()):
            if self._pair_at(i) in before:
                model.select(table.model().index(i, 0), flags)
        if rows and not before:
            table.selectRow(0)
        self.accept_empty.setEnabled(any(row.occurrences and row.now == "empty" for row in rows))
        self._selection_changed()

    def selected(self) -> list[Pair]:
        """The selected pairs, from top to bottom."""
        return [self._pair_at(index.row()) for index in self.table.selectionModel().selectedRows()]

    def closeEvent(self, event: QCloseEvent) -> None:
        """Closing is also waiting no longer."""
        self.cancel_wanted.emit()
        super().closeEvent(event)

    def _items(self, row: LearnRow) -> list[QTableWidgetItem]:
        heard = row.occurrences > 0
        now = self.tr("learned, accepted") if row.accepted else row.now
        texts = ("–".join(row.pair), str(row.occurrences) if heard else "", f"{row.residual:.3f}" if heard else "", now)
        keys = (None, row.occurrences, row.residual if heard else -1.0, None)
        items = []
        for column, (text, key) in enumerate(zip(texts, keys, strict=True)):
            item = _Item(text, key)
            item.setData(_PAIR, row.pair)
            if column in (1, 2):
                item.setTextAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
            if not heard:
                item.setForeground(theme.MUTED)
                item.setToolTip(self.tr("Never heard: a suggestion from the pairs that were"))
            items.append(item)
        return items

    def _pair_at(self, row: int) -> Pair:
        first, second = self.table.item(row, 0).data(_PAIR)
        return first, second

    def _table(self) -> QTableWidget:
        table = QTableWidget(0, 4)
        table.setHorizontalHeaderLabels(
            [self.tr("Bigram"), self.tr("Heard"), self.tr("Residual"), self.tr("In this set")]
        )
        table.setAccessibleName(self.tr("Learned bigrams"))
        table.verticalHeader().hide()
        for column, width in enumerate((96, 74, 88)):  # measuring the contents anew for every cell takes a minute
            table.setColumnWidth(column, width)
        table.horizontalHeader().setStretchLastSection(True)
        table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        table.setAlternatingRowColors(True)
        table.sortByColumn(1, Qt.SortOrder.DescendingOrder)
        table.itemSelectionChanged.connect(self._selection_changed)
        return table

    def _selection_changed(self) -> None:
        pairs = self.selected()
        self.accept_one.setEnabled(bool(pairs))
        self.picked.emit(pairs[-1] if pairs else None)

    def _lay_out(self, close: QPushButton) -> None:
        top = QHBoxLayout()
        top.addWidget(self.folder)
        top.addWidget(self.summary, 1)
        middle = QHBoxLayout()
        middle.addWidget(self.progress, 1)
        middle.addWidget(self.cancel)
        body = QSplitter(Qt.Orientation.Horizontal)
        body.addWidget(self.table)
        body.addWidget(self.plot)
        body.setStretchFactor(0, 2)
        body.setStretchFactor(1, 3)
        body.setChildrenCollapsible(False)
        body.setSizes([440, 620])
        foot = QHBoxLayout()
        foot.addWidget(self.accept_one)
        foot.addWidget(self.accept_empty)
        foot.addStretch(1)
        foot.addWidget(close)
        column = QVBoxLayout(self)
        column.addLayout(top)
        column.addLayout(middle)
        column.addWidget(body, 1)
        column.addLayout(foot)


class _Item(QTableWidgetItem):
    """Sorted by its number, where it has one."""

    def __init__(self, text: str, key: float | None) -> None:
        super().__init__(text)
        self._key = key

    def __lt__(self, other: QTableWidgetItem) -> bool:
        if self._key is not None and isinstance(other, _Item) and other._key is not None:
            return self._key < other._key
        return self.text() < other.text()
