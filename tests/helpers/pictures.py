"""Small files on whose triangles a picture lies, and what is seen at a vertex: its colour × the picture there."""

from __future__ import annotations

import io
import zlib
from typing import Any

import numpy as np
from PIL import Image

from core_pipeline.faces.face import Face
from core_pipeline.faces.texture import Texture
from tests.helpers.gltf import Gltf, tetrahedron


def png(pixels: Any, kind: str = "PNG") -> bytes:
    out = io.BytesIO()
    Image.fromarray(np.array(pixels, np.uint8)).save(out, kind, **({"lossless": True} if kind == "WEBP" else {}))
    return out.getvalue()


def huge_png(side: int) -> bytes:
    """A picture of a few hundred bytes that announces side × side pixels."""
    whole = bytearray(png([[[1, 2, 3]]]))
    whole[16:24] = side.to_bytes(4, "big") * 2
    whole[29:33] = zlib.crc32(bytes(whole[12:29])).to_bytes(4, "big")
    return bytes(whole)


#: red above green, blue beside: top left, top right, bottom left, bottom right
FOUR = png([[[255, 0, 0], [0, 0, 255]], [[0, 188, 0], [255, 255, 255]]])
#: the same in linear RGB
COLOURS = [[1, 0, 0], [0, 0, 1], [0, 0.5028865, 0], [1, 1, 1]]


def textured(
    picture: bytes = FOUR,
    places: Any = ((0.1, 0.1), (0.9, 0.1), (0.1, 0.9), (0.9, 0.9)),
    uri: str | None = None,
    **material: Any,
) -> Gltf:
    """A tetrahedron whose four vertices lie in a picture; `surface` and the rest describe its material."""
    gltf = tetrahedron()
    coordinates = gltf.view(np.array(places, np.float32))
    gltf.json["accessors"].append({"bufferView": coordinates, "componentType": 5126, "count": 4, "type": "VEC2"})
    gltf.primitive()["attributes"]["TEXCOORD_0"] = len(gltf.json["accessors"]) - 1
    gltf.primitive()["material"] = 0
    image = {"uri": uri} if uri else {"bufferView": gltf.view(np.frombuffer(picture, np.uint8))}
    gltf.json["images"] = [image]
    gltf.json["textures"] = [{"source": 0}]
    surface = {"baseColorTexture": {"index": 0}, "roughnessFactor": 1} | material.pop("surface", {})
    gltf.json["materials"] = [{"pbrMetallicRoughness": surface} | material]
    return gltf


def pixel(value: float, wrap: str, side: int) -> int:
    """The row or column that a coordinate falls on, told pixel by pixel."""
    at = int(np.floor(value * side))
    if wrap == "clamp":
        return min(max(at, 0), side - 1)
    turn, at = divmod(at, side)
    return side - 1 - at if wrap == "mirror" and turn % 2 else at


def sampled(texture: Texture, places: np.ndarray) -> np.ndarray:
    """(n, 4) linear RGB and alpha of the nearest pixels."""
    height, width = texture.picture.shape[:2]
    found = [
        texture.picture[pixel(v, texture.wrap[1], height), pixel(u, texture.wrap[0], width)] for u, v in places.tolist()
    ]
    values = np.array(found) / 255
    rgb = values[:, :3]
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    return np.concatenate([linear, values[:, 3:]], axis=1)


def seen_colours(face: Face) -> np.ndarray:
    """(n, 3) linear RGB at the vertices of a face, in the light of nothing."""
    colours = face.colours[:, :3].astype(float)
    for name, material in face.materials.items():
        first, count = face.parts[name]
        mine = np.unique(face.triangles[first : first + count])
        assert face.texcoords is not None
        colours[mine] *= sampled(face.textures[material.texture], face.texcoords[mine])[:, :3]
    return colours
