"""The set's phonemes: add, split off, rename, remove; below, what that changes. Nothing is done before OK.

Knows names only: whoever shows it answers every wish with new rows and a new preview.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QGroupBox,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QListWidget,
    QListWidgetItem,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from .. import theme

_NAME = Qt.ItemDataRole.UserRole


@dataclass(frozen=True)
class PhoneRow:
    """One phoneme and the language's phones that it stands for."""

    name: str
    spoken: tuple[str, ...]


class PhoneSetDialog(QDialog):
    """added(name, like, spoken)  a new phoneme; `like` is the one whose curves it copies, "" for empty bigrams
    renamed(old, new)
    removed(name, into)  what it stood for plays `into`
    """

    added = Signal(str, str, tuple)
    renamed = Signal(str, str)
    removed = Signal(str, str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(self.tr("Phone Set"))
        self.resize(620, 560)
        self._rows: tuple[PhoneRow, ...] = ()
        self.list = QListWidget()
        self.list.setAccessibleName(self.tr("Phonemes"))
        self.list.currentItemChanged.connect(self._picked)
        self.name = QLineEdit()
        self.name.setPlaceholderText(self.tr("b, ü, …"))
        self.spoken = QLineEdit()
        self.spoken.setPlaceholderText(self.tr("phones of the language, such as b"))
        self.like = QComboBox()
        self.add = QPushButton(self.tr("&Add"))
        self.add.clicked.connect(self._add)
        self.new_name = QLineEdit()
        self.rename = QPushButton(self.tr("&Rename"))
        self.rename.clicked.connect(lambda: self.renamed.emit(self.current, self.new_name.text().strip()))
        self.into = QComboBox()
        self.remove = QPushButton(self.tr("Re&move"))
        self.remove.clicked.connect(lambda: self.removed.emit(self.current, self.into.currentText()))
        self.problem = self._text()
        palette = self.problem.palette()
        palette.setColor(palette.ColorRole.WindowText, theme.WEAK)
        self.problem.setPalette(palette)
        self.preview = self._text()
        self.preview.setAccessibleName(self.tr("What changes"))
        self.buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Ok | QDialogButtonBox.StandardButton.Cancel)
        self.buttons.accepted.connect(self.accept)
        self.buttons.rejected.connect(self.reject)
        self._lay_out()

    def _text(self) -> QLabel:
        label = QLabel()
        label.setWordWrap(True)
        label.setTextFormat(Qt.TextFormat.PlainText)
        label.setAlignment(Qt.AlignmentFlag.AlignTop)
        return label

    def _lay_out(self) -> None:
        right = QVBoxLayout()
        for title, rows, button in (
            (
                self.tr("New phoneme"),
                (
                    (self.tr("Name"), self.name),
                    (self.tr("Stands for"), self.spoken),
                    (self.tr("Begins with the curves of"), self.like),
                ),
                self.add,
            ),
            (self.tr("The chosen phoneme"), ((self.tr("New name"), self.new_name),), self.rename),
            ("", ((self.tr("What it stood for plays"), self.into),), self.remove),
        ):
            box = QGroupBox(title)
            form = QFormLayout(box)
            for label, widget in rows:
                widget.setAccessibleName(label)
                form.addRow(label, widget)
            line = QHBoxLayout()
            line.addStretch(1)
            line.addWidget(button)
            form.addRow(line)
            right.addWidget(box)
        right.addStretch(1)
        upper = QHBoxLayout()
        upper.addWidget(self.list, 1)
        upper.addLayout(right, 2)
        changes = QGroupBox(self.tr("What changes"))
        QVBoxLayout(changes).addWidget(self.preview)
        changes.setMinimumHeight(120)
        column = QVBoxLayout(self)
        column.addLayout(upper, 1)
        column.addWidget(self.problem)
        column.addWidget(changes)
        column.addWidget(self.buttons)

    @property
    def current(self) -> str:
        """The chosen phoneme, "" for none."""
        item = self.list.currentItem()
        return "" if item is None else str(item.data(_NAME))

    def set_rows(self, rows: Sequence[PhoneRow], choose: str = "") -> None:
        """All phonemes of the set as it would be; `choose` is shown chosen, else the one that was."""
        choose = choose or self.current
        self._rows = tuple(rows)
        self.list.clear()
        for row in rows:
            item = QListWidgetItem(f"{row.name}   {' '.join(row.spoken)}")
            item.setData(_NAME, row.name)
            self.list.addItem(item)
        names = [row.name for row in rows]
        like = self.like.currentText()
        self.like.clear()
        self.like.addItems([self.tr("none: empty bigrams"), *names])
        if like in names:
            self.like.setCurrentText(like)
        self.list.setCurrentRow(names.index(choose) if choose in names else 0)

    def set_preview(self, lines: Sequence[str]) -> None:
        """What OK would change, a sentence a line; without any, OK has nothing to do."""
        self.preview.setText("\n".join(lines) if lines else self.tr("Nothing yet."))
        self.buttons.button(QDialogButtonBox.StandardButton.Ok).setEnabled(bool(lines))

    def set_problem(self, sentence: str) -> None:
        """Why the last wish was not met; "" when it was."""
        self.problem.setText(sentence)

    def _add(self) -> None:
        like = self.like.currentText() if self.like.currentIndex() > 0 else ""
        self.added.emit(self.name.text().strip(), like, tuple(self.spoken.text().replace(",", " ").split()))

    def _picked(self) -> None:
        name = self.current
        self.new_name.setText(name)
        self.into.clear()
        self.into.addItems([row.name for row in self._rows if row.name != name])
        if name:
            self.like.setCurrentText(name)
        for button in (self.rename, self.remove):
            button.setEnabled(bool(name) and (button is self.rename or len(self._rows) > 1))
