"""Which letters of a word stand for which of its phones: "fat", f ae t → "f" "a" "t".

A best alignment by the rules that speech/letters.py reads with, the other way round. For showing a bigram in a
word; never for speaking.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from .letters import RULES
from .utterance import Utterance

#: First letter, and one behind the last.
Span = tuple[int, int]

#: What it costs to leave a letter silent, to sound a phone that no letter stands for, to spell it oddly.
_SILENT, _UNWRITTEN, _ODD = 2.0, 3.0, 1.5
_LONGEST = max(map(len, RULES))

#: Sounds that spelling tells apart badly.
_GROUPS = ("ae ah ax aa ao eh ih uh er", "ey eh ae", "iy ih", "uw uh w", "s z", "t d", "ow ao")
_ALIKE = {phone: group.split() for group in _GROUPS for phone in group.split()}


def _spells(grapheme: str, phones: tuple[str, ...]) -> float | None:
    """The cost of these letters for these phones; None when they cannot be."""
    known = RULES.get(grapheme)
    if known is None or len(known) != len(phones):
        return None
    costs = (0.0 if a == b else 0.5 if b in _ALIKE.get(a, ()) else 4.0 for a, b in zip(known, phones, strict=True))
    return sum(costs)


@lru_cache(1024)
def letters_of(word: str, phones: tuple[str, ...]) -> tuple[Span, ...]:
    """For each phone the span of its letters; empty spans for sounds that are not written.

    word  as written, of any case, with apostrophes or hyphens; phones are ARPAbet's
    """
    text, n, m = word.lower(), len(word), len(phones)
    best: list[list[tuple[float, int, int]]] = [[(float("inf"), 0, 0)] * (m + 1) for _ in range(n + 1)]
    best[0][0] = (0.0, 0, 0)

    def offer(i: int, j: int, cost: float, from_i: int, from_j: int) -> None:
        if cost < best[i][j][0]:
            best[i][j] = (cost, from_i, from_j)

    for i in range(n + 1):
        for j in range(m + 1):
            cost = best[i][j][0]
            if i < n:
                offer(i + 1, j, cost + (_SILENT if text[i].isalnum() else 0.0), i, j)
            if j < m:
                offer(i, j + 1, cost + _UNWRITTEN, i, j)
            if i < n and j < m and text[i].isalnum():
                offer(i + 1, j + 1, cost + 2 * _ODD, i, j)
            for size in range(1, min(_LONGEST, n - i) + 1):
                known = RULES.get(text[i : i + size])
                if known is not None and j + len(known) <= m:
                    spelt = _spells(text[i : i + size], tuple(phones[j : j + len(known)]))
                    if spelt is not None:
                        offer(i + size, j + len(known), cost + spelt, i, j)
    spans: list[Span] = []
    i, j = n, m
    while i or j:
        _, from_i, from_j = best[i][j]
        spans[:0] = [(from_i, i)] * (j - from_j)
        i, j = from_i, from_j
    return tuple(spans)


def in_words(utterance: Utterance) -> list[tuple[str, Span]]:
    """Where each bigram of an utterance stands in its text: ("fat", (0, 2)), ("cats often", (3, 6)).

    For the phones i and i + 1 the word or the two words in which they sound, and the span of their letters;
    ("", (0, 0)) outside of every word.
    """
    schedule = utterance.schedule
    middles = (schedule.times[1:] + schedule.times[:-1]) / 2
    places: list[tuple[int, Span] | None] = [None] * len(schedule)
    for number, word in enumerate(utterance.words):
        inside = np.flatnonzero((middles >= word.start) & (middles <= word.end)).tolist()
        spans = letters_of(word.text, tuple(schedule.phones[i] for i in inside))
        for i, span in zip(inside, spans, strict=True):
            places[i] = number, span
    return [_joined(utterance, [place for place in places[i : i + 2] if place]) for i in range(len(schedule) - 1)]


def _joined(utterance: Utterance, found: Sequence[tuple[int, Span]]) -> tuple[str, Span]:
    if not found:
        return "", (0, 0)
    (first, start), (last, end) = found[0], found[-1]
    text = utterance.words[first].text
    if first == last:
        return text, (start[0], end[1])
    return f"{text} {utterance.words[last].text}", (start[0], len(text) + 1 + end[1])
