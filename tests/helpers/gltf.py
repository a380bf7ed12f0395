"""Small glTF files, put together by hand so that tests can spoil any part of them."""

from __future__ import annotations

import json
import struct
from typing import Any

import numpy as np

_COMPONENTS = {"int8": 5120, "uint8": 5121, "int16": 5122, "uint16": 5123, "uint32": 5125, "float32": 5126}
_KINDS = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}


class Gltf:
    """`json` is the document, free to change; `data` its one buffer."""

    def __init__(self) -> None:
        self.data = b""
        self.json: dict[str, Any] = {
            "asset": {"version": "2.0"},
            "scenes": [{"nodes": []}],
            "nodes": [],
            "meshes": [],
            "accessors": [],
            "bufferViews": [],
            "buffers": [{"byteLength": 0}],
        }

    def view(self, values: np.ndarray, stride: int | None = None) -> int:
        raw = np.ascontiguousarray(values).tobytes()
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(raw)}
        self.json["bufferViews"].append(view if stride is None else view | {"byteStride": stride})
        self.data += raw + b"\0" * (-len(raw) % 4)
        self.json["buffers"][0]["byteLength"] = len(self.data)
        return len(self.json["bufferViews"]) - 1

    def accessor(self, values: np.ndarray, *, normalized: bool = False) -> int:
        entry = {
            "bufferView": self.view(values),
            "componentType": _COMPONENTS[values.dtype.name],
            "count": len(values),
            "type": _KINDS[values.shape[1]],
        }
        self.json["accessors"].append(entry | {"normalized": True} if normalized else entry)
        return len(self.json["accessors"]) - 1

    def sparse(self, count: int, indices: list[int], values: np.ndarray) -> int:
        sparse = {
            "count": len(indices),
            "indices": {"bufferView": self.view(np.array(indices, np.uint16)), "componentType": 5123},
            "values": {"bufferView": self.view(values)},
        }
        self.json["accessors"].append({"componentType": 5126, "count": count, "type": "VEC3", "sparse": sparse})
        return len(self.json["accessors"]) - 1

    def add_mesh(
        self, points: np.ndarray, indices: list[int], shapes: dict[str, np.ndarray], name: str = "tetra"
    ) -> None:
        primitive = {
            "attributes": {"POSITION": self.accessor(points)},
            "indices": self.accessor(np.array(indices, np.uint16)[:, None]),
            "targets": [{"POSITION": self.accessor(delta)} for delta in shapes.values()],
        }
        mesh = {"name": name, "primitives": [primitive], "extras": {"targetNames": list(shapes)}}
        self.json["meshes"].append(mesh)
        self.json["nodes"].append({"mesh": len(self.json["meshes"]) - 1})
        self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]) - 1)

    def mesh(self) -> dict[str, Any]:
        return self.json["meshes"][0]

    def primitive(self) -> dict[str, Any]:
        return self.mesh()["primitives"][0]

    def points(self) -> np.ndarray:
        view = self.json["bufferViews"][0]
        return np.frombuffer(self.data, np.float32, view["byteLength"] // 4, view["byteOffset"]).reshape(-1, 3)

    def glb(self) -> bytes:
        text = json.dumps(self.json).encode()
        text += b" " * (-len(text) % 4)
        head = struct.pack("<4sII", b"glTF", 2, 12 + 8 + len(text) + 8 + len(self.data))
        return (
            head
            + struct.pack("<I4s", len(text), b"JSON")
            + text
            + struct.pack("<I4s", len(self.data), b"BIN\0")
            + self.data
        )


def tetrahedron() -> Gltf:
    """Four triangles facing outwards; the shape "up" lifts the last vertex by 1."""
    gltf = Gltf()
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], np.float32)
    up = np.zeros((4, 3), np.float32)
    up[3, 1] = 1
    gltf.add_mesh(points, [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3], {"up": up})
    return gltf
