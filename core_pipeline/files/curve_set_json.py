"""Curve sets as JSON: one curve a line, canonical order, so that a one-key edit is a one-line diff.

    {
      "schema": "lipstitch.CurveSet.1",
      "name": "English", "language": "en", "base": null,
      "phonemes": ["ah", …], "poses": ["open", …],
      "phoneme_map": {…}, "settings": {…},
      "bigrams": {
        "f-ah": {"status": "approved", "source": "authored", "note": "", "curves": {
          "open": [[0.3, 0], [0.62, 0.71], [1, 0.12]],
          "FV": [[0, 0.2], [0.26, 0.97], [0.42, 0.55], [1, 0]]
        }}
      }
    }

Fields this version does not know survive. What can be mended without guessing (keys out of order or a
little out of range) is mended and reported; everything else is refused, naming bigram, pose and key.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import msgspec
import numpy as np

from ..curve_set import STATUSES, Bigram, CurveSet
from ..curves import Curve
from ..errors import UserError
from ..phonemes import COMMON, SILENCE, TABLE_1, Pair, pair_name
from ..poses import FACEFX
from .atomic import read_bytes, write_atomically
from .json_text import decode_json, is_deeper, shown
from .settings_json import decode_settings, encode_settings, number, unknown_fields

VERSION = 1
SCHEMA = f"lipstitch.CurveSet.{VERSION}"

#: A full English set takes half a megabyte.
MAX_BYTES = 64 * 2**20
MAX_NAMES = 400
MAX_KEYS = 2000
#: Keys this far outside 0…1 are drawing noise and are clipped; further is an error.
SLACK = 0.05
#: A damaged file may have thousands of problems; this many are told.
MAX_TOLD = 50
#: Unknown fields are kept as they are, but a program must be able to walk them.
MAX_DEPTH = 50

_Label = Annotated[str, msgspec.Meta(max_length=200)]
_Note = Annotated[str, msgspec.Meta(max_length=10_000)]


class HeadRecord(msgspec.Struct):
    """The set's own fields."""

    name: _Label = "Untitled"
    language: _Label = "en"
    base: _Note | None = None
    phonemes: list[str] = msgspec.field(default_factory=lambda: list(COMMON))
    poses: list[str] = msgspec.field(default_factory=lambda: list(FACEFX))
    phoneme_map: dict[str, str] | None = None


class BigramRecord(msgspec.Struct):
    """One bigram's fields; keys stay raw so that a fault can be named by pose and key."""

    status: str = "draft"
    source: _Note = "authored"
    note: _Note = ""
    curves: dict[str, list[Any]] = {}


@dataclass(frozen=True)
class Reading:
    """What a file held.

    repairs  one sentence per repair made
    newer    written by a later version: shown, but not to be saved over
    """

    curve_set: CurveSet
    repairs: tuple[str, ...] = ()
    newer: bool = False


def load(path: Path | str) -> CurveSet:
    """The curve set in a file; UserError when it cannot be used as it is or after plain repairs."""
    return read(path).curve_set


def read(path: Path | str) -> Reading:
    """The curve set in a file and what had to be repaired; UserError when it cannot be used."""
    return parse(read_bytes(path, MAX_BYTES, "curve set"), str(path))


def save(curve_set: CurveSet, path: Path | str) -> None:
    """Write the set atomically; UserError when that fails, and then the old file is untouched."""
    write_atomically(path, dumps(curve_set))


def parse(data: bytes, place: str) -> Reading:
    """As `read`, from bytes; `place` names the file in messages. The first problem is told, and how many more."""
    reading, problems = examine(data, place)
    if problems or reading is None:
        more = f" ({len(problems) - 1} more problems; `check` lists them)" if len(problems) > 1 else ""
        raise UserError(problems[0] + more)
    return reading


