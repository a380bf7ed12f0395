"""What a label file says, whatever its format: intervals in seconds with the names as they are written."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple

#: Intervals; ten hours of speech.
MOST = 400_000


class Interval(NamedTuple):
    """A label and when it lasts, in seconds."""

    start: float
    end: float
    name: str


@dataclass(frozen=True)
class LabelFile:
    """kind: the format, for people. phones, words: sorted. start, end: what the file claims to cover."""

    kind: str
    phones: tuple[Interval, ...]
    words: tuple[Interval, ...] = ()
    start: float = 0.0
    end: float = 0.0
    notes: tuple[str, ...] = ()


def make(
    kind: str,
    phones: Iterable[Interval],
    words: Iterable[Interval] = (),
    span: tuple[float, float] | None = None,
    notes: Iterable[str] = (),
) -> LabelFile:
    """Sorted, without what has no length; a note says how many that were. span: start and end, else those found."""
    kept, bad = _proper(phones)
    told = list(notes)
    if bad:
        told.append(f"{bad} {'label' if bad == 1 else 'labels'} without a length or a usable time left out.")
    start = min((i.start for i in kept), default=0.0)
    end = max((i.end for i in kept), default=0.0)
    if span is not None and all(map(math.isfinite, span)):
        start, end = min(start, span[0]), max(end, span[1])
    return LabelFile(kind, kept, _proper(words)[0], start, end, tuple(told))


def _proper(intervals: Iterable[Interval]) -> tuple[tuple[Interval, ...], int]:
    everything = list(intervals)
    kept = [i for i in everything if math.isfinite(i.start + i.end) and i.end > i.start and abs(i.end) < 1e6]
    return tuple(sorted(kept, key=lambda i: (i.start, i.end))), len(everything) - len(kept)
