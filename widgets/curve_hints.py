"""What the canvas says in words: what is selected, what can be done now, why something was refused."""

from __future__ import annotations

from PySide6.QtCore import QT_TRANSLATE_NOOP, QCoreApplication

from .curve_controller import CurveController
from .curve_scene import Refusal

_CONTEXT = "CurveCanvas"

_REASONS = {
    Refusal.LOCKED: QT_TRANSLATE_NOOP("CurveCanvas", "{0} is locked: unlock it in the list of poses"),
    Refusal.HIDDEN: QT_TRANSLATE_NOOP("CurveCanvas", "{0} is hidden: show it in the list of poses"),
    Refusal.NO_POSE: QT_TRANSLATE_NOOP("CurveCanvas", "pick a pose first"),
    Refusal.KEY_THERE: QT_TRANSLATE_NOOP("CurveCanvas", "{0} already has a key at this time"),
    Refusal.OFF_CURVE: QT_TRANSLATE_NOOP(
        "CurveCanvas", "to add a key, double-click on the curve of {0} or Ctrl+click anywhere"
    ),
    Refusal.NOTHING_SELECTED: QT_TRANSLATE_NOOP("CurveCanvas", "select keys first"),
    Refusal.NO_ROOM: QT_TRANSLATE_NOOP("CurveCanvas", "no room to move further"),
}


def _tr(text: str) -> str:
    return QCoreApplication.translate(_CONTEXT, text)


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


def hint_text(control: CurveController) -> str:
    """What the hand can do next, or why it could not."""
    if control.refusal is not None:
        why, pose = control.refusal
        return _tr(str(_REASONS[why])).format(pose)
    if control.dragging:
        return _tr("Shift: one axis · Ctrl: snap · Alt: fine · Esc: back")
    if control.selection:
        return _tr("drag moves · arrows nudge · Del deletes · double-click adds")
    return _tr("double-click adds a key · drag selects · click a line to pick its pose")
