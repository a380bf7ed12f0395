"""Quiet life beside the speech: a face that never blinks looks dead. Pure functions of time, no state.

One blink falls into each slot of SLOT seconds, at a place that looks random and never changes, so that a
clip rendered twice is the same clip.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from .face import Floats

#: Seconds by which the lives of two faces in one picture are apart, so that they do not blink as one.
APART = 1000.9
#: Seconds; one blink in each.
SLOT = 4.2
#: Seconds a lid takes to fall, stays down, and takes to rise: about those of people.
FALL, SHUT, RISE = 0.07, 0.03, 0.15
LENGTH = FALL + SHUT + RISE
_BROW = 0.14


def enliven(amounts: Floats, shapes: Sequence[str], time: float, speaking: bool) -> None:
    """Add blink and brows at `time` to amounts (k,) of the shapes, in place, where the face has such shapes."""
    for shape, amount in (("blink", blink(time)), ("browUp", brow(time) if speaking else 0.0)):
        if shape in shapes:
            place = shapes.index(shape)
            amounts[place] = max(amounts[place], amount)


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


def _start(slot: int) -> float:
    """The blink of a slot; it ends within the slot."""
    scattered = (slot * 2654435761 + 97) % 2**32 / 2**32
    return slot * SLOT + 0.3 + scattered * (SLOT - LENGTH - 0.6)


def _ease(share: float) -> float:
    return share * share * (3.0 - 2.0 * share)
