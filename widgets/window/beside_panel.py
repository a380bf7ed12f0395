"""A second canvas beside the first, for another bigram of the same set: a-b beside b-a."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QToolButton, QVBoxLayout, QWidget

from core_pipeline.phonemes import Pair

from .. import theme
from ..canvas.curve_canvas import CurveCanvas
from ..canvas.curve_panel import CurvePanel
from ..elided_label import ElidedLabel
from ..picker.bigram_model import spoken_pair


class BesidePanel(QWidget):
    """The canvas is the owner's to connect, like the first.

    pin_toggled(on)  stay with this bigram, or follow the open one again
    closed()         the user wants one canvas only
    """

    pin_toggled = Signal(bool)
    closed = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.canvas = CurveCanvas()
        self.canvas.setAccessibleName(self.tr("Curves of the bigram beside"))
        self.panel = CurvePanel(self.canvas)
        self._title = QLabel()
        self._title.setFont(theme.font(15, bold=True))
        self._title.setAccessibleName(self.tr("Bigram beside"))
        self._detail = ElidedLabel()
        self.pin = self._button("pin-outline", self.tr("Stay with this bigram"))
        self.pin.setCheckable(True)
        self.pin.clicked.connect(self.pin_toggled)
        self.close_button = self._button("close", self.tr("One canvas only"))
        self.close_button.clicked.connect(self.closed)
        self._head = QWidget()
        head = QHBoxLayout(self._head)
        head.setContentsMargins(12, 5, 8, 5)
        head.setSpacing(8)
        head.addWidget(self._title)
        head.addWidget(self._detail, 1)
        head.addWidget(self.pin)
        head.addWidget(self.close_button)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self._head)
        column.addWidget(self.panel, 1)
        self.hide()

    def set_head_height(self, height: int) -> None:
        """Pixels above the canvas, so that both canvases begin at one height."""
        self._head.setFixedHeight(height)

    def set_pair(self, pair: Pair | None, detail: str, *, pinned: bool) -> None:
        """The bigram, a few words about it, and whether it stays."""
        self._title.setText(spoken_pair(pair) if pair is not None else "")
        self._detail.set_text(detail)
        self.pin.setChecked(pinned)

    @property
    def title(self) -> str:
        """The bigram as shown."""
        return self._title.text()

    def _button(self, icon: str, name: str) -> QToolButton:
        button = QToolButton()
        button.setIcon(theme.icon(icon))
        button.setText(name)
        button.setToolTip(name)
        button.setAccessibleName(name)
        return button
