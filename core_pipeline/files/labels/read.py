"""Any label file → LabelFile: the format is found out from the content, the name only helps in doubt."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ...errors import UserError
from ...schedule import Schedule
from .. import schedule_json, utterance_json
from ..atomic import read_bytes
from ..json_text import decode_json
from . import columns, textgrid
from .label_file import Interval, LabelFile, make
from .text import decode

MAX_BYTES = 16 * 2**20
#: Endings of label files, of which .json may be something else too.
ENDINGS = (".textgrid", ".lab", ".phn", ".mlf", ".rec", ".phones", ".wrd", ".csv", ".txt")


def read(path: Path | str, rate: int | None = None) -> LabelFile:
    """Phones and words of a label file; TIMIT's words are looked for beside its phones.

    rate  samples per second of the recording, for times written in samples
    UserError names file and cure.
    """
    path = Path(path)
    found = parse(read_bytes(path, MAX_BYTES, "label file"), str(path), path.suffix.lower(), rate)
    if not found.phones:
        raise UserError(f"{path} holds no labels with a length: choose another file.")
    if found.words or path.suffix.lower() != ".phn":
        return found
    beside = next((p for p in (path.with_suffix(".wrd"), path.with_suffix(".WRD")) if p.is_file()), None)
    if beside is None:
        return found
    words = parse(read_bytes(beside, MAX_BYTES, "label file"), str(beside), ".wrd", rate).phones
    return make(found.kind, found.phones, words, (found.start, found.end), found.notes)


def parse(data: bytes, place: str, ending: str = "", rate: int | None = None) -> LabelFile:
    """As `read`, from bytes; `place` names the file in messages."""
    if data.startswith(b"ooBinaryFile"):
        raise UserError(f"{place} is a binary TextGrid: save it from Praat as a text file.")
    text = decode(data, place)
    if not text.strip():
        raise UserError(f"{place} is empty: choose another file.")
    if text.lstrip()[:1] == "{":
        return _json(text, place)
    if textgrid.is_textgrid(text):
        return textgrid.parse(text, place)
    return columns.parse(text, place, ending, rate)


def _json(text: str, place: str) -> LabelFile:
    data = text.encode("utf-8", "replace")
    top = decode_json(data, place)
    schema = top.get("schema")
    if schema == schedule_json.SCHEMA:
        return _of_schedule("Lipstitch schedule", schedule_json.parse(data, place), ())
    if schema == utterance_json.SCHEMA:
        saved = utterance_json.parse(data, place)
        words = [Interval(word.start, word.end, word.text) for word in saved.words]
        return _of_schedule("Lipstitch utterance", saved.schedule, words)
    if isinstance(top.get("tiers"), dict):
        return _mfa(top, place)
    raise UserError(f"{place} is no label file: it is neither a schedule nor an utterance of ours, nor MFA's JSON.")


def _of_schedule(kind: str, schedule: Schedule, words: list[Interval] | tuple[()]) -> LabelFile:
    times = schedule.times.tolist()
    phones = map(Interval, times[:-1], times[1:], schedule.phones)
    return make(kind, phones, words, (schedule.start, schedule.end))


def _mfa(top: dict[str, Any], place: str) -> LabelFile:
    """MFA's JSON: {"start", "end", "tiers": {"words": {"entries": [[start, end, label]…]}, "phones": …}}."""
    found: dict[str, list[Interval]] = {"phones": [], "words": []}
    try:
        for name, tier in top["tiers"].items():
            kind = next((kind for kind in found if kind[:-1] in str(name).lower()), None)
            if kind and not found[kind]:
                found[kind] = [Interval(float(a), float(b), str(label).strip()) for a, b, label in tier["entries"]]
        span = (float(top.get("start", 0.0)), float(top.get("end", 0.0)))
    except (TypeError, ValueError, KeyError, AttributeError):
        raise UserError(f"{place} is damaged: a tier's entries should be [start, end, label].") from None
    if not found["phones"]:
        raise UserError(f"{place} has no tier of phones: name that tier “phones”.")
    return make("MFA JSON", found["phones"], found["words"], span)
