"""Phones with a start and an end each, from recognisers and label files → a schedule without gap or overlap."""

from __future__ import annotations

from collections.abc import Iterable

from ..phonemes import SILENCE
from ..schedule import Schedule

#: A gap or overlap of at most this many seconds is rounding; a phone this short is left out.
ROUNDING = 0.002

PhoneSpan = tuple[str, float, float]


def to_schedule(spans: Iterable[PhoneSpan], start: float, end: float) -> Schedule:
    """A schedule from `start` to `end`: gaps become silence, overlaps are cut at the later phone's start.

    Spans in any order; what lies outside is cut off, what has no length left is dropped, neighbouring
    silences are one.
    """
    phones: list[str] = []
    times: list[float] = []

    def add(phone: str, at: float) -> None:
        if phones and at - times[-1] < ROUNDING:  # the one before has no length
            phones.pop()
            at = times.pop()
        if not (phone == SILENCE and phones and phones[-1] == SILENCE):
            phones.append(phone)
            times.append(at)

    add(SILENCE, start)
    reached = start
    cut = ((phone, max(first, start), min(last, end)) for phone, first, last in spans)
    for phone, first, last in sorted(cut, key=lambda span: (span[1], span[2])):
        if last - first < ROUNDING or last <= reached:
            continue
        if first > reached + ROUNDING:
            add(SILENCE, reached)
            add(phone, first)
        else:  # an overlap begins where the later one says, unless that is where the earlier one began
            add(phone, first)
        reached = last
    if reached < end - ROUNDING:
        add(SILENCE, reached)
    if len(phones) > 1 and end - times[-1] < ROUNDING:
        phones.pop()
        times.pop()
    return Schedule(phones, [*times, end])
