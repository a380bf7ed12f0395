"""The hand on the curves: press, move, release; one gesture at a time, one edit each. No Qt.

The canvas hands in pixels and modifiers and draws what stands here. A gesture works on its own copy;
`release` hands back one `Edit` for the whole of it, `cancel` leaves the very objects from before.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from core_pipeline.curves import Curve

from .curve_gestures import PLAIN, Blend, Drag, Gesture, Marquee, Modifiers, Move, Scale, Start
from .curve_magnets import Landing
from .curve_scene import CurveScene, Refusal
from .transform_box import Handle

#: Pixels from the middle of the selection to where scaling starts when no pointer is there.
ARM = 100.0

#: Edits round to six decimals.
_MET = 2e-6


@dataclass(frozen=True)
class Edit:
    """What one gesture did: pose → new curve, None where the curve is gone; and its name."""

    changes: Mapping[str, Curve | None]
    label: str


class CurveHand(CurveScene, ABC):
    """The scene, and the one gesture that may be running on it.

    snap          whether drags and new keys keep to the grid
    boundary      normalised time between the two phones, a magnet
    band          the marquee's corners (x0, y0, x1, y1) in pixels while one is drawn
    hover_handle  the handle of the transform box under the pointer, or held
    refusal       why the last action did nothing, and for which pose or what text
    """

    def __init__(self) -> None:
        super().__init__()
        self.snap = False
        self.boundary = 0.5
        self.band: tuple[float, float, float, float] | None = None
        self.hover_handle: Handle | None = None
        self.refusal: tuple[Refusal, str] | None = None
        self._gesture: Gesture | None = None
        self._incoming: Mapping[str, Curve] | None = None

    def set_curves(self, curves: Mapping[str, Curve]) -> None:
        """As in the scene; while a gesture runs the curves wait until it has ended."""
        if self._gesture is not None:
            self._incoming = curves
        else:
            super().set_curves(curves)

    def _prune(self) -> None:
        if self._gesture is None:
            super()._prune()

    @property
    def busy(self) -> bool:
        """Whether a gesture is under way."""
        return self._gesture is not None

    @property
    def modal(self) -> bool:
        """Whether a gesture is under way that no button holds."""
        return self._gesture is not None and self._gesture.start.modal

    @property
    def blending(self) -> bool:
        """Whether the poses are sliding to another version."""
        return isinstance(self._gesture, Blend)

    @property
    def dragging(self) -> bool:
        """Whether keys are being moved or scaled: the pointer has left the threshold."""
        return isinstance(self._gesture, Drag) and self._gesture.started

    @property
    def axis(self) -> str:
        """The one axis the gesture keeps to: "t" or "v", else ""."""
        return self._gesture.axis if self._gesture is not None else ""

    def met(self) -> tuple[frozenset[float], frozenset[float]]:
        """The magnets, in time and in weight, on which a dragged key lies now."""
        if not self.dragging:
            return frozenset(), frozenset()
        landing, chosen = Landing(self.view, self.boundary), self.chosen()
        t = np.concatenate([self.curves[pose].t[at] for pose, at in chosen.items()])
        v = np.concatenate([self.curves[pose].v[at] for pose, at in chosen.items()])
        return (
            frozenset(m for m in landing.times if np.abs(t - m).min() < _MET),
            frozenset(m for m in landing.weights if np.abs(v - m).min() < _MET),
        )

    def _may(self, pose: str) -> bool:
        why = self.refuses(pose)
        self.refusal = (why, pose) if why is not None else None
        return why is None

    def _refuse(self, why: Refusal, what: str | None = None) -> None:
        self.refusal = (why, self.active if what is None else what)

    def _start(self, x: float, y: float, held: Modifiers = PLAIN, *, modal: bool = False) -> Start:
        return Start(x, y, dict(self.curves), self.selection, held, modal)

    # With a button held

    def press(self, x: float, y: float, held: Modifiers = PLAIN) -> None:
        """The left button goes down: on a key it moves keys, on a handle it scales, else it draws a marquee."""
        if self.busy:
            return
        self.refusal = None
        start, key = self._start(x, y, held), self.key_at(x, y)
        if key is None:
            box, handle = self.box(), self.handle_at(x, y)
            if box is None or handle is None:
                self._gesture = Marquee(start)
            else:
                self._gesture = Scale(start, self.chosen(), box, handle)
            return
        self.active, self._picked = key[0], key
        if not self._may(key[0]):
            return
        if key not in self.selection:
            self.selection = self.selection | {key} if held.shift else frozenset({key})
        self._gesture = Move(start, self.chosen(), key)

    def move(self, x: float, y: float, held: Modifiers = PLAIN) -> Mapping[str, Curve] | None:
        """The pointer moves; the working curves that became others, or None when none did."""
        gesture = self._gesture
        if gesture is None:
            self.hover = self.key_at(x, y)
            self.hover_handle = None if self.hover is not None else self.handle_at(x, y)
            return None
        if not gesture.far_enough(x, y):
            return None
        if isinstance(gesture, Drag):
            landing = Landing(self.view, self.boundary, self.snap != held.ctrl, held.alt)
            return self._show(gesture, gesture.step(x, y, held, landing))
        if isinstance(gesture, Marquee):
            self.band = (gesture.start.x, gesture.start.y, x, y)
            self.selection = gesture.chosen(self.keys_within(*self.band))
        return None

    def _show(self, gesture: Gesture, changed: dict[str, Curve]) -> Mapping[str, Curve] | None:
        """Takes these as working copies; those that became others, None when none did."""
        now = {**gesture.start.curves, **changed}
        touched = [pose for pose in (changed.keys() | gesture.changed.keys()) if pose in now]
        gesture.changed = changed
        if all(now[pose].same_as(self.curves.get(pose)) for pose in touched):
            return None
        self.curves = now
        if self.hover is not None and not self._has(self.hover):
            self.hover = None  # on the way to another version curves have other keys
        return {pose: now[pose] for pose in touched}

    def release(self, x: float, y: float) -> Edit | None:
        """The button goes up, or the modal gesture is kept: its one edit, None when nothing changed."""
        gesture = self._gesture
        if gesture is None:
            return None
        result = {pose: curve for pose, curve in gesture.result().items() if self.refuses(pose) is None}
        changed = {pose: c for pose, c in result.items() if c is None or not c.same_as(gesture.start.curves.get(pose))}
        self.curves = dict(gesture.start.curves)
        self._end()
        edit = self._commit(changed, gesture.label) if changed else None
        if not gesture.started:
            edit = self._click(gesture, x, y)
        self._prune()
        return edit

    def _click(self, gesture: Gesture, x: float, y: float) -> Edit | None:
        held, before = gesture.start.held, gesture.start.selection
        if isinstance(gesture, Move):
            if not held.shift:
                self.selection = frozenset({gesture.key})
            elif gesture.key in before:
                self.selection = before - {gesture.key}
        elif isinstance(gesture, Marquee):
            if held.ctrl:
                return self.add(x, y, anywhere=True)
            if not held.shift:
                self.selection = frozenset()
            if pose := self.pose_at(x, y):
                self.active = pose
        return None

    @abstractmethod
    def add(self, x: float, y: float, *, anywhere: bool = False) -> Edit | None:
        """A key at (x, y): what Ctrl+click does."""

    def cancel(self) -> bool:
        """Puts back what the running gesture changed; whether one was running."""
        gesture = self._gesture
        if gesture is None:
            return False
        self.curves = dict(gesture.start.curves)
        if isinstance(gesture, Marquee | Blend):
            self.selection = gesture.start.selection
        self._end()
        return True

    def _end(self) -> None:
        self._gesture, self.band = None, None
        incoming, self._incoming = self._incoming, None
        self.set_curves(self.curves if incoming is None else incoming)

    def _commit(self, changes: Mapping[str, Curve | None], label: str) -> Edit:
        """Shows the changes at once; the owner's next set_curves has the last word."""
        curves = {**self.curves, **changes}
        self.curves = {pose: curve for pose, curve in curves.items() if curve is not None}
        self._prune()
        return Edit(dict(changes), label)

    # Without a button

    def begin_move(self, x: float, y: float) -> bool:
        """The selection follows the pointer from here on; False when nothing is selected."""
        if self.lead is None or not self._has_work():
            return False
        self._gesture = Move(self._start(x, y, modal=True), self.chosen(), self.lead)
        return True

    def begin_scale(self, at: tuple[float, float] | None = None) -> tuple[float, float] | None:
        """The selection stretches about its middle as the pointer goes away from it; where the pointer starts.

        at  the pointer in pixels; without one the gesture starts right of the middle
        None when there is nothing to scale.
        """
        if not self._has_work():
            return None
        box = self.box()
        if box is None:
            self._refuse(Refusal.TWO_KEYS)
            return None
        x, y = at or (self.view.x(box.middle[0]) + ARM, self.view.y(box.middle[1]))
        self._gesture = Scale(self._start(x, y, modal=True), self.chosen(), box)
        return x, y

    def keep_axis(self, axis: str) -> None:
        """Only time ("t") or weight ("v") changes from the next move on; once more: both."""
        if isinstance(self._gesture, Drag):
            self._gesture.axis = "" if self._gesture.axis == axis else axis

    def begin_blend(self, target: Mapping[str, Curve]) -> bool:
        """Slides every editable pose towards `target`; False when there is nothing to slide."""
        if self.busy:
            return False
        self.refusal = None
        wanted = self._towards(target)
        if not wanted:
            return False
        self._gesture = Blend(self._start(0.0, 0.0, modal=True), wanted)
        self.selection = frozenset()  # on the way curves have other keys
        return True

    def blend(self, share: float) -> Mapping[str, Curve] | None:
        """As far as `share`, 0 to 1; the working curves that became others."""
        gesture = self._gesture
        return self._show(gesture, gesture.to(share)) if isinstance(gesture, Blend) else None

    def _towards(self, target: Mapping[str, Curve]) -> dict[str, Curve | None]:
        """What must change for the editable poses to be as in `target`; else a refusal says why nothing must."""
        other = {}
        for pose in self.poses:
            mine, wanted = self.curves.get(pose), target.get(pose)
            if mine is not wanted and not (mine is not None and mine.same_as(wanted)):
                other[pose] = wanted
        free = {pose: curve for pose, curve in other.items() if self.refuses(pose) is None}
        if not free:
            pose = next(iter(other), "")
            why = self.refuses(pose) if pose else None
            self._refuse(why or Refusal.NO_GHOST, pose)
        return free

    def _has_work(self) -> bool:
        self.refusal = None
        if not self.busy and not self.selection:
            self._refuse(Refusal.NOTHING_SELECTED)
        return not self.busy and bool(self.selection)
