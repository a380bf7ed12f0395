"""Rigs as they were read once: all arrays in one .npz, good for as long as no file of the rig has changed."""

from __future__ import annotations

import contextlib
import hashlib
import io
import json
import os
import sys
import zipfile
from collections.abc import Iterable
from dataclasses import asdict, astuple
from pathlib import Path
from typing import Any

import numpy as np

from core_pipeline.errors import UserError
from core_pipeline.faces.face import Camera, Face
from core_pipeline.faces.rigs.limits import MAX_FILE
from core_pipeline.faces.texture import Material, Texture
from core_pipeline.files.atomic import write_atomically

FORMAT = "lipstitch-rig-cache.4"
#: Bytes of all rigs kept; the ones opened longest ago go first.
MAX_KEPT = 2**30

_ARRAYS = ("positions", "normals", "triangles", "colours", "deltas", "normal_deltas", "texcoords")
_PICTURE = "picture {}"


def user_cache() -> Path:
    """Where this user's programs keep what can be made again."""
    home = Path.home()
    if sys.platform == "win32":
        base = Path(os.environ.get("LOCALAPPDATA") or home / "AppData" / "Local")
    elif sys.platform == "darwin":
        base = home / "Library" / "Caches"
    else:
        base = Path(os.environ.get("XDG_CACHE_HOME") or home / ".cache")
    return base / "lipstitch" / "rigs"


def recall(rig: Path, cache: Path) -> tuple[Face, tuple[str, ...]] | None:
    """The face and its notes as kept by `keep`; None when there is none, or a file has changed since."""
    path = _place(rig, cache)
    try:
        with path.open("rb") as file, np.load(file, allow_pickle=False) as kept:
            about = json.loads(str(kept["about"]))
            if about["format"] != FORMAT or about["files"] != _stamps(Path(name) for name, *_ in about["files"]):
                return None
            arrays: dict[str, Any] = {name: kept[name] for name in _ARRAYS if name in kept}
            pictures = [kept[_PICTURE.format(number)] for number in range(about["pictures"])]
        camera = about["camera"] | {"target": tuple(about["camera"]["target"])}
        face = Face(
            name=about["name"],
            title=about["title"],
            shapes=tuple(about["shapes"]),
            parts={name: (first, count) for name, (first, count) in about["parts"].items()},
            expressions=about["expressions"],
            camera=Camera(**camera),
            textures=tuple(Texture(pictures[number], (across, down)) for number, across, down in about["textures"]),
            materials={name: Material(*material) for name, material in about["materials"].items()},
            **arrays,
        )
        path.touch()  # opened just now
    except (OSError, ValueError, KeyError, IndexError, TypeError, AttributeError, EOFError, zipfile.BadZipFile):
        return None  # made again, then
    return face, tuple(about["notes"])


def keep(rig: Path, files: Iterable[Path], face: Face, notes: tuple[str, ...], cache: Path) -> None:
    """Keep a face under the name of its rig.

    files  all that was read for it, and folders in which a new file would matter
    A cache that cannot be written is no reason to fail.
    """
    pictures = {id(texture.picture): texture.picture for texture in face.textures}  # two may share one
    numbers = {key: number for number, key in enumerate(pictures)}
    about = {
        "format": FORMAT,
        "files": _stamps(files),
        "name": face.name,
        "title": face.title,
        "shapes": face.shapes,
        "parts": face.parts,
        "expressions": face.expressions,
        "camera": asdict(face.camera),
        "pictures": len(pictures),
        "textures": [(numbers[id(texture.picture)], *texture.wrap) for texture in face.textures],
        "materials": {name: astuple(material) for name, material in face.materials.items()},
        "notes": notes,
    }
    arrays: dict[str, Any] = {name: getattr(face, name) for name in _ARRAYS if getattr(face, name) is not None}
    arrays |= {_PICTURE.format(number): picture for number, picture in enumerate(pictures.values())}
    if sum(array.nbytes for array in arrays.values()) > MAX_FILE:
        return
    packed = io.BytesIO()
    np.savez(packed, about=np.array(json.dumps(about)), **arrays)
    with contextlib.suppress(OSError, UserError):
        cache.mkdir(parents=True, exist_ok=True)
        write_atomically(_place(rig, cache), packed.getvalue())
        _prune(cache)


def _place(rig: Path, cache: Path) -> Path:
    return cache / f"{hashlib.sha256(str(rig.resolve()).encode(errors='surrogateescape')).hexdigest()[:24]}.npz"


def _stamps(files: Iterable[Path]) -> list[list[Any]]:
    """[path, size, time of change] of each file, as JSON gives it back."""
    stamps = []
    for path in files:
        found = path.resolve().stat()
        stamps.append([str(path.resolve()), found.st_size, found.st_mtime_ns])
    return stamps


def _prune(cache: Path) -> None:
    kept = sorted(cache.glob("*.npz"), key=lambda path: path.stat().st_mtime_ns, reverse=True)
    total = 0
    for path in kept:
        total += path.stat().st_size
        if total > MAX_KEPT:
            path.unlink()
