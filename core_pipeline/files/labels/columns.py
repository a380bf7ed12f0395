"""Label files of one interval a line: HTK (100 ns), TIMIT (samples), ESPS and Festival (end times), Audacity (seconds).

They share an ending and differ in their numbers; `is_…` and the size of the numbers tell them apart.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Sequence
from itertools import pairwise
from statistics import median

from ...errors import UserError
from ..json_text import shown
from .label_file import MOST, Interval, LabelFile, make

#: TIMIT's own rate, in samples per second.
TIMIT_RATE = 16000
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
#: Seconds given to a last label whose end is not written.
_LAST = 0.1


def parse(text: str, place: str, ending: str, rate: int | None) -> LabelFile:
    """Any of them. ending: of the file's name, small letters. rate: samples per second, for TIMIT."""
    lines = [line.strip() for line in text.split("\n")]
    if lines and lines[0].startswith("#!MLF!#"):
        return _master(lines, place, rate)
    if "#" in lines[:200] and not _looks_like_intervals(lines[: lines.index("#")]):
        return _esps(lines[lines.index("#") + 1 :], place)
    head = lines[0].lower().replace(" ", "") if lines else ""
    if head.startswith("begin,end,label"):
        return _table_of_mfa(text, place)
    return _intervals([line for line in lines if line and not line.startswith(("#", "//", ";"))], place, ending, rate)


def _looks_like_intervals(lines: Sequence[str]) -> bool:
    return any(len(_numbers(line.split())) >= 2 for line in lines)


def _numbers(columns: Sequence[str]) -> list[str]:
    """The leading columns that are numbers, at most two."""
    count = 0
    while count < min(2, len(columns)) and _NUMBER.fullmatch(columns[count]):
        count += 1
    return list(columns[:count])


def _esps(lines: Sequence[str], place: str) -> LabelFile:
    """After the line "#": end time in seconds, a colour, the label."""
    phones: list[Interval] = []
    start = 0.0
    for number, line in enumerate(lines[:MOST], 1):
        columns = line.split(";")[0].split()
        if not columns:
            continue
        if not _NUMBER.fullmatch(columns[0]):
            raise UserError(f"{place}: label {number} (“{shown(line)}”) does not begin with a time: mend that line.")
        end = float(columns[0])
        has_colour = len(columns) > 2 or (len(columns) == 2 and _NUMBER.fullmatch(columns[1]))
        name = " ".join(columns[2:] if has_colour else columns[1:])
        phones.append(Interval(start, end, name))
        start = max(start, end)
    if not phones:
        raise UserError(f"{place} holds no labels: choose another file.")
    return make("ESPS label file", phones)


def _intervals(lines: Sequence[str], place: str, ending: str, rate: int | None) -> LabelFile:
    rows = [line.split("\t") if line.count("\t") >= 2 else line.split() for line in lines[:MOST]]
    rows = [[column.strip() for column in row if column.strip()] for row in rows]
    counts = [len(_numbers(row)) for row in rows]
    if not rows or max(counts) == 0:
        raise UserError(
            f"{place} is no label file that is known here: choose a TextGrid, an HTK, ESPS or TIMIT label file."
        )
    for number, (row, count) in enumerate(zip(rows, counts, strict=True), 1):
        if count == 0:
            line = shown(" ".join(row))
            raise UserError(f"{place}: label {number} (“{line}”) does not begin with a time: mend that line.")
    unit, kind, notes = _unit(rows, counts, ending, rate)
    starts = [float(row[0]) * unit for row in rows]
    if max(counts) == 1 and starts[0] > 0 and kind == "label file in seconds":  # ends, as Festival writes them
        starts, ends = [0.0, *starts[:-1]], starts
    else:
        following = [*starts[1:], starts[-1] + _LAST]
        ends = [
            float(row[1]) * unit if count == 2 else after
            for row, count, after in zip(rows, counts, following, strict=True)
        ]
    phones, words = [], []
    for row, count, start, end in zip(rows, counts, starts, ends, strict=True):
        names = [name for name in row[count:] if not _NUMBER.fullmatch(name)] or row[count : count + 1] or [""]
        if kind.startswith("HTK"):
            phones.append(Interval(start, end, _htk_name(names[0])))
            if len(names) > 1:  # the word begins at its first phone
                words.append(Interval(start, end, names[1].strip('"')))
        else:
            phones.append(Interval(start, end, " ".join(row[count:])))
    return make(kind, phones, _until_next(words, ends[-1]), notes=notes)


