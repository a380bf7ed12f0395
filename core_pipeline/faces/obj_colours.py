"""Colours for .obj faces: what the files say, else what the names of their parts suggest.

Poses come without pictures: teeth and eyes in the colour of skin could not be read, and the clear shells before an
eye would hide it.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from core_pipeline.errors import UserError
from core_pipeline.faces.face import Floats
from core_pipeline.files.atomic import read_bytes

Colour = tuple[float, float, float, float]

#: Linear RGB and gloss.
SKIN: Colour = (0.62, 0.42, 0.34, 0.35)
_CLEAR: Colour = (0.0, 0.0, 0.0, -1.0)
_MAX_MTL = 2**20

#: Words in the names of parts and materials, most telling first; a rig's own names, in English as they all are.
_BY_NAME: tuple[tuple[tuple[str, ...], Colour], ...] = (
    (("occlusion", "lacrimal", "tear", "cornea", "lens", "fluid", "eyeblend", "eye_blend", "wetness"), _CLEAR),
    (("teeth", "tooth"), (0.80, 0.76, 0.66, 0.6)),
    (("gum", "tongue", "mouthsocket", "mouth_socket", "mouthbag"), (0.45, 0.13, 0.12, 0.5)),
    (("pupil",), (0.01, 0.01, 0.01, 0.9)),
    (("iris",), (0.10, 0.16, 0.22, 0.8)),
    (("lash", "brow", "hair", "beard"), (0.06, 0.04, 0.03, 0.3)),
    (("sclera", "eyeball", "eyewhite"), (0.82, 0.80, 0.78, 0.8)),
    (("eyeleft", "eyeright", "eye_l", "eye_r", "lefteye", "righteye"), (0.82, 0.80, 0.78, 0.8)),
)


def part_colours(names: Sequence[str], folder: Path, library: str | None) -> list[Colour | None]:
    """A colour for each name ("group material"), None for a part that is not to be seen.

    library  the material file the .obj names, if any; only one in `folder` is read
    """
    known = _library(folder, library) if library else {}
    colours: list[Colour | None] = []
    for name in names:
        colour = named_colour(name) or known.get(name.rpartition(" ")[2], SKIN)
        colours.append(None if colour == _CLEAR else colour)
    return colours


def named_colour(name: str) -> Colour | None:
    """What a part's name suggests; None when it suggests nothing. Fourth place below 0: not to be seen."""
    plain = name.casefold()
    return next((colour for words, colour in _BY_NAME if any(word in plain for word in words)), None)


def linear(colours: NDArray[np.float64]) -> Floats:
    """sRGB, from 0 to 1 or to 255, as linear RGB."""
    unit = np.clip(colours / (255 if colours.max(initial=0) > 1 else 1), 0, 1)
    rgb: Floats = np.where(unit <= 0.04045, unit / 12.92, ((unit + 0.055) / 1.055) ** 2.4).astype(np.float32)
    return rgb


def _library(folder: Path, name: str) -> dict[str, Colour]:
    """Material → its diffuse colour, of those that have one worth showing."""
    path = folder / name
    try:
        if "\0" in name or path.resolve().parent != folder.resolve():
            return {}
        text = read_bytes(path, _MAX_MTL, "material").decode("utf-8", "replace")
    except (UserError, OSError):
        return {}  # a face without its colours is still a face
    found: dict[str, Colour] = {}
    material = ""
    for line in text.splitlines():
        words = line.split()
        if words[:1] == ["newmtl"]:
            material = words[-1]
        elif words[:1] == ["Kd"] and (rgb := _three(words[1:])) is not None and len(set(rgb)) > 1:  # grey: never set
            red, green, blue = linear(np.array(rgb)).tolist()
            found[material] = (red, green, blue, 0.35)
        elif words[:1] == ["d"] and len(words) == 2 and words[1] in ("0", "0.0", "0.000000"):
            found[material] = _CLEAR
    return found


def _three(words: list[str]) -> list[float] | None:
    try:
        numbers = [float(word) for word in words]
    except ValueError:
        return None
    return numbers if len(numbers) == 3 and all(0 <= number <= 1 for number in numbers) else None
