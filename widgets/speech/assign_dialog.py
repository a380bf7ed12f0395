"""A table of names and what each stands for: phone names nobody knows, or a whole phoneme map."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QHeaderView,
    QLabel,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)


class AssignDialog(QDialog):
    """Asks what names stand for; `answers` has the result.

    names    name → what it stands for now; "" for nothing yet
    choices  (value, title) of what may be chosen
    """

    def __init__(
        self,
        title: str,
        sentence: str,
        heads: tuple[str, str],
        names: Mapping[str, str],
        choices: Sequence[tuple[str, str]],
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(title)
        self.setMinimumSize(380, 260)
        self.resize(420, min(640, 190 + 32 * len(names)))
        told = QLabel(sentence)
        told.setWordWrap(True)
        told.setTextFormat(Qt.TextFormat.PlainText)
        self.table = QTableWidget(len(names), 2)
        self.table.setHorizontalHeaderLabels(list(heads))
        self.table.verticalHeader().hide()
        self.table.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Stretch)
        self.boxes: dict[str, QComboBox] = {}
        for row, (name, value) in enumerate(names.items()):
            item = QTableWidgetItem(name)
            item.setFlags(Qt.ItemFlag.ItemIsEnabled)
            self.table.setItem(row, 0, item)
            box = QComboBox()
            box.setAccessibleName(self.tr("What {0} stands for").format(name))
            for choice, text in choices:
                box.addItem(text, choice)
            box.setCurrentIndex(max(0, box.findData(value)))
            self.table.setCellWidget(row, 1, box)
            self.boxes[name] = box
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Ok | QDialogButtonBox.StandardButton.Cancel)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        column = QVBoxLayout(self)
        column.addWidget(told)
        column.addWidget(self.table, 1)
        column.addWidget(buttons)

    @property
    def answers(self) -> dict[str, str]:
        """name → the value chosen."""
        return {name: str(box.currentData()) for name, box in self.boxes.items()}
