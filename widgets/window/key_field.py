"""Waits for one key with its modifiers, whatever it is, and says which it was."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QKeyCombination, Qt, Signal
from PySide6.QtGui import QFocusEvent, QKeyEvent, QKeySequence
from PySide6.QtWidgets import QLabel, QWidget

from .. import theme

_MODIFIERS = frozenset(
    {
        Qt.Key.Key_Shift,
        Qt.Key.Key_Control,
        Qt.Key.Key_Alt,
        Qt.Key.Key_Meta,
        Qt.Key.Key_AltGr,
        Qt.Key.Key_Super_L,
        Qt.Key.Key_Super_R,
        Qt.Key.Key_CapsLock,
        Qt.Key.Key_NumLock,
        Qt.Key.Key_unknown,
    }
)


class KeyField(QLabel):
    """While it waits it has the focus and every key.

    recorded(key)  the key as Qt writes it everywhere, "Ctrl+Shift+S"
    ended()        Escape, or the focus went elsewhere: no key
    """

    recorded = Signal(str)
    ended = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setFocusPolicy(Qt.FocusPolicy.ClickFocus)
        self.setAccessibleName(self.tr("Press the new key"))
        self.setStyleSheet(
            f"background:{theme.BACKGROUND.name()};border:1px solid {theme.ACCENT.name()};"
            f"border-radius:4px;padding:4px 8px;color:{theme.BRIGHT.name()}"
        )
        self.hide()

    def wait(self) -> None:
        """Take the focus and wait."""
        self.setText(self.tr("Press the key now · Esc: leave it as it is"))
        self.show()
        self.setFocus(Qt.FocusReason.OtherFocusReason)

    def event(self, event: QEvent) -> bool:
        """Tab and the window's shortcuts are keys like any other here."""
        if isinstance(event, QKeyEvent):
            if event.type() == QEvent.Type.ShortcutOverride:
                event.accept()
                return True
            if event.type() == QEvent.Type.KeyPress:
                self._press(event)
                return True
        return super().event(event)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """Whoever looks elsewhere records nothing."""
        super().focusOutEvent(event)
        self._end()

    def _press(self, event: QKeyEvent) -> None:
        key = Qt.Key(event.key())
        held = event.modifiers() & ~(Qt.KeyboardModifier.KeypadModifier | Qt.KeyboardModifier.GroupSwitchModifier)
        if key in _MODIFIERS:
            return
        if key == Qt.Key.Key_Escape and not held:
            self._end()
            return
        if key == Qt.Key.Key_Backtab:
            key = Qt.Key.Key_Tab
        text = QKeySequence(QKeyCombination(held, key)).toString(QKeySequence.SequenceFormat.PortableText)
        self._end()
        self.recorded.emit(text)

    def _end(self) -> None:
        if self.isVisible():
            self.hide()
            self.ended.emit()
