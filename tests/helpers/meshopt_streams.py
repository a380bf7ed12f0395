"""Streams from the reference encoder of meshopt, and a glTF file packed with them."""

import base64
import json
from pathlib import Path

import numpy as np

from tests.helpers.gltf import Gltf, tetrahedron

_FILE = json.loads((Path(__file__).resolve().parents[1] / "data" / "meshopt_streams.json").read_text())
CORNERS = _FILE["corners"]
STREAMS = {name: base64.b64decode(text) for name, text in _FILE["streams"].items()}


def packed_tetrahedron() -> Gltf:
    """The plain tetrahedron of the other tests, with every buffer view packed."""
    gltf = tetrahedron()
    primitive = gltf.primitive()
    jobs = [
        (primitive["attributes"]["POSITION"], "tetra points", 4, 12, {"mode": "ATTRIBUTES"}),
        (primitive["indices"], "tetra corners", 12, 4, {"mode": "TRIANGLES"}),
        (primitive["targets"][0]["POSITION"], "tetra up", 4, 12, {"mode": "ATTRIBUTES", "filter": "EXPONENTIAL"}),
    ]
    for accessor, name, count, stride, how in jobs:
        packed = gltf.json["bufferViews"][gltf.view(np.frombuffer(STREAMS[name], np.uint8))]
        extension = {**packed, "count": count, "byteStride": stride, **how}
        gltf.json["bufferViews"].append(
            {"buffer": 1, "byteLength": count * stride, "extensions": {"EXT_meshopt_compression": extension}}
        )
        gltf.json["accessors"][accessor]["bufferView"] = len(gltf.json["bufferViews"]) - 1
    gltf.json["accessors"][primitive["indices"]]["componentType"] = 5125
    gltf.json["buffers"].append({"byteLength": 96, "extensions": {"EXT_meshopt_compression": {"fallback": True}}})
    gltf.json["extensionsRequired"] = ["EXT_meshopt_compression"]
    return gltf
