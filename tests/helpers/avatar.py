"""A whole avatar as game exporters write it: body, clothes, hair card, teeth and eyes in meshes of their own, skinned,
with pictures; plain, or quantised as gltfpack does and packed by an encoder handed in.

Its geometry is that of our Toon, so that a reader that is right shows Toon.
"""

from __future__ import annotations

import io
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image
from scipy.interpolate import NearestNDInterpolator

from core_pipeline.faces.face import Face
from core_pipeline.faces.face_folder import load
from tests.helpers.gltf import Gltf

#: The avatar's size and place: metres, standing on the ground.
SCALE, HEIGHT = 0.11, 1.66
#: How many parts of a whole positions are quantised to.
STEPS = 2**14 - 1

_ROOT = Path(__file__).resolve().parents[2]
_SAME = {
    "jawOpen": "open", "mouthPucker": "W", "mouthFunnel": "ShCh", "mouthClose": "PBM", "mouthRollLower": "FV",
    "mouthStretchLeft": "wide", "viseme_aa": "open", "viseme_U": "W", "viseme_CH": "ShCh", "viseme_PP": "PBM",
    "viseme_FF": "FV", "viseme_I": "wide", "eyeBlinkLeft": "blink", "eyeBlinkRight": "blink", "browInnerUp": "browUp",
}  # fmt: skip
#: mesh → the parts of Toon it is made of
MESHES = {
    "Wolf3D_Head": ("skin", "lips", "mouth", "lid_rims", "ear_right", "ear_left", "neck", "brow_right", "brow_left"),
    "Wolf3D_Teeth": ("teeth_upper", "gums_upper", "teeth_lower", "gums_lower", "tongue"),
    "EyeLeft": ("eye_left",),
    "EyeRight": ("eye_right",),
    "Wolf3D_Hair": ("hair",),
}
WITH_SHAPES = ("Wolf3D_Head", "Wolf3D_Teeth")

#: (elements (n, bytes), "ATTRIBUTES" or "TRIANGLES") → stream
Pack = Callable[[np.ndarray, str], bytes]


@dataclass(frozen=True)
class Piece:
    """One mesh, in the avatar's space; colours are sRGB, 0…255."""

    positions: np.ndarray
    normals: np.ndarray
    triangles: np.ndarray
    places: np.ndarray
    picture: bytes
    deltas: dict[str, np.ndarray]


@cache
def toon() -> Face:
    return load(_ROOT / "assets" / "faces" / "toon")


def avatar(shapes: Sequence[str], *, quantised: bool = False, pack: Pack | None = None, body: bool = True) -> Gltf:
    """The file. `pack` compresses the buffer views: vertices always, indices too when it is an encoder for both."""
    gltf = Gltf()
    document = gltf.json
    joints = [1, 2]
    document["nodes"] = [
        {"name": "Armature", "children": [1]},
        {"name": "Hips", "translation": [0, 1.0, 0], "children": [2]},
        {"name": "Head", "translation": [0, HEIGHT - 1.0, 0]},
    ]
    document["skins"] = []
    document["scenes"] = [{"nodes": [0]}]
    for part in ("textures", "images", "materials"):
        document[part] = []
    for name in MESHES:
        _add(gltf, name, _piece(name, tuple(shapes) if name in WITH_SHAPES else ()), joints, quantised, pack)
    if body:
        _add(gltf, "Wolf3D_Body", _body(), joints, quantised, pack)
    if quantised:
        document["extensionsRequired"] = document["extensionsUsed"] = ["KHR_mesh_quantization"]
    if pack:
        document["extensionsRequired"] = [*document["extensionsRequired"], "EXT_meshopt_compression"]
        document["buffers"].append({"byteLength": 2**20, "extensions": {"EXT_meshopt_compression": {"fallback": True}}})
    return gltf


