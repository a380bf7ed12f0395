"""The typed structures of a curve-set file, its limits, and the JSON Schema made from them.

The Schema is published as assets/curves/curve_set.schema.json: editors and other programs can check files with it.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated, Any, Literal

import msgspec

from .atomic import write_atomically
from .settings_json import SettingsRecord

VERSION = 1
SCHEMA = f"lipstitch.CurveSet.{VERSION}"

#: A full English set takes half a megabyte.
MAX_BYTES = 16 * 2**20
#: More brackets, braces or commas than this would take more memory than a curve set is worth.
MAX_ARRAYS = 400_000
MAX_OBJECTS = 100_000
MAX_VALUES = 1_000_000
MAX_NAMES = 400
MAX_KEYS = 2000
#: A damaged file may have thousands of problems; this many are told.
MAX_TOLD = 50
#: Unknown fields are kept as they are, but a program must be able to walk them.
MAX_DEPTH = 50

Label = Annotated[str, msgspec.Meta(max_length=200)]
Note = Annotated[str, msgspec.Meta(max_length=10_000)]


class HeadRecord(msgspec.Struct):
    """The set's own fields. `base` is a built-in set's name ("english") or a .json file, relative to this one."""

    name: Label = "Untitled"
    language: Label = "en"
    base: Annotated[str, msgspec.Meta(min_length=1, max_length=1000)] | None = None
    authors: list[Label] = []
    provenance: Note = ""
    phonemes: list[str] | None = None
    poses: list[str] | None = None
    phoneme_map: dict[str, str] | None = None


class BigramRecord(msgspec.Struct):
    """One bigram's fields; keys stay raw so that a fault can be named by pose and key."""

    status: str = "draft"
    source: Note = "authored"
    note: Note = ""
    author: Label = ""
    curves: dict[str, list[Any]] = {}


_Unit = Annotated[float, msgspec.Meta(ge=0, le=1)]
_Name = Annotated[str, msgspec.Meta(min_length=1, max_length=60)]
_Phoneme = Annotated[str, msgspec.Meta(min_length=1, max_length=60, pattern="^[^-]+$")]
_Key = Annotated[
    tuple[_Unit, _Unit], msgspec.Meta(description="Normalised time and weight; times rise strictly within a curve.")
]
_Curve = Annotated[list[_Key], msgspec.Meta(min_length=1, max_length=MAX_KEYS)]


class PublishedBigram(BigramRecord):
    """A bigram as a sound file has it. Fields of other programs may stand beside these."""

    status: Literal["empty", "suggestion", "draft", "review", "approved"] = "draft"
    curves: dict[str, _Curve] = {}


class PublishedSet(HeadRecord, kw_only=True):
    """A curve set: for every pair of phones ("f-ah"), what each pose does while the pair is spoken."""

    schema: Literal["lipstitch.CurveSet.1"]
    settings: SettingsRecord | None = None
    phonemes: Annotated[list[_Phoneme], msgspec.Meta(min_length=1, max_length=MAX_NAMES)] | None = None
    poses: Annotated[list[_Name], msgspec.Meta(min_length=1, max_length=MAX_NAMES)] | None = None
    bigrams: dict[str, PublishedBigram] = {}
    aside: dict[str, PublishedBigram] = {}


def write_schema(folder: Path) -> Path:
    """Publish the JSON Schema in a folder; the path written."""
    path = folder / "curve_set.schema.json"
    write_atomically(path, json_schema())
    return path


def json_schema() -> str:
    """The JSON Schema of curve-set files, as text."""
    schema = msgspec.json.schema(PublishedSet)
    top = {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": SCHEMA, **schema}
    return json.dumps(top, indent=2, ensure_ascii=False) + "\n"
