"""The journal of unsaved work: a file that only grows, a line a gesture, so that a crash can cost a second at most.

The first line holds the whole set, each further one the bigrams that a gesture changed. A line that a crash cut
short is passed over; everything before it counts.
"""

from __future__ import annotations

import errno
import json
import os
from collections.abc import Collection, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from core_pipeline.curve_set import CurveSet
from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json
from core_pipeline.files.atomic import read_bytes, reason, write_atomically
from core_pipeline.phonemes import Pair, pair_name

SCHEMA = "lipstitch.Journal.1"
#: A journal that has grown to this is begun anew with the whole set.
LONG = 4 * 2**20
_MAX_BYTES = 64 * 2**20


@dataclass(frozen=True)
class Kept:
    """What a journal holds: the set, its own file if any, and the digest of what that file held."""

    curve_set: CurveSet
    path: Path | None
    digest: str


def begin(file: Path, kept: Kept) -> None:
    """A new journal in place of any old one. UserError when it cannot be written."""
    path = str(kept.path) if kept.path is not None else None
    head = {"schema": SCHEMA, "path": path, "digest": kept.digest, "set": _text(kept.curve_set)}
    write_atomically(file, json.dumps(head, ensure_ascii=False) + "\n")


def add(file: Path, curve_set: CurveSet, pairs: Collection[Pair]) -> None:
    """One more line: what became of these bigrams, and of the settings. UserError when it cannot be written."""
    own = {pair: curve_set.own[pair] for pair in pairs if pair in curve_set.own}
    changed = replace(curve_set, bigrams=own, base=None, below=None, aside={}, extra={})
    line: dict[str, Any] = {"set": _text(changed), "gone": [pair_name(pair) for pair in pairs if pair not in own]}
    if curve_set.settings is None:
        line["settings"] = None
    data = json.dumps(line, ensure_ascii=False).encode() + b"\n"
    try:
        with file.open("ab", buffering=0) as journal:
            whole = journal.tell()
            try:
                if journal.write(data) < len(data):
                    raise OSError(errno.ENOSPC, "")
                os.fsync(journal.fileno())
            except OSError:
                journal.truncate(whole)  # half a line would spoil the next
                raise
    except OSError as error:
        raise UserError(f"Cannot write {file}: {reason(error)}.") from error


def read(file: Path) -> Kept:
    """The set as the journal's last whole line leaves it; UserError when there is no whole set."""
    lines = _lines(read_bytes(file, _MAX_BYTES, "journal"))
    head = next(lines, {})
    if head.get("schema") != SCHEMA or not isinstance(head.get("set"), str):
        raise UserError(f"{file} is no journal of Lipstitch: choose another file.")
    path = Path(head["path"]) if isinstance(head.get("path"), str) else None
    curve_set = _first(_bytes(head["set"]), file, path.parent if path is not None else None)
    for line in lines:
        text, gone = line.get("set"), line.get("gone")
        if not (isinstance(text, str) and isinstance(gone, list)):
            break
        try:
            changed = curve_set_json.parse(_bytes(text), str(file)).curve_set
        except UserError:  # a damaged line: what was written before it counts
            break
        for pair, bigram in changed.bigrams.items():
            curve_set = curve_set.with_bigram(pair, bigram)
        for name in gone:
            first, _, second = str(name).partition("-")
            curve_set = curve_set.with_bigram((first, second), None)
        curve_set = replace(curve_set, settings=None if "settings" in line else changed.settings)
    return Kept(curve_set, path, str(head.get("digest", "")))


def _first(data: bytes, file: Path, folder: Path | None) -> CurveSet:
    """The whole set of the first line; where its base has gone meanwhile, what was its own, standing alone."""
    try:
        return curve_set_json.parse(data, str(file), folder).curve_set
    except UserError:
        top = next(_lines(data + b"\n"), {})
        if not top.pop("base", None):
            raise
        return curve_set_json.parse(json.dumps(top).encode(), str(file)).curve_set


def _lines(data: bytes) -> Iterator[dict[str, Any]]:
    """The whole lines; the last counts only when its end was written too."""
    for line in data.split(b"\n")[:-1]:
        try:
            value = json.loads(line)
        except (ValueError, RecursionError):
            return
        if not isinstance(value, dict):
            return
        yield value


def _bytes(text: str) -> bytes:
    """For the reader of sets, which refuses half a character."""
    return text.encode("utf-8", "surrogatepass")


def _text(curve_set: CurveSet) -> str:
    return curve_set_json.dumps(curve_set, minified=True)
