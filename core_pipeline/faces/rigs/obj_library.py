"""The materials (.mtl) that .obj faces name: a colour, a picture, and what is see-through of it.

All in the folder of the poses; whatever lies elsewhere is left alone.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from core_pipeline.errors import UserError
from core_pipeline.files.atomic import read_bytes

_MAX_MTL = 2**20
#: Options of a `map_…` line, and how many words follow each, at most; of -o, -s and -t only numbers do.
_OPTIONS = {
    "-blendu": 1, "-blendv": 1, "-boost": 1, "-mm": 2, "-o": 3, "-s": 3, "-t": 3, "-texres": 1, "-clamp": 1,
    "-bm": 1, "-imfchan": 1, "-type": 1, "-cc": 1,
}  # fmt: skip
_NUMBERS_ONLY = ("-o", "-s", "-t")


@dataclass(frozen=True)
class ObjMaterial:
    """What a material says of itself.

    diffuse       sRGB, None when it says nothing, or just grey: so exporters write what was never set
    clear         not to be seen at all
    picture       name of its picture, "" for none; seen: of the one that tells where it is see-through
    clamp         the picture does not go on beyond its edges
    """

    diffuse: tuple[float, float, float] | None = None
    clear: bool = False
    picture: str = ""
    seen: str = ""
    clamp: bool = False


def read_library(folder: Path, name: str | None) -> tuple[Mapping[str, ObjMaterial], list[Path]]:
    """Material by name, and the files that were read for it; nothing when there is no such file in `folder`."""
    if name is None:
        return {}, []
    path = folder / name
    try:
        if "\0" in name or path.resolve().parent != folder.resolve():
            return {}, []
        text = read_bytes(path, _MAX_MTL, "material").decode("utf-8", "replace")
    except (UserError, OSError):
        return {}, []  # a face without its colours is still a face
    found: dict[str, ObjMaterial] = {}
    name = ""
    for line in text.splitlines():
        key, *words = line.split() or [""]
        if key == "newmtl":
            name = " ".join(words)
        found[name] = _told(found.get(name, ObjMaterial()), key, words)
    return found, [path]


def file_in(folder: Path, name: str) -> Path | None:
    """The picture of that name in the folder, wherever it was when the rig was made; None when there is none."""
    plain = name.replace("\\", "/")
    for candidate in (plain, plain.rpartition("/")[2]):
        try:
            path = (folder / candidate).resolve()
            if path.is_relative_to(folder.resolve()) and path.is_file():
                return path
        except (OSError, ValueError):
            continue
    return None


def _told(material: ObjMaterial, key: str, words: list[str]) -> ObjMaterial:
    """The material as one line more describes it."""
    if key == "Kd" and (rgb := _three(words)) is not None and len(set(rgb)) > 1:
        return replace(material, diffuse=rgb)
    if key == "d" and len(words) == 1 and words[0] in ("0", "0.0", "0.000000"):
        return replace(material, clear=True)
    if key.casefold() == "map_kd":
        name, options = _name_and_options(words)
        return replace(material, picture=name, clamp=options.get("-clamp") == ["on"])
    if key.casefold() == "map_d":
        return replace(material, seen=_name_and_options(words)[0])
    return material


def _three(words: list[str]) -> tuple[float, float, float] | None:
    try:
        red, green, blue = (float(word) for word in words)
    except ValueError:
        return None
    return (red, green, blue) if all(0 <= number <= 1 for number in (red, green, blue)) else None


def _name_and_options(words: list[str]) -> tuple[str, dict[str, list[str]]]:
    """A file's name, which may hold spaces, stands behind all options."""
    options: dict[str, list[str]] = {}
    while words and words[0] in _OPTIONS:
        key, most = words[0], _OPTIONS[words[0]]
        end = 1
        while end <= most and end < len(words) and (key not in _NUMBERS_ONLY or _is_number(words[end])):
            end += 1
        options[key], words = words[1:end], words[end:]
    return " ".join(words), options


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True
