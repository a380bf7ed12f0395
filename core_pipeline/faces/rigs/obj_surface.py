"""What a folder of .obj poses looks like: the neutral's triangles, colours, and the pictures its materials name.

A vertex that lies at two places of a picture becomes two, of which the first keeps its number: the poses know
numbers only.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from core_pipeline.faces.face import Floats
from core_pipeline.faces.rigs.obj_colours import SKIN, Colour, linear, named_colour
from core_pipeline.faces.rigs.obj_file import Ints, ObjFile
from core_pipeline.faces.rigs.obj_library import ObjMaterial, read_library
from core_pipeline.faces.rigs.obj_pictures import ObjPictures
from core_pipeline.faces.rigs.picture_alpha import seen_through
from core_pipeline.faces.rigs.scaffold import LEFT_OUT, is_scaffold
from core_pipeline.faces.texture import Material, Texture

_WHITE = (1.0, 1.0, 1.0, SKIN[3])

Triangles = NDArray[np.uint32]


@dataclass(frozen=True)
class Surface:
    """The rest of a face (see `Face`), and of each of its n vertices `source` (n,), the number in the files."""

    triangles: Triangles
    colours: Floats
    source: Ints
    parts: Mapping[str, tuple[int, int]]
    textures: tuple[Texture, ...]
    materials: Mapping[str, Material]
    texcoords: Floats | None
    files: tuple[Path, ...]
    notes: tuple[str, ...]


def surface(base: ObjFile, title: str) -> Surface:
    """The surface of a neutral. With pictures, every material is a part; `title` names what has none, or everything.

    UserError when its faces are damaged, or a picture is far too large.
    """
    triangles = base.triangles()
    library, files = read_library(base.path.parent, base.library)
    pictures = ObjPictures(base.path.parent, library)
    looks = [_look(stretch.name, library.get(stretch.material)) for stretch in base.stretches]
    placed = base.texture_corners() if any(material.picture for material in library.values()) else None
    # per stretch: the material whose picture lies on it, and that one's number
    lying = [
        stretch.material if placed and look and pictures.texture(stretch.material) else ""
        for stretch, look in zip(base.stretches, looks, strict=True)
    ]
    names = sorted(set(lying) - {""})
    numbers = np.array([names.index(name) if name else -1 for name in lying])
    # and now per triangle
    stretch = np.searchsorted([found.first for found in base.stretches[1:]], base.owner(), side="right")
    on = numbers[stretch]
    source, texcoords = np.arange(len(base.vertices)), None
    if placed and names:
        source, texcoords, triangles = _split(triangles, *placed, on, len(base.vertices))
    table = np.array([_WHITE if name else look or SKIN for name, look in zip(lying, looks, strict=True)], np.float32)
    colours = _colours(base, triangles, table[stretch], on, source)
    materials = {name: pictures.material(name) for name in names}
    shown = np.array([look is not None for look in looks])[stretch]
    for number, name in enumerate(names):
        texture = pictures.texture(name)
        if materials[name].soft and texture is not None and texcoords is not None:
            shown[on == number] &= seen_through(texture, texcoords, triangles[on == number], 1.0)
    scaffold = any(is_scaffold(found.name) for found in base.stretches)
    titles = [found.material if names and found.material else title for found in base.stretches]
    order, parts = _parts(titles, stretch, shown if shown.any() else ~shown)
    return Surface(
        triangles[order],
        colours,
        source,
        parts,
        pictures.textures(),
        {name: material for name, material in materials.items() if name in parts},
        texcoords,
        (*files, *pictures.files),
        (*pictures.notes, *(LEFT_OUT,) * scaffold),
    )


def _look(name: str, material: ObjMaterial | None) -> Colour | None:
    """The colour of a stretch of polygons where no picture lies; None when it is not to be seen."""
    named = named_colour(name)
    clear = material is not None and material.clear
    if (named is not None and named[3] < 0) or clear or is_scaffold(name):
        return None
    if named is not None or material is None or material.diffuse is None:
        return named or SKIN
    red, green, blue = linear(np.array(material.diffuse)).tolist()
    return (red, green, blue, SKIN[3])


def _split(triangles: Triangles, places: Floats, corners: Ints, on: Ints, count: int) -> tuple[Ints, Floats, Triangles]:
    """Vertices of one number, one place and one picture each: their `source`, texture coordinates, triangles.

    places   (t, 2), +v up
    corners  (m, 3) which of them the corners have, -1 for none
    on       (m,) number of the picture that lies on a triangle, -1 for none
    count    of the vertices there were
    """
    corners = np.where(on[:, None] < 0, -1, corners)
    keys = (triangles.astype(np.int64) * (len(places) + 1) + corners + 1) * (int(on.max()) + 2) + on[:, None] + 1
    _, first, which = np.unique(keys.ravel(), return_index=True, return_inverse=True)
    vertex, place = triangles.ravel()[first].astype(np.int64), corners.ravel()[first]
    again = np.concatenate([[False], vertex[1:] == vertex[:-1]])
    number = vertex.copy()
    number[again] = count + np.arange(np.count_nonzero(again))
    source: Ints = np.concatenate([np.arange(count), vertex[again]])
    texcoords = np.zeros((len(source), 2), np.float32)
    placed = place >= 0
    texcoords[number[placed], 0] = places[place[placed], 0]
    texcoords[number[placed], 1] = 1 - places[place[placed], 1]
    return source, texcoords, number[which].reshape(-1, 3).astype(np.uint32)


def _colours(base: ObjFile, triangles: Triangles, told: Floats, on: Ints, source: Ints) -> Floats:
    """(n, 4): what each triangle was `told` (m, 4); the file's own where no picture lies."""
    colours = np.tile(np.array(SKIN, np.float32), (len(source), 1))
    colours[triangles.ravel()] = np.repeat(told, 3, axis=0)
    if base.colours is not None:
        plain = np.ones(len(source), bool)
        plain[triangles[on >= 0].ravel()] = False
        colours[plain, :3] = linear(base.colours)[source[plain]]
    return colours


def _parts(titles: list[str], stretch: Ints, shown: NDArray[np.bool_]) -> tuple[Ints, dict[str, tuple[int, int]]]:
    """Which of the triangles that are `shown` come one after the other, and the parts they make.

    titles   name of the part that each stretch of polygons belongs to
    stretch  (m,) which one a triangle belongs to
    """
    names = sorted(set(titles))
    number = np.array([names.index(title) for title in titles])[stretch]
    order = np.argsort(number, kind="stable")
    order = order[shown[order]]
    counts = np.bincount(number[order], minlength=len(names))
    ends = np.cumsum(counts)
    found = zip(names, (ends - counts).tolist(), counts.tolist(), strict=True)
    return order, {name: (first, count) for name, first, count in found if count}
