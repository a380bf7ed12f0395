"""The bigrams of the sentence that need work, worst first, as the diagnosis gives them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QModelIndex, QSignalBlocker, Qt, Signal
from PySide6.QtGui import QKeyEvent, QMouseEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QFrame,
    QHeaderView,
    QLabel,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)

from core_pipeline.phonemes import Pair

from .. import theme
from .bigram_model import spoken_pair


@dataclass(frozen=True)
class WeakRow:
    """One line of the list.

    reason    why, in a few words: "missing", "speed-limited 38 %"
    time      where in the sentence it is, seconds; None when it is no place in time
    uses      how often the sentence, or the text, has it
    serious   drawn with a warning sign; a mere draft is not
    sentence  the sentence of a text in which it is; "" for the present one
    """

    pair: Pair
    reason: str
    time: float | None = None
    uses: int = 0
    serious: bool = True
    sentence: str = ""


class _Rows(QTreeWidget):
    """Bigram, reason, time; opens what is clicked or reached by keys."""

    opened = Signal(QModelIndex)

    def __init__(self) -> None:
        super().__init__()
        self.setColumnCount(3)
        self.setHeaderHidden(True)
        self.setRootIsDecorated(False)
        self.setIndentation(0)
        self.setUniformRowHeights(True)
        self.setAllColumnsShowFocus(True)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setTextElideMode(Qt.TextElideMode.ElideRight)
        self.header().setMinimumSectionSize(20)
        self.header().setStretchLastSection(False)
        self.header().setSectionResizeMode(0, QHeaderView.ResizeMode.ResizeToContents)
        self.header().setSectionResizeMode(1, QHeaderView.ResizeMode.Stretch)
        self.header().setSectionResizeMode(2, QHeaderView.ResizeMode.ResizeToContents)
        self.setMinimumHeight(44)
        self.empty_text = ""

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Arrows move and open; Enter opens again."""
        before = self.currentItem()
        super().keyPressEvent(event)
        now = self.currentItem()
        if now is not None and (now is not before or event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter)):
            self.opened.emit(self.currentIndex())

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """A left click opens."""
        super().mousePressEvent(event)
        index = self.indexAt(event.position().toPoint())
        if index.isValid() and event.button() == Qt.MouseButton.LeftButton:
            self.opened.emit(index)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """A drag selects nothing."""

    def paintEvent(self, event: QPaintEvent) -> None:
        """The rows, or a line that says why there are none."""
        super().paintEvent(event)
        if not self.topLevelItemCount():
            painter = QPainter(self.viewport())
            painter.setPen(theme.FAINT)
            flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            painter.drawText(self.viewport().rect().adjusted(8, 0, -8, 0), flags, self.empty_text)


class WeakList(QWidget):
    """Rows to open.

    picked(pair, time)               the user wants this bigram opened, at this time of the sentence or None
    picked_in(pair, sentence, time)  the same, in another sentence than the present one
    """

    picked = Signal(tuple, object)
    picked_in = Signal(tuple, str, object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._values: tuple[WeakRow, ...] = ()
        self._title = QLabel()
        self._title.setStyleSheet(f"color:{theme.MUTED.name()}")
        self.list = _Rows()
        self.list.setAccessibleName(self.tr("Weak bigrams in this sentence"))
        self.list.setAccessibleDescription(self.tr("Up and down open the bigram"))
        self.list.empty_text = self.tr("No weak bigram in this sentence.")
        self.list.opened.connect(self._open)
        column = QVBoxLayout(self)
        column.setContentsMargins(6, 4, 6, 6)
        column.setSpacing(4)
        column.addWidget(self._title)
        column.addWidget(self.list, 1)
        self.setFocusProxy(self.list)
        self.set_rows([])

    def set_rows(self, rows: Sequence[WeakRow]) -> None:
        """The lines, worst first; the selected bigram stays selected. Emits nothing."""
        if tuple(rows) == self._values and self._title.text():
            return
        at = self.list.currentIndex().row()
        kept = self._values[at].pair if at >= 0 else None
        self._values = tuple(rows)
        with QSignalBlocker(self.list):
            self.list.clear()
            items = [self._item(row) for row in self._values]
            self.list.addTopLevelItems(items)
            for item, row in zip(items, self._values, strict=True):
                if row.pair == kept:
                    self.list.setCurrentItem(item)
                    break
        count = f" · {len(rows)}" if rows else ""
        self._title.setText(self.tr("Weak bigrams in this sentence") + count)
        self.list.viewport().update()

    def step(self, way: int) -> None:
        """Open the next bigram of the list, or the previous one with −1; round the end."""
        if not self._values:
            return
        at = self.list.currentIndex().row()
        here = self._values[at].pair if at >= 0 else None
        if at < 0 and way < 0:
            at = 0
        for _ in self._values:  # several rows may be about the same bigram
            at = (at + way) % len(self._values)
            if self._values[at].pair != here:
                break
        self.list.setCurrentItem(self.list.topLevelItem(at))
        self._open(self.list.currentIndex())

    def hide_title(self) -> None:
        """Somebody else says what the list is about."""
        self._title.hide()

    @property
    def rows(self) -> tuple[WeakRow, ...]:
        """What is shown."""
        return self._values

    def _item(self, row: WeakRow) -> QTreeWidgetItem:
        uses = self.tr("%1×").replace("%1", str(row.uses)) if row.uses else ""
        reason = " · ".join(part for part in (row.reason, uses) if part)
        time = "" if row.time is None else self.tr("%1 s").replace("%1", f"{row.time:.2f}")
        item = QTreeWidgetItem([f"{row.pair[0]} – {row.pair[1]}", reason, time])
        sign = ("alert", theme.WEAK) if row.serious else ("circle-small", theme.MUTED)
        item.setIcon(0, theme.icon(*sign))
        item.setForeground(1, theme.TEXT if row.serious else theme.MUTED)
        item.setForeground(2, theme.MUTED)
        item.setTextAlignment(2, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        quoted = f"“{row.sentence}”" if row.sentence else ""
        whole = " · ".join(part for part in (spoken_pair(row.pair), reason, time, quoted) if part)
        for column in range(3):
            item.setToolTip(column, whole)
            item.setData(column, Qt.ItemDataRole.AccessibleTextRole, whole)
        return item

    def _open(self, index: QModelIndex) -> None:
        row = self._values[index.row()]
        if row.sentence:
            self.picked_in.emit(row.pair, row.sentence, row.time)
        else:
            self.picked.emit(row.pair, row.time)
