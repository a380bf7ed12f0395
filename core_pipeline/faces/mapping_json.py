"""Retargeting as files: the presets we ship, and a user's own mix of shapes, kept beside the rig.

`head.glb` has its mapping in `head.glb.lipstitch.json`, a folder `poses` in `poses.lipstitch.json`.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from core_pipeline.errors import UserError
from core_pipeline.faces.retarget import Mix, Preset
from core_pipeline.files.atomic import read_bytes, write_atomically
from core_pipeline.files.json_text import decode_json, shown

MAPPING_FORMAT = "lipstitch-mapping.1"
PRESET_FORMAT = "lipstitch-retarget.1"
MAX_BYTES = 2**20
#: Shapes go from 0 to 1; a little more for rigs that were made timidly, less than 0 for correctives.
MAX_AMOUNT = 4.0
_CURE = "delete the file, or mend it"


def mapping_path(rig: Path) -> Path:
    """Where the mapping of a rig (a file or a folder) is kept."""
    place = rig.absolute()
    return place.with_name(place.name + ".lipstitch.json")


def save_mapping(rig: Path, preset: str, poses: Mapping[str, Mix]) -> Path:
    """Keep what each pose is made of, beside the rig; the path written. UserError when that cannot be done.

    preset  the preset it began with, for people; it is not needed to read the mapping
    """
    for pose, mix in poses.items():
        for shape, amount in mix.items():
            if not abs(amount) <= MAX_AMOUNT:
                raise ValueError(f"{pose}: {shape} {amount}")
    rows = ",\n".join(f"    {_text(pose)}: {_text(dict(mix))}" for pose, mix in poses.items())
    path = mapping_path(rig)
    write_atomically(
        path,
        f'{{\n  "format": "{MAPPING_FORMAT}",\n  "preset": {_text(preset)},\n  "poses": {{\n{rows}\n  }}\n}}\n',
    )
    return path


def load_mapping(rig: Path) -> tuple[str, dict[str, Mix]] | None:
    """(preset, poses) as saved beside the rig, None when nothing was. UserError when the file is damaged."""
    path = mapping_path(rig)
    if not path.exists():
        return None
    about = _checked(path, MAPPING_FORMAT)
    preset = about.get("preset", "")
    if not isinstance(preset, str):
        raise UserError(f"{path}: “preset” is not a name; {_CURE}.")
    return preset, _poses(path, about)


def load_presets(folder: Path) -> tuple[Preset, ...]:
    """Every preset in a folder, by file name. UserError when one is damaged or there are none."""
    presets = tuple(_preset(path) for path in sorted(folder.glob("*.json")))
    if not presets:
        raise UserError(f"{folder}: there are no retarget presets; install Lipstitch again.")
    return presets


def _preset(path: Path) -> Preset:
    about = _checked(path, PRESET_FORMAT)
    title, names, aliases = about.get("title"), about.get("names"), about.get("aliases", {})
    if (
        not isinstance(title, str)
        or not _is_words(names)
        or not isinstance(aliases, dict)
        or not all(_is_words(words) for words in aliases.values())
    ):
        raise UserError(f"{path}: its title, names or aliases are not as they should be; {_CURE}.")
    return Preset(path.stem, title, _poses(path, about), aliases, frozenset(names or ()))


def _checked(path: Path, expected: str) -> dict[str, Any]:
    about = decode_json(read_bytes(path, MAX_BYTES, "mapping"), str(path))
    if about.get("format") != expected:
        raise UserError(f"{path}: is not a “{expected}” file; {_CURE}.")
    return about


def _poses(path: Path, about: dict[str, Any]) -> dict[str, Mix]:
    poses = about.get("poses")
    if not isinstance(poses, dict) or not all(isinstance(mix, dict) for mix in poses.values()):
        raise UserError(f"{path}: “poses” does not give each pose its shapes; {_CURE}.")
    for pose, mix in poses.items():
        for shape, amount in mix.items():
            fits = isinstance(amount, int | float) and not isinstance(amount, bool) and abs(amount) <= MAX_AMOUNT
            if not fits or not math.isfinite(amount):
                raise UserError(
                    f"{path}: pose {shown(pose)} takes {shown(str(amount))} of {shown(shape)}; "
                    f"write a number within ±{MAX_AMOUNT:g}, or delete the file."
                )
    return {pose: {shape: float(amount) for shape, amount in mix.items()} for pose, mix in poses.items()}


def _is_words(value: object) -> bool:
    return isinstance(value, list) and all(isinstance(word, str) for word in value)


def _text(value: object) -> str:
    return json.dumps(value, ensure_ascii=False)
