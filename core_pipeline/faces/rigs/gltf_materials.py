"""A glTF material on our faces: what multiplies its picture, the picture itself, and what of it is see-through.

Vertex colours and the material's colour go into our vertex colours. What can never be seen (corneas, tear lines, the
empty parts of lash cards) is left out: it would stand before the eyes.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core_pipeline.faces.face import Floats
from core_pipeline.faces.rigs.album import Album, Key, Wraps
from core_pipeline.faces.rigs.gltf_file import GltfFile, Json
from core_pipeline.faces.rigs.obj_colours import SKIN, named_colour
from core_pipeline.faces.rigs.picture_alpha import FAINT, VISIBLE, highest_alpha, seen_through
from core_pipeline.faces.rigs.pictures import Picture, Unpacker
from core_pipeline.faces.texture import Material, Texture, Wrap

#: A material whose colour is as light as that has left all colour to its picture.
_WHITE = 0.95
_SEE_THROUGH = ("MASK", "BLEND")
_WRAPS: dict[float, Wrap] = {10497: "repeat", 33071: "clamp", 33648: "mirror"}

Triangles = NDArray[np.uint32]


@dataclass(frozen=True)
class Surface:
    """What a primitive looks like.

    colours    (n, 4) linear RGB and gloss
    shown      (m,) which triangles can be seen
    material   the picture on it, None for none
    texcoords  (n, 2), +v down, when it has one
    """

    colours: Floats
    shown: NDArray[np.bool_]
    material: Material | None = None
    texcoords: Floats | None = None


@dataclass(frozen=True)
class _Lying:
    """A picture, its name in the album, and where (n, 2) vertices lie in it."""

    texture: Texture
    key: Key
    texcoords: Floats


class Materials:
    """Reads the materials of one file; every picture once, into the `album`."""

    def __init__(self, gltf: GltfFile) -> None:
        self.album = Album()
        self._gltf = gltf
        self._unpacker = Unpacker(gltf)

    def of(self, primitive: Json, name: str, count: int, triangles: Triangles) -> Surface:
        """The surface of a primitive of `count` vertices.

        name  of the part: where its picture cannot be read, it tells what colour to expect
        """
        gltf = self._gltf
        material = gltf.item("materials", primitive["material"]) if "material" in primitive else {}
        surface = gltf.part(material, "pbrMetallicRoughness")
        older = gltf.part(gltf.part(material, "extensions"), "KHR_materials_pbrSpecularGlossiness")
        base = gltf.floats(surface.get("baseColorFactor", older.get("diffuseFactor", (1, 1, 1, 1))), 4)
        colours = np.ones((count, 4), np.float32)
        colours[:, 3] = 1 - np.clip(gltf.floats([surface.get("roughnessFactor", 0.6)], 1)[0], 0, 1)
        alpha = self._vertex_colours(primitive, colours)
        colours[:, :3] *= base[:3]
        picture = gltf.part(surface, "baseColorTexture") or gltf.part(older, "diffuseTexture")
        lying = self._lying(primitive, picture) if picture and count else None
        shown, cutoff, soft = self._seen(material, float(base[3]), alpha[triangles].mean(axis=1), lying, triangles)
        if picture and lying is None and "COLOR_0" not in gltf.part(primitive, "attributes") and min(base[:3]) > _WHITE:
            expected = named_colour(f"{name} {material.get('name', '')}") or SKIN
            if expected[3] >= 0:
                colours[:, :3] *= expected[:3]
            elif material.get("alphaMode") in _SEE_THROUGH:
                shown[:] = False  # a cornea of which we cannot see how clear it is
            else:
                colours[:, :3] *= SKIN[:3]
        colours = np.clip(colours, 0, 1)
        if lying is None or not shown.any():
            return Surface(colours, shown)
        number = self.album.number(lying.key, lying.texture.wrap)
        return Surface(colours, shown, Material(number, cutoff, soft), lying.texcoords)

    def _vertex_colours(self, primitive: Json, colours: Floats) -> NDArray[np.float64]:
        """Multiply `colours` by the file's own; the alpha (n,) that these have."""
        gltf = self._gltf
        alpha = np.ones(len(colours))
        index: Any = gltf.part(primitive, "attributes").get("COLOR_0")
        if index is None:
            return alpha
        kind = "VEC4" if gltf.item("accessors", index).get("type") == "VEC4" else "VEC3"
        own = gltf.read(index, kind).astype(np.float32)
        colours[:, :3] *= own[:, :3]
        if kind == "VEC4" and primitive.get("extras") == {"glossInAlpha": True}:
            colours[:, 3] = own[:, 3]
        elif kind == "VEC4":
            alpha *= own[:, 3]
        return alpha

    def _seen(
        self, material: Json, factor: float, alpha: NDArray[np.float64], lying: _Lying | None, triangles: Triangles
    ) -> tuple[NDArray[np.bool_], float, bool]:
        """(m,) which triangles can be seen, the alpha of the picture that cuts, and whether its edges are soft.

        alpha  (m,) of the vertices' own colours
        """
        mode = material.get("alphaMode")
        if mode not in _SEE_THROUGH:
            return np.ones(len(triangles), bool), 0.0, False
        soft = mode == "BLEND"
        least = FAINT if soft else float(self._gltf.floats([material.get("alphaCutoff", 0.5)], 1)[0])
        alpha = alpha * factor
        shown = alpha >= (VISIBLE if soft else least)
        if lying is None or lying.texture.picture[..., 3].min() == 255:
            return shown, 0.0, False
        where = lying.texture, lying.texcoords, triangles
        shown &= seen_through(*where, alpha) if soft else alpha * highest_alpha(*where) >= least
        return shown, float(np.clip(least / max(factor, 1e-6), 0, 1)), soft

    def _lying(self, primitive: Json, texture: Json) -> _Lying | None:
        """The picture of a material and where a primitive's vertices lie in it; None when it shows none."""
        gltf = self._gltf
        move = gltf.part(gltf.part(texture, "extensions"), "KHR_texture_transform")
        channel = f"TEXCOORD_{move.get('texCoord', texture.get('texCoord', 0))}"
        attributes = gltf.part(primitive, "attributes")
        if channel not in attributes:
            return None
        entry = gltf.item("textures", texture.get("index"))
        wrap = self._wrap(entry)
        key = self._source(entry)
        found = self.album.texture(key, wrap, lambda: self._unpacked(key)) if key is not None else None
        if found is None:
            return None
        places = gltf.read(attributes[channel], "VEC2").astype(np.float64)
        angle = gltf.floats([move.get("rotation", 0)], 1)[0]
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        scale, offset = gltf.floats(move.get("scale", (1, 1)), 2), gltf.floats(move.get("offset", (0, 0)), 2)
        return _Lying(found, key, (places * scale @ turn + offset).astype(np.float32))

    def _wrap(self, texture: Json) -> Wraps:
        sampler = self._gltf.item("samplers", texture["sampler"]) if "sampler" in texture else {}
        across, down = (sampler.get(key) for key in ("wrapS", "wrapT"))
        return _wrap_mode(across), _wrap_mode(down)

    def _source(self, texture: Json) -> int | None:
        """Number of the image, or None after a note when this kind of picture cannot be read."""
        gltf = self._gltf
        other = gltf.part(texture, "extensions")
        kinds = [gltf.part(other, name) for name in ("EXT_texture_webp", "KHR_texture_basisu")]
        index = next((kind["source"] for kind in kinds if "source" in kind), texture.get("source"))
        if index is None:
            gltf.note("Some of its textures are in a format that cannot be read: parts show a plain colour.")
            return None
        gltf.item("images", index)
        return int(index)

    def _unpacked(self, index: int) -> Picture | None:
        gltf = self._gltf
        image = gltf.item("images", index)
        raw = gltf.data(image["bufferView"]) if "bufferView" in image else gltf.beside(image.get("uri"), "a texture")
        return self._unpacker.unpacked(raw, f"image {index}")


def _wrap_mode(value: object) -> Wrap:
    return _WRAPS.get(value, "repeat") if isinstance(value, int | float) else "repeat"
