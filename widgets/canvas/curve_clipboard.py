"""Keys and curves on the clipboard, as JSON that other windows, programs and people can read. No Qt.

{"schema": "lipstitch.Curves.1", "bigram": ["f", "ah"], "whole": ["FV"], "curves": {"FV": [[0, 0], [0.5, 1]]}}
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass

from core_pipeline.curves import Curve

NAME = "lipstitch.Curves"
VERSION = 1

#: A longer text is none of ours and is not read.
LONGEST = 1_000_000

NOTHING = "the clipboard holds no curves: copy keys first"
NEWER = "the curves on the clipboard come from a newer Lipstitch: update to paste them"
BROKEN = "the curves on the clipboard are damaged: copy them again"


class NotCurvesError(ValueError):
    """A clipboard without curves; str() is NOTHING, NEWER or BROKEN."""


@dataclass(frozen=True, eq=False)
class Copied:
    """What was copied: pose → its keys, and which of them are whole curves.

    bigram  where it came from, ("", "") when that is not known
    """

    curves: Mapping[str, Curve]
    whole: frozenset[str]
    bigram: tuple[str, str] = ("", "")


def to_text(copied: Copied) -> str:
    """As JSON."""
    return json.dumps(
        {
            "schema": f"{NAME}.{VERSION}",
            "bigram": list(copied.bigram),
            "whole": sorted(copied.whole),
            "curves": {pose: curve.keys() for pose, curve in copied.curves.items()},
        },
        ensure_ascii=False,
    )


def from_text(text: str) -> Copied:
    """Reads what to_text wrote; NotCurvesError says why that cannot be."""
    try:
        data = json.loads(text) if len(text) <= LONGEST else None
    except (ValueError, RecursionError):
        data = None
    if not isinstance(data, dict):
        raise NotCurvesError(NOTHING)
    name, _, version = str(data.get("schema")).rpartition(".")
    if name != NAME or not data.get("curves"):
        raise NotCurvesError(NOTHING)
    if version != str(VERSION):
        raise NotCurvesError(NEWER)
    try:
        curves = {str(pose): Curve.of(keys) for pose, keys in data["curves"].items()}
        whole = frozenset(str(pose) for pose in data.get("whole", ())) & curves.keys()
        first, second = (str(phone) for phone in data.get("bigram", ("", "")))
    except (ValueError, TypeError, KeyError, IndexError, AttributeError, OverflowError):
        raise NotCurvesError(BROKEN) from None
    return Copied(curves, whole, (first, second))
