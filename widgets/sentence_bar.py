"""Where the test sentence is typed: the beginning of the whole picture."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QEvent, QObject, QSize, Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent, QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QLineEdit, QSizePolicy, QWidget

from . import theme
from .elided_label import ElidedLabel

SETTLE_MS = 150  # typing counts as finished after this pause
HISTORY = 50

_SIGNS = {
    "": ("message-text-outline", theme.MUTED, theme.MUTED),
    "hint": ("information-outline", theme.LINK, theme.MUTED),
    "error": ("alert-circle-outline", theme.ERROR, theme.ERROR),
}


def _settled(text: str) -> str:
    return " ".join(text.split())


class SentenceBar(QWidget):
    """A field for one sentence, with its message inside at the right.

    sentence_entered(text)  the user has typed a sentence: after a short pause, or at once with Enter. Spaces are
                            tidied; the same sentence comes twice only by Enter. "" when the field was emptied.
    history_changed()       a sentence was finished
    """

    sentence_entered = Signal(str)
    history_changed = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.field = QLineEdit()
        self.field.setClearButtonEnabled(True)
        self.field.setPlaceholderText(self.tr("Type a sentence…"))
        self.field.setAccessibleName(self.tr("Test sentence"))
        self.field.setToolTip(
            self.tr("The sentence to speak. Enter speaks it at once; Up and Down bring back earlier ones.")
        )
        self._sign = self.field.addAction(
            theme.icon(_SIGNS[""][0], theme.MUTED), QLineEdit.ActionPosition.LeadingPosition
        )
        self._message = ElidedLabel(self.field, points=8.5)
        self._message.setCursor(Qt.CursorShape.ArrowCursor)
        self._message.hide()
        self._kind = ""
        self._last = ""  # what the world has heard, or told us
        self._history: list[str] = []
        self._draft = ""  # typed text while walking through the history
        self._at = 0
        self._settle = QTimer(self)
        self._settle.setSingleShot(True)
        self._settle.setInterval(SETTLE_MS)
        self._settle.timeout.connect(self._speak)
        self.field.textEdited.connect(self._edited)
        self.field.editingFinished.connect(self._finished)
        self.field.returnPressed.connect(self._entered)
        self.field.installEventFilter(self)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(self.field)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setMinimumWidth(160)
        self.setFocusProxy(self.field)

    @property
    def sentence(self) -> str:
        """The text in the field."""
        return _settled(self.field.text())

    @property
    def message(self) -> str:
        """The message shown."""
        return self._message.text

    @property
    def history(self) -> tuple[str, ...]:
        """Finished sentences, oldest first."""
        return tuple(self._history)

    def set_history(self, texts: Sequence[str]) -> None:
        """Sentences finished earlier, oldest first; emits nothing."""
        self._history = list(dict.fromkeys(settled for text in texts if (settled := _settled(text))))[-HISTORY:]
        self._at = len(self._history)

    def sizeHint(self) -> QSize:
        """Room for a sentence of usual length."""
        return QSize(480, super().sizeHint().height())

    def set_sentence(self, text: str) -> None:
        """Show a sentence from outside; emits nothing.

        An echo of what was last entered leaves alone what the user has typed since.
        """
        text = _settled(text)
        if self._settle.isActive() and text == self._last:
            return
        self._settle.stop()
        self._last = text
        if text != self.sentence:
            self.field.setText(text)
            self.field.setCursorPosition(0)
            self._remember(text)
            self._place_message()

    def set_message(self, text: str, kind: str = "error") -> None:
        """A line about the sentence: kind "error" or "hint"; "" takes it away."""
        self._kind = kind if text else ""
        icon, sign_colour, text_colour = _SIGNS[self._kind]
        self._sign.setIcon(theme.icon(icon, sign_colour))
        self._message.set_text(text, text_colour)
        self._message.setVisible(bool(text))
        self.field.setAccessibleDescription(text)
        border = f"QLineEdit{{border-color:{theme.ERROR.name()}}}" if self._kind == "error" else ""
        if self.field.styleSheet() != border:
            self.field.setStyleSheet(border)
        self._place_message()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Up and Down walk through the history; a new size moves the message."""
        if watched is self.field:
            if isinstance(event, QResizeEvent):
                self._place_message()
            elif isinstance(event, QKeyEvent) and event.type() == QEvent.Type.KeyPress:
                step = {Qt.Key.Key_Up: -1, Qt.Key.Key_Down: 1}.get(Qt.Key(event.key()))
                if step is not None and event.modifiers() in (
                    Qt.KeyboardModifier.NoModifier,
                    Qt.KeyboardModifier.KeypadModifier,
                ):
                    self._walk(step)
                    return True
        return super().eventFilter(watched, event)

    def _edited(self) -> None:
        self._at = len(self._history)
        self._settle.start()
        self._place_message()

    def _entered(self) -> None:
        self._settle.stop()
        self._last = self.sentence
        self._remember(self._last)
        self.sentence_entered.emit(self._last)

    def _finished(self) -> None:
        if self._settle.isActive():
            self._settle.stop()
            self._speak()
        self._remember(self.sentence)

    def _speak(self) -> None:
        if self.sentence != self._last:
            self._last = self.sentence
            self.sentence_entered.emit(self._last)

    def _remember(self, text: str) -> None:
        if text and text not in self._history[-1:]:
            self._history = [*(old for old in self._history if old != text), text][-HISTORY:]
            self.history_changed.emit()
        self._at = len(self._history)

    def _walk(self, step: int) -> None:
        if self._at == len(self._history):
            self._draft = self.field.text()
        steps = [*self._history, self._draft]
        if self._at == len(self._history) and self._history and self.sentence == self._history[-1] and step < 0:
            self._at -= 1  # the newest one already stands in the field
        target = self._at + step
        if 0 <= target < len(steps):
            self._at = target
            self.field.setText(steps[target])
            self._settle.start()

    def _place_message(self) -> None:
        """The message stands in what the sentence leaves free, or at least in two fifths of the field."""
        margin, button = 8, 30
        width = 0
        if self.message:
            typed = self.field.fontMetrics().horizontalAdvance(self.field.text()) + 60
            room = max(self.field.width() * 2 // 5, self.field.width() - typed)
            width = min(self._message.sizeHint().width(), room - button)
            height = self._message.sizeHint().height()
            left = self.field.width() - button - width
            self._message.setGeometry(left, (self.field.height() - height) // 2, width, height)
        self.field.setTextMargins(0, 0, width + margin if width else 0, 0)
