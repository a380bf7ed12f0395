"""Live Link Face and other ARKit recordings as CSV.

    Timecode,BlendshapeCount,EyeBlinkLeft,…,TongueOut,HeadYaw,…        63 columns
    19:10:54:53.879,61,0.05,…
    19:10:54:57.882,0                                                  the face was lost

The frame field of the timecode counts in 60ths even where the camera runs at 30, so a row's number tells nothing of
its time; the timecodes do. Where even they contradict the clock, the rows of each second are spread evenly over it.
Other programs write camelCase, `time` or `frame` columns, per cent, or semicolons: all of that is read.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import UserError
from ..files.atomic import open_to_read, read_bytes
from ..files.json_text import shown
from .capture import Capture, even

Array = NDArray[np.float64]

MAX_BYTES = 512 * 2**20
MAX_COLUMNS = 2000
#: Columns that tell the time, in the order in which they are believed.
_CLOCKS = ("timecode", "time", "timestamp", "seconds", "timeseconds", "frame", "framenumber")
_NO_SHAPES = {"blendshapecount", *_CLOCKS}
_TIMECODE = re.compile(r"\s*(\d{1,2}):(\d{1,2}):(\d{1,2})(?:[:;.](\d+(?:\.\d+)?))?\s*")
#: What the frame field of a timecode may count in.
_BASES = (24, 25, 30, 48, 50, 60, 100, 120, 240, 1000)
#: Used when the column counts frames and nothing says how fast.
_ASSUMED = 60.0
_DAY = 86_400.0


def load(path: Path, *, points: bool = False) -> Capture:
    """The capture in a file; UserError names file, line and cure.

    points  the columns are places in any unit, not shapes from 0 to 1
    """
    return parse(read_bytes(path, MAX_BYTES, "capture"), str(path), points=points)


def parse(data: bytes, place: str, *, points: bool = False) -> Capture:
    """As `load`, from bytes; `place` names the file in messages."""
    header, rows = _table(data, place)
    plain = [re.sub(r"[\s_\-()]", "", name).casefold() for name in header]
    clock = next((plain.index(name) for name in _CLOCKS if name in plain), None)
    if clock is None:
        raise UserError(f"{place} has no column Timecode or time: choose a Live Link Face or ARKit recording.")
    columns = [i for i, name in enumerate(plain) if name and name not in _NO_SHAPES]
    if not columns:
        raise UserError(f"{place} has no column of a blendshape: choose a Live Link Face or ARKit recording.")
    count = plain.index("blendshapecount") if "blendshapecount" in plain else None
    notes: list[str] = []
    values = np.full((len(rows), len(columns)), np.nan)
    for i, (line, row) in enumerate(rows):
        if len(row) > len(header):
            raise UserError(f"{place}: line {line} has {len(row)} columns, the first line {len(header)}. Correct it.")
        if len(row) == len(header) and (count is None or row[count] not in ("0", "")):  # else the face was lost
            values[i] = [_number(row[c], place, line) for c in columns]
    times = _times([row[clock] for _, row in rows], plain[clock], [line for line, _ in rows], notes, place)
    values[np.abs(values) > 1e6] = np.nan
    top = np.nanmax(np.abs(values)) if np.isfinite(values).any() else 0.0
    if 1.5 < top <= 110 and not points:
        values /= 100.0
        notes.append("The values are per cent; they were divided by 100.")
    order = np.argsort(times, kind="stable")
    unique = np.concatenate(([True], np.diff(times[order]) > 1e-6))
    if not unique.all():
        notes.append(f"{int((~unique).sum())} rows have the time of another; the first of each is taken.")
    order = order[unique]
    times = times[order] - times[order[0]]
    return even(tuple(header[c] for c in columns), times, values[order], notes, place)


def is_capture(header: Sequence[str]) -> bool:
    """Whether a table's first line is that of a capture rather than of weights over poses."""
    plain = {re.sub(r"[\s_\-()]", "", name).casefold() for name in header}
    return bool(plain & {"timecode", "blendshapecount"}) or "jawopen" in plain


def header_of(path: Path) -> list[str]:
    """The first line's cells; empty when the file cannot be read as a table."""
    try:
        with open_to_read(path) as file:
            first = file.readline(100_000).decode("utf-8-sig", "replace")
    except OSError:
        return []
    return next(csv.reader([first], delimiter=_delimiter(first)), [])