def examine(data: bytes, place: str) -> tuple[Reading | None, list[str]]:
    """Everything that is wrong with a file, one sentence each, and the set when nothing is."""
    try:
        top = decode_json(data, place)
        newer = _check_schema(top, place)
        if newer:
            place = f"{place} (written by a newer Lipstitch)"
        head = _head(top, place)
        settings = None if top.get("settings") is None else decode_settings(top["settings"], place)
        extra = _unknown_fields(top, place)
    except UserError as error:
        return None, [str(error)]
    bigrams_value = top.get("bigrams", {})
    if not isinstance(bigrams_value, dict):
        return None, [f'{place}: "bigrams" is not an object; write {{"f-ah": {{…}}}}.']
    problems: list[str] = []
    repairs: list[str] = []
    bigrams: dict[Pair, Bigram] = {}
    phones = {*head.phonemes, SILENCE}
    for name, value in bigrams_value.items():
        if len(problems) >= MAX_TOLD:
            problems.append(f"{place}: further problems are not listed.")
            break
        where = f"{place}, bigram {shown(name)}"
        pair = _pair(name, phones)
        if pair is None:
            problems.append(f'{where}: not two phonemes of this set joined by "-"; correct or remove it.')
            continue
        bigram = _bigram(value, where, head.poses, problems, repairs)
        if bigram is not None:
            bigrams[pair] = bigram
    if problems:
        return None, problems
    curve_set = CurveSet(
        name=head.name,
        language=head.language,
        phonemes=tuple(head.phonemes),
        poses=tuple(head.poses),
        bigrams=bigrams,
        phoneme_map=TABLE_1 if head.phoneme_map is None else head.phoneme_map,
        settings=settings,
        base=head.base,
        extra=extra,
    )
    return Reading(curve_set, tuple(repairs), newer), []


def dumps(curve_set: CurveSet, *, minified: bool = False) -> str:
    """The file's text. Bigrams in the order of the phoneme set, poses in the set's order, LF, at most 4 decimals."""
    order = [*curve_set.phonemes, SILENCE]
    rank = {phone: i for i, phone in enumerate(order)}
    pairs = sorted(curve_set.bigrams, key=lambda pair: (rank.get(pair[0], 10**6), rank.get(pair[1], 10**6), pair))
    lines = [
        f'  "schema": "{SCHEMA}"',
        f'  "name": {_text(curve_set.name)}, "language": {_text(curve_set.language)}, "base": {_text(curve_set.base)}',
        f'  "phonemes": {_text(list(curve_set.phonemes))}',
        f'  "poses": {_text(list(curve_set.poses))}',
        f'  "phoneme_map": {_text(dict(curve_set.phoneme_map))}',
        f'  "settings": {encode_settings(curve_set.effective_settings, curve_set.extra.get("settings", {}))}',
        *(f"  {_text(name)}: {_text(value)}" for name, value in curve_set.extra.items() if name != "settings"),
    ]
    bigrams = ",\n".join(_bigram_text(pair, curve_set.bigrams[pair], curve_set.poses) for pair in pairs)
    lines.append(f'  "bigrams": {{{chr(10) + bigrams + chr(10) + "  " if bigrams else ""}}}')
    text = "{\n" + ",\n".join(lines) + "\n}\n"
    return json.dumps(json.loads(text), ensure_ascii=False, separators=(",", ":")) + "\n" if minified else text


def _check_schema(top: dict[str, Any], place: str) -> bool:
    """Whether a newer version wrote the file; UserError when it is no curve set at all."""
    schema = top.get("schema")
    match = re.fullmatch(r"lipstitch\.CurveSet\.(\d{1,6})", schema) if isinstance(schema, str) else None
    if match is None or int(match[1]) < 1:
        raise UserError(f'{place} is not a curve set: it should say "schema": "{SCHEMA}". Choose another file.')
    return int(match[1]) > VERSION


def _unknown_fields(top: dict[str, Any], place: str) -> dict[str, Any]:
    """What this version does not know, to be written again; that of the settings under "settings"."""
    known = {*HeadRecord.__struct_fields__, "schema", "settings", "bigrams"}
    extra = {name: value for name, value in top.items() if name not in known}
    if more := unknown_fields(top.get("settings") or {}):
        extra["settings"] = more
    if is_deeper(extra, MAX_DEPTH):
        raise UserError(f"{place} is nested too deeply to be one of our files: choose another.")
    return extra


def _head(top: dict[str, Any], place: str) -> HeadRecord:
    try:
        head = msgspec.convert(top, HeadRecord)
    except msgspec.ValidationError as error:
        raise UserError(f"{place}: {str(error)[:200].lower()}. Correct that value.") from error
    for what, names in (("phonemes", head.phonemes), ("poses", head.poses)):
        if not 1 <= len(names) <= MAX_NAMES:
            raise UserError(f'{place}: "{what}" has {len(names)} names; write 1 to {MAX_NAMES}.')
        odd = next(
            (n for n in names if not n or len(n) > 60 or not n.isprintable() or ("-" in n and what == "phonemes")), None
        )
        if odd is not None:
            raise UserError(f'{place}: {odd[:60]!r} in "{what}" is not a usable name; write a short one without "-".')
        if len(set(names)) < len(names):
            double = next(n for n in names if names.count(n) > 1)
            raise UserError(f'{place}: "{what}" names {double!r} twice; remove one.')
    if SILENCE in head.phonemes:
        raise UserError(f'{place}: "{SILENCE}" means silence and is no phoneme; remove it from "phonemes".')
    return head


