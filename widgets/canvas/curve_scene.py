"""What lies on the canvas and where: curves, which poses show, what is within reach of a point. No Qt."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from enum import Enum, auto

from core_pipeline.curves import Curve

from .curve_geometry import Array, View, distance_to_line, nearest_key, spline_points
from .transform_box import Box, Handle

#: A key: pose and index.
Key = tuple[str, int]

#: How near the pointer must be, in pixels: to a key, to a line, and to a line for a double-click.
KEY_REACH = 9.0
LINE_REACH = 6.0
ADD_REACH = 12.0


class Refusal(Enum):
    """Why an action did nothing."""

    LOCKED = auto()
    HIDDEN = auto()
    NO_POSE = auto()
    KEY_THERE = auto()
    OFF_CURVE = auto()
    NOTHING_SELECTED = auto()
    NO_ROOM = auto()
    SOLOED = auto()
    TWO_KEYS = auto()
    NOTHING_TO_COPY = auto()
    NOT_TYPED = auto()
    NO_GHOST = auto()
    NO_CURVES = auto()
    NEWER_CURVES = auto()
    BROKEN_CURVES = auto()
    NO_SUCH_POSE = auto()
    SAME_WEIGHT = auto()
    NO_NEIGHBOUR = auto()


class CurveScene:
    """Curves of one bigram as shown, and the selection.

    poses      all poses, in order
    curves     pose → curve as shown; during a drag the working copy
    active     the pose that is picked first and gets new keys; "" when there are no poses
    selection  selected keys; never hidden or locked ones
    hover      the key under the pointer
    visible    poses that are drawn: those with an open eye, or of these the soloed ones where there are any
    """

    def __init__(self) -> None:
        self.poses: tuple[str, ...] = ()
        self.curves: dict[str, Curve] = {}
        self.active = ""
        self.selection: frozenset[Key] = frozenset()
        self.hover: Key | None = None
        self._picked: Key | None = None
        self.visible: frozenset[str] = frozenset()
        self.solo: frozenset[str] = frozenset()
        self._open_eyes: frozenset[str] = frozenset()
        self.locked: frozenset[str] = frozenset()
        self._view = View()
        self._kind = "pchip"
        self._lines: dict[str, tuple[Curve, Array, Array]] = {}

    def set_poses(self, poses: Collection[str]) -> None:
        """Other poses; all visible and unlocked, the first one active unless the active one is among them."""
        self.poses = tuple(poses)
        self.visible = self._open_eyes = frozenset(self.poses)
        self.locked = self.solo = frozenset()
        if self.active not in self.poses:
            self.active = self.poses[0] if self.poses else ""
        self._prune()

    def set_curves(self, curves: Mapping[str, Curve]) -> None:
        """Other curves; the selection stays on those that have as many keys as before."""
        before, self.curves = self.curves, dict(curves)
        gone = {p for p in before if p not in curves or len(curves[p]) != len(before[p])}
        self.selection = frozenset(k for k in self.selection if k[0] not in gone)
        self._prune()

    def set_active(self, pose: str) -> None:
        """Another active pose; ignored when it is none of the poses."""
        if pose in self.poses:
            self.active = pose

    def set_visible(self, poses: Collection[str]) -> None:
        """Only these are drawn and can be picked; the data of the others stays."""
        self._open_eyes = frozenset(poses)
        self._look()

    def set_solo(self, poses: Collection[str]) -> None:
        """While there are any, these alone are drawn and can be picked, whatever the eyes say."""
        self.solo = frozenset(poses) & frozenset(self.poses)
        self._look()

    def _look(self) -> None:
        self.visible = self.solo or self._open_eyes
        self._prune()

    def set_locked(self, poses: Collection[str]) -> None:
        """These can be activated and seen, not edited."""
        self.locked = frozenset(poses)
        self._prune()

    def set_view(self, view: View) -> None:
        """Where the curves now lie."""
        if view != self._view:
            self._view = view
            self._lines.clear()

    def set_spline(self, kind: str) -> None:
        """How keys are joined; see core_pipeline.spline."""
        self._kind = kind
        self._lines.clear()

    @property
    def view(self) -> View:
        """Data ↔ pixels."""
        return self._view

    @property
    def spline(self) -> str:
        """How keys are joined."""
        return self._kind

    def _prune(self) -> None:
        self.selection = frozenset(k for k in self.selection if self._has(k) and self.refuses(k[0]) is None)
        if self.hover is not None and not (self._has(self.hover) and self.hover[0] in self.visible):
            self.hover = None

    def _has(self, key: Key) -> bool:
        return key[0] in self.curves and key[1] < len(self.curves[key[0]])

    def keys_px(self, pose: str) -> Array:
        """Pixels (m, 2) of a pose's keys."""
        return self._line(pose)[1]

    def spline_px(self, pose: str) -> Array:
        """Pixels (n, 2) along a pose's smooth curve."""
        return self._line(pose)[2]

    def _line(self, pose: str) -> tuple[Curve, Array, Array]:
        curve = self.curves[pose]
        line = self._lines.get(pose)
        if line is None or line[0] is not curve:
            line = (curve, self._view.points(curve.t, curve.v), spline_points(curve, self._kind, self._view))
            self._lines[pose] = line
        return line

    def drawn(self) -> list[str]:
        """Visible poses with a curve, the active one first."""
        order = sorted(self.poses, key=lambda pose: pose != self.active)
        return [pose for pose in order if pose in self.visible and pose in self.curves]

    def key_at(self, x: float, y: float) -> Key | None:
        """The key within reach; the active curve's before any other, then the nearest."""
        best: tuple[float, Key] | None = None
        for pose in self.drawn():
            distance, index = nearest_key(self.keys_px(pose), x, y)
            if distance <= KEY_REACH:
                if pose == self.active:
                    return pose, index
                if best is None or distance < best[0]:
                    best = distance, (pose, index)
        return best and best[1]

    def pose_at(self, x: float, y: float, reach: float = LINE_REACH) -> str | None:
        """The pose whose line, smooth or straight, is within reach; the active one before any other."""
        best: tuple[float, str] | None = None
        for pose in self.drawn():
            distance = min(distance_to_line(line, x, y) for line in self._line(pose)[1:])
            if distance <= reach:
                if pose == self.active:
                    return pose
                if best is None or distance < best[0]:
                    best = distance, pose
        return best and best[1]

    def keys_within(self, x0: float, y0: float, x1: float, y1: float) -> frozenset[Key]:
        """Editable keys in the rectangle between two corners."""
        (left, right), (top, bottom) = sorted((x0, x1)), sorted((y0, y1))
        return frozenset(
            (pose, index)
            for pose in self.editable()
            for index, (x, y) in enumerate(self.keys_px(pose))
            if left <= x <= right and top <= y <= bottom
        )

    def editable(self) -> list[str]:
        """Visible, unlocked poses with a curve, the active one first."""
        return [pose for pose in self.drawn() if self.refuses(pose) is None]

    def refuses(self, pose: str) -> Refusal | None:
        """Why this pose cannot be edited now, or None."""
        if pose not in self.poses:
            return Refusal.NO_POSE
        if pose not in self.visible:
            return Refusal.SOLOED if self.solo else Refusal.HIDDEN
        return Refusal.LOCKED if pose in self.locked else None

    @property
    def lead(self) -> Key | None:
        """The selected key that was picked last, or the first selected one."""
        return self._picked if self._picked in self.selection else min(self.selection, default=None)

    def chosen(self) -> dict[str, list[int]]:
        """The selection as pose → indices, ascending."""
        result: dict[str, list[int]] = {}
        for pose, index in sorted(self.selection):
            result.setdefault(pose, []).append(index)
        return result

    def box(self) -> Box | None:
        """Around the selection, None when there is nothing in it to scale."""
        return Box.around(self.curves, self.chosen())

    def handle_at(self, x: float, y: float) -> Handle | None:
        """The handle of the transform box within reach."""
        box = self.box()
        return None if box is None else box.handle_at(self._view, x, y)

    def select(self, keys: Collection[Key]) -> None:
        """Selects these keys; unknown, hidden or locked ones are left out."""
        self.selection = frozenset(keys)
        self._prune()

    def select_all(self) -> None:
        """All keys of the active curve; when they are selected already, those of every editable curve."""
        everything = frozenset((pose, i) for pose in self.editable() for i in range(len(self.curves[pose])))
        own = frozenset(key for key in everything if key[0] == self.active)
        self.selection = own if own and self.selection != own else everything

    def select_next(self, step: int) -> None:
        """Only the next (step 1) or the previous (−1) key of the active curve."""
        if self.active not in self.curves or self.refuses(self.active) is not None:
            return
        count = len(self.curves[self.active])
        own = self.chosen().get(self.active)
        if own is None:
            index = 0 if step > 0 else count - 1
        else:
            index = (own[-1] if step > 0 else own[0]) + step
        self.selection = frozenset({(self.active, index % count)})

    def next_pose(self, step: int) -> None:
        """Makes the next visible pose active (step 1), or the previous one (−1)."""
        seen = [pose for pose in self.poses if pose in self.visible]
        if seen:
            at = seen.index(self.active) if self.active in seen else -step
            self.active = seen[(at + step) % len(seen)]
