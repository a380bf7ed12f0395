"""What a crab has besides a face: the numbers of its shell's colours, claws, legs, spikes and eye stalks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from core_pipeline.faces.sculpt.character import Character, Hair
from core_pipeline.faces.sculpt.horn import Horn
from core_pipeline.faces.sculpt.sdf import Point


@dataclass(frozen=True)
class Stalks:
    """Eyes like lamps: a visor above and one below, opening to these degrees from straight ahead.

    foot    where the right stalk leaves the shell; girth: half thickness at foot and eye
    shut    where the visors meet in a blink
    tilt    degrees the opening leans: positive lifts the inner corners
    lift    how far browUp stretches the stalks, and by how many degrees more it opens the eyes
    narrow  pose → degrees by which it moves the (upper, lower) visor: a smile reaches the eyes
    """

    foot: Point
    girth: tuple[float, float] = (0.13, 0.10)
    upper: float = 42.0
    lower: float = -44.0
    shut: float = -10.0
    tilt: float = 7.0
    yaw: float = 8.0
    lift: tuple[float, float] = (0.12, 14.0)
    narrow: Mapping[str, tuple[float, float]] = field(default_factory=dict)


@dataclass(frozen=True)
class Claw:
    """Right claw: an arm to the wrist, a palm that ends in the fixed finger, and the moving finger."""

    arm: Horn
    palm: Horn
    finger: Horn


@dataclass(frozen=True)
class Spot:
    """A patch of lighter colour where the ray from the shell's middle in a direction comes out."""

    towards: Point
    radius: float


BALD = Hair(hairline=())


@dataclass(frozen=True, kw_only=True)
class Crab(Character):
    """A crab: a character with a shell instead of a head. Limbs are the right side's; the left mirrors them.

    brim       height of the edge between carapace and face
    left_claw  size of the left claw over the right one's
    """

    hair: Hair = BALD
    stalks: Stalks
    claw: Claw
    left_claw: float = 1.0
    legs: tuple[Horn, ...] = ()
    spikes: tuple[Horn, ...] = ()
    spots: tuple[Spot, ...] = ()
    brim: float = 0.1
    side: Point = (0.95, 0.50, 0.25)
    belly: Point = (1.0, 0.82, 0.60)
    spot: Point = (0.99, 0.60, 0.30)
    tip: Point = (1.0, 0.90, 0.76)
