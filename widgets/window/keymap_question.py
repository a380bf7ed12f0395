"""Asked once, above the canvas: whose keys do your fingers know? It waits there and keeps nobody from working."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QPushButton, QSizePolicy, QToolButton, QWidget

from .. import theme
from ..canvas.keymaps import KEYMAPS, NEUTRAL
from ..elided_label import ElidedLabel


class KeymapQuestion(QFrame):
    """chosen(name): one of the keymaps; the neutral one when it is waved away."""

    chosen = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("question")
        self.setAccessibleName(self.tr("Which keys do your fingers know?"))
        self.setStyleSheet(f"#question{{background:{theme.CHECKED.name()}}}")
        question = QLabel(self.tr("Which keys do your fingers know?"))
        question.setFont(theme.font(bold=True))
        hint = ElidedLabel()
        hint.set_text(self.tr("The Edit menu changes it later"), theme.TEXT)
        hint.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.buttons: dict[str, QPushButton] = {}
        titles = {NEUTRAL: self.tr("Neutral"), "Maya": self.tr("Maya"), "Blender": self.tr("Blender")}
        row = QHBoxLayout(self)
        row.setContentsMargins(12, 4, 6, 4)
        row.setSpacing(6)
        row.addWidget(question)
        for name, keymap in KEYMAPS.items():
            button = self.buttons[name] = QPushButton(titles[name])
            tip = self.tr("{grab} moves keys, {scale} scales, {add} adds, {frame_all} frames all").format(
                **{action: keys[0] for action, keys in keymap.items()}
            )
            button.setToolTip(tip)
            button.setAccessibleDescription(tip)
            button.clicked.connect(lambda _=False, name=name: self._choose(name))
            row.addWidget(button)
        row.addWidget(hint, 1)
        close = QToolButton()
        close.setIcon(theme.icon("close"))
        close.setText(self.tr("Not now"))
        close.setToolTip(self.tr("Stay with the neutral keys"))
        close.setAccessibleName(close.toolTip())
        close.clicked.connect(lambda: self._choose(NEUTRAL))
        row.addWidget(close)
        self.hide()

    def _choose(self, name: str) -> None:
        self.hide()
        self.chosen.emit(name)
