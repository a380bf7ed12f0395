"""Schedules as JSON: {"schema": "lipstitch.Schedule.1", "phones": ["f","ah"], "times": [0.0, 0.1, 0.22]}."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import msgspec

from ..curve_set import CurveSet
from ..errors import UserError
from ..phonemes import SILENCE
from ..schedule import Schedule
from .atomic import read_bytes, write_atomically
from .json_text import decode_json, shown

SCHEMA = "lipstitch.Schedule.1"
MAX_BYTES = 64 * 2**20


class ScheduleRecord(msgspec.Struct):
    """n phones, n+1 times in seconds."""

    phones: list[str]
    times: list[float]


def load(path: Path | str, curve_set: CurveSet | None = None) -> Schedule:
    """The schedule in a file; UserError names file, phone and cure.

    curve_set  when given, every phone must be one of its phonemes, of its phoneme map, or `sil`
    """
    return parse(read_bytes(path, MAX_BYTES, "schedule"), str(path), curve_set)


def parse(data: bytes, place: str, curve_set: CurveSet | None = None) -> Schedule:
    """As `load`, from bytes; `place` names the file in messages."""
    top = decode_json(data, place)
    schema = top.get("schema")
    if schema != SCHEMA:
        raise UserError(f'{place} is not a schedule: it should say "schema": "{SCHEMA}". Choose another file.')
    try:
        record = msgspec.convert(top, ScheduleRecord)
    except msgspec.ValidationError as error:
        raise UserError(f"{place}: {str(error)[:200].lower()}. Correct that value.") from error
    try:
        schedule = Schedule(record.phones, record.times)
    except UserError as error:
        raise UserError(f"{place}: {error}") from error
    if curve_set is not None:
        _check_phones(schedule, curve_set, place)
    return schedule


def _check_phones(schedule: Schedule, curve_set: CurveSet, place: str) -> None:
    known = {*curve_set.phonemes, *curve_set.phoneme_map, SILENCE}
    for i, phone in enumerate(schedule.phones):
        if phone not in known:
            raise UserError(
                f"{place}: phone {i} is “{shown(phone)}”, which the curve set {curve_set.name!r} does not know; "
                f"write one of {' '.join(curve_set.phonemes)}, {SILENCE} or a phone of its map."
            )


def dumps(schedule: Schedule) -> str:
    """The file's text, times to the microsecond."""
    top: dict[str, Any] = {
        "schema": SCHEMA,
        "phones": list(schedule.phones),
        "times": [round(t, 6) for t in schedule.times.tolist()],
    }
    return json.dumps(top, ensure_ascii=False) + "\n"


def save(schedule: Schedule, path: Path | str) -> None:
    """Write the schedule atomically; UserError when that fails."""
    write_atomically(path, dumps(schedule))
