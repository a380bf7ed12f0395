"""How often phone pairs are said: our table beside the paper's table 2, and the cumulative curve of figure 2."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import (
    QAbstractItemView,
    QDialog,
    QHeaderView,
    QLabel,
    QSplitter,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from core_pipeline.phonemes import Pair
from core_pipeline.statistics import PAPER_COVER, PAPER_FIRST, PAPER_NEVER, TABLE_2, Frequencies, Progress

from .. import theme

_LEFT, _RIGHT, _TOP, _FOOT = 40, 12, 10, 26


class CumulativeCurve(QWidget):
    """Figure 2: which share of running speech the 1, 2, 3 … most frequent pairs cover."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setMinimumSize(260, 180)
        self.setAccessibleName(self.tr("Cumulative curve of the most frequent pairs"))
        self._cumulative = np.zeros(0)

    def set_frequencies(self, frequencies: Frequencies) -> None:
        """Draw another corpus."""
        self._cumulative = frequencies.cumulative
        first = frequencies.first(PAPER_COVER)
        text = self.tr("The {0} most frequent pairs cover {1} % of running speech").format(first, 100 * PAPER_COVER)
        self.setAccessibleDescription(text)
        self.setToolTip(text)
        self.update()

    def sizeHint(self) -> QSize:
        """Wide enough to read off."""
        return QSize(420, 300)

    def point(self, count: float, share: float) -> QPointF:
        """Where the share (0…1) of the first `count` pairs is drawn."""
        wide, tall = self.width() - _LEFT - _RIGHT, self.height() - _TOP - _FOOT
        return QPointF(_LEFT + wide * count / max(self._cumulative.size, 1), _TOP + tall * (1 - share))

    def paintEvent(self, event: QPaintEvent) -> None:
        """Grid, curve, and the paper's own point."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), theme.BACKGROUND)
        painter.setFont(theme.font(8.5))
        for share in (0.0, 0.25, 0.5, 0.75, 1.0):
            y = round(self.point(0, share).y())
            painter.fillRect(_LEFT, y, self.width() - _LEFT - _RIGHT, 1, theme.GRID)
            painter.setPen(theme.MUTED)
            box = QRectF(0, y - 8, _LEFT - 6, 16)
            painter.drawText(box, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter, f"{100 * share:.0f} %")
        size = self._cumulative.size
        for count in range(0, size + 1, 100):
            x = self.point(count, 0).x()
            painter.drawText(
                QRectF(x - 20, self.height() - _FOOT + 4, 40, 16), Qt.AlignmentFlag.AlignCenter, str(count)
            )
        if not size:
            return
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(theme.LINK, 1))
        steps = zip(range(size + 1), (0.0, *self._cumulative.tolist()), strict=True)
        painter.drawPolyline(QPolygonF([self.point(n, share) for n, share in steps]))
        if size > PAPER_FIRST:
            at = self.point(PAPER_FIRST, PAPER_COVER)
            painter.setPen(QPen(theme.HIGHLIGHT, 1))
            painter.drawEllipse(at, 4, 4)
            text = self.tr("the paper: {0} cover {1} %").format(PAPER_FIRST, 100 * PAPER_COVER)
            wide = painter.fontMetrics().horizontalAdvance(text)
            painter.drawText(QPointF(min(at.x() - wide / 2, self.width() - wide - 6), at.y() + 22), text)


class StatisticsView(QDialog):
    """The tables and the curve; shows values, asks nothing."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(self.tr("Corpus statistics"))
        self.summary = QLabel()
        self.summary.setWordWrap(True)
        self.table = self._table([self.tr("Pair"), self.tr("Corpus"), self.tr("Paper")])
        self.table.setAccessibleName(self.tr("Pairs by frequency"))
        self.table_2 = self._table([self.tr("Pair"), self.tr("Paper"), self.tr("Corpus")])
        self.table_2.setAccessibleName(self.tr("Table 2 of the paper"))
        self.curve = CumulativeCurve()
        columns = QSplitter(Qt.Orientation.Horizontal)
        for title, widget in (
            (self.tr("By frequency"), self.table),
            (self.tr("Table 2 of the paper"), self.table_2),
            (self.tr("The most frequent pairs together (figure 2)"), self.curve),
        ):
            columns.addWidget(self._titled(title, widget))
        columns.setStretchFactor(2, 1)
        columns.setChildrenCollapsible(False)
        column = QVBoxLayout(self)
        column.addWidget(self.summary)
        column.addWidget(columns, 1)
        self.resize(1060, 560)

    def set_frequencies(self, name: str, said: Frequencies, now: Progress) -> None:
        """Show a corpus, and how much of it the open set covers."""
        lines = [
            self.tr("{0}: {1} pairs in {2} sentences; {3} of {4} pairs never appear (the paper: {5}).").format(
                name, f"{said.total:,}", said.utterances, said.never, said.possible, PAPER_NEVER
            ),
            self.tr("{0} of the {1} most frequent are in the paper's table 2; the first {2} cover {3} %.").format(
                said.shared_with_paper(), len(TABLE_2), said.first(PAPER_COVER), 100 * PAPER_COVER
            ),
            self.tr("Drawn: {0} bigrams, {1:.1f} % of this speech; approved: {2}, {3:.1f} %.").format(
                now.drawn, 100 * now.speech, now.approved, 100 * now.approved_speech
            ),
        ]
        self.summary.setText(" ".join(lines))
        theirs = {pair: percent / 100 for pair, percent in TABLE_2.items()}
        self._fill(self.table, [(pair, share, theirs.get(pair)) for pair, share in said.shares.items()])
        self._fill(self.table_2, [(pair, share, said.shares.get(pair)) for pair, share in theirs.items()])
        self.curve.set_frequencies(said)

    @staticmethod
    def _table(columns: list[str]) -> QTableWidget:
        table = QTableWidget(0, len(columns))
        table.setHorizontalHeaderLabels(columns)
        table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        table.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Stretch)
        table.verticalHeader().setDefaultSectionSize(20)
        table.setShowGrid(False)
        table.setTabKeyNavigation(False)
        return table

    @staticmethod
    def _fill(table: QTableWidget, rows: list[tuple[Pair, float, float | None]]) -> None:
        table.setRowCount(len(rows))
        right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        for i, (pair, share, beside) in enumerate(rows):
            for column, text in enumerate(
                (" – ".join(pair), _percent(share), "" if beside is None else _percent(beside))
            ):
                item = QTableWidgetItem(text)
                if column:
                    item.setTextAlignment(right)
                if column == 2:
                    item.setForeground(theme.MUTED)
                table.setItem(i, column, item)

    @staticmethod
    def _titled(title: str, widget: QWidget) -> QWidget:
        box = QWidget()
        column = QVBoxLayout(box)
        column.setContentsMargins(0, 0, 0, 0)
        label = QLabel(title)
        label.setStyleSheet(f"color:{theme.MUTED.name()}")
        column.addWidget(label)
        column.addWidget(widget, 1)
        return box


def _percent(share: float) -> str:
    return f"{100 * share:.2f} %"