def _pair(name: str, phones: set[str]) -> Pair | None:
    first, dash, second = name.partition("-")
    return (first, second) if dash and first in phones and second in phones else None


def _bigram(value: Any, where: str, poses: list[str], problems: list[str], repairs: list[str]) -> Bigram | None:
    try:
        record = msgspec.convert(value, BigramRecord)
    except msgspec.ValidationError as error:
        problems.append(f"{where}: {str(error)[:200].lower()}. Correct that value.")
        return None
    if record.status not in STATUSES:
        problems.append(f"{where}: there is no status “{shown(record.status)}”; write one of {', '.join(STATUSES)}.")
        return None
    curves: dict[str, Curve] = {}
    for pose, keys in record.curves.items():
        if pose not in poses:
            problems.append(f'{where}: the pose “{shown(pose)}” is not in "poses"; correct the name or add it there.')
        elif not keys:
            repairs.append(f"{where}, pose {pose}: a curve without keys was left out.")
        else:
            curve = _curve(keys, f"{where}, pose {pose}", problems, repairs)
            if curve is not None:
                curves[pose] = curve
    known = BigramRecord.__struct_fields__
    extra = {k: v for k, v in value.items() if k not in known}
    if is_deeper(extra, MAX_DEPTH):
        problems.append(f"{where}: an unknown field is nested too deeply; remove it.")
    return Bigram(curves, record.status, record.source, record.note, extra)


def _curve(keys: list[Any], where: str, problems: list[str], repairs: list[str]) -> Curve | None:
    if len(keys) > MAX_KEYS:
        problems.append(f"{where}: {len(keys)} keys; at most {MAX_KEYS} are possible.")
        return None
    for i, key in enumerate(keys):
        if not (isinstance(key, list) and len(key) == 2 and all(type(x) in (int, float) for x in key)):
            problems.append(f"{where}, key {i}: not a pair of numbers [time, value].")
            return None
        if any(not -SLACK <= x <= 1 + SLACK for x in key):
            problems.append(f"{where}, key {i}: {_short(key[0])}, {_short(key[1])} lies outside 0…1; correct it.")
            return None
    array = np.array(keys, dtype=np.float64)
    clipped = np.clip(array, 0.0, 1.0)
    if (clipped != array).any():
        repairs.append(f"{where}: {int((clipped != array).any(1).sum())} keys a little outside 0…1 were clipped.")
    t, v = clipped[:, 0], clipped[:, 1]
    if (np.diff(t) < 0).any():
        order = t.argsort(kind="stable")
        t, v = t[order], v[order]
        repairs.append(f"{where}: keys out of order were sorted.")
    if (np.diff(t) == 0).any():
        count = t.size
        t, group = np.unique(t, return_inverse=True)
        highest = np.zeros(t.size)
        np.maximum.at(highest, group, v)
        v = highest
        repairs.append(f"{where}: {count - t.size} keys at the time of another were merged, the highest kept.")
    return Curve(t, v)


def _short(number: float) -> str:
    """A number for a message; a file may hold integers of thousands of digits."""
    return f"{number:.4g}" if abs(number) < 1e300 else "a number of hundreds of digits"


def _bigram_text(pair: Pair, bigram: Bigram, poses: tuple[str, ...]) -> str:
    fields = {"status": bigram.status, "source": bigram.source, "note": bigram.note, **bigram.extra}
    start = f"    {_text(pair_name(pair))}: {_text(fields)[:-1]}, " + '"curves": {'
    curves = [f"      {_text(pose)}: {_keys_text(bigram.curves[pose])}" for pose in poses if pose in bigram.curves]
    return start + ("\n" + ",\n".join(curves) + "\n    }}" if curves else "}}")


def _keys_text(curve: Curve) -> str:
    times = [number(t) for t in curve.t]
    if len(set(times)) < len(times):  # keys nearer than four decimals can tell
        times = [repr(float(t)) for t in curve.t]
    return "[" + ", ".join(f"[{t}, {number(v)}]" for t, v in zip(times, curve.v, strict=True)) + "]"


def _text(value: Any) -> str:
    return json.dumps(dict(value) if isinstance(value, Mapping) else value, ensure_ascii=False)
