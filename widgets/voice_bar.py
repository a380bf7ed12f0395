"""Who speaks the sentence, how fast it is played, and whether it can be heard."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QLabel, QSizePolicy, QWidget

from . import theme
from .number_box import NumberBox

SIGN = 16


class VoiceBar(QWidget):
    """Emits what the user wants; what is in use comes back by the set_… methods.

    voice_chosen(name)    another voice
    speed_changed(speed)  0.25…1
    """

    voice_chosen = Signal(str)
    speed_changed = Signal(float)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.voice = QComboBox()
        self.voice.setAccessibleName(self.tr("Voice"))
        self.voice.setToolTip(self.tr("Who speaks the sentence"))
        self.voice.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.voice.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.voice.setMinimumContentsLength(12)
        self.voice.activated.connect(lambda i: self.voice_chosen.emit(self.voice.itemData(i)))
        self.speed = NumberBox(0.25, 1.0, 0.25, suffix=" ×")
        self.speed.setValue(1.0)
        self.speed.make_narrow()
        self.speed.setAccessibleName(self.tr("Playback speed"))
        self.speed.setToolTip(self.tr("Playback speed, 0.25× to 1×"))
        self.speed.valueChanged.connect(self.speed_changed)
        self._sign = QLabel()
        self._sign.setFixedSize(SIGN, SIGN)
        self._word = QLabel(self.tr("silent"))
        self._word.setStyleSheet(f"color:{theme.MUTED.name()}")
        self._state = ""
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(4)
        row.addWidget(self._sign)
        row.addWidget(self._word)
        row.addWidget(self.voice)
        row.addWidget(self.speed)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self.set_sound("")

    def set_voices(self, voices: Mapping[str, str]) -> None:
        """Name → title of all that can speak; the one in use stays if it is among them."""
        before = self.voice.currentData()
        self.voice.clear()
        for name, title in voices.items():
            self.voice.addItem(title, name)
            self.voice.setItemData(self.voice.count() - 1, title, Qt.ItemDataRole.ToolTipRole)
        self.set_voice(before)

    def set_voice(self, name: str | None) -> None:
        """Who speaks; emits nothing. One that is not in the list leaves it as it is."""
        self.voice.setCurrentIndex(max(self.voice.findData(name), 0))

    def set_speed(self, speed: float) -> None:
        """The playback speed; emits nothing."""
        self.speed.show_value(speed)

    def set_sound(self, state: str) -> None:
        """What is wrong with the sound, "no audio device: playing silently"; "" when it works."""
        self._state = state
        for label in (self._sign, self._word):
            label.setVisible(bool(state))
            label.setToolTip(state)
            label.setAccessibleName(state)
        if state and self._sign.pixmap().isNull():
            self._sign.setPixmap(theme.icon("volume-off", theme.MUTED).pixmap(SIGN, SIGN))

    @property
    def sound(self) -> str:
        """The sound state shown."""
        return self._state