def _unit(
    rows: Sequence[Sequence[str]], counts: Sequence[int], ending: str, rate: int | None
) -> tuple[float, str, list[str]]:
    """Seconds of one unit of the numbers, the format's name, notes."""
    if any("." in number for row, count in zip(rows, counts, strict=True) for number in row[:count]):
        return 1.0, "label file in seconds", []
    times = [float(row[0]) for row in rows]
    steps = [b - a for a, b in pairwise(times) if b > a]
    typical = median(steps) if steps else float(rows[0][1]) - times[0] if counts[0] == 2 else 0.0
    # a phone of 20 ms to 0.5 s is 200,000 to 5,000,000 units of HTK, 160 to 24,000 samples
    if typical >= 50_000 or (ending in (".lab", ".mlf", ".rec") and typical > 30_000):
        return 1e-7, "HTK label file", []
    samples = rate or TIMIT_RATE
    note = [] if rate else [f"Times were taken as samples at {samples} per second, as in TIMIT."]
    return 1 / samples, "TIMIT label file", note


def _htk_name(name: str) -> str:
    """The phone in the middle: "dh-ax+k" → ax, "x^x-sil+dh=ax@…" → sil, "s2[3]" → s2."""
    name = name.strip("\"'")
    name = re.sub(r"\[\d+\]$", "", name)
    if re.fullmatch(r"[^\s^]+\^[^\s-]+-[^\s+]+\+.*", name):  # HTS full context
        name = name.split("-", 1)[1]
        return name.split("+", 1)[0]
    if len(name) > 1 and "-" in name[1:-1]:
        name = name.split("-", 1)[1]
    if len(name) > 1 and "+" in name[1:]:
        name = name.split("+", 1)[0]
    return name


def _until_next(words: Sequence[Interval], end: float) -> list[Interval]:
    """Words last until the next one."""
    ends = [*(word.start for word in words), end][1:]
    spans = [word._replace(end=stop) for word, stop in zip(words, ends, strict=True)]
    return [word for word in spans if word.name.lower() not in ("sil", "sp", "silence", "sent-start", "sent-end")]


def _master(lines: Sequence[str], place: str, rate: int | None) -> LabelFile:
    """HTK's master label file: the first of its sections."""
    sections: list[list[str]] = []
    for line in lines[1:]:
        if line.startswith('"'):
            sections.append([])
        elif line and line != "." and sections:
            sections[-1].append(line)
    filled = [section for section in sections if section]
    if not filled:
        raise UserError(f"{place} holds no labels: choose another file.")
    found = _intervals(filled[0], place, ".mlf", rate)
    if len(filled) == 1:
        return found
    note = f"The file holds {len(filled)} utterances: the first one was taken."
    return make(found.kind, found.phones, found.words, notes=[*found.notes, note])


def _table_of_mfa(text: str, place: str) -> LabelFile:
    """MFA's CSV: Begin, End, Label, Type, Speaker."""
    phones: list[Interval] = []
    words: list[Interval] = []
    try:
        for row in csv.DictReader(io.StringIO(text.replace("\0", ""))):
            kind = (row.get("Type") or "phones").strip().lower()
            interval = Interval(float(row["Begin"]), float(row["End"]), (row["Label"] or "").strip())
            (words if kind.startswith("word") else phones).append(interval)
    except (csv.Error, ValueError, TypeError, KeyError) as error:
        raise UserError(f"{place} is a damaged table of labels ({shown(str(error))}): export it again.") from None
    if not phones:
        raise UserError(f"{place} holds no phones: export it with phones.")
    return make("MFA table", phones, words)
