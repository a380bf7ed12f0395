"""A recording and its words: typed or recognised, then aligned; how far that is, and what came of it."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QSignalBlocker, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import (
    QHBoxLayout,
    QLabel,
    QPlainTextEdit,
    QProgressBar,
    QPushButton,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from .. import theme
from ..elided_label import ElidedLabel


class TranscriptField(QPlainTextEdit):
    """Emits `finished()` when Ctrl+Enter is pressed; Tab goes on to the next control."""

    finished = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setTabChangesFocus(True)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Qt's hook."""
        if _is_end(event):
            self.finished.emit()
        else:
            super().keyPressEvent(event)

    def event(self, event: QEvent) -> bool:
        """Qt's hook: here Ctrl+Enter is ours, whatever it does elsewhere in the window."""
        if event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent) and _is_end(event):
            event.accept()
            return True
        return super().event(event)


def _is_end(event: QKeyEvent) -> bool:
    enter = event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter)
    return enter and bool(event.modifiers() & Qt.KeyboardModifier.ControlModifier)


class RecordingPanel(QWidget):
    """Emits what the user wants; everything shown comes by the set_… methods.

    open_wanted(), align_wanted(text), recognise_wanted(), phones_wanted(), labels_wanted()
    cancelled()        give up what is under way
    save_wanted()      keep the phones and words
    transcript_changed(text)
    """

    open_wanted = Signal()
    align_wanted = Signal(str)
    recognise_wanted = Signal()
    phones_wanted = Signal()
    labels_wanted = Signal()
    cancelled = Signal()
    save_wanted = Signal()
    transcript_changed = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._has_recording = self._busy = False
        self.name = ElidedLabel()
        self.open = self._button(self.tr("Open…"), self.tr("Open a recording: wav, flac, ogg, mp3"), self.open_wanted)
        self.transcript = TranscriptField()
        self.transcript.setPlaceholderText(
            self.tr("What is said in the recording. Type it, drop a .txt, or recognise it.")
        )
        self.transcript.setAccessibleName(self.tr("Transcript"))
        self.transcript.setAccessibleDescription(self.tr("What the recording says, as text"))
        self.transcript.setMinimumHeight(64)
        self.transcript.textChanged.connect(self._text_changed)
        self.transcript.finished.connect(self._align)
        self.recognise = self._button(
            self.tr("Recognise"), self.tr("Guess the words, for you to correct"), self.recognise_wanted
        )
        self.phones = self._button(
            self.tr("Phones only"), self.tr("Guess the phones without any words: rough"), self.phones_wanted
        )
        self.labels = self._button(
            self.tr("Label file…"),
            self.tr("Phones with times from another program: TextGrid, HTK, TIMIT …"),
            self.labels_wanted,
        )
        self.align = QPushButton(self.tr("Align"))
        self.align.setToolTip(self.tr("Find when each word and phone sounds (Ctrl+Enter in the transcript)"))
        self.align.clicked.connect(self._align)
        self.save = self._button(
            self.tr("Save…"), self.tr("Keep phones and words in a file beside the recording"), self.save_wanted
        )
        self.bar = QProgressBar()
        self.bar.setRange(0, 1000)
        self.bar.setTextVisible(False)
        self.bar.setFixedHeight(6)
        self.bar.setAccessibleName(self.tr("Progress"))
        self.cancel = self._button(self.tr("Cancel"), self.tr("Give up what is under way"), self.cancelled)
        self.message = QLabel()
        self.message.setWordWrap(True)
        self.message.setTextFormat(Qt.TextFormat.PlainText)
        self.message.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.message.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Minimum)
        self._lay_out()
        self.set_recording("", 0.0)
        self.set_busy(False)

    def _button(self, text: str, tip: str, signal: Signal) -> QPushButton:
        button = QPushButton(text)
        button.setToolTip(tip)
        button.clicked.connect(signal)
        return button

    def _lay_out(self) -> None:
        column = QVBoxLayout(self)
        column.setContentsMargins(8, 8, 8, 8)
        column.setSpacing(6)
        head = QHBoxLayout()
        head.addWidget(self.name, 1)
        head.addWidget(self.open)
        column.addLayout(head)
        column.addWidget(self.transcript, 1)
        guess = QHBoxLayout()
        for button in (self.recognise, self.phones, self.labels):
            guess.addWidget(button)
        guess.addStretch(1)
        column.addLayout(guess)
        act = QHBoxLayout()
        act.addWidget(self.align, 1)
        act.addWidget(self.save)
        column.addLayout(act)
        work = QHBoxLayout()
        work.addWidget(self.bar, 1)
        work.addWidget(self.cancel)
        self._work = QWidget()
        self._work.setLayout(work)
        work.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self._work)
        column.addWidget(self.message)

    # Values come down

    def set_recording(self, name: str, seconds: float) -> None:
        """Which recording is open, and how long it is; "" for none."""
        self._has_recording = bool(name)
        minutes = f"{int(seconds) // 60}:{seconds % 60:04.1f}"
        self.name.set_text(
            f"{name} · {minutes}" if name else self.tr("Drop a recording here"), theme.TEXT if name else theme.MUTED
        )
        self._enable()

    def set_transcript(self, text: str) -> None:
        """The words; emits nothing."""
        if text != self.transcript.toPlainText():
            with QSignalBlocker(self.transcript):
                self.transcript.setPlainText(text)
        self._enable()

    def set_busy(self, busy: bool) -> None:
        """Whether something is under way."""
        self._busy = busy
        self.bar.setValue(0)
        self._work.setVisible(busy)
        self._enable()

    def set_progress(self, done: float) -> None:
        """0…1."""
        self.bar.setValue(round(1000 * done))

    def set_message(self, text: str, kind: str = "hint") -> None:
        """What came of it: kind "hint" or "error"."""
        self.message.setText(text)
        colour = theme.ERROR if kind == "error" else theme.MUTED
        self.message.setStyleSheet(f"color:{colour.name()}")
        self.message.setAccessibleName(text)

    def set_can_save(self, on: bool) -> None:
        """Whether there are phones to keep."""
        self.save.setEnabled(on)

    # Wishes go up

    def _text_changed(self) -> None:
        self._enable()
        self.transcript_changed.emit(self.transcript.toPlainText())

    def _align(self) -> None:
        if self.align.isEnabled():
            self.align_wanted.emit(self.transcript.toPlainText())

    def _enable(self) -> None:
        ready = self._has_recording and not self._busy
        self.recognise.setEnabled(ready)
        self.phones.setEnabled(ready)
        self.align.setEnabled(ready and bool(self.transcript.toPlainText().strip()))
