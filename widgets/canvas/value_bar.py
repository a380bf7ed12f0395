"""The bar under the canvas: time and weight of the selected keys as fields to type into."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QFocusEvent, QKeyEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QLineEdit, QSizePolicy, QWidget

from .. import theme
from ..elided_label import ElidedLabel


class ValueField(QLineEdit):
    """One value of the whole selection; Enter wishes what is typed, Esc takes it back and leaves."""

    typed = Signal(str)
    left = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._shown = ""
        self.setFont(theme.mono_font())
        self.setMinimumWidth(self.fontMetrics().horizontalAdvance("0.000") + 22)
        self.setMaximumWidth(self.fontMetrics().horizontalAdvance("0.000 … 0.000") + 22)
        self.setEnabled(False)
        self.returnPressed.connect(self._wish)

    def set_values(self, values: Sequence[float]) -> None:
        """The values of all selected keys; what is being typed stays."""
        texts = [f"{value:.4f}".rstrip("0").rstrip(".") for value in (min(values), max(values))] if values else [""]
        self._shown = texts[0] if len(set(texts)) == 1 else ""
        self.setPlaceholderText("" if self._shown else " … ".join(texts))
        self.setEnabled(bool(values))
        if not self.isModified() or not self.hasFocus():
            self.setText(self._shown)

    def _wish(self) -> None:
        text = self.text()
        self.setModified(False)
        if text.strip() and text != self._shown:
            self.typed.emit(text)
        self.setText(self._shown)
        self.selectAll()

    def focusInEvent(self, ev: QFocusEvent) -> None:
        """Typing replaces what is there."""
        super().focusInEvent(ev)
        self.selectAll()

    def focusOutEvent(self, ev: QFocusEvent) -> None:
        """What was typed without Enter is taken back."""
        super().focusOutEvent(ev)
        if ev.reason() not in (Qt.FocusReason.PopupFocusReason, Qt.FocusReason.ActiveWindowFocusReason):
            self.setText(self._shown)

    def keyPressEvent(self, ev: QKeyEvent) -> None:
        """Esc takes back; the rest is typing."""
        if ev.key() == Qt.Key.Key_Escape:
            self.setText(self._shown)
            self.left.emit()
        else:
            super().keyPressEvent(ev)


class ValueBar(QWidget):
    """“t [0.26]  v [0.97]”. A plain number sets, “*0.5”, “+0.1”, “-0.1” and “=.3” act on every selected key."""

    #: "t" or "v", and the text.
    typed = Signal(str, str)
    #: The keyboard should go back to the canvas.
    left = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        how = self.tr("A number sets it; *0.5, +0.1, -0.1 and =.3 act on every selected key. Enter applies.")
        self.time, self.weight = ValueField(), ValueField()
        row = QHBoxLayout(self)
        row.setContentsMargins(12, 3, 8, 3)
        row.setSpacing(6)
        for axis, field, name, letter in (
            ("t", self.time, self.tr("Time of the selected keys"), self.tr("t")),
            ("v", self.weight, self.tr("Weight of the selected keys"), self.tr("v")),
        ):
            field.setAccessibleName(name)
            field.setAccessibleDescription(how)
            field.setToolTip(f"{name}. {how}")
            field.typed.connect(lambda text, axis=axis: self.typed.emit(axis, text))
            field.left.connect(self.left)
            label = QLabel(letter)
            label.setBuddy(field)
            row.addWidget(label)
            row.addWidget(field)
            row.addSpacing(8)
        self._count = ElidedLabel()
        row.addWidget(self._count, 1)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)

    def set_keys(self, keys: Sequence[tuple[float, float]]) -> None:
        """(t, v) of every selected key."""
        self.time.set_values([t for t, _ in keys])
        self.weight.set_values([v for _, v in keys])
        many = self.tr("{0} keys: *0.5, +0.1 or =.3 act on all").format(len(keys))
        self._count.set_text(many if len(keys) > 1 else "" if keys else self.tr("no key selected"))