def packed(raw: np.ndarray, _mode: str = "ATTRIBUTES") -> bytes:
    """Vertices (n, stride) as a meshopt stream in which a group of sixteen is nothing or whole bytes."""
    count, stride = raw.shape
    steps = np.diff(raw, axis=0, prepend=raw[:1]).astype(np.uint8)
    zigzag = (steps << 1) ^ (steps.view(np.int8) >> 7).view(np.uint8)
    block, stream = min(8192 // stride & ~15, 256), bytearray(b"\xa0")
    for first in range(0, count, block):
        part = zigzag[first : first + block]
        part = np.pad(part, ((0, -len(part) % 16), (0, 0))).reshape(-1, 16, stride)
        used = part.any(axis=1)
        for column in range(stride):
            header = sum(3 << 2 * group for group in np.flatnonzero(used[:, column]).tolist())
            stream += header.to_bytes(-(-len(part) // 4), "little")
            stream += part[used[:, column], :, column].tobytes()
    return bytes(stream) + bytes(max(32 - stride, 0)) + raw[0].tobytes()


@cache
def _piece(name: str, shapes: tuple[str, ...]) -> Piece:
    face = toon()
    triangles = np.concatenate([face.triangles[a : a + n] for a, n in (face.parts[part] for part in MESHES[name])])
    used, corners = np.unique(triangles, return_inverse=True)
    positions = face.positions[used]
    deltas = {
        shape: face.deltas[face.shapes.index(_SAME[shape]), used] * SCALE
        if shape in _SAME
        else _small(positions, number)
        for number, shape in enumerate(shapes)
    }
    places = _places(name, used, positions)
    return Piece(
        positions * SCALE + np.float32([0, HEIGHT, 0]),
        face.normals[used],
        corners.reshape(-1, 3),
        places,
        _painted(places, face.colours[used, :3]),
        deltas,
    )


def _small(positions: np.ndarray, number: int) -> np.ndarray:
    """A shape of no meaning: a dent that differs from shape to shape."""
    where = np.float32([np.sin(number), np.cos(number), 1.0])
    near = np.exp(-6 * ((positions - where) ** 2).sum(1))
    return (near[:, None] * np.float32([0, 0.02, 0.01]) * (near > 0.05)[:, None] * SCALE).astype(np.float32)


def _places(name: str, used: np.ndarray, positions: np.ndarray) -> np.ndarray:
    """Texture coordinates: each part in a strip of its own, round the head or over the front of an eye; +v down."""
    face, parts = toon(), MESHES[name]
    places = np.zeros((len(positions), 2), np.float32)
    for row, part in enumerate(parts):
        first, count = face.parts[part]
        mine = np.isin(used, face.triangles[first : first + count])
        points = positions[mine]
        low, high = points.min(0), points.max(0)
        flat = (points - low) / (high - low)
        if not name.startswith("Eye"):
            flat[:, 0] = np.arctan2(points[:, 0], points[:, 2]) / (2 * np.pi) + 0.5
        places[mine] = np.stack([flat[:, 0], (row + 0.05 + 0.9 * (1 - flat[:, 1])) / len(parts)], -1)
    return places


def _painted(places: np.ndarray, linear: np.ndarray, side: int = 256) -> bytes:
    srgb = np.where(linear <= 0.0031308, linear * 12.92, 1.055 * np.maximum(linear, 0.0031308) ** (1 / 2.4) - 0.055)
    row, column = np.mgrid[0:side, 0:side]
    near = NearestNDInterpolator(places, srgb * 255)
    picture = near(np.stack([(column + 0.5) / side, (row + 0.5) / side], -1)).astype(np.uint8)
    out = io.BytesIO()
    Image.fromarray(picture).save(out, "PNG")
    return out.getvalue()


def _body() -> Piece:
    """Trunk and legs: a pillar from the neck to the ground."""
    around = np.linspace(0, 2 * np.pi, 13)
    rings = [np.stack([0.2 * np.sin(around), np.full(13, y), 0.12 * np.cos(around)], -1) for y in (1.42, 1.0, 0.0)]
    positions = np.concatenate(rings).astype(np.float32)
    first = np.arange(26)[np.arange(26) % 13 < 12]
    triangles = np.concatenate(
        [np.stack([first, first + 13, first + 14], 1), np.stack([first, first + 14, first + 1], 1)]
    )
    normals = positions * np.float32([1, 0, 1])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    places = np.zeros((len(positions), 2), np.float32)
    return Piece(positions, normals, triangles, places, _painted(np.eye(3)[:, :2], np.full((3, 3), 0.1), 2), {})


def _add(gltf: Gltf, name: str, piece: Piece, joints: list[int], quantised: bool, pack: Pack | None) -> None:
    document, count = gltf.json, len(piece.positions)
    low, size = piece.positions.min(0), float(np.ptp(piece.positions, axis=0).max())
    step = size / STEPS if quantised else 1.0
    inverse = np.tile(np.eye(4, dtype=np.float32), (len(joints), 1, 1))
    for row, height in enumerate((1.0, HEIGHT)):
        inverse[row, 1, 3] = -height
        if quantised:
            inverse[row, :3, 3] += low
            inverse[row, :3, :3] *= step
    writer = _Writer(gltf, pack)
    which = np.zeros((count, 4), np.uint8)
    which[:, 0] = 1
    weights = np.zeros((count, 4), np.uint8)
    weights[:, 0] = 255
    attributes: dict[str, int] = {}
    if quantised:
        attributes["POSITION"] = writer.values(np.rint((piece.positions - low) / step).astype(np.uint16))
        attributes["NORMAL"] = writer.values(np.rint(piece.normals * 127).astype(np.int8), normalized=True)
        attributes["TEXCOORD_0"] = writer.values(np.rint(piece.places * 4095).astype(np.uint16))
    else:
        attributes["POSITION"] = writer.values(piece.positions.astype(np.float32))
        attributes["NORMAL"] = writer.values(piece.normals.astype(np.float32))
        attributes["TEXCOORD_0"] = writer.values(piece.places.astype(np.float32))
    attributes["TEXCOORD_1"] = writer.values(np.zeros((count, 2), np.uint16), normalized=True)
    attributes["JOINTS_0"] = writer.values(which)
    attributes["WEIGHTS_0"] = writer.values(weights, normalized=True)
    targets = []
    for delta in piece.deltas.values():
        moved = np.rint(delta / step).astype(np.int16) if quantised else delta.astype(np.float32)
        targets.append({"POSITION": writer.values(moved)})
    primitive: dict[str, Any] = {
        "attributes": attributes,
        "indices": writer.values(piece.triangles.reshape(-1, 1).astype(np.uint16), indices=True),
        "material": _material(gltf, name, piece.picture, quantised),
    }
    mesh: dict[str, Any] = {"name": name, "primitives": [primitive]}
    if targets:
        primitive["targets"] = targets
        mesh |= {"extras": {"targetNames": list(piece.deltas)}, "weights": [0.0] * len(targets)}
    document["meshes"].append(mesh)
    bind = gltf.view(inverse.swapaxes(1, 2).reshape(-1, 16))
    document["accessors"].append({"bufferView": bind, "componentType": 5126, "count": len(joints), "type": "MAT4"})
    document["skins"].append({"joints": joints, "inverseBindMatrices": len(document["accessors"]) - 1})
    document["nodes"][0]["children"].append(len(document["nodes"]))
    document["nodes"].append({"name": name, "mesh": len(document["meshes"]) - 1, "skin": len(document["skins"]) - 1})


def _material(gltf: Gltf, name: str, picture: bytes, quantised: bool) -> int:
    document = gltf.json
    document["images"].append({"bufferView": gltf.view(np.frombuffer(picture, np.uint8)), "mimeType": "image/png"})
    document["textures"].append({"source": len(document["images"]) - 1})
    texture: dict[str, Any] = {"index": len(document["textures"]) - 1}
    if quantised:
        texture["extensions"] = {"KHR_texture_transform": {"scale": [1 / 4095, 1 / 4095]}}
    document["materials"].append(
        {
            "name": name,
            "pbrMetallicRoughness": {"baseColorTexture": texture, "metallicFactor": 0, "roughnessFactor": 0.5},
        }
    )
    return len(document["materials"]) - 1


class _Writer:
    """Accessors as gltfpack lays them out: every element padded to four bytes, streams packed."""

    def __init__(self, gltf: Gltf, pack: Pack | None) -> None:
        self._gltf, self._pack = gltf, pack

    def values(self, values: np.ndarray, *, normalized: bool = False, indices: bool = False) -> int:
        if self._pack is None and values.dtype.kind != "f" and not indices:
            return self._strided(values, normalized)
        if self._pack is None or (indices and self._pack is packed):
            return self._gltf.accessor(values, normalized=normalized)
        if indices:
            raw, stride = np.ascontiguousarray(values), values.dtype.itemsize
        else:
            raw, stride = _padded(values), -(-values.shape[1] * values.dtype.itemsize // 4) * 4
        return self._entry(values, self._packed(raw, stride, len(values), indices), normalized)

    def _strided(self, values: np.ndarray, normalized: bool) -> int:
        raw = _padded(values)
        return self._entry(values, self._gltf.view(raw, stride=raw.shape[1]), normalized)

    def _packed(self, raw: np.ndarray, stride: int, count: int, indices: bool) -> int:
        assert self._pack is not None
        mode = "TRIANGLES" if indices else "ATTRIBUTES"
        stream = self._gltf.json["bufferViews"][self._gltf.view(np.frombuffer(self._pack(raw, mode), np.uint8))]
        extension = {**stream, "count": count, "byteStride": stride, "mode": mode}
        view: dict[str, Any] = {"buffer": 1, "byteLength": count * stride}
        view["extensions"] = {"EXT_meshopt_compression": extension}
        self._gltf.json["bufferViews"].append(view if indices else view | {"byteStride": stride})
        return len(self._gltf.json["bufferViews"]) - 1

    def _entry(self, values: np.ndarray, view: int, normalized: bool) -> int:
        kinds = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}
        components = {"int8": 5120, "uint8": 5121, "int16": 5122, "uint16": 5123, "float32": 5126}
        entry = {
            "bufferView": view,
            "componentType": components[values.dtype.name],
            "count": len(values),
            "type": kinds[values.shape[1]],
            "normalized": normalized,
        }
        self._gltf.json["accessors"].append(entry)
        return len(self._gltf.json["accessors"]) - 1


def _padded(values: np.ndarray) -> np.ndarray:
    raw = np.ascontiguousarray(values).view(np.uint8).reshape(len(values), -1)
    return np.ascontiguousarray(np.pad(raw, ((0, 0), (0, -raw.shape[1] % 4))))
