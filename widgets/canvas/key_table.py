"""The keys of the active curve as a table: what the canvas does by hand, for keyboard and screen reader."""

from __future__ import annotations

from collections.abc import Collection

from PySide6.QtCore import (
    QAbstractTableModel,
    QItemSelection,
    QItemSelectionModel,
    QModelIndex,
    QPersistentModelIndex,
    Qt,
    Signal,
)
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableView, QWidget

from core_pipeline.curves import Curve

from .. import theme

TIME, WEIGHT = range(2)
_AXES = ("t", "v")

_Index = QModelIndex | QPersistentModelIndex
_Role = Qt.ItemDataRole


class _Keys(QAbstractTableModel):
    """One row per key: time, weight."""

    typed = Signal(int, str, str)

    def __init__(self) -> None:
        super().__init__()
        self.curve: Curve | None = None
        self.pose = ""
        self.editable = True

    def show(self, pose: str, curve: Curve | None, *, editable: bool) -> None:
        """Other keys; as many as before keep their rows."""
        same_rows = self.rowCount() == (len(curve) if curve is not None else 0) and pose == self.pose
        if not same_rows:
            self.beginResetModel()
        self.pose, self.curve, self.editable = pose, curve, editable
        if not same_rows:
            self.endResetModel()
        elif curve is not None:
            self.dataChanged.emit(self.index(0, TIME), self.index(len(curve) - 1, WEIGHT))

    def rowCount(self, parent: _Index | None = None) -> int:
        inside = parent is not None and parent.isValid()
        return 0 if self.curve is None or inside else len(self.curve)

    def columnCount(self, parent: _Index | None = None) -> int:
        return 0 if parent is not None and parent.isValid() else len(_AXES)

    def data(self, index: _Index, role: int = _Role.DisplayRole) -> object:
        if self.curve is None or not index.isValid():
            return None
        value = float((self.curve.t, self.curve.v)[index.column()][index.row()])
        if role in (_Role.DisplayRole, _Role.EditRole):
            return f"{value:.4f}".rstrip("0").rstrip(".") if role == _Role.EditRole else f"{value:.3f}"
        if role == _Role.TextAlignmentRole:
            return int(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        if role == _Role.AccessibleTextRole:
            what = (self.tr("time"), self.tr("weight"))[index.column()]
            return self.tr("{0} key {1} {2} {3}").format(self.pose, index.row() + 1, what, f"{value:.3f}")
        return None

    def setData(self, index: _Index, value: object, role: int = _Role.EditRole) -> bool:
        """Only wishes: the new value comes back down."""
        text = str(value)
        if role == _Role.EditRole and text.strip() and text != self.data(index, _Role.EditRole):
            self.typed.emit(index.row(), _AXES[index.column()], text)
        return False

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = _Role.DisplayRole) -> object:
        if role == _Role.DisplayRole:
            return _AXES[section] if orientation == Qt.Orientation.Horizontal else str(section + 1)
        if role == _Role.ToolTipRole and orientation == Qt.Orientation.Horizontal:
            return (self.tr("Normalised time, 0 to 1"), self.tr("Weight, 0 to 1"))[section]
        return None

    def flags(self, index: _Index) -> Qt.ItemFlag:
        plain = Qt.ItemFlag.ItemIsEnabled | Qt.ItemFlag.ItemIsSelectable
        return plain | Qt.ItemFlag.ItemIsEditable if self.editable else plain


class KeyTable(QTableView):
    """Type a number, or “*0.5”, “+0.1”, “=.3”, into a cell; Ins adds a key, Del removes the selected ones.

    Values come in by set_curve and select_keys; the table changes nothing by itself.
    """

    #: Key, "t" or "v", and what was typed.
    typed = Signal(int, str, str)
    #: The selected keys: frozenset of indices.
    keys_picked = Signal(object)
    add_wanted = Signal()
    delete_wanted = Signal()
    #: The keyboard should go back to the canvas.
    left = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._keys = _Keys()
        self._telling = frozenset[int]()
        self.setModel(self._keys)
        self.setAccessibleName(self.tr("Keys"))
        self.setAccessibleDescription(
            self.tr("Times and weights of the active curve: Enter or a number edits, Insert adds, Delete removes.")
        )
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.ExtendedSelection)
        self.setEditTriggers(
            QAbstractItemView.EditTrigger.DoubleClicked
            | QAbstractItemView.EditTrigger.AnyKeyPressed
            | QAbstractItemView.EditTrigger.EditKeyPressed
        )
        self.setTabKeyNavigation(False)
        self.setFont(theme.mono_font(8.5))
        self.setShowGrid(False)
        self.setStyleSheet(f"QTableView{{selection-background-color:{theme.CHECKED.name()}}}")
        self.setAlternatingRowColors(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Stretch)
        self.horizontalHeader().setHighlightSections(False)
        self.verticalHeader().setDefaultSectionSize(22)
        self.verticalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        self.setMinimumWidth(130)
        self._keys.typed.connect(self.typed)

    def set_curve(self, pose: str, curve: Curve | None, *, editable: bool = True) -> None:
        """The active curve, None where the pose has none."""
        self._keys.show(pose, curve, editable=editable)
        self.setAccessibleName(self.tr("Keys of {0}").format(pose) if pose else self.tr("Keys"))

    def select_keys(self, indices: Collection[int]) -> None:
        """The keys that are selected; answered with no wish."""
        self._telling = frozenset(indices)
        if self.picked == self._telling:
            return
        rows = QItemSelection()
        for row in sorted(self._telling):
            rows.select(self._keys.index(row, TIME), self._keys.index(row, WEIGHT))
        flag = QItemSelectionModel.SelectionFlag
        selection = self.selectionModel()
        if self._telling and self.currentIndex().row() not in self._telling:
            first = self._keys.index(min(self._telling), max(self.currentIndex().column(), TIME))
            selection.setCurrentIndex(first, flag.NoUpdate)
        selection.select(rows, flag.ClearAndSelect)

    @property
    def picked(self) -> frozenset[int]:
        """Selected rows."""
        return frozenset(index.row() for index in self.selectionModel().selectedRows())

    def selectionChanged(self, selected: QItemSelection, deselected: QItemSelection) -> None:
        """Says which keys the user has picked."""
        super().selectionChanged(selected, deselected)
        if self.picked != self._telling and self.hasFocus():
            self._telling = self.picked
            self.keys_picked.emit(self._telling)

    def keyPressEvent(self, ev: QKeyEvent) -> None:
        """Ins, Del and Esc; Enter edits; letters other than those of a number are left to the window."""
        if self.state() == QAbstractItemView.State.EditingState:
            super().keyPressEvent(ev)  # what the cell's editor has left over
        elif ev.key() == Qt.Key.Key_Insert:
            self.add_wanted.emit()
        elif ev.key() in (Qt.Key.Key_Delete, Qt.Key.Key_Backspace):
            self.delete_wanted.emit()
        elif ev.key() == Qt.Key.Key_Escape:
            self.left.emit()
        elif ev.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter) and self.currentIndex().isValid():
            if self._keys.editable:
                self.edit(self.currentIndex())
        elif ev.text().strip() and ev.text() not in "0123456789.,+-*/=" and not ev.modifiers():
            ev.ignore()
        else:
            super().keyPressEvent(ev)
