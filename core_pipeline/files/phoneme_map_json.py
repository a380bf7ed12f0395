"""Phoneme maps as JSON: which phones of a language count as the same, and the set they become (table 1).

{"schema": "lipstitch.PhonemeMap.1", "name": "…", "note": "…", "phonemes": ["ah", …], "map": {"ae": "ah", …}}
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

import msgspec

from ..errors import UserError
from ..phonemes import SILENCE
from .atomic import read_bytes, write_atomically
from .json_text import decode_json, shown

SCHEMA = "lipstitch.PhonemeMap.1"
MAX_BYTES = 2**20


class _Record(msgspec.Struct):
    phonemes: list[str]
    map: dict[str, str]
    name: str = "Untitled"
    note: str = ""


@dataclass(frozen=True)
class PhonemeMap:
    """phonemes: the common set. table: language phone → one of them. note: where it comes from."""

    name: str
    phonemes: tuple[str, ...]
    table: Mapping[str, str]
    note: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "table", MappingProxyType(dict(self.table)))


def load(path: Path | str) -> PhonemeMap:
    """The map in a file; UserError names file, phone and cure."""
    return parse(read_bytes(path, MAX_BYTES, "phoneme map"), str(path))


def parse(data: bytes, place: str) -> PhonemeMap:
    """As `load`, from bytes; `place` names the file in messages."""
    top = decode_json(data, place)
    if top.get("schema") != SCHEMA:
        raise UserError(f'{place} is not a phoneme map: it should say "schema": "{SCHEMA}". Choose another file.')
    try:
        record = msgspec.convert(top, _Record)
    except msgspec.ValidationError as error:
        raise UserError(f"{place}: {str(error)[:200].lower()}. Correct that value.") from error
    found = PhonemeMap(record.name, tuple(record.phonemes), record.map, record.note)
    check(found, place)
    return found


def check(found: PhonemeMap, place: str) -> None:
    """UserError when phones are named twice, are no names, or lead to a phoneme the set does not have."""
    seen: set[str] = set()
    for phone in found.phonemes:
        if not phone.strip() or phone != phone.strip() or "-" in phone or phone == SILENCE:
            raise UserError(f"{place}: “{shown(phone)}” cannot be a phoneme: use letters, without blanks and hyphens.")
        if phone in seen:
            raise UserError(f"{place} lists the phoneme “{shown(phone)}” twice: remove one.")
        seen.add(phone)
    if not seen:
        raise UserError(f"{place} lists no phonemes: write at least one.")
    for phone, common in found.table.items():
        if common not in seen and common != SILENCE:
            raise UserError(
                f"{place}: “{shown(phone)}” leads to “{shown(common)}”, which is not among its phonemes: "
                f"write one of {shown(' '.join(found.phonemes), 300)}."
            )


def dumps(found: PhonemeMap) -> str:
    """The file's text."""
    top = {
        "schema": SCHEMA,
        "name": found.name,
        "note": found.note,
        "phonemes": list(found.phonemes),
        "map": dict(found.table),
    }
    return json.dumps(top, ensure_ascii=False, indent=1) + "\n"


def save(found: PhonemeMap, path: Path | str) -> None:
    """Write it atomically; UserError when that fails."""
    check(found, str(path))
    write_atomically(path, dumps(found))
