"""A character's folder: face.glb, and face.json with its title, camera, parts and how poses mix shapes."""

from __future__ import annotations

import json
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import numpy as np

from core_pipeline.errors import UserError
from core_pipeline.faces.face import Camera, Face
from core_pipeline.faces.rigs.glb import read_glb
from core_pipeline.faces.rigs.glb_write import write_glb
from core_pipeline.faces.texture import Material

FORMAT = "lipstitch-face.1"


def load(folder: str | Path) -> Face:
    """The face in a folder. UserError when a file is missing or damaged."""
    place = Path(folder)
    if not (place / "face.glb").is_file():
        raise UserError(f"{place}: there is no face.glb; choose the folder of a character.")
    face = replace(read_glb(place / "face.glb"), name=place.name, title=place.name)
    about = place / "face.json"
    return _described(face, about, _read_json(about)) if about.exists() else face


def save(face: Face, folder: str | Path) -> None:
    """Write both files, making the folder. UserError when that cannot be done.

    ValueError for a face on which pictures lie: ours have none.
    """
    place = Path(folder)
    about = {
        "format": FORMAT,
        "title": face.title,
        "licence": "MIT",
        "camera": asdict(face.camera),
        "pose_map": {pose: dict(mix) for pose, mix in face.pose_map.items()},
        "parts": {name: list(part) for name, part in face.parts.items()},
        "closed": [name for name in face.parts if name in face.closed],
    }
    try:
        place.mkdir(parents=True, exist_ok=True)
        (place / "face.json").write_text(_pretty(about), encoding="utf-8")
    except OSError as error:
        raise UserError(f"{place}: cannot be written ({error.strerror}); choose another place.") from None
    write_glb(face, place / "face.glb")


def _pretty(about: dict[str, Any]) -> str:
    """One entry a line, one level deep: readable, and small differences give small diffs."""
    lines = []
    for key, value in about.items():
        if isinstance(value, dict) and value:
            inner = ",\n".join(f"    {json.dumps(k)}: {json.dumps(v, ensure_ascii=False)}" for k, v in value.items())
            lines.append(f"  {json.dumps(key)}: {{\n{inner}\n  }}")
        else:
            lines.append(f"  {json.dumps(key)}: {json.dumps(value, ensure_ascii=False)}")
    return "{\n" + ",\n".join(lines) + "\n}\n"


def _read_json(path: Path) -> dict[str, Any]:
    try:
        about = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise UserError(f"{path}: cannot be read ({error.strerror}); check the folder.") from None
    except (ValueError, RecursionError):
        raise UserError(f"{path}: is not readable JSON; restore the file or delete it.") from None
    if not isinstance(about, dict) or about.get("format") != FORMAT:
        raise UserError(f"{path}: is not a “{FORMAT}” file; restore the file or delete it.")
    return about


def _described(face: Face, path: Path, about: dict[str, Any]) -> Face:
    try:
        camera = Camera(**{key: _camera_value(key, value) for key, value in about.get("camera", {}).items()})
        pose_map = {
            str(pose): {str(shape): _finite(amount) for shape, amount in mix.items()}
            for pose, mix in about.get("pose_map", {}).items()
        }
        parts = {str(name): (int(first), int(count)) for name, (first, count) in about.get("parts", face.parts).items()}
        closed = frozenset(map(str, about.get("closed", ())))
    except (TypeError, ValueError, AttributeError):
        raise UserError(
            f"{path}: its camera, pose_map, parts or closed are not as they should be; restore the file."
        ) from None
    unknown = sorted({shape for mix in pose_map.values() for shape in mix} - set(face.shapes))
    if unknown:
        raise UserError(f"{path}: the pose map uses shapes the face does not have: {', '.join(unknown)}.")
    for name, (first, count) in parts.items():
        if first < 0 or count < 0 or first + count > len(face.triangles):
            raise UserError(f"{path}: part “{name}” lies outside the face's {len(face.triangles):,} triangles.")
    if not closed <= set(parts):
        raise UserError(f"{path}: it has no parts to be closed named {', '.join(sorted(closed - set(parts)))}.")
    return replace(
        face,
        title=str(about.get("title") or face.name),
        camera=camera,
        pose_map=pose_map,
        parts=parts,
        closed=closed,
        materials={name: lying for name, part in parts.items() if (lying := _material(face, part, name, path))},
    )


def _material(face: Face, part: tuple[int, int], name: str, path: Path) -> Material | None:
    """What lies on a part, other than the file's own parts though it may be; UserError when that is several things."""
    first, end = part[0], sum(part)
    found = {
        face.materials.get(own)
        for own, (start, count) in face.parts.items()
        if max(start, first) < min(start + count, end)
    }
    if len(found) > 1:
        raise UserError(f"{path}: part “{name}” has several pictures; make it end where they end.")
    return found.pop() if found else None


def _camera_value(key: str, value: Any) -> Any:
    if key == "target":
        x, y, z = (_finite(part) for part in value)
        return (x, y, z)
    return _finite(value)


def _finite(value: Any) -> float:
    if isinstance(value, bool) or not np.isfinite(number := float(value)):
        raise ValueError(value)
    return number
