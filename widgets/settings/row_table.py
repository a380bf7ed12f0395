"""A column of rows of fields with "add" and "remove", for the short tables of the settings."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Generic, TypeVar

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QLabel, QToolButton, QVBoxLayout, QWidget

from .. import theme


def pose_box() -> QComboBox:
    """A choice of poses that may be narrow, and ignores the wheel so that the panel scrolls."""
    box = QComboBox()
    box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
    box.setMinimumContentsLength(2)
    box.setMinimumWidth(70)
    box.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
    box.wheelEvent = lambda event: event.ignore()  # type: ignore[method-assign]
    return box


def show_choice(box: QComboBox, names: Sequence[str], name: str) -> None:
    """Offer `names`, with `name` chosen; `activated` stays silent."""
    if [box.itemText(i) for i in range(box.count())] != list(names):
        box.clear()
        box.addItems(list(names))
    box.setCurrentText(name)


class Row(QWidget):
    """Fields in one line with a remove button at the end; a subclass puts its fields in."""

    changed = Signal(str)
    removed = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.line = QHBoxLayout(self)
        self.line.setContentsMargins(0, 0, 0, 0)
        self.line.setSpacing(4)
        self.remove = QToolButton()
        self.remove.setIcon(theme.icon("close", theme.MUTED))
        self.remove.setIconSize(QSize(14, 14))
        self.remove.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.remove.clicked.connect(self.removed)

    def add_sign(self, text: str) -> None:
        """A muted word between two fields."""
        sign = QLabel(text)
        sign.setStyleSheet(f"color:{theme.MUTED.name()}")
        self.line.addWidget(sign)


R = TypeVar("R", bound=Row)


class RowTable(QWidget, Generic[R]):
    """Rows are re-used for new values, so that the field with the keyboard focus outlives them.

    add_wanted, remove_wanted(row), row_changed(label)  what the user did; values are read from `rows`
    """

    add_wanted = Signal()
    remove_wanted = Signal(int)
    row_changed = Signal(str)

    def __init__(self, make_row: Callable[[], R], add_text: str) -> None:
        super().__init__()
        self._make_row = make_row
        self.rows: list[R] = []
        self.add = QToolButton()
        self.add.setIcon(theme.icon("plus", theme.MUTED))
        self.add.setIconSize(QSize(14, 14))
        self.add.setText(add_text)
        self.add.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.add.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.add.setAccessibleName(add_text)
        self.add.setToolTip(add_text)
        self.add.clicked.connect(self.add_wanted)
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 0, 0, 0)
        self._column.setSpacing(3)
        self._column.addWidget(self.add, 0, Qt.AlignmentFlag.AlignLeft)

    def set_count(self, count: int) -> None:
        """Make or drop rows at the end."""
        while len(self.rows) < count:
            row = self._make_row()
            row.changed.connect(self.row_changed)
            row.removed.connect(lambda row=row: self.remove_wanted.emit(self.rows.index(row)))
            self._column.insertWidget(len(self.rows), row)
            before = self.rows[-1].remove if self.rows else None
            self.rows.append(row)
            if before is not None:
                self.setTabOrder(before, row)
            self.setTabOrder(row.remove, self.add)
        while len(self.rows) > count:
            row = self.rows.pop()
            if row.isAncestorOf(self.focusWidget() or self):
                (self.rows[-1].remove if self.rows else self.add).setFocus()
            row.hide()
            row.deleteLater()
