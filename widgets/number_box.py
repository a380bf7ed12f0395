"""A number field that speaks only when the user has finished a value, and never by an accidental wheel turn."""

from __future__ import annotations

from PySide6.QtCore import QSignalBlocker, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QAbstractSpinBox, QDoubleSpinBox, QWidget


class NumberBox(QDoubleSpinBox):
    """valueChanged comes from the user alone: `show_value` is silent, and half-typed numbers are not values yet."""

    def __init__(
        self, low: float, high: float, step: float, decimals: int = 2, suffix: str = "", parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self.setDecimals(decimals)
        self.setRange(low, high)
        self.setSingleStep(step)
        self.setSuffix(suffix)
        self.setKeyboardTracking(False)
        self.setCorrectionMode(QAbstractSpinBox.CorrectionMode.CorrectToNearestValue)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self._given = low

    def make_narrow(self) -> None:
        """As wide as one digit, the decimals and the suffix, whatever the range."""
        longest = f"{0:.{self.decimals()}f}{self.suffix()}"
        self.setFixedWidth(self.fontMetrics().horizontalAdvance(longest) + 32)

    def show_value(self, value: float) -> None:
        """Show a value from outside; emits nothing."""
        self._given = value
        if value != self.value():
            with QSignalBlocker(self):
                self.setValue(value)

    @property
    def exact(self) -> float:
        """The value given from outside, unrounded, as long as the user has not changed it."""
        return self._given if round(self._given, self.decimals()) == self.value() else self.value()

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Only where the user is already; elsewhere the wheel scrolls the panel."""
        if self.hasFocus():
            super().wheelEvent(event)
        else:
            event.ignore()
