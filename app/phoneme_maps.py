"""A phoneme map put to use: which of a language's phones lead to which phoneme of the curve set."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from core_pipeline.curve_set import CurveSet
from core_pipeline.errors import UserError
from core_pipeline.files import phoneme_map_json
from core_pipeline.files.phoneme_map_json import PhonemeMap


def applied(curve_set: CurveSet, path: Path) -> CurveSet:
    """The set with the map in a file. UserError when the map leads to phonemes the set does not have."""
    found = phoneme_map_json.load(path)
    check_fits(curve_set, found)
    return replace(curve_set, phoneme_map=found.table)


def check_fits(curve_set: CurveSet, found: PhonemeMap) -> None:
    """UserError when a map leads to phonemes that the set does not have."""
    strange = [phone for phone in found.phonemes if phone not in curve_set.phonemes]
    if strange:
        raise UserError(
            f"The map “{found.name}” leads to {', '.join(strange[:6])}, which the curve set “{curve_set.name}” does "
            "not have: choose another map, or a curve set made for it."
        )
