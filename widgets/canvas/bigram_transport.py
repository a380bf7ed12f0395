"""Plays the open bigram alone: a button and how long it takes."""

from __future__ import annotations

from PySide6.QtCore import QSize, Signal
from PySide6.QtWidgets import QHBoxLayout, QToolButton, QWidget

from .. import theme
from ..number_box import NumberBox


class BigramTransport(QWidget):
    """play_toggled(), length_changed(seconds): what the user wants; the bigram loops until stopped."""

    play_toggled = Signal()
    length_changed = Signal(float)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.button = QToolButton()
        self.button.setIconSize(QSize(18, 18))
        self.button.clicked.connect(self.play_toggled)
        self.length = NumberBox(0.1, 4.0, 0.05, suffix=self.tr(" s"))
        self.length.setToolTip(self.tr("How long the bigram takes when it is played alone"))
        self.length.setAccessibleName(self.tr("Length of the bigram in seconds"))
        self.length.valueChanged.connect(self.length_changed)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(4)
        layout.addWidget(self.button)
        layout.addWidget(self.length)
        self.set_playing(False)

    def set_playing(self, playing: bool) -> None:
        """Whether the bigram is being played."""
        tip = (
            self.tr("Stop the bigram (Space)")
            if playing
            else self.tr("Play this bigram alone, looped (Space in the canvas)")
        )
        self.button.setIcon(theme.icon("stop" if playing else "play-circle-outline"))
        self.button.setToolTip(tip)
        self.button.setAccessibleName(tip)
        self.button.setText(tip)

    def set_length(self, seconds: float) -> None:
        """How long it takes; emits nothing."""
        self.length.show_value(seconds)
