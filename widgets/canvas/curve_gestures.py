"""What can be under way on the canvas: a marquee, moving keys, scaling them, sliding to another version. No Qt.

A gesture keeps the curves from before and answers what they become; it changes nothing by itself.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from math import hypot
from typing import NamedTuple

from core_pipeline.curves import Curve

from .curve_edits import FLAT, blended, moved, stretched
from .curve_geometry import View
from .curve_magnets import Landing
from .curve_scene import Key
from .transform_box import Box, Handle

#: How far in pixels the pointer must go before a press is a drag.
DRAG_THRESHOLD = 3.0

#: Speed of a drag while Alt is held.
FINE = 0.1

#: Nearer to the middle than this, in pixels, scaling goes by way and not by ratio: no sudden leaps.
LEAST_ARM = 60.0

MOVE = "Move keys"
SCALE = "Scale keys"
BLEND = "Blend curves"


class Modifiers(NamedTuple):
    """What is held: Shift keeps to one axis, Ctrl snaps (or stops snapping), Alt is fine."""

    shift: bool = False
    ctrl: bool = False
    alt: bool = False


PLAIN = Modifiers()


class Start(NamedTuple):
    """How a gesture begins: where, in pixels, with what held, and what there was before.

    modal  no button is held: a click or a key ends it
    """

    x: float
    y: float
    curves: Mapping[str, Curve]
    selection: frozenset[Key]
    held: Modifiers = PLAIN
    modal: bool = False


class Gesture:
    """Something under way.

    axis     "t" or "v" while it keeps to one, else ""
    started  whether the pointer has left the threshold
    changed  the curves that now differ from those before
    """

    label = ""

    def __init__(self, start: Start) -> None:
        self.start = start
        self.axis = ""
        self.started = start.modal
        self.changed: dict[str, Curve] = {}

    def far_enough(self, x: float, y: float) -> bool:
        """Whether this is a drag and not a click with a trembling hand."""
        self.started = self.started or hypot(x - self.start.x, y - self.start.y) >= DRAG_THRESHOLD
        return self.started

    def result(self) -> dict[str, Curve | None]:
        """What the whole gesture changes."""
        return dict(self.changed)


class Marquee(Gesture):
    """Draws a rectangle; what was held at the press says what becomes of the keys in it."""

    def chosen(self, caught: frozenset[Key]) -> frozenset[Key]:
        """The selection when these keys lie in the rectangle."""
        before, held = self.start.selection, self.start.held
        if held.shift:
            return before | caught
        return before - caught if held.ctrl else caught


class Drag(Gesture, ABC):
    """Follows the pointer with the keys in `chosen`, pose → indices."""

    def __init__(self, start: Start, chosen: Mapping[str, list[int]]) -> None:
        super().__init__(start)
        self.chosen = chosen
        # Where Alt last changed: the pointer, and the shift in pixels reached by then.
        self._anchor, self._reached, self._fine = (start.x, start.y), (0.0, 0.0), start.held.alt

    def travel(self, x: float, y: float, held: Modifiers) -> tuple[float, float]:
        """Pixels gone since the start, fine where Alt was held; without a jump when Alt changes."""
        if held.alt != self._fine:
            self._reached = self._reach(x, y)
            self._anchor, self._fine = (x, y), held.alt
        return self._reach(x, y)

    def _reach(self, x: float, y: float) -> tuple[float, float]:
        speed = FINE if self._fine else 1.0
        return self._reached[0] + (x - self._anchor[0]) * speed, self._reached[1] + (y - self._anchor[1]) * speed

    def free(self, dx: float, dy: float, held: Modifiers) -> tuple[bool, bool]:
        """Whether time and weight may change."""
        if self.axis:
            return self.axis == "t", self.axis == "v"
        across = abs(dx) >= abs(dy)
        return (across, not across) if held.shift else (True, True)

    @abstractmethod
    def step(self, x: float, y: float, held: Modifiers, landing: Landing) -> dict[str, Curve]:
        """The curves that differ from those before when the pointer is at (x, y)."""


class Move(Drag):
    """Moves keys; `key` is the one that meets the grid and the magnets."""

    label = MOVE

    def __init__(self, start: Start, chosen: Mapping[str, list[int]], key: Key) -> None:
        super().__init__(start, chosen)
        self.key = key

    def step(self, x: float, y: float, held: Modifiers, landing: Landing) -> dict[str, Curve]:
        """The whole selection goes as far as it can."""
        dx, dy = self.travel(x, y, held)
        in_t, in_v = self.free(dx, dy, held)
        curve = self.start.curves[self.key[0]]
        t, v = float(curve.t[self.key[1]]), float(curve.v[self.key[1]])
        dt = landing.time(t + dx / landing.view.width) - t if in_t else 0.0
        dv = landing.weight(v - dy / landing.view.height) - v if in_v else 0.0
        return moved(self.start.curves, self.chosen, dt, dv)


class Scale(Drag):
    """Scales keys about the middle of their `box`, or with a `handle` about the opposite edge."""

    label = SCALE

    def __init__(self, start: Start, chosen: Mapping[str, list[int]], box: Box, handle: Handle | None = None) -> None:
        super().__init__(start, chosen)
        self.box, self.handle = box, handle

    def step(self, x: float, y: float, held: Modifiers, landing: Landing) -> dict[str, Curve]:
        """The whole selection stretches as far as it can."""
        dx, dy = self.travel(x, y, held)
        in_t, in_v = self.free(dx, dy, held)
        if self.handle is None:
            pivot, factor = self.box.middle, self._by_distance(dx, dy, landing.view)
            factors = (landing.factor(factor, self._arms(in_t, in_v)),) * 2
        else:
            pivot, factors = self.box.opposite(self.handle), self._by_edge(self.handle, dx, dy, landing)
        kept = factors[0] if in_t else 1.0, factors[1] if in_v else 1.0
        return stretched(self.start.curves, self.chosen, pivot, kept)

    def _by_distance(self, dx: float, dy: float, view: View) -> float:
        x, y = view.x(self.box.middle[0]), view.y(self.box.middle[1])
        away_x, away_y = self.start.x - x, self.start.y - y
        before, now = hypot(away_x, away_y), hypot(away_x + dx, away_y + dy)
        return max(1.0 + (now - before) / max(before, LEAST_ARM), 0.0)

    def _arms(self, in_t: bool, in_v: bool) -> list[tuple[float, float, bool]]:
        box, (t, v) = self.box, self.box.middle
        return [(t, edge - t, True) for edge in (box.t0, box.t1) if in_t] + [
            (v, edge - v, False) for edge in (box.v0, box.v1) if in_v
        ]

    def _by_edge(self, handle: Handle, dx: float, dy: float, landing: Landing) -> tuple[float, float]:
        (t, v), (t0, v0) = self.box.edge(handle), self.box.opposite(handle)
        new_t, new_v = landing.time(t + dx / landing.view.width), landing.weight(v - dy / landing.view.height)
        in_t = max((new_t - t0) / (t - t0), 0.0) if handle[0] and t != t0 else 1.0
        in_v = max((new_v - v0) / (v - v0), 0.0) if handle[1] and v != v0 else 1.0
        return in_t, in_v


class Blend(Gesture):
    """Slides poses from what they are to `target`, None where the target has no curve."""

    label = BLEND

    def __init__(self, start: Start, target: Mapping[str, Curve | None]) -> None:
        super().__init__(start)
        self.target = dict(target)
        self.share = 0.0

    def to(self, share: float) -> dict[str, Curve]:
        """The curves at `share` of the way, 0 to 1."""
        self.share = share
        return {
            pose: blended(self.start.curves.get(pose, FLAT), FLAT if end is None else end, share)
            for pose, end in self.target.items()
        }

    def result(self) -> dict[str, Curve | None]:
        """The target itself at the end of the way, nothing at its start."""
        if self.share <= 0:
            return {}
        return dict(self.target) if self.share >= 1 else dict(self.changed)
