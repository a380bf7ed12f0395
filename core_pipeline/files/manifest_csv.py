"""The table of a batch: a line for each utterance, as CSV with a header.

Columns, in any order: text, audio, transcript, labels, voice, name. Others are left alone. Comma,
semicolon or tab; any encoding a spreadsheet writes.
"""

from __future__ import annotations

import csv
import io
import re
from dataclasses import dataclass
from pathlib import Path

from ..errors import UserError
from .atomic import read_bytes
from .json_text import shown
from .labels.text import decode

COLUMNS = ("text", "audio", "transcript", "labels", "voice")
MAX_BYTES = 64 * 2**20
#: Characters no file system likes in a name.
_FORBIDDEN = re.compile(r'[<>:"/\\|?*\x00-\x1f]')


@dataclass(frozen=True)
class Row:
    """One line: its number in the file, the name of what it makes, and its cells by column."""

    line: int
    name: str
    cells: dict[str, str]


def load(path: Path) -> list[Row]:
    """The lines of a manifest, each with a name of its own. UserError names line and cure."""
    text = decode(read_bytes(path, MAX_BYTES, "manifest"), str(path), "manifest")
    head = text.lstrip("\n").split("\n", 1)[0]
    delimiter = max(",;\t", key=head.count)
    try:
        reader = csv.DictReader(io.StringIO(text.replace("\0", "")), delimiter=delimiter, restval="", restkey="")
        columns = [(name or "").strip().lower() for name in reader.fieldnames or ()]
        reader.fieldnames = columns
        if not {"text", "audio", "labels"} & set(columns):
            raise UserError(f"{path}: the first line should name its columns, such as name,audio,transcript.")
        rows = [(reader.line_num, {c: str(row.get(c) or "").strip() for c in (*COLUMNS, "name")}) for row in reader]
    except csv.Error as error:
        raise UserError(f"{path} is a damaged table ({error}): save it as CSV again.") from None
    filled = [(line, cells) for line, cells in rows if any(cells.values())]
    if not filled:
        raise UserError(f"{path} has no lines below its header: add one for each utterance.")
    return _named(filled, path)


def _named(rows: list[tuple[int, dict[str, str]]], path: Path) -> list[Row]:
    taken: dict[str, int] = {}
    found = []
    for line, cells in rows:
        wanted = cells.pop("name") or Path(cells["audio"] or cells["labels"]).stem or f"line-{line:05d}"
        name = _FORBIDDEN.sub("_", wanted).strip(". ")[:120] or f"line-{line:05d}"
        if (before := taken.get(name.lower())) is not None:
            raise UserError(f"{path}: the lines {before} and {line} are both named “{shown(name)}”: name them apart.")
        taken[name.lower()] = line
        found.append(Row(line, name, cells))
    return found
