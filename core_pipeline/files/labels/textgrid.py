"""Praat's TextGrid, long and short, as Praat, MFA, WebMAUS and others write it.

Read as Praat reads it: strings in quotes and numbers standing free are the data, every other word is
decoration. So both forms are one, and a file that ends early gives what it holds.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from ...errors import UserError
from ...phonemes import SILENCE
from ...schedule import Schedule
from ...speech.phone_names import alphabet_of, translated
from ...speech.utterance import Word
from ..atomic import write_atomically
from ..json_text import shown
from .label_file import MOST, Interval, LabelFile, make

#: A string (quotes in it are doubled), a comment, or a word.
_TOKEN = re.compile(r'"([^"]*+(?:""[^"]*+)*+)"|(![^\n]*)|([^\s"=!]+)')
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
_PHONES = re.compile(r"phon|seg|^mau$|^kas$|^phn$|[-_ .]mau$|allophon", re.IGNORECASE)
_WORDS = re.compile(r"word|^ort|[-_ .]ort|^wrd$|orthograph|^mot", re.IGNORECASE)


@dataclass
class _Tier:
    name: str
    intervals: list[Interval]


def is_textgrid(text: str) -> bool:
    """Whether this is one, by its header or its tiers."""
    head = text[:2000]
    return "ooTextFile" in head or '"TextGrid"' in head or '"IntervalTier"' in head


def parse(text: str, place: str) -> LabelFile:
    """Phones and words of the tiers that hold them. UserError names the cure."""
    if "chronological TextGrid" in text[:300]:
        raise UserError(f"{place} is a chronological TextGrid: save it from Praat as a text file.")
    tokens = list(_tokens(text))
    starts = [i for i, token in enumerate(tokens) if token in ("IntervalTier", "TextTier")]
    span = [token for token in tokens[: starts[0] if starts else 0] if isinstance(token, float)][:2]
    notes = []
    tiers = []
    for at in starts:
        if tokens[at] == "IntervalTier" and at + 1 < len(tokens):
            tier, whole = _tier(tokens, at)
            tiers.append(tier)
            if not whole:
                notes.append(f"The tier “{shown(tier.name)}” is cut off: what is there was read.")
    if not any(tier.intervals for tier in tiers):
        raise UserError(f"{place} has no interval tier with labels: choose a TextGrid with a tier of phones.")
    phones, words = _choose([tier for tier in tiers if tier.intervals], place, notes)
    return make("Praat TextGrid", phones, words, (span[0], span[1]) if len(span) == 2 else None, notes)


def _tokens(text: str) -> Iterator[str | float]:
    for match in _TOKEN.finditer(text):
        string, _, word = match.groups()
        if string is not None:
            yield string.replace('""', '"')
        elif word is not None and _NUMBER.fullmatch(word):
            yield float(word)


def _tier(tokens: Sequence[str | float], at: int) -> tuple[_Tier, bool]:
    """The tier whose class stands at `at`, and whether all its intervals are there."""
    name = str(tokens[at + 1])
    head = tokens[at + 2 : at + 5]
    if len(head) < 3 or not all(isinstance(token, float) for token in head):
        return _Tier(name, []), False
    count = float(head[2])
    tier = _Tier(name, [])
    i = at + 5
    while len(tier.intervals) < min(count, MOST) and i + 2 < len(tokens):
        start, end, label = tokens[i : i + 3]
        if not (isinstance(start, float) and isinstance(end, float) and isinstance(label, str)):
            break
        tier.intervals.append(Interval(start, end, label.strip()))
        i += 3
    return tier, len(tier.intervals) >= count


def _choose(tiers: Sequence[_Tier], place: str, notes: list[str]) -> tuple[list[Interval], list[Interval]]:
    """The tiers of phones and of words: by name, else the one whose labels are phones of an alphabet."""
    phones = [tier for tier in tiers if _PHONES.search(tier.name) and not _WORDS.search(tier.name)]
    phones = [tier for tier in phones if _known_part(tier) > 0.3] or phones  # canonical forms of words are none
    if not phones:
        phones = [tier for tier in tiers if _known_part(tier) > 0.6]
    if not phones and len(tiers) == 1:
        phones = list(tiers)
    if not phones:
        names = ", ".join(shown(tier.name) for tier in tiers[:8])
        raise UserError(f"{place} has no tier of phones among {names}: name that tier “phones”.")
    best = max(phones, key=lambda tier: (round(_known_part(tier), 1), sum(bool(i.name) for i in tier.intervals)))
    if len(phones) > 1:
        notes.append(f"Of {len(phones)} tiers with phones, “{shown(best.name)}” was taken.")
    words = [tier for tier in tiers if tier is not best and _WORDS.search(tier.name)]
    speaker = re.sub(_PHONES, "", best.name).split("-")[0].strip()
    words.sort(key=lambda tier: not tier.name.startswith(speaker))
    return best.intervals, words[0].intervals if words else []


def _known_part(tier: _Tier) -> float:
    """How many of the distinct labels are phones of some alphabet, 0…1."""
    names = [i.name for i in tier.intervals if i.name]
    if not names:
        return 0.0
    found, unknown = translated(names, {})
    return 1 - len(unknown) / len(found) if alphabet_of(names) else 0.0


def dumps(schedule: Schedule, words: Sequence[Word]) -> str:
    """A long TextGrid with the tiers "words" and "phones", silence as the empty label."""
    phones = [
        Interval(float(a), float(b), "" if phone == SILENCE else phone)
        for phone, a, b in zip(schedule.phones, schedule.times, schedule.times[1:], strict=False)
    ]
    spoken = _filled([Interval(w.start, w.end, w.text) for w in words], schedule.start, schedule.end)
    tiers = [("words", spoken), ("phones", phones)]
    lines = ['File type = "ooTextFile"', 'Object class = "TextGrid"', ""]
    lines += [f"xmin = {schedule.start:.6f} ", f"xmax = {schedule.end:.6f} "]
    lines += ["tiers? <exists> ", f"size = {len(tiers)} ", "item []: "]
    for number, (name, intervals) in enumerate(tiers, 1):
        lines += [f"    item [{number}]:", '        class = "IntervalTier" ', f'        name = "{name}" ']
        lines += [f"        xmin = {schedule.start:.6f} ", f"        xmax = {schedule.end:.6f} "]
        lines.append(f"        intervals: size = {len(intervals)} ")
        for i, interval in enumerate(intervals, 1):
            label = interval.name.replace('"', '""')
            lines += [f"        intervals [{i}]:", f"            xmin = {interval.start:.6f} "]
            lines += [f"            xmax = {interval.end:.6f} ", f'            text = "{label}" ']
    return "\n".join(lines) + "\n"


def save(path: Path | str, schedule: Schedule, words: Sequence[Word] = ()) -> None:
    """Write it atomically; UserError when that fails."""
    write_atomically(path, dumps(schedule, words))


def _filled(intervals: Sequence[Interval], start: float, end: float) -> list[Interval]:
    """Praat wants no gaps and no overlaps."""
    filled: list[Interval] = []
    reached = start
    for interval in sorted(intervals):
        first, last = max(interval.start, reached), min(interval.end, end)
        if last - first < 1e-6:
            continue
        if first - reached > 1e-6:
            filled.append(Interval(reached, first, ""))
        else:
            first = reached
        filled.append(Interval(first, last, interval.name))
        reached = last
    if end - reached > 1e-6 or not filled:
        filled.append(Interval(reached, end, ""))
    return filled
