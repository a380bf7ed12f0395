"""Utterances as JSON: text, phones, times and words, and the name of the recording they belong to.

{"schema": "lipstitch.Utterance.1", "text": "…", "recording": "a.wav", "phones": […], "times": […],
"words": [["Hello", 0.1, 0.42], …]}; the recording lies beside the file and is never copied into it.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import msgspec

from ..errors import UserError
from ..schedule import Schedule
from ..speech.utterance import Utterance, Word
from .atomic import read_bytes, write_atomically
from .json_text import decode_json
from .schedule_json import MAX_BYTES

SCHEMA = "lipstitch.Utterance.1"


class _Record(msgspec.Struct):
    phones: list[str]
    times: list[float]
    words: list[tuple[str, float, float]] = []
    text: str = ""
    recording: str = ""


@dataclass(frozen=True, eq=False)
class Saved:
    """recording: the name of the sound's file, beside this one; "" when there is none."""

    text: str
    schedule: Schedule
    words: tuple[Word, ...]
    recording: str


def load(path: Path | str) -> Saved:
    """The utterance in a file; UserError names file and cure."""
    return parse(read_bytes(path, MAX_BYTES, "utterance"), str(path))


def parse(data: bytes, place: str) -> Saved:
    """As `load`, from bytes; `place` names the file in messages."""
    top = decode_json(data, place)
    if top.get("schema") != SCHEMA:
        raise UserError(f'{place} is not an utterance: it should say "schema": "{SCHEMA}". Choose another file.')
    try:
        record = msgspec.convert(top, _Record)
        schedule = Schedule(record.phones, record.times)
    except msgspec.ValidationError as error:
        raise UserError(f"{place}: {str(error)[:200].lower()}. Correct that value.") from error
    except UserError as error:
        raise UserError(f"{place}: {error}") from error
    words = tuple(Word(text, start, end) for text, start, end in record.words if end > start)
    name = record.recording
    return Saved(record.text, schedule, words, name if name == Path(name).name else "")


def dumps(utterance: Utterance, recording: str = "") -> str:
    """The file's text, times to the microsecond."""
    top = {
        "schema": SCHEMA,
        "text": utterance.text,
        "recording": recording,
        "phones": list(utterance.schedule.phones),
        "times": [round(t, 6) for t in utterance.schedule.times.tolist()],
        "words": [[word.text, round(word.start, 6), round(word.end, 6)] for word in utterance.words],
    }
    return json.dumps(top, ensure_ascii=False) + "\n"


def save(path: Path | str, utterance: Utterance, recording: str = "") -> None:
    """Write it atomically; UserError when that fails."""
    write_atomically(path, dumps(utterance, recording))
