"""How the voice speaks, and which phoneme map leads from its phones to the curves."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QComboBox, QFormLayout, QHBoxLayout, QPushButton, QSizePolicy, QWidget

from ..number_box import NumberBox


class VoicePanel(QWidget):
    """Emits what the user wants; what is in use comes back by the set_… methods.

    rate_changed(words per minute), pitch_changed(0…99)
    map_chosen(name), map_edit_wanted(), map_open_wanted()
    """

    rate_changed = Signal(int)
    pitch_changed = Signal(int)
    map_chosen = Signal(str)
    map_edit_wanted = Signal()
    map_open_wanted = Signal()

    def __init__(self, slowest: int, fastest: int, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.rate = NumberBox(slowest, fastest, 5, decimals=0, suffix=self.tr(" words/min"))
        self.rate.setAccessibleName(self.tr("Rate of the voice"))
        self.rate.setToolTip(self.tr("How fast the voice speaks; the sentence is spoken anew"))
        self.rate.valueChanged.connect(lambda value: self.rate_changed.emit(round(value)))
        self.pitch = NumberBox(0, 99, 5, decimals=0)
        self.pitch.setAccessibleName(self.tr("Pitch of the voice"))
        self.pitch.setToolTip(self.tr("How high the voice speaks, 0 to 99"))
        self.pitch.valueChanged.connect(lambda value: self.pitch_changed.emit(round(value)))
        self.maps = QComboBox()
        self.maps.setAccessibleName(self.tr("Phoneme map"))
        self.maps.setToolTip(self.tr("Which phones of the voice count as which phoneme of the curves"))
        self.maps.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.maps.activated.connect(lambda i: self.map_chosen.emit(self.maps.itemData(i)))
        self.edit = QPushButton(self.tr("Edit…"))
        self.edit.setToolTip(self.tr("Change where single phones lead"))
        self.edit.clicked.connect(self.map_edit_wanted)
        self.open = QPushButton(self.tr("Open…"))
        self.open.setToolTip(self.tr("Use a phoneme map from a file"))
        self.open.clicked.connect(self.map_open_wanted)
        form = QFormLayout(self)
        form.setContentsMargins(8, 8, 8, 8)
        form.addRow(self.tr("Rate"), self.rate)
        form.addRow(self.tr("Pitch"), self.pitch)
        row = QHBoxLayout()
        row.addWidget(self.maps, 1)
        row.addWidget(self.edit)
        row.addWidget(self.open)
        form.addRow(self.tr("Phonemes"), row)

    def set_voice(self, rate: int, pitch: int) -> None:
        """Rate and pitch in use; emits nothing."""
        self.rate.show_value(rate)
        self.pitch.show_value(pitch)

    def set_maps(self, names: Sequence[tuple[str, str, str]], current: str) -> None:
        """(name, title, note) of all maps, and the name of the one in use; "" when it is the user's own."""
        with QSignalBlocker(self.maps):
            self.maps.clear()
            if not current:
                self.maps.addItem(self.tr("(the set's own)"), "")
            for name, title, note in names:
                self.maps.addItem(title, name)
                self.maps.setItemData(self.maps.count() - 1, note, 3)  # the tool tip
            self.maps.setCurrentIndex(max(0, self.maps.findData(current)))
