"""The microphone, or a recording replayed as if live: start, stop, how late the lips are."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import (
    QComboBox,
    QHBoxLayout,
    QLabel,
    QProgressBar,
    QPushButton,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from .. import theme


class LivePanel(QWidget):
    """Emits what the user wants; everything shown comes by the set_… methods.

    start_wanted(device)  listen to this microphone
    replay_wanted()       replay the open recording as if it were spoken now
    stop_wanted()
    record_wanted()       what was said becomes the sentence
    """

    start_wanted = Signal(object)
    replay_wanted = Signal()
    stop_wanted = Signal()
    record_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._running = self._can_replay = self._can_record = False
        self._reason = ""
        self.devices = QComboBox()
        self.devices.setAccessibleName(self.tr("Microphone"))
        self.devices.setAccessibleDescription(self.tr("Which microphone is listened to"))
        self.devices.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.start = QPushButton(self.tr("Listen"))
        self.start.setToolTip(self.tr("Let the face say what the microphone hears"))
        self.start.clicked.connect(lambda: self.start_wanted.emit(self.devices.currentData()))
        self.replay = QPushButton(self.tr("Replay Recording as if Live"))
        self.replay.setToolTip(self.tr("The open recording, 40 ms at a time, as the microphone would bring it"))
        self.replay.clicked.connect(self.replay_wanted)
        self.stop = QPushButton(self.tr("Stop"))
        self.stop.setToolTip(self.tr("Stop listening"))
        self.stop.clicked.connect(self.stop_wanted)
        self.record = QPushButton(self.tr("Record as Utterance"))
        self.record.setToolTip(self.tr("What was said until now becomes the sentence, to play and to edit"))
        self.record.clicked.connect(self.record_wanted)
        self.level = QProgressBar()
        self.level.setRange(0, 100)
        self.level.setTextVisible(False)
        self.level.setFixedHeight(6)
        self.level.setAccessibleName(self.tr("Loudness"))
        self.phone = QLabel()
        self.phone.setStyleSheet("font-size:20pt")
        self.phone.setMinimumWidth(64)
        self.phone.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.latency = QLabel()
        self.latency.setAccessibleName(self.tr("Latency"))
        self.message = QLabel()
        self.message.setWordWrap(True)
        self.message.setTextFormat(Qt.TextFormat.PlainText)
        self.message.setStyleSheet(f"color:{theme.MUTED.name()}")
        self._lay_out()
        self._enable()

    def _lay_out(self) -> None:
        column = QVBoxLayout(self)
        column.setContentsMargins(8, 8, 8, 8)
        column.setSpacing(6)
        for row in ((self.devices, self.start), (self.replay, self.stop), (self.phone, self.latency)):
            line = QHBoxLayout()
            line.addWidget(row[0], 0 if row[0] is self.phone else 1)
            line.addWidget(row[1], 1 if row[0] is self.phone else 0)
            column.addLayout(line)
        column.addWidget(self.level)
        column.addWidget(self.record)
        column.addWidget(self.message)
        column.addStretch(1)

    def set_devices(self, devices: Sequence[tuple[object, str]], reason: str = "") -> None:
        """(device, title) of every microphone; without any, why."""
        before = self.devices.currentData()
        with QSignalBlocker(self.devices):
            self.devices.clear()
            for device, title in devices:
                self.devices.addItem(title, device)
            if not devices:
                self.devices.addItem(self.tr("no microphone"), None)
            self.devices.setCurrentIndex(max(0, self.devices.findData(before) if before is not None else 0))
        self._reason = self.tr("{0}. A recording can still be replayed.").format(reason) if reason else ""
        self.set_message("")
        self._enable()

    def set_can_replay(self, on: bool) -> None:
        """Whether a recording is open."""
        self._can_replay = on
        self._enable()

    def set_running(self, running: bool) -> None:
        """Whether something is being heard."""
        self._running = running
        if not running:
            self.level.setValue(0)
            self.phone.setText("")
        self._enable()

    def set_moment(self, phone: str, latency: float, cost: float, loudness: float) -> None:
        """The newest phone, seconds from sound to lips, the part of real time that computing takes, loudness 0…1."""
        self._can_record = True
        self.phone.setText(phone)
        self.latency.setText(
            self.tr("{0:.0f} ms behind the sound\n{1:.0f} % of real time").format(1000 * latency, 100 * cost)
        )
        self.level.setValue(round(100 * min(1.0, loudness)))
        self._enable()

    def set_message(self, text: str) -> None:
        """One sentence; "" shows why there is no microphone, if there is none."""
        self.message.setText(text or self._reason)

    def _enable(self) -> None:
        self.start.setEnabled(not self._running and self.devices.currentData() is not None)
        self.replay.setEnabled(not self._running and self._can_replay)
        self.stop.setEnabled(self._running)
        self.record.setEnabled(self._can_record)
