"""A bar over the canvas with a slider between the curves as they are and another version of them."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtGui import QFocusEvent, QKeyEvent
from PySide6.QtWidgets import QComboBox, QFrame, QHBoxLayout, QLabel, QSlider, QWidget

from .. import theme

STEPS = 100

_Key = Qt.Key
_FOR_THE_BAR = (_Key.Key_Return, _Key.Key_Enter, _Key.Key_Escape, _Key.Key_Space, _Key.Key_Up, _Key.Key_Down)


class _Slider(QSlider):
    """A slider that says when the keyboard has gone elsewhere, and leaves Enter, Esc, Up and Down to its bar."""

    left = Signal()

    def focusOutEvent(self, ev: QFocusEvent) -> None:
        super().focusOutEvent(ev)
        if ev.reason() not in (Qt.FocusReason.PopupFocusReason, Qt.FocusReason.ActiveWindowFocusReason):
            self.left.emit()

    def keyPressEvent(self, ev: QKeyEvent) -> None:
        if ev.key() in _FOR_THE_BAR:
            ev.ignore()
        else:
            super().keyPressEvent(ev)


class BlendBar(QFrame):
    """“now ———●——— [previous version]”: moved by mouse or left and right; let go or Enter keeps, Esc takes back.

    Up and down go through the other versions at the same share.

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
        self.slider.setAccessibleDescription(self.tr("Left: as it is; right: as the other version"))
        self.slider.setMinimumWidth(160)
        self.targets = QComboBox()
        self.targets.setAccessibleName(self.tr("The other version"))
        self.targets.setAccessibleDescription(self.tr("What the slider goes towards"))
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

    def begin(self, names: Sequence[str], name: str, share: float = 0.0) -> None:
        """Shows the bar at `share` of the way with these other versions to choose from."""
        if [self.targets.itemText(i) for i in range(self.targets.count())] != list(names):
            self.targets.clear()
            self.targets.addItems(list(names))
        self.targets.setCurrentText(name)
        with QSignalBlocker(self.slider):
            self.slider.setValue(round(share * STEPS))
        self._show_share()
        self.show()
        self.raise_()
        self.slider.setFocus(Qt.FocusReason.PopupFocusReason)

    @property
    def share_value(self) -> float:
        """How far the slider stands towards the other version, 0 to 1."""
        return self.slider.value() / STEPS

    def step_target(self, step: int) -> None:
        """Picks the next other version, or the previous one with step −1."""
        self.targets.setCurrentIndex((self.targets.currentIndex() + step) % max(self.targets.count(), 1))
        self.target_picked.emit(self.targets.currentText())

    def _show_share(self) -> None:
        self.share.setText(f"{100 * self.slider.value() // STEPS} %")

    def _slid(self, value: int) -> None:
        self._show_share()
        self.moved.emit(value / STEPS)

    def keyPressEvent(self, ev: QKeyEvent) -> None:
        """Enter keeps, Esc takes back, Up and Down go to another version."""
        if ev.key() in (_Key.Key_Return, _Key.Key_Enter):
            self.kept.emit()
        elif ev.key() == _Key.Key_Escape:
            self.taken_back.emit()
        elif ev.key() in (_Key.Key_Up, _Key.Key_Down):
            self.step_target(1 if ev.key() == _Key.Key_Down else -1)
        else:
            super().keyPressEvent(ev)
