"""Quiet life beside the speech: a face that never blinks looks dead. Pure functions of time, no state.

One blink falls into each slot of SLOT seconds, at a place that looks random and never changes, so that a
clip rendered twice is the same clip.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from functools import lru_cache

from .face import Face, Floats
from .retarget import Preset, Rig

#: Seconds by which the lives of two faces in one picture are apart, so that they do not blink as one.
APART = 1000.9
#: Seconds; one blink in each.
SLOT = 4.2
#: Seconds a lid takes to fall, stays down, and takes to rise: about those of people.
FALL, SHUT, RISE = 0.07, 0.03, 0.15
LENGTH = FALL + SHUT + RISE
_BROW = 0.14

#: What shuts both eyes, and what lifts the brows, by one convention each; the first that a rig has is taken.
_LIDS = (
    ("blink",),
    ("eyeBlinkLeft", "eyeBlinkRight"),
    ("blinkLeft", "blinkRight"),
    ("Eyes_Blink",),
    ("eyesClosed",),
    ("Fcl_EYE_Close",),
    ("まばたき",),
)
_BROWS = (
    ("browUp",),
    ("browInnerUp", "browOuterUpLeft", "browOuterUpRight"),
    ("Brow_Raise_Inner_L", "Brow_Raise_Inner_R", "Brow_Raise_Outer_L", "Brow_Raise_Outer_R"),
    ("browRaiseInL", "browRaiseInR", "browRaiseOuterL", "browRaiseOuterR"),
    ("Eyebrow_Raise",),
)
_PLAIN = Preset("", "", {})


def enliven(amounts: Floats, face: Face, time: float, speaking: bool) -> None:
    """Add blink and brows at `time` to amounts (k,) of the face's shapes, in place, where it has such shapes."""
    lids, brows = _lively(face.shapes, tuple(face.expressions.get("blink", {}).items()))
    for mix, amount in ((lids, blink(time)), (brows, brow(time) if speaking else 0.0)):
        for place, share in mix if amount else ():
            amounts[place] = max(amounts[place], share * amount)


def blink(time: float) -> float:
    """How far the lids are shut at `time` seconds, 0…1."""
    age = time - _start(math.floor(time / SLOT))
    if not 0.0 < age < LENGTH:
        return 0.0
    if age < FALL:
        return _ease(age / FALL)
    return 1.0 if age < FALL + SHUT else _ease((LENGTH - age) / RISE)


def next_blink(time: float) -> float:
    """When the next blink begins, seconds; later than `time`."""
    slot = math.floor(time / SLOT)
    start = _start(slot)
    return start if start > time else _start(slot + 1)


def brow(time: float) -> float:
    """A slow, slight raising of the brows while speaking, 0…0.14."""
    wave = math.sin(1.1 * time) + math.sin(1.9 * time + 1.0) + math.sin(3.1 * time + 2.0)
    return _BROW * max(0.0, wave / 3.0)


@lru_cache(maxsize=16)
def _lively(
    shapes: tuple[str, ...], made: tuple[tuple[str, float], ...]
) -> tuple[tuple[tuple[int, float], ...], tuple[tuple[int, float], ...]]:
    """What shuts the lids and what lifts the brows: (place among the shapes, share) each.

    made  what a rig's author makes the blink of, if anything is said
    """
    rig = Rig(shapes)

    def first(conventions: Iterable[Sequence[str]]) -> tuple[tuple[int, float], ...]:
        found = ({shape for name in names for shape in rig.shapes(name, _PLAIN)} for names in conventions)
        return tuple((shapes.index(shape), 1.0) for shape in sorted(next(filter(None, found), ())))

    lids = tuple((shapes.index(shape), share) for shape, share in made if shape in shapes)
    return lids or first(_LIDS), first(_BROWS)


def _start(slot: int) -> float:
    """The blink of a slot; it ends within the slot."""
    scattered = (slot * 2654435761 + 97) % 2**32 / 2**32
    return slot * SLOT + 0.3 + scattered * (SLOT - LENGTH - 0.6)


def _ease(share: float) -> float:
    return share * share * (3.0 - 2.0 * share)
