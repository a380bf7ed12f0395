"""What the canvas says in words: what is selected, what can be done now, why something was refused."""

from __future__ import annotations

from PySide6.QtCore import QT_TRANSLATE_NOOP, QCoreApplication
from PySide6.QtGui import QKeySequence

from .curve_clipboard import BROKEN, NEWER, NOTHING
from .curve_controller import CurveController
from .curve_scene import Refusal
from .keymaps import Keymap

_CONTEXT = "CurveCanvas"

_REASONS = {
    Refusal.LOCKED: QT_TRANSLATE_NOOP("CurveCanvas", "{0} is locked: unlock it in the list of poses"),
    Refusal.HIDDEN: QT_TRANSLATE_NOOP("CurveCanvas", "{0} is hidden: show it in the list of poses"),
    Refusal.SOLOED: QT_TRANSLATE_NOOP("CurveCanvas", "{0} is hidden while others are solo: {isolate} ends that"),
    Refusal.NO_POSE: QT_TRANSLATE_NOOP("CurveCanvas", "pick a pose first"),
    Refusal.KEY_THERE: QT_TRANSLATE_NOOP("CurveCanvas", "{0} already has a key at this time"),
    Refusal.OFF_CURVE: QT_TRANSLATE_NOOP(
        "CurveCanvas", "to add a key, double-click on the curve of {0} or Ctrl+click anywhere"
    ),
    Refusal.NOTHING_SELECTED: QT_TRANSLATE_NOOP("CurveCanvas", "select keys first"),
    Refusal.NO_ROOM: QT_TRANSLATE_NOOP("CurveCanvas", "no room: another key is in the way"),
    Refusal.TWO_KEYS: QT_TRANSLATE_NOOP("CurveCanvas", "select two or more keys to scale them"),
    Refusal.NOTHING_TO_COPY: QT_TRANSLATE_NOOP("CurveCanvas", "nothing to copy: {0} has no curve here"),
    Refusal.NOT_TYPED: QT_TRANSLATE_NOOP(
        "CurveCanvas", "“{0}” is no value: type .3 or =.3 to set, *0.5 to scale, +0.1 or -0.1 to add"
    ),
    Refusal.NO_GHOST: QT_TRANSLATE_NOOP("CurveCanvas", "there is no other version: nothing has changed yet"),
    Refusal.NO_SUCH_POSE: QT_TRANSLATE_NOOP("CurveCanvas", "this set has no pose {0}: nothing was pasted"),
    Refusal.SAME_WEIGHT: QT_TRANSLATE_NOOP("CurveCanvas", "nothing to mirror: these keys have the same weight"),
    Refusal.NO_NEIGHBOUR: QT_TRANSLATE_NOOP(
        "CurveCanvas", "nothing to duplicate: no similar bigram has other curves than this one"
    ),
    Refusal.NO_CURVES: QT_TRANSLATE_NOOP("CurveCanvas", "the clipboard holds no curves: copy keys with {copy} first"),
    Refusal.NEWER_CURVES: QT_TRANSLATE_NOOP(
        "CurveCanvas", "the curves on the clipboard come from a newer Lipstitch: update to paste them"
    ),
    Refusal.BROKEN_CURVES: QT_TRANSLATE_NOOP("CurveCanvas", "the curves on the clipboard are damaged: copy them again"),
}

#: Why a clipboard could not be read → the refusal that says so.
UNREADABLE = {NOTHING: Refusal.NO_CURVES, NEWER: Refusal.NEWER_CURVES, BROKEN: Refusal.BROKEN_CURVES}

#: A longer piece of what was typed is cut.
_LONGEST = 24


def _tr(text: str) -> str:
    return QCoreApplication.translate(_CONTEXT, text)


def key_name(key: str) -> str:
    """A key of a keymap as this system writes it."""
    return QKeySequence(key).toString(QKeySequence.SequenceFormat.NativeText)


def pair_title(first: str, second: str, dash: str = " – ") -> str:
    """("f", "ah") → "F – Ah"; "" when no bigram is open."""
    return dash.join((first.capitalize(), second.capitalize())) if first or second else ""


def selection_text(control: CurveController, pair: tuple[str, str]) -> str:
    """As "F–Ah · FV · 2 keys selected · t 0.26  v 0.97": the key picked last speaks for all."""
    chosen = control.chosen()
    parts = [pair_title(*pair, "–"), ", ".join(pose for pose in control.poses if pose in chosen) or control.active]
    if control.lead is not None:
        count = len(control.selection)
        parts.append(_tr("1 key selected") if count == 1 else _tr("{0} keys selected").format(count))
        pose, index = control.lead
        curve = control.curves[pose]
        parts.append(f"t {curve.t[index]:.2f}  v {curve.v[index]:.2f}")
    return " · ".join(part for part in parts if part)


def hint_text(control: CurveController, keymap: Keymap) -> str:
    """What the hand can do next by the keys of this map, or why it could not."""
    keys = {action: key_name(names[0]) for action, names in keymap.items()}
    if control.refusal is not None:
        why, what = control.refusal
        short = what if len(what) <= _LONGEST else what[:_LONGEST] + "…"
        return _tr(str(_REASONS[why])).format(short, **keys)
    if control.blending:
        return _tr("←/→ slide towards the other version · ↑/↓ another one · Enter keeps · Esc: back")
    if control.dragging:
        text = _tr("{time_only}/{weight_only} or Shift: one axis · Ctrl: snap · Alt: fine · Esc: back")
        if control.modal:
            text = _tr("click or Enter keeps") + " · " + text
        return text.format(**keys)
    if control.hover_handle is not None:
        return _tr("drag scales about the opposite edge · {scale} about the middle").format(**keys)
    if len(control.selection) > 1:
        return _tr("drag moves · {scale} or the box scales · {reverse} reverses · {delete} deletes").format(**keys)
    if control.selection:
        return _tr("drag or {grab} moves · arrows nudge · {delete} deletes · double-click adds").format(**keys)
    return _tr("double-click adds a key · drag selects · click a line to pick its pose")
