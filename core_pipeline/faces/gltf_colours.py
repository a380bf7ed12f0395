"""A glTF material as colours per vertex: vertex colours × the material's colour × its picture; and what is see-through.

We draw opaque triangles of one colour per vertex. Triangles a material makes invisible (lash cards, corneas) are
left out, else they would stand before the eyes.
"""

from __future__ import annotations

import io
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image, UnidentifiedImageError

from core_pipeline.errors import UserError
from core_pipeline.faces.face import Floats
from core_pipeline.faces.gltf_file import GltfFile, Json

#: Pixels a picture may announce; it is not unpacked before.
MAX_PIXELS = 8192 * 8192
#: Pictures are looked up at this size: one value per vertex wants no more.
_SIDE = 1024
_VISIBLE = 0.4
_REPEAT, _CLAMP, _MIRROR = 10497, 33071, 33648

Triangles = NDArray[np.uint32]
Picture = NDArray[np.uint8]


@dataclass(frozen=True)
class Surface:
    """colours (n, 4): linear RGB and gloss; shown (m,) which triangles can be seen."""

    colours: Floats
    shown: NDArray[np.bool_]


class Colours:
    """Reads the materials of one file; every picture once."""

    def __init__(self, gltf: GltfFile) -> None:
        self._gltf = gltf
        self._pictures: dict[int, Picture | None] = {}

    def of(self, primitive: Json, count: int, triangles: Triangles) -> Surface:
        """The surface of a primitive with `count` vertices."""
        gltf = self._gltf
        material = gltf.item("materials", primitive["material"]) if "material" in primitive else {}
        surface = gltf.part(material, "pbrMetallicRoughness")
        older = gltf.part(gltf.part(material, "extensions"), "KHR_materials_pbrSpecularGlossiness")
        factor = surface.get("baseColorFactor", older.get("diffuseFactor", (1, 1, 1, 1)))
        base = gltf.floats(factor, 4)
        alpha = np.full(count, base[3])
        colours = np.ones((count, 4), np.float32)
        colours[:, 3] = 1 - np.clip(gltf.floats([surface.get("roughnessFactor", 0.6)], 1)[0], 0, 1)
        index: Any = gltf.part(primitive, "attributes").get("COLOR_0")
        if index is not None:
            kind = "VEC4" if gltf.item("accessors", index).get("type") == "VEC4" else "VEC3"
            own = gltf.read(index, kind).astype(np.float32)
            colours[:, :3] = own[:, :3]
            if kind == "VEC4" and primitive.get("extras") == {"glossInAlpha": True}:
                colours[:, 3] = own[:, 3]
            elif kind == "VEC4":
                alpha *= own[:, 3]
        colours[:, :3] *= base[:3]
        texture = gltf.part(surface, "baseColorTexture") or gltf.part(older, "diffuseTexture")
        seen = alpha[triangles].mean(axis=1)
        if texture:
            looked_up = self._looked_up(texture, primitive, count, triangles)
            if looked_up is not None:
                at_vertices, at_triangles = looked_up
                colours[:, :3] *= at_vertices[:, :3]
                seen = seen * (at_triangles[:, 3] + at_vertices[:, 3][triangles].mean(axis=1)) / 2
        shown = np.ones(len(triangles), bool)
        if material.get("alphaMode") in ("MASK", "BLEND"):
            cutoff = gltf.floats([material.get("alphaCutoff", 0.5)], 1)[0]
            shown = seen >= (cutoff if material["alphaMode"] == "MASK" else _VISIBLE)
        return Surface(np.clip(colours, 0, 1), shown)

    def _looked_up(
        self, texture: Json, primitive: Json, count: int, triangles: Triangles
    ) -> tuple[Floats, Floats] | None:
        """Linear RGB and alpha of the picture at the vertices (n, 4), and amid the triangles (m, 4)."""
        gltf = self._gltf
        move = gltf.part(gltf.part(texture, "extensions"), "KHR_texture_transform")
        channel = f"TEXCOORD_{move.get('texCoord', texture.get('texCoord', 0))}"
        attributes = gltf.part(primitive, "attributes")
        if channel not in attributes:
            return None
        found = gltf.item("textures", texture.get("index"))
        picture = self._picture(found)
        if picture is None or not count:
            return None
        places = gltf.read(attributes[channel], "VEC2").astype(np.float64)
        angle = gltf.floats([move.get("rotation", 0)], 1)[0]
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        places = (places * gltf.floats(move.get("scale", (1, 1)), 2)) @ turn + gltf.floats(
            move.get("offset", (0, 0)), 2
        )
        wrap = gltf.item("samplers", found["sampler"]) if "sampler" in found else {}
        modes = wrap.get("wrapS", _REPEAT), wrap.get("wrapT", _REPEAT)
        inside = _sampled(picture, places[triangles].reshape(-1, 3, 2).mean(axis=1), modes)
        return _sampled(picture, places, modes), inside

    def _picture(self, texture: Json) -> Picture | None:
        """(h, w, 4) sRGB, or None after a note when this kind of picture cannot be read."""
        gltf = self._gltf
        webp = gltf.part(gltf.part(texture, "extensions"), "EXT_texture_webp")
        index = webp.get("source", texture.get("source"))
        if index is None:
            gltf.note("Some of its textures are in a format that cannot be read: parts show their plain colour.")
            return None
        image = gltf.item("images", index)
        if index not in self._pictures:
            raw = (
                gltf.data(image["bufferView"]) if "bufferView" in image else gltf.beside(image.get("uri"), "a texture")
            )
            self._pictures[index] = self._unpacked(raw, index)
        return self._pictures[index]

    def _unpacked(self, raw: bytes, index: int) -> Picture | None:
        gltf = self._gltf
        try:
            with Image.open(io.BytesIO(raw), formats=("PNG", "JPEG", "WEBP")) as image:
                width, height = image.size
                if width * height > MAX_PIXELS:
                    raise gltf.fail(f"image {index} has {width:,} × {height:,} pixels, more than we take; reduce it.")
                image.draft("RGB", (_SIDE, _SIDE))
                image.thumbnail((_SIDE, _SIDE), Image.Resampling.BOX)
                return np.asarray(image.convert("RGBA"))
        except UserError:
            raise
        except Image.DecompressionBombError:
            raise gltf.fail(f"image {index} unpacks to far too many pixels; reduce its size.") from None
        except (UnidentifiedImageError, OSError, ValueError, SyntaxError, EOFError, KeyError, IndexError, TypeError):
            gltf.note(f"Image {index} cannot be read: what it covers shows its plain colour.")
            return None


def _sampled(picture: Picture, places: NDArray[np.float64], modes: tuple[Any, Any]) -> Floats:
    """(n, 4) linear RGB and alpha at texture coordinates (n, 2); +v is down, as in glTF."""
    height, width = picture.shape[:2]
    at = np.stack([_wrapped(places[:, axis], mode) for axis, mode in enumerate(modes)], -1)
    column = np.minimum((at[:, 0] * width).astype(np.int64), width - 1)
    row = np.minimum((at[:, 1] * height).astype(np.int64), height - 1)
    values: Floats = picture[row, column].astype(np.float32) / 255
    rgb = values[:, :3]
    values[:, :3] = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    return values


def _wrapped(values: NDArray[np.float64], mode: object) -> NDArray[np.float64]:
    if mode == _CLAMP:
        return np.clip(values, 0, 1)
    if mode == _MIRROR:
        return 1 - np.abs(values % 2 - 1)
    return values % 1
