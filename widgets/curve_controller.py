"""The hand on the curves: press, move, release and single actions, as edits of curves. No Qt.

The canvas hands in pixels and modifiers and draws what stands here. A drag works on its own copy;
`release` hands back one `Edit` for the whole gesture, `cancel` leaves the very objects from before.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import hypot
from typing import NamedTuple

from core_pipeline.curves import MIN_GAP, Curve

from .curve_geometry import feasible, shifted, snapped
from .curve_scene import ADD_REACH, CurveScene, Key, Refusal

#: How far in pixels the pointer must go before a press is a drag.
DRAG_THRESHOLD = 3.0

#: Speed of a drag while Alt is held.
FINE = 0.1

#: The first key of a curve becomes its end key when it is nearer than this to 0 or 1.
END_REACH = 0.02

MOVE = "Move keys"
ADD = "Add key"
DELETE = "Delete keys"
NUDGE = "Nudge keys"


class Modifiers(NamedTuple):
    """What is held: Shift keeps to one axis, Ctrl snaps (or stops snapping), Alt is fine."""

    shift: bool = False
    ctrl: bool = False
    alt: bool = False


PLAIN = Modifiers()


@dataclass(frozen=True)
class Edit:
    """What one gesture did: pose → new curve, None where the curve is gone; and its name."""

    changes: Mapping[str, Curve | None]
    label: str


@dataclass
class _Gesture:
    """A button held down: on `key` it moves keys, else it draws a marquee.

    curves, selection  as they were before
    anchor, reached    where Alt last changed: the pointer, and the shift in pixels reached by then
    changed            the curves that now differ from `curves`
    """

    x: float
    y: float
    held: Modifiers
    key: Key | None
    curves: Mapping[str, Curve]
    selection: frozenset[Key]
    anchor: tuple[float, float]
    fine: bool
    reached: tuple[float, float] = (0.0, 0.0)
    started: bool = False
    changed: dict[str, Curve] = field(default_factory=dict)

    def reach(self, x: float, y: float) -> tuple[float, float]:
        """The shift in pixels when the pointer is at (x, y)."""
        speed = FINE if self.fine else 1.0
        return self.reached[0] + (x - self.anchor[0]) * speed, self.reached[1] + (y - self.anchor[1]) * speed


class CurveController(CurveScene):
    """The scene, and the one gesture that may be running on it.

    snap      whether drags and new keys keep to the grid
    boundary  normalised time between the two phones, a magnet while snapping
    band      the marquee's corners (x0, y0, x1, y1) in pixels while one is drawn
    refusal   why the last action did nothing, and for which pose
    """

    def __init__(self) -> None:
        super().__init__()
        self.snap = False
        self.boundary = 0.5
        self.band: tuple[float, float, float, float] | None = None
        self.refusal: tuple[Refusal, str] | None = None
        self._gesture: _Gesture | None = None
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
        """Whether a button is held down."""
        return self._gesture is not None

    @property
    def dragging(self) -> bool:
        """Whether keys are being moved: the pointer has left the threshold."""
        return self._gesture is not None and self._gesture.started and self._gesture.key is not None

    def _may(self, pose: str) -> bool:
        why = self.refuses(pose)
        self.refusal = (why, pose) if why is not None else None
        return why is None

    def _refuse(self, why: Refusal) -> None:
        self.refusal = (why, self.active)

    # One gesture

    def press(self, x: float, y: float, held: Modifiers = PLAIN) -> None:
        """The left button goes down."""
        if self.busy:
            return
        self.refusal = None
        key = self.key_at(x, y)
        before = self.selection
        if key is not None:
            self.active, self._picked = key[0], key
            if not self._may(key[0]):
                return
            if key not in before:
                self.selection = before | {key} if held.shift else frozenset({key})
        self._gesture = _Gesture(x, y, held, key, dict(self.curves), before, anchor=(x, y), fine=held.alt)

    def move(self, x: float, y: float, held: Modifiers = PLAIN) -> Mapping[str, Curve] | None:
        """The pointer moves; the working curves that became others, or None when none did."""
        gesture = self._gesture
        if gesture is None:
            self.hover = self.key_at(x, y)
            return None
        if not gesture.started and hypot(x - gesture.x, y - gesture.y) < DRAG_THRESHOLD:
            return None
        gesture.started = True
        if gesture.key is None:
            self._stretch_band(gesture, x, y)
            return None
        changed = self._shifted(gesture.curves, *self._wish(gesture, gesture.key, x, y, held))
        touched = changed.keys() | gesture.changed.keys()
        now = {**gesture.curves, **changed}
        if all(now[pose].same_as(self.curves[pose]) for pose in touched):
            return None
        gesture.changed, self.curves = changed, now
        return {pose: now[pose] for pose in touched}

    def _stretch_band(self, gesture: _Gesture, x: float, y: float) -> None:
        self.band = (gesture.x, gesture.y, x, y)
        caught = self.keys_within(*self.band)
        if gesture.held.shift:
            self.selection = gesture.selection | caught
        elif gesture.held.ctrl:
            self.selection = gesture.selection - caught
        else:
            self.selection = caught

    def _wish(self, gesture: _Gesture, key: Key, x: float, y: float, held: Modifiers) -> tuple[float, float]:
        """The shift (dt, dv) the pointer asks for, before it is known whether there is room."""
        if held.alt != gesture.fine:  # go on from here, slower or faster, without a jump
            gesture.reached = gesture.reach(x, y)
            gesture.anchor, gesture.fine = (x, y), held.alt
        dx, dy = gesture.reach(x, y)
        if held.shift:
            dx, dy = (dx, 0.0) if abs(dx) >= abs(dy) else (0.0, dy)
        dt, dv = dx / self.view.width, -dy / self.view.height
        if self.snap != held.ctrl and not held.alt:
            curve = gesture.curves[key[0]]
            t, v = float(curve.t[key[1]]), float(curve.v[key[1]])
            if dx or not held.shift:
                dt = snapped(t + dt, (0.0, 1.0, self.boundary)) - t
            if dy or not held.shift:
                dv = snapped(v + dv, (0.0, 1.0)) - v
        return dt, dv

    def _shifted(self, curves: Mapping[str, Curve], dt: float, dv: float) -> dict[str, Curve]:
        """The curves that become others when the whole selection goes that way as far as it can."""
        chosen = self.chosen()
        dt_lo, dt_hi, dv_lo, dv_hi = feasible(curves, chosen)
        dt, dv = min(max(dt, dt_lo), dt_hi), min(max(dv, dv_lo), dv_hi)
        if dt == 0 and dv == 0:
            return {}
        moved = {pose: shifted(curves[pose], indices, dt, dv) for pose, indices in chosen.items()}
        return {pose: curve for pose, curve in moved.items() if not curve.same_as(curves[pose])}

    def release(self, x: float, y: float) -> Edit | None:
        """The button goes up: the one edit of this gesture, or None when nothing changed."""
        gesture = self._gesture
        if gesture is None:
            return None
        changed = {pose: curve for pose, curve in gesture.changed.items() if self.refuses(pose) is None}
        self.curves = dict(gesture.curves)
        self._end()
        edit = self._commit(changed, MOVE) if changed else None if gesture.started else self._click(gesture, x, y)
        self._prune()
        return edit

    def _click(self, gesture: _Gesture, x: float, y: float) -> Edit | None:
        if gesture.key is not None:
            if not gesture.held.shift:
                self.selection = frozenset({gesture.key})
            elif gesture.key in gesture.selection:
                self.selection = gesture.selection - {gesture.key}
            return None
        if gesture.held.ctrl:
            return self.add(x, y, anywhere=True)
        if not gesture.held.shift:
            self.selection = frozenset()
        if pose := self.pose_at(x, y):
            self.active = pose
        return None

    def cancel(self) -> bool:
        """Puts back what the running gesture changed; whether one was running."""
        gesture = self._gesture
        if gesture is None:
            return False
        self.curves = dict(gesture.curves)
        if gesture.key is None:
            self.selection = gesture.selection
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

    # Single actions; each does nothing while a gesture runs

    def add(self, x: float, y: float, *, anywhere: bool = False) -> Edit | None:
        """A key of the active pose at (x, y), which must be near its curve unless `anywhere`; see add_at."""
        if self.busy or not self._may(self.active):
            return None
        if not anywhere and self.active in self.curves and self.pose_at(x, y, ADD_REACH) != self.active:
            self._refuse(Refusal.OFF_CURVE)
            return None
        t, v = self.view.t(x), self.view.v(y)
        if self.snap:
            t, v = snapped(t, (0.0, 1.0, self.boundary)), snapped(v, (0.0, 1.0))
        return self.add_at(t, v)

    def add_at(self, t: float, v: float) -> Edit | None:
        """A key of the active pose at time t and weight v, both brought into [0, 1]; it is selected.

        A pose without a curve gets one: (0, 0), the key, (1, 0).
        """
        if self.busy or not self._may(self.active):
            return None
        t, v = (round(min(max(value, 0.0), 1.0), 4) for value in (t, v))
        curve = self.curves.get(self.active)
        if curve is None:
            t = 0.0 if t < END_REACH else 1.0 if t > 1 - END_REACH else t
            new = Curve.of([(0.0, 0.0)] * (t > 0) + [(t, v)] + [(1.0, 0.0)] * (t < 1))
        elif abs(curve.t - t).min() < MIN_GAP:
            self._refuse(Refusal.KEY_THERE)
            return None
        else:
            new = curve.with_key(t, v)
        edit = self._commit({self.active: new}, ADD)
        self.selection = frozenset({(self.active, int(new.t.searchsorted(t)))})
        return edit

    def delete(self) -> Edit | None:
        """Without the selected keys; a curve that loses its last key is gone."""
        if not self._has_work():
            return None
        changes = {pose: self.curves[pose].without(indices) for pose, indices in self.chosen().items()}
        self.selection = frozenset()
        return self._commit(changes, DELETE)

    def nudge(self, dt: float, dv: float) -> Edit | None:
        """Moves the selection by a little, as far as there is room."""
        if not self._has_work():
            return None
        changes = self._shifted(self.curves, dt, dv)
        if not changes:
            self._refuse(Refusal.NO_ROOM)
            return None
        return self._commit(changes, NUDGE)

    def _has_work(self) -> bool:
        self.refusal = None
        if not self.busy and not self.selection:
            self._refuse(Refusal.NOTHING_SELECTED)
        return not self.busy and bool(self.selection)
