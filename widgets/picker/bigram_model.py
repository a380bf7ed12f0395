"""What is known of every bigram, as a table model: one row per first phone, one column per second."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Any

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QPersistentModelIndex, Qt
from PySide6.QtWidgets import QWidget

from core_pipeline.phonemes import Pair

Index = QModelIndex | QPersistentModelIndex
_NOWHERE = QModelIndex()


def spoken_pair(pair: Pair) -> str:
    """("f", "ah") → "F – Ah", as shown to people."""
    return " – ".join(phone.capitalize() for phone in pair)


class BigramModel(QAbstractTableModel):
    """Phones × phones; what is known of each pair. Cells carry no text, only tooltips and accessible names."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.phonemes: tuple[str, ...] = ()
        self.statuses: Mapping[Pair, str] = {}
        self.weak: Mapping[Pair, str] = {}
        self.weakness: Mapping[Pair, float] = {}
        self.differences: Mapping[Pair, float] | None = None
        self.used: Mapping[Pair, int] = {}
        self.words: Mapping[Pair, str] = {}
        self.overridden: Collection[Pair] = frozenset()
        self._place: dict[str, int] = {}

    def set_phonemes(self, phonemes: Sequence[str]) -> None:
        """The phones of rows and columns, in order."""
        self.beginResetModel()
        self.phonemes = tuple(phonemes)
        self._place = {phone: i for i, phone in enumerate(self.phonemes)}
        self.endResetModel()

    def refresh(self) -> None:
        """Tell views that what is known of the pairs has changed."""
        if self.phonemes:
            last = len(self.phonemes) - 1
            self.dataChanged.emit(self.index(0, 0), self.index(last, last))

    def cell(self, pair: Pair) -> tuple[int, int] | None:
        """Row and column of a pair; None when one of its phones is not in the square."""
        row, column = self._place.get(pair[0]), self._place.get(pair[1])
        return None if row is None or column is None else (row, column)

    def pair_at(self, index: Index) -> Pair:
        """The pair of a valid index."""
        return self.phonemes[index.row()], self.phonemes[index.column()]

    def index_of(self, pair: Pair | None) -> QModelIndex:
        """The index of a pair, invalid when it is not in the square."""
        cell = None if pair is None else self.cell(pair)
        return QModelIndex() if cell is None else self.index(*cell)

    def describe(self, pair: Pair) -> str:
        """One line for tooltips and screen readers: "F – Ah as in fat · draft · used 2×"."""
        word = self.words.get(pair)
        name = (
            self.tr("%1 as in %2").replace("%1", spoken_pair(pair)).replace("%2", word) if word else spoken_pair(pair)
        )
        parts = [name, self.status_label(self.statuses.get(pair, "empty"))]
        if pair in self.weak:
            parts.append(self.weak[pair])
        if self.used.get(pair):
            parts.append(self.tr("used %1×").replace("%1", str(self.used[pair])))
        if pair in self.overridden:
            parts.append(self.tr("this character's own"))
        return " · ".join(parts)

    def status_label(self, status: str) -> str:
        """A status in the user's language."""
        labels = {
            "empty": self.tr("empty"),
            "suggestion": self.tr("suggestion"),
            "draft": self.tr("draft"),
            "review": self.tr("review"),
            "approved": self.tr("approved"),
        }
        return labels.get(status, status)

    def rowCount(self, parent: Index = _NOWHERE) -> int:
        """One per phone."""
        return 0 if parent.isValid() else len(self.phonemes)

    def columnCount(self, parent: Index = _NOWHERE) -> int:
        """One per phone."""
        return 0 if parent.isValid() else len(self.phonemes)

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """Tooltip, accessible name and accessible description."""
        if role == Qt.ItemDataRole.AccessibleTextRole:
            return spoken_pair(self.pair_at(index))
        if role in (Qt.ItemDataRole.ToolTipRole, Qt.ItemDataRole.AccessibleDescriptionRole):
            return self.describe(self.pair_at(index))
        return None

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """The phone itself."""
        return self.phonemes[section] if role == Qt.ItemDataRole.DisplayRole else None
