"""A search field for one of a rig's many shapes: type any part of a name, or open the list."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent, QWheelEvent
from PySide6.QtWidgets import QComboBox, QCompleter, QLineEdit, QSizePolicy, QWidget


class ShapeBox(QComboBox):
    """shape_picked(name): chosen from the list or typed; Enter takes the first that fits, Esc forgets."""

    shape_picked = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._field = QLineEdit()
        self._field.setPlaceholderText(self.tr("Add a shape…"))
        self.setEditable(True)
        self.setLineEdit(self._field)
        self.setInsertPolicy(QComboBox.InsertPolicy.NoInsert)
        self.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.setMinimumContentsLength(8)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMaxVisibleItems(14)
        self.setAccessibleName(self.tr("Add a shape"))
        self.setToolTip(self.tr("Type any part of a shape's name; Enter adds the first that fits"))
        completer = QCompleter(self.model(), self)
        completer.setFilterMode(Qt.MatchFlag.MatchContains)
        completer.setCaseSensitivity(Qt.CaseSensitivity.CaseInsensitive)
        completer.setCompletionMode(QCompleter.CompletionMode.PopupCompletion)
        self.setCompleter(completer)
        for names in (self.view(), completer.popup()):  # many begin alike and tell what they are at their end
            names.setTextElideMode(Qt.TextElideMode.ElideMiddle)
        self.textActivated.connect(self._pick)

    def set_shapes(self, shapes: Sequence[str]) -> None:
        """What can be added."""
        if [self.itemText(i) for i in range(self.count())] != list(shapes):
            self.clear()
            self.addItems(list(shapes))
        self.setEnabled(bool(shapes))
        self._forget()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Enter picks, Esc forgets, Up and Down open the list; the rest is typing."""
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self._pick(self._field.text())
        elif event.key() == Qt.Key.Key_Escape and self._field.text():
            self._forget()
        elif event.key() in (Qt.Key.Key_Up, Qt.Key.Key_Down):
            self.showPopup()  # a step in the closed list would add a shape unseen
        else:
            super().keyPressEvent(event)

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Left to the panel, which scrolls."""
        event.ignore()

    def _pick(self, text: str) -> None:
        wanted = text.strip().casefold()
        names = [self.itemText(i) for i in range(self.count())]
        fitting = [name for name in names if wanted and wanted in name.casefold()]
        exact = [name for name in fitting if name == text.strip()]
        if fitting:
            self._forget()
            self.shape_picked.emit((exact or fitting)[0])

    def _forget(self) -> None:
        self.setCurrentIndex(-1)
        self.clearEditText()
