"""Key events as keymaps write keys, and what is held."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QKeyCombination, Qt
from PySide6.QtGui import QKeyEvent, QKeySequence

from .curve_controller import Modifiers

_Key = Qt.Key
_Held = Qt.KeyboardModifier

#: Keys that are held while others or the mouse are used.
HELD = (_Key.Key_Shift, _Key.Key_Control, _Key.Key_Alt)

#: These may stand on Shift or AltGr, depending on the keyboard.
_SYMBOLS = ("\\", "/", "[", "]")


def modifiers_of(held: Qt.KeyboardModifier) -> Modifiers:
    """What is held, as the controller wants it."""
    return Modifiers(
        bool(held & _Held.ShiftModifier), bool(held & _Held.ControlModifier), bool(held & _Held.AltModifier)
    )


def key_of(ev: QKeyEvent) -> str:
    """The key as keymaps write it, whatever part of the keyboard it was on."""
    held = ev.modifiers() & ~(_Held.KeypadModifier | _Held.GroupSwitchModifier)
    alt_gr = bool(held & _Held.ControlModifier) and bool(held & _Held.AltModifier)
    plain = not held & (_Held.ControlModifier | _Held.AltModifier | _Held.MetaModifier)
    if ev.text() in _SYMBOLS and (plain or alt_gr):
        return ev.text()
    return QKeySequence(QKeyCombination(held, _Key(ev.key()))).toString(QKeySequence.SequenceFormat.PortableText)


def held_after(ev: QKeyEvent) -> Qt.KeyboardModifier:
    """The modifiers once this press or release of one of them has happened."""
    which = {
        _Key.Key_Shift: _Held.ShiftModifier,
        _Key.Key_Control: _Held.ControlModifier,
        _Key.Key_Alt: _Held.AltModifier,
    }
    own = which[_Key(ev.key())]
    return ev.modifiers() | own if ev.type() == QEvent.Type.KeyPress else ev.modifiers() & ~own
