"""What a user may set in the pipeline, and the two presets (sections 3.1.2, 3.2.1, 3.2.2 and 3.2.3)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType

from .errors import UserError

#: pchip: through every knot, no overshoot (default). bspline: the paper's "smooth B-spline" taken
#: literally, which halves the peak of a three-key curve. cardinal: tension 0.5, clipped. linear: none.
SPLINES = ("pchip", "bspline", "cardinal", "linear")

#: Two weights of at most 1 can never exceed this: a pair without a constraint.
UNCONSTRAINED = 2.0

_PRIORITIES = ("open", "W", "wide", "ShCh", "FV", "PBM")


@dataclass(frozen=True)
class Constraint:
    """C(a, b) of section 3.2.2: the weights of the two poses may add up to `limit` at most."""

    a: str
    b: str
    limit: float


@dataclass(frozen=True)
class Settings:
    """Everything but curves and schedule that shapes the result. Immutable; UserError when out of range.

    window       full width 2·t_w of the smoothing window, seconds, 0…1
    windows      the same for single poses
    constraints  one per constrained pair; the pose later in `priorities` stays, the other gives way
    priorities   poses from lowest to highest; a pose not named is never constrained
    speed_limit  l_max, weight per second, > 0
    spline       one of SPLINES
    """

    window: float = 0.18
    windows: Mapping[str, float] = field(default_factory=dict)
    constraints: tuple[Constraint, ...] = ()
    priorities: tuple[str, ...] = ()
    speed_limit: float = 15.0
    spline: str = "pchip"

    def __post_init__(self) -> None:
        object.__setattr__(self, "windows", MappingProxyType(dict(self.windows)))
        for name, width in [("smoothing window", self.window)] + [
            (f"smoothing window of {pose}", width) for pose, width in self.windows.items()
        ]:
            if not 0 <= width <= 1:
                raise UserError(f"The {name} is {width:g} s: choose a value from 0 to 1 s.")
        if not (math.isfinite(self.speed_limit) and 0.01 <= self.speed_limit <= 1e4):
            raise UserError(f"The speed limit is {self.speed_limit:g}/s: choose a value from 0.01 to 10000.")
        if self.spline not in SPLINES:
            raise UserError(f"There is no spline {self.spline!r}: choose one of {', '.join(SPLINES)}.")
        if len(set(self.priorities)) != len(self.priorities):
            raise UserError("A pose stands twice in the priorities: name each pose once.")
        for c in self.constraints:
            if not 0 <= c.limit <= UNCONSTRAINED:
                raise UserError(f"The constraint of {c.a} and {c.b} is {c.limit:g}: choose 0 to 2.")
            if c.a == c.b:
                raise UserError(f"The pose {c.a} is constrained against itself: name two poses.")

    @classmethod
    def paper(cls) -> Settings:
        """Constraints, priorities and l_max as printed; the windows are ours (two closures must not merge)."""
        return cls(
            windows={"PBM": 0.10, "FV": 0.10},
            constraints=_constraints("open FV .5, open PBM .5, open ShCh .5"),
            priorities=_PRIORITIES,
            speed_limit=15.0,
        )

    @classmethod
    def smartbody(cls) -> Settings:
        """The values of SmartBody, the paper's own system: more constraints, and a speed limit of 6.

        So low a limit keeps lips from closing in fast speech, whatever the curves.
        """
        return cls(
            windows={"PBM": 0.10, "FV": 0.10},
            constraints=_constraints(
                "open PBM .5, wide PBM .5, ShCh PBM .5, open FV .5, wide FV .5, open W .5, open wide .5, open ShCh .7"
            ),
            priorities=_PRIORITIES,
            speed_limit=6.0,
        )

    def window_of(self, pose: str) -> float:
        """The smoothing window of one pose in seconds."""
        return self.windows.get(pose, self.window)

    def with_spline(self, spline: str) -> Settings:
        """The same with another spline."""
        return replace(self, spline=spline)

    def preset_name(self) -> str:
        """ "paper", "smartbody", or "" when changed by hand; the spline is not part of a preset."""
        for name, preset in PRESETS.items():
            if self.with_spline(preset.spline) == preset:
                return name
        return ""

    @cached_property
    def clashes(self) -> Mapping[str, tuple[tuple[str, float], ...]]:
        """Pose → the poses before which it gives way, with C: of higher priority and C below 2."""
        rank = {p: i for i, p in enumerate(self.priorities)}
        found: dict[str, dict[str, float]] = {}
        for c in self.constraints:
            if {c.a, c.b} <= rank.keys() and c.limit < UNCONSTRAINED:
                low, high = sorted((c.a, c.b), key=rank.__getitem__)
                limits = found.setdefault(low, {})
                limits[high] = min(c.limit, limits.get(high, UNCONSTRAINED))
        return {low: tuple(limits.items()) for low, limits in found.items()}


def _constraints(text: str) -> tuple[Constraint, ...]:
    rows = (row.split() for row in text.split(","))
    return tuple(Constraint(a, b, float(limit)) for a, b, limit in rows)


PRESETS: Mapping[str, Settings] = MappingProxyType({"paper": Settings.paper(), "smartbody": Settings.smartbody()})
