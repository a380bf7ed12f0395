"""A glTF material as colours per vertex: vertex colours × the material's colour × its picture; and what is see-through.

We draw opaque triangles of one colour per vertex, finer ones where a picture needs them. Triangles a material makes
invisible (lash cards, corneas) are left out, else they would stand before the eyes.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core_pipeline.faces.face import Floats
from core_pipeline.faces.finer import Box, Finer, refined
from core_pipeline.faces.gltf_file import GltfFile, Json
from core_pipeline.faces.gltf_pictures import Picture, unpacked
from core_pipeline.faces.obj_colours import SKIN, named_colour

_VISIBLE = 0.4
#: A material whose colour is as light as that has left all colour to its picture.
_WHITE = 0.95
#: Most pixels (in each direction) averaged for one vertex: more would mix in what lies beside an island.
_BLUR = 4
_REPEAT, _CLAMP, _MIRROR = 10497, 33071, 33648

Triangles = NDArray[np.uint32]


@dataclass(frozen=True)
class Surface:
    """colours (n, 4): linear RGB and gloss; shown (m,) which triangles can be seen."""

    colours: Floats
    shown: NDArray[np.bool_]


@dataclass(frozen=True)
class Pictured:
    """A picture (h, w, 4) in sRGB, where vertices lie in it (n, 2), and how it goes on beyond its edges."""

    picture: Picture
    places: NDArray[np.float64]
    modes: tuple[Any, Any]

    def sample(self, places: NDArray[np.float64]) -> Floats:
        """(n, 4) sRGB and alpha at texture coordinates (n, 2); +v is down, as in glTF."""
        height, width = self.picture.shape[:2]
        at = np.stack([_wrapped(places[:, axis], mode) for axis, mode in enumerate(self.modes)], -1)
        column = np.minimum((at[:, 0] * width).astype(np.int64), width - 1)
        row = np.minimum((at[:, 1] * height).astype(np.int64), height - 1)
        values: Floats = self.picture[row, column].astype(np.float32) / 255
        return values

    def colours(self, finer: Finer) -> tuple[Floats, Floats]:
        """Linear RGB and alpha at the vertices (n, 4), and amid the triangles (m, 4).

        A vertex stands for what lies around it: where triangles are large, pixels are averaged first.
        """
        places, triangles = finer.of(self.places), finer.triangles
        corners = places[triangles]
        edges = np.abs(corners - np.roll(corners, 1, axis=1)).max(axis=2) * max(self.picture.shape[:2])
        times = int(np.clip(np.median(edges) / 2, 1, _BLUR)) if len(edges) else 1
        from_afar = Pictured(_shrunk(self.picture, times), self.places, self.modes)
        return _linear(from_afar.sample(places)), _linear(from_afar.sample(corners.mean(axis=1)))


class Colours:
    """Reads the materials of one file; every picture once."""

    def __init__(self, gltf: GltfFile) -> None:
        self._gltf = gltf
        self._pictures: dict[int, Picture | None] = {}

    def finer(self, primitive: Json, positions: Floats, triangles: Triangles, box: Box, most: int) -> Finer:
        """The triangles of a primitive, halved where its picture asks for it, inside the head's box: `most` more."""
        found = self._pictured(primitive)
        if found is None or most <= 0:
            return Finer(triangles)
        return refined(positions, found.places, triangles, found.sample, box, most)

    def of(self, primitive: Json, name: str, count: int, finer: Finer) -> Surface:
        """The surface of a primitive that had `count` vertices and is now as `finer` says.

        name  of the part: where its picture cannot be read, it tells what colour to expect
        """
        gltf, triangles = self._gltf, finer.triangles
        material = gltf.item("materials", primitive["material"]) if "material" in primitive else {}
        surface = gltf.part(material, "pbrMetallicRoughness")
        older = gltf.part(gltf.part(material, "extensions"), "KHR_materials_pbrSpecularGlossiness")
        factor = surface.get("baseColorFactor", older.get("diffuseFactor", (1, 1, 1, 1)))
        base = gltf.floats(factor, 4)
        all_of_them = count + sum(map(len, finer.rounds))
        alpha = np.full(all_of_them, base[3])
        colours = np.ones((all_of_them, 4), np.float32)
        colours[:, 3] = 1 - np.clip(gltf.floats([surface.get("roughnessFactor", 0.6)], 1)[0], 0, 1)
        index: Any = gltf.part(primitive, "attributes").get("COLOR_0")
        if index is not None:
            kind = "VEC4" if gltf.item("accessors", index).get("type") == "VEC4" else "VEC3"
            own = finer.of(gltf.read(index, kind).astype(np.float32))
            colours[:, :3] = own[:, :3]
            if kind == "VEC4" and primitive.get("extras") == {"glossInAlpha": True}:
                colours[:, 3] = own[:, 3]
            elif kind == "VEC4":
                alpha *= own[:, 3]
        colours[:, :3] *= base[:3]
        seen = alpha[triangles].mean(axis=1)
        pictured = self._pictured(primitive) if count else None
        if pictured is not None:
            at_vertices, at_triangles = pictured.colours(finer)
            colours[:, :3] *= at_vertices[:, :3]
            seen = seen * (at_triangles[:, 3] + at_vertices[:, 3][triangles].mean(axis=1)) / 2
        elif "baseColorTexture" in surface and index is None and min(base[:3]) > _WHITE:
            expected = named_colour(f"{name} {material.get('name', '')}")
            colours[:, :3] *= (expected or SKIN)[:3]
        shown = np.ones(len(triangles), bool)
        if material.get("alphaMode") in ("MASK", "BLEND"):
            cutoff = gltf.floats([material.get("alphaCutoff", 0.5)], 1)[0]
            shown = seen >= (cutoff if material["alphaMode"] == "MASK" else _VISIBLE)
        return Surface(np.clip(colours, 0, 1), shown)

    def _pictured(self, primitive: Json) -> Pictured | None:
        """The picture of a primitive's material and where its vertices lie in it; None when it shows none."""
        gltf = self._gltf
        material = gltf.item("materials", primitive["material"]) if "material" in primitive else {}
        older = gltf.part(gltf.part(material, "extensions"), "KHR_materials_pbrSpecularGlossiness")
        surface = gltf.part(material, "pbrMetallicRoughness")
        texture = gltf.part(surface, "baseColorTexture") or gltf.part(older, "diffuseTexture")
        move = gltf.part(gltf.part(texture, "extensions"), "KHR_texture_transform")
        channel = f"TEXCOORD_{move.get('texCoord', texture.get('texCoord', 0))}"
        attributes = gltf.part(primitive, "attributes")
        if not texture or channel not in attributes:
            return None
        found = gltf.item("textures", texture.get("index"))
        picture = self._picture(found)
        if picture is None:
            return None
        places = gltf.read(attributes[channel], "VEC2").astype(np.float64)
        angle = gltf.floats([move.get("rotation", 0)], 1)[0]
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        places = (places * gltf.floats(move.get("scale", (1, 1)), 2)) @ turn + gltf.floats(
            move.get("offset", (0, 0)), 2
        )
        wrap = gltf.item("samplers", found["sampler"]) if "sampler" in found else {}
        return Pictured(picture, places, (wrap.get("wrapS", _REPEAT), wrap.get("wrapT", _REPEAT)))

    def _picture(self, texture: Json) -> Picture | None:
        """(h, w, 4) sRGB, or None after a note when this kind of picture cannot be read."""
        gltf = self._gltf
        other = gltf.part(texture, "extensions")
        kinds = [gltf.part(other, name) for name in ("EXT_texture_webp", "KHR_texture_basisu")]
        index = next((kind["source"] for kind in kinds if "source" in kind), texture.get("source"))
        if index is None:
            gltf.note("Some of its textures are in a format that cannot be read: parts show a plain colour.")
            return None
        image = gltf.item("images", index)
        if index not in self._pictures:
            raw = (
                gltf.data(image["bufferView"]) if "bufferView" in image else gltf.beside(image.get("uri"), "a texture")
            )
            self._pictures[index] = unpacked(gltf, raw, index)
        return self._pictures[index]


def _shrunk(picture: Picture, times: int) -> Picture:
    """The picture with `times` × `times` pixels averaged to one."""
    height, width = (side // times * times for side in picture.shape[:2])
    if times < 2 or not height or not width:
        return picture
    blocks = picture[:height, :width].reshape(height // times, times, width // times, times, 4)
    smaller: Picture = blocks.mean(axis=(1, 3)).astype(np.uint8)
    return smaller


def _linear(srgb: Floats) -> Floats:
    rgb = srgb[:, :3]
    return np.concatenate(
        [np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4), srgb[:, 3:]], axis=1
    ).astype(np.float32)


def _wrapped(values: NDArray[np.float64], mode: object) -> NDArray[np.float64]:
    if mode == _CLAMP:
        return np.clip(values, 0, 1)
    if mode == _MIRROR:
        return 1 - np.abs(values % 2 - 1)
    return values % 1
