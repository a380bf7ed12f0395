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

A set with a "base" holds what differs from it; reading gives both layers, writing the upper one (layers.py).
Fields this version does not know survive. What can be mended without guessing (keys out of order or a
little out of range) is mended and reported; everything else is refused, naming bigram, pose and key.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from ..curve_set import CurveSet
from ..errors import UserError
from ..phonemes import COMMON, SILENCE, TABLE_1
from ..poses import FACEFX
from .atomic import read_bytes, write_atomically
from .curve_set_decode import Decoder
from .curve_set_records import MAX_ARRAYS, MAX_BYTES, MAX_OBJECTS, MAX_TOLD, MAX_VALUES, SCHEMA, VERSION
from .curve_set_text import dumps
from .json_text import decode_json
from .layers import base_path, moved_base, refuse_circle
from .settings_json import decode_settings
from .upgrades import upgraded, version_of

__all__ = ["MAX_BYTES", "MAX_TOLD", "SCHEMA", "Reading", "dumps", "examine", "load", "moved", "parse", "read", "save"]


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
    return _read(Path(path), ())


def _read(path: Path, above: tuple[Path, ...]) -> Reading:
    data = read_bytes(path, MAX_BYTES, "curve set")
    return _whole(*_examine(data, str(path), path.parent, (*above, path.resolve())))


def save(curve_set: CurveSet, path: Path | str) -> None:
    """Write the set atomically; UserError when that fails, and then the old file is untouched."""
    write_atomically(path, dumps(curve_set))


def moved(curve_set: CurveSet, old: Path | None, new: Path) -> CurveSet:
    """The same set for another folder: a base that is a file is named from there. The same object where nothing is."""
    base = moved_base(curve_set.base, old, new)
    return curve_set if base == curve_set.base else replace(curve_set, base=base)


def parse(data: bytes, place: str, folder: Path | None = None) -> Reading:
    """As `read`, from bytes; the first problem is told, and how many more.

    place   names the file in messages
    folder  where the file is or will be, for a base beside it
    """
    return _whole(*_examine(data, place, folder, ()))


def examine(data: bytes, place: str, folder: Path | None = None) -> tuple[Reading | None, list[str]]:
    """Everything that is wrong with a file, one sentence each, and the set when nothing is."""
    return _examine(data, place, folder, ())


def _whole(reading: Reading | None, problems: list[str]) -> Reading:
    if problems or reading is None:
        others = "1 more problem" if len(problems) == 2 else f"{len(problems) - 1} more problems"
        more = f" ({others}; `check` lists them)" if len(problems) > 1 else ""
        raise UserError(problems[0] + more)
    return reading


def _examine(data: bytes, place: str, folder: Path | None, above: tuple[Path, ...]) -> tuple[Reading | None, list[str]]:
    try:
        _refuse_bombs(data, place)
        top = decode_json(data, place)
        version = version_of(top, place)
        newer = version > VERSION
        if newer:
            place = f"{place} (written by a newer Lipstitch)"
        top = upgraded(top, version)
        decoder = Decoder(place)
        head = decoder.head(top)
        settings = None if top.get("settings") is None else decode_settings(top["settings"], place)
        extra = decoder.unknown(top)
        below = None if head.base is None else _below(head.base, folder, above, place)
        poses = tuple(head.poses or (FACEFX if below is None else below.poses))
        if below is not None and (lost := [pose for pose in below.poses if pose not in poses]):
            raise UserError(f'{place}: its base has the pose “{lost[0]}”; add it to "poses".')
    except UserError as error:
        return None, [str(error)]
    phonemes = tuple(head.phonemes or (COMMON if below is None else below.phonemes))
    bigrams = decoder.bigrams(top.get("bigrams", {}), "bigrams", {*phonemes, SILENCE}, set(poses))
    aside = decoder.bigrams(top.get("aside", {}), "aside", None, None)
    if decoder.problems:
        return None, decoder.problems
    curve_set = CurveSet(
        name=head.name,
        language=head.language,
        phonemes=phonemes,
        poses=poses,
        bigrams=bigrams,
        phoneme_map=(TABLE_1 if below is None else below.phoneme_map) if head.phoneme_map is None else head.phoneme_map,
        settings=settings,
        aside=aside,
        authors=tuple(head.authors),
        provenance=head.provenance,
        extra=extra,
    )
    if below is not None and head.base is not None:
        curve_set = curve_set.on_base(head.base, below)
    return Reading(curve_set, tuple(decoder.repairs), newer), []


def _below(base: str, folder: Path | None, above: tuple[Path, ...], place: str) -> CurveSet:
    """The set that this one stands on."""
    path = base_path(base, folder, place)
    refuse_circle(path.resolve(), above, place)
    try:
        return _read(path, above).curve_set
    except UserError as error:
        raise UserError(f"{place}: its base cannot be used: {error}") from error


def _refuse_bombs(data: bytes, place: str) -> None:
    """UserError before a file is unpacked that would take far more memory than any curve set does."""
    if (
        data.count(b"[") > MAX_ARRAYS
        or data.count(b"{") > MAX_OBJECTS
        or data.count(b",") > MAX_VALUES
        or len(data) > MAX_BYTES
    ):
        raise UserError(f"{place} holds far more than any curve set does: choose another file.")
