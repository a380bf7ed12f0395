"""How often pairs are said, as JSON: one row of the phoneme set a line.

{
  "schema": "lipstitch.Frequencies.1", "utterances": 211, "phonemes": ["ah", …],
  "counts": {
    "ah": {"d": 443, "bmp": 146, …},
    …
  }
}
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import msgspec

from ..errors import UserError
from ..statistics import Frequencies
from .atomic import read_bytes, write_atomically
from .json_text import decode_json

SCHEMA = "lipstitch.Frequencies.1"
MAX_BYTES = 4 * 2**20

_Count = Annotated[int, msgspec.Meta(ge=0, le=2**40)]


class FrequenciesRecord(msgspec.Struct):
    """The fields of the file."""

    phonemes: list[str]
    counts: dict[str, dict[str, _Count]]
    utterances: _Count = 0


def load(path: Path | str) -> Frequencies:
    """The table in a file; UserError names file and cure."""
    place = str(path)
    top = decode_json(read_bytes(path, MAX_BYTES, "table of frequencies"), place)
    if top.get("schema") != SCHEMA:
        raise UserError(f'{place} is no table of frequencies: it should say "schema": "{SCHEMA}".')
    try:
        record = msgspec.convert(top, FrequenciesRecord)
    except msgspec.ValidationError as error:
        raise UserError(f"{place}: {str(error)[:200].lower()}. Correct that value.") from error
    counts = {(a, b): n for a, row in record.counts.items() for b, n in row.items()}
    odd = sorted({phone for pair in counts for phone in pair} - set(record.phonemes))
    if odd:
        raise UserError(f'{place}: {odd[0][:60]!r} in "counts" is not among "phonemes"; correct it.')
    return Frequencies(tuple(record.phonemes), counts, record.utterances)


def save(frequencies: Frequencies, path: Path | str) -> None:
    """Write the table atomically; UserError when that fails."""
    rows = []
    for first in frequencies.phonemes:
        row = {b: n for (a, b), n in frequencies.counts.items() if a == first}
        if row:
            rows.append(f"    {_text(first)}: {_text(row)}")
    head = [
        f'  "schema": "{SCHEMA}", "utterances": {frequencies.utterances}',
        f'  "phonemes": {_text(list(frequencies.phonemes))}',
        f'  "counts": {{\n{",".join(chr(10) + r for r in rows).lstrip(chr(10))}\n  }}' if rows else '  "counts": {}',
    ]
    write_atomically(path, "{\n" + ",\n".join(head) + "\n}\n")


def _text(value: object) -> str:
    return json.dumps(value, ensure_ascii=False)
