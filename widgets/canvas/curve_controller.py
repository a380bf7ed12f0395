"""The hand's single actions: add, delete, nudge, reverse, mirror, paste, type, swap; each is one edit. No Qt.

They do nothing while a gesture runs, and leave a `refusal` where they could do nothing.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise

import numpy as np

from core_pipeline.curves import MIN_GAP, Curve

from ..value_text import parse_typed
from .curve_clipboard import Copied
from .curve_edits import mirrored_values, moved, rekeyed, reversed_keys, turned_round, with_keys
from .curve_gestures import MOVE, PLAIN, SCALE, Modifiers
from .curve_hand import CurveHand, Edit
from .curve_magnets import snapped
from .curve_scene import ADD_REACH, Key, Refusal

__all__ = ["ADD", "DELETE", "MOVE", "NUDGE", "PLAIN", "SCALE", "CurveController", "Edit", "Modifiers"]

#: The first key of a curve becomes its end key when it is nearer than this to 0 or 1.
END_REACH = 0.02

#: Weight of the first key of a curve that is begun by key.
FIRST_WEIGHT = 0.5

ADD = "Add key"
DELETE = "Delete keys"
CUT = "Cut keys"
NUDGE = "Nudge keys"
REVERSE = "Reverse keys"
MIRROR = "Mirror values"
PASTE = "Paste keys"
TYPE = "Type values"
SWAP = "Swap with previous version"


class CurveController(CurveHand):
    """All the canvas can do with curves."""

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

    def add_between(self) -> Edit | None:
        """A key on the active curve half way from its last selected key to the next, else in its widest gap.

        A pose without a curve gets one with its key at the phone boundary.
        """
        curve = self.curves.get(self.active)
        if curve is None:
            return self.add_at(self.boundary, FIRST_WEIGHT)
        walls = np.unique(np.concatenate(([0.0], curve.t, [1.0])))
        gaps = list(pairwise(walls.tolist()))
        own = self.chosen().get(self.active)
        after = [gap for gap in gaps if own and gap[0] >= curve.t[own[-1]]]
        start, end = after[0] if after else max(gaps, key=lambda gap: gap[1] - gap[0])
        t = (start + end) / 2
        return self.add_at(t, float(curve.at(t)))

    def delete(self, label: str = DELETE) -> Edit | None:
        """Without the selected keys; a curve that loses its last key is gone."""
        if not self._has_work():
            return None
        changes = {pose: self.curves[pose].without(indices) for pose, indices in self.chosen().items()}
        self.selection = frozenset()
        return self._commit(changes, label)

    def nudge(self, dt: float, dv: float) -> Edit | None:
        """Moves the selection by a little, as far as there is room."""
        if not self._has_work():
            return None
        changes = moved(self.curves, self.chosen(), dt, dv)
        if not changes:
            self._refuse(Refusal.NO_ROOM)
            return None
        return self._commit(changes, NUDGE)

    def reverse(self) -> Edit | None:
        """Mirrors the selection in time, without one the active curve: see curve_edits.reversed_keys."""
        chosen = self._selection_or_active()
        if not chosen:
            return None
        turned = reversed_keys(self.curves, chosen)
        if turned is None:
            self._refuse(Refusal.NO_ROOM)
            return None
        changed = {p: (curve, at) for p, (curve, at) in turned.items() if not curve.same_as(self.curves[p])}
        return self._commit_keys(turned, REVERSE) if changed else None

    def mirror(self) -> Edit | None:
        """Turns the selection upside down, without one the active curve: see curve_edits.mirrored_values."""
        chosen = self._selection_or_active()
        if not chosen:
            return None
        turned = mirrored_values(self.curves, chosen)
        if all(curve.same_as(self.curves[pose]) for pose, (curve, _) in turned.items()):
            self._refuse(Refusal.SAME_WEIGHT)
            return None
        return self._commit_keys(turned, MIRROR)

    def type_value(self, axis: str, text: str, keys: Mapping[str, list[int]] | None = None) -> Edit | None:
        """Times (axis "t") or weights ("v") of the selection become what `text` says; see value_text.

        keys  pose → indices instead of the selection
        Weights are brought into [0, 1]; keys may pass one another in time, and a time without room is refused.
        """
        if keys is None and not self._has_work():
            return None
        self.refusal = None
        chosen = dict(keys) if keys is not None else self.chosen()
        typed = parse_typed(text)
        if self.busy or not all(self._may(pose) for pose in chosen):
            return None
        if typed is None:
            self._refuse(Refusal.NOT_TYPED, text.strip())
            return None
        turned = {}
        for pose, at in chosen.items():
            curve = self.curves[pose]
            t, v = curve.t[at], curve.v[at]
            new = rekeyed(curve, at, typed.of(t), v) if axis == "t" else rekeyed(curve, at, t, typed.of(v))
            if new is None:
                self._refuse(Refusal.NO_ROOM)
                return None
            turned[pose] = new
        return self._commit_keys(turned, TYPE, select=keys is None)

    def copy(self) -> Copied | None:
        """The selected keys, without a selection the active curve."""
        chosen = self._selection_or_active(editing=False)
        if not chosen:
            return None
        curves = {p: Curve(self.curves[p].t[at], self.curves[p].v[at]) for p, at in chosen.items()}
        return Copied(curves, frozenset(p for p, at in chosen.items() if len(at) == len(self.curves[p])))

    def paste(self, copied: Copied, *, backwards: bool = False) -> Edit | None:
        """Copied curves replace those of the same poses, copied keys what lies in their time; one pose: the active's.

        backwards  mirrored in time
        """
        if self.busy:
            return None
        self.refusal = None
        curves = turned_round(copied.curves, copied.whole) if backwards else dict(copied.curves)
        whole = copied.whole
        if len(curves) == 1 and self.active:
            (name,) = curves
            curves, whole = {self.active: curves[name]}, frozenset({self.active} if name in whole else ())
        targets = [pose for pose in curves if pose in self.poses]
        if not targets:
            self._refuse(Refusal.NO_SUCH_POSE, ", ".join(curves))
            return None
        free = [pose for pose in targets if self.refuses(pose) is None]
        if not free:
            self._may(targets[0])
            return None
        turned = {}
        for pose in free:
            new = curves[pose]
            turned[pose] = (new, list(range(len(new)))) if pose in whole else with_keys(self.curves.get(pose), new)
        return self._commit_keys(turned, PASTE)

    def swap(self, other: Mapping[str, Curve]) -> Edit | None:
        """Editable poses become as in `other`."""
        if self.busy:
            return None
        self.refusal = None
        changes = self._towards(other)
        return self._commit(changes, SWAP) if changes else None

    def _selection_or_active(self, *, editing: bool = True) -> dict[str, list[int]]:
        """Pose → indices to work on; empty with a refusal when there are none."""
        self.refusal = None
        if self.busy:
            return {}
        if self.selection:
            return self.chosen()
        if self.active not in self.curves:
            self._refuse(Refusal.NOTHING_SELECTED if editing else Refusal.NOTHING_TO_COPY)
            return {}
        if editing and not self._may(self.active):
            return {}
        return {self.active: list(range(len(self.curves[self.active])))}

    def _commit_keys(
        self, turned: Mapping[str, tuple[Curve, list[int]]], label: str, *, select: bool = True
    ) -> Edit | None:
        """Commits the curves that differ, and selects the keys that came with them; None when none differ."""
        changes = {pose: curve for pose, (curve, _) in turned.items() if not curve.same_as(self.curves.get(pose))}
        selection: frozenset[Key] = frozenset((pose, index) for pose, (_, at) in turned.items() for index in at)
        edit = self._commit(changes, label) if changes else None
        if select:
            self.select(selection)
        return edit
