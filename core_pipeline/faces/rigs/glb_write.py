"""A face into a .glb (glTF 2.0): one mesh, sparse morph targets, colour per vertex with the gloss in its alpha."""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core_pipeline.errors import UserError
from core_pipeline.faces.face import Face

_VERTICES, _INDICES = 34962, 34963
_COMPONENTS = {"f": 5126, "u": 5125}


def write_glb(face: Face, path: str | Path) -> None:
    """Write `face`; the same face gives the same bytes. UserError when the file cannot be written.

    ValueError as for `glb_bytes`.
    """
    try:
        Path(path).write_bytes(glb_bytes(face))
    except OSError as error:
        raise UserError(f"{path}: cannot be written ({error.strerror}); choose another place.") from None


def glb_bytes(face: Face) -> bytes:
    """The file as bytes. ValueError for a face on which pictures lie: ours have none."""
    if face.textures:
        raise ValueError(f"{face.name}: a face with pictures cannot be written")
    pack = _Pack()
    attributes = {
        "POSITION": pack.add(face.positions, "VEC3", _VERTICES, bounds=True),
        "NORMAL": pack.add(face.normals, "VEC3", _VERTICES),
        "COLOR_0": pack.add(face.colours, "VEC4", _VERTICES),
    }
    primitive = {
        "attributes": attributes,
        "indices": pack.add(face.triangles.reshape(-1, 1), "SCALAR", _INDICES),
        "material": 0,
        "targets": [{"POSITION": pack.add_delta(delta)} for delta in face.deltas],
        "extras": {"glossInAlpha": True},
    }
    surface = {"metallicFactor": 0.0, "roughnessFactor": 0.6}
    document = {
        "asset": {"version": "2.0", "generator": "Lipstitch", "copyright": "MIT licence"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": face.name}],
        "meshes": [{"name": face.name, "primitives": [primitive], "extras": {"targetNames": list(face.shapes)}}],
        "materials": [{"pbrMetallicRoughness": surface, "doubleSided": True}],
        "accessors": pack.accessors,
        "bufferViews": pack.views,
        "buffers": [{"byteLength": len(pack.data)}],
    }
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    length = 12 + 8 + len(text) + 8 + len(pack.data)
    head = struct.pack("<4sII", b"glTF", 2, length) + struct.pack("<I4s", len(text), b"JSON")
    return head + text + struct.pack("<I4s", len(pack.data), b"BIN\0") + bytes(pack.data)


class _Pack:
    """Arrays, one after the other in one buffer, and what glTF says about them."""

    def __init__(self) -> None:
        self.data = bytearray()
        self.views: list[dict[str, Any]] = []
        self.accessors: list[dict[str, Any]] = []

    def add(self, values: NDArray[Any], kind: str, target: int, *, bounds: bool = False) -> int:
        accessor: dict[str, Any] = {
            "bufferView": self._view(values, target),
            "componentType": _COMPONENTS[values.dtype.kind],
            "count": len(values),
            "type": kind,
        }
        if bounds:
            accessor |= _bounds(values)
        self.accessors.append(accessor)
        return len(self.accessors) - 1

    def add_delta(self, delta: NDArray[np.float32]) -> int:
        """Only the vertices that move, unless nearly all do."""
        moving = np.flatnonzero(delta.any(axis=1)).astype(np.uint32)
        if not 0 < len(moving) * 16 < delta.size * 4:
            return self.add(delta, "VEC3", _VERTICES, bounds=True)
        sparse = {
            "count": len(moving),
            "indices": {"bufferView": self._view(moving, None), "componentType": 5125},
            "values": {"bufferView": self._view(delta[moving], None)},
        }
        self.accessors.append(
            {"componentType": 5126, "count": len(delta), "type": "VEC3", "sparse": sparse} | _bounds(delta)
        )
        return len(self.accessors) - 1

    def _view(self, values: NDArray[Any], target: int | None) -> int:
        raw = np.ascontiguousarray(values, values.dtype.newbyteorder("<")).tobytes()
        view: dict[str, Any] = {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(raw)}
        if target is not None:
            view["target"] = target
        self.views.append(view)
        self.data += raw + b"\0" * (-len(raw) % 4)
        return len(self.views) - 1


def _bounds(values: NDArray[Any]) -> dict[str, list[float]]:
    return {"min": (values.min(0) + 0.0).tolist(), "max": (values.max(0) + 0.0).tolist()}
