"""Edits of an utterance by hand: a boundary moved, a phone renamed, put in or taken out. Each gives a new one.

Words that begin or end at a boundary go with it. Silence beside silence becomes one.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..errors import UserError
from ..phonemes import SILENCE
from ..schedule import Schedule
from .utterance import Utterance, Word

#: No phone can be made shorter than this many seconds by hand.
SHORTEST = 0.01
#: A word and a phone begin together when they are this near, in seconds.
_SAME = 1e-4


def boundary_moved(utterance: Utterance, boundary: int, time: float) -> Utterance:
    """Boundary i, the start of phone i, at another time; it stops SHORTEST before its neighbours.

    The first and the last one (0 and n) stay where they are.
    """
    times = utterance.schedule.times
    if not 0 < boundary < len(utterance.schedule):
        return utterance
    before = float(times[boundary])
    low, high = float(times[boundary - 1]) + SHORTEST, float(times[boundary + 1]) - SHORTEST
    if low > high:  # there is no room at all
        return utterance
    after = min(max(time, low), high)
    moved = times.copy()
    moved[boundary] = after
    words = tuple(_nudged(word, before, after) for word in utterance.words)
    return replace(utterance, schedule=Schedule(utterance.schedule.phones, moved), words=words)


def renamed(utterance: Utterance, phone: int, name: str) -> Utterance:
    """Phone i is another one."""
    phones = list(utterance.schedule.phones)
    phones[phone] = name
    return _with(utterance, phones, utterance.schedule.times.tolist())


def inserted(utterance: Utterance, phone: int, name: str, *, after: bool) -> Utterance:
    """A new phone takes the last half of phone i, or with after=False its first half. UserError without room."""
    phones, times = list(utterance.schedule.phones), utterance.schedule.times.tolist()
    start, end = times[phone], times[phone + 1]
    if end - start < 2 * SHORTEST:
        raise UserError(f"There is no room in {phones[phone]} for another phone: make it longer first.")
    phones.insert(phone + after, name)
    times.insert(phone + 1, (start + end) / 2)
    return _with(utterance, phones, times)


def removed(utterance: Utterance, phone: int) -> Utterance:
    """Without phone i: the one before takes its time, or the one behind it where it is the first."""
    phones, times = list(utterance.schedule.phones), utterance.schedule.times.tolist()
    if len(phones) == 1:
        raise UserError("The last phone cannot be removed: rename it instead.")
    del phones[phone]
    del times[phone or 1]
    return _with(utterance, phones, times)


def _with(utterance: Utterance, phones: list[str], times: list[float]) -> Utterance:
    kept = [i for i, p in enumerate(phones) if not (i and p == SILENCE and phones[i - 1] == SILENCE)]
    schedule = Schedule([phones[i] for i in kept], [*(times[i] for i in kept), times[-1]])
    edges = schedule.times
    words = []
    for word in utterance.words:  # to the nearest boundaries that are left
        start, end = (float(edges[int(np.argmin(np.abs(edges - t)))]) for t in (word.start, word.end))
        if end > start:
            words.append(Word(word.text, start, end))
    return replace(utterance, schedule=schedule, words=tuple(words))


def _nudged(word: Word, before: float, after: float) -> Word:
    start = after if abs(word.start - before) < _SAME else word.start
    end = after if abs(word.end - before) < _SAME else word.end
    return Word(word.text, start, end) if end > start else word
