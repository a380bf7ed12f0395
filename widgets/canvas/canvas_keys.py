"""The canvas's keys in words, for lists of everything that has a key."""

from __future__ import annotations

from PySide6.QtCore import QT_TRANSLATE_NOOP, QCoreApplication

_TITLES = {
    "add": QT_TRANSLATE_NOOP("CanvasKeys", "Add a key"),
    "delete": QT_TRANSLATE_NOOP("CanvasKeys", "Delete the selected keys"),
    "reverse": QT_TRANSLATE_NOOP("CanvasKeys", "Reverse in time"),
    "copy": QT_TRANSLATE_NOOP("CanvasKeys", "Copy keys"),
    "cut": QT_TRANSLATE_NOOP("CanvasKeys", "Cut keys"),
    "paste": QT_TRANSLATE_NOOP("CanvasKeys", "Paste keys"),
    "paste_reversed": QT_TRANSLATE_NOOP("CanvasKeys", "Paste reversed in time"),
    "swap": QT_TRANSLATE_NOOP("CanvasKeys", "Swap with the previous version"),
    "slide": QT_TRANSLATE_NOOP("CanvasKeys", "Slide to another version"),
    "select_all": QT_TRANSLATE_NOOP("CanvasKeys", "Select all keys"),
    "select_none": QT_TRANSLATE_NOOP("CanvasKeys", "Select no key"),
    "previous_key": QT_TRANSLATE_NOOP("CanvasKeys", "Previous key"),
    "next_key": QT_TRANSLATE_NOOP("CanvasKeys", "Next key"),
    "previous_pose": QT_TRANSLATE_NOOP("CanvasKeys", "Previous pose"),
    "next_pose": QT_TRANSLATE_NOOP("CanvasKeys", "Next pose"),
    "frame": QT_TRANSLATE_NOOP("CanvasKeys", "Frame the selection"),
    "frame_all": QT_TRANSLATE_NOOP("CanvasKeys", "Frame all"),
    "play": QT_TRANSLATE_NOOP("CanvasKeys", "Play the bigram"),
    "grab": QT_TRANSLATE_NOOP("CanvasKeys", "Move keys"),
    "scale": QT_TRANSLATE_NOOP("CanvasKeys", "Scale keys"),
    "isolate": QT_TRANSLATE_NOOP("CanvasKeys", "Show only this pose, or all again"),
    "time_only": QT_TRANSLATE_NOOP("CanvasKeys", "In a drag: time only"),
    "weight_only": QT_TRANSLATE_NOOP("CanvasKeys", "In a drag: weight only"),
}


def canvas_title(action: str) -> str:
    """What an action of a keymap is called."""
    known = _TITLES.get(action)
    return QCoreApplication.translate("CanvasKeys", str(known)) if known else action.replace("_", " ").capitalize()