def _table(data: bytes, place: str) -> tuple[list[str], list[tuple[int, list[str]]]]:
    """The header, and (line number, cells) of every row."""
    encoding = "utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig"
    try:
        text = data.decode(encoding)
        reader = csv.reader(io.StringIO(text, newline=""), delimiter=_delimiter(text[: text.find("\n") + 1] or text))
        rows = [(reader.line_num, [cell.strip() for cell in row]) for row in reader if any(c.strip() for c in row)]
    except (UnicodeDecodeError, csv.Error) as error:
        raise UserError(f"{place} is not a table in UTF-8 ({str(error)[:80]}): export it as CSV again.") from error
    if len(rows) < 2:
        raise UserError(f"{place} has no row of a recording: choose another file.")
    header = rows[0][1]
    while header and not header[-1]:  # a comma at the end of the line
        header.pop()
    if len(header) > MAX_COLUMNS:
        raise UserError(f"{place} has {len(header)} columns, more than a face: choose another file.")
    width = len(header)
    return header, [(line, row[:width] if not any(row[width:]) else row) for line, row in rows[1:]]


def _delimiter(line: str) -> str:
    return max(",;\t", key=line.count)


def _number(cell: str, place: str, line: int) -> float:
    """A value; NaN where there is none, a decimal comma is understood."""
    if not cell or cell.casefold() in ("nan", "null", "none", "inf", "-inf"):
        return np.nan
    try:
        value = float(cell.replace(",", "."))
    except ValueError:
        raise UserError(f"{place}: line {line} holds “{shown(cell)}” where a number belongs. Correct it.") from None
    return value if np.isfinite(value) else np.nan


def _times(cells: list[str], clock: str, lines: list[int], notes: list[str], place: str) -> Array:
    """(rows,) seconds, rising apart from damage."""
    matches = [_TIMECODE.fullmatch(cell) for cell in cells]
    if all(matches):
        return _timecodes([m.groups() for m in matches if m], notes)
    values = np.array([_number(cell, place, line) for cell, line in zip(cells, lines, strict=True)])
    odd = np.flatnonzero(~np.isfinite(values))
    if odd.size or any(m for m in matches):
        line = lines[int(odd[0])] if odd.size else lines[next(i for i, m in enumerate(matches) if not m)]
        raise UserError(f"{place}: line {line} has no readable time. Correct or remove it.")
    if clock.startswith("frame"):
        notes.append(f"Only frames are counted; {_ASSUMED:g} a second are assumed.")
        return values / _ASSUMED
    step = float(np.median(np.diff(values))) if values.size > 1 else 0.0
    for unit, name in ((1e9, "nanoseconds"), (1e6, "microseconds"), (1e3, "milliseconds")):
        if 0.002 * unit <= step <= unit:
            notes.append(f"The times are taken as {name}.")
            return values / unit
    return values


def _timecodes(parts: Sequence[tuple[str | None, ...]], notes: list[str]) -> Array:
    whole = np.array([int(h or 0) * 3600 + int(m or 0) * 60 + int(s or 0) for h, m, s, _ in parts], np.float64)
    frame = np.array([float(f or 0) for *_, f in parts])
    jumps = np.flatnonzero(np.diff(whole) < -_DAY / 2)
    for jump in jumps:  # past midnight
        whole[jump + 1 :] += _DAY
    top = frame.max(initial=0.0)
    base = next((b for b in _BASES if top < b), top + 1)
    base = 60 if base < 60 and not _fills(whole, frame, base) else base
    times = whole + frame / base
    seconds, per_second = np.unique(whole, return_counts=True)
    if seconds.size < 4:  # the first and the last are not full
        return times
    rate = float(per_second[1:-1].max())  # in some seconds rows may be lacking
    steps = np.diff(times)
    if steps.min(initial=0.0) >= 0 and abs(float(np.median(steps)) * rate - 1.0) <= 0.1:
        return times
    notes.append(f"The frames of the timecode contradict its seconds; {rate:g} rows a second are spread evenly.")
    return _spread(whole, seconds, per_second, rate)


def _fills(whole: Array, frame: Array, base: float) -> bool:
    """Whether the frame field really counts to `base`: some full second comes near its end."""
    inner = (whole > whole[0]) & (whole < whole[-1])
    return bool(inner.any()) and float(frame[inner].max()) >= base - 2.5


def _spread(whole: Array, seconds: Array, per_second: NDArray[np.intp], rate: float) -> Array:
    """The rows of each second evenly over it; those of the first second at its end."""
    times = np.empty(whole.size)
    at = 0
    for i, (second, count) in enumerate(zip(seconds.tolist(), per_second.tolist(), strict=True)):
        room = max(rate, float(count))
        shift = room - count if i == 0 else 0.0
        times[at : at + count] = second + (shift + np.arange(count)) / room
        at += count
    return times
