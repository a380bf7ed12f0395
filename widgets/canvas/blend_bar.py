"""A bar over the canvas with a slider between the curves as they are and another version of them."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtGui import QFocusEvent, QKeyEvent
from PySide6.QtWidgets import QComboBox, QFrame, QHBoxLayout, QLabel, QSlider, QWidget

from .. import theme

STEPS = 100


class _Slider(QSlider):
    """A slider that says when the keyboard has gone elsewhere, and leaves Enter and Esc to its bar."""

    left = Signal()

    def focusOutEvent(self, ev: QFocusEvent) -> None:
        super().focusOutEvent(ev)
        if ev.reason() not in (Qt.FocusReason.PopupFocusReason, Qt.FocusReason.ActiveWindowFocusReason):
            self.left.emit()

    def keyPressEvent(self, ev: QKeyEvent) -> None:
        if ev.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Escape, Qt.Key.Key_Space):
            ev.ignore()
        else:
            super().keyPressEvent(ev)


class BlendBar(QFrame):
    """“now ———●——— [previous version]”: moved by mouse or arrows; let go or Enter keeps, Esc takes back.

    Nothing is kept by itself: the owner blends and closes.
    """

    #: How far towards the other version, 0 to 1.
    moved = Signal(float)
    target_picked = Signal(str)
    kept = Signal()
    taken_back = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAutoFillBackground(True)
        self.setFrameShape(QFrame.Shape.StyledPanel)
        self.setStyleSheet(
            f"BlendBar{{background:{theme.RAISED.name()};border:1px solid {theme.BORDER.name()};border-radius:6px}}"
        )
        self.slider = _Slider(Qt.Orientation.Horizontal)
        self.slider.setRange(0, STEPS)
        self.slider.setPageStep(10)
        self.slider.setAccessibleName(self.tr("From now to the other version"))
        self.slider.setMinimumWidth(160)
        self.targets = QComboBox()
        self.targets.setAccessibleName(self.tr("The other version"))
        self.targets.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.share = QLabel()
        self.share.setAccessibleName(self.tr("Share of the other version"))
        self.share.setMinimumWidth(self.share.fontMetrics().horizontalAdvance("100 %"))
        self.share.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        row = QHBoxLayout(self)
        row.setContentsMargins(12, 6, 8, 6)
        row.setSpacing(10)
        row.addWidget(QLabel(self.tr("now")))
        row.addWidget(self.slider, 1)
        row.addWidget(self.share)
        row.addWidget(self.targets)
        self.slider.valueChanged.connect(self._slid)
        self.slider.sliderReleased.connect(self.kept)
        self.slider.left.connect(self.kept)
        self.targets.textActivated.connect(self.target_picked)
        self.hide()

    def begin(self, names: Sequence[str], name: str) -> None:
        """Shows the bar at "now" with these other versions to choose from."""
        if [self.targets.itemText(i) for i in range(self.targets.count())] != list(names):
            self.targets.clear()
            self.targets.addItems(list(names))
        self.targets.setCurrentText(name)
        with QSignalBlocker(self.slider):
            self.slider.setValue(0)
        self.share.setText("0 %")
        self.show()
        self.raise_()
        self.slider.setFocus(Qt.FocusReason.PopupFocusReason)

    def _slid(self, value: int) -> None:
        self.share.setText(f"{100 * value // STEPS} %")
        self.moved.emit(value / STEPS)

    def keyPressEvent(self, ev: QKeyEvent) -> None:
        """Enter keeps, Esc takes back."""
        if ev.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self.kept.emit()
        elif ev.key() == Qt.Key.Key_Escape:
            self.taken_back.emit()
        else:
            super().keyPressEvent(ev)
