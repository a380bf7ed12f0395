"""Meshes compressed with KHR_draco_mesh_compression, unpacked by the optional package DracoPy."""

from __future__ import annotations

from typing import Any

import numpy as np

from core_pipeline.faces.rigs.gltf_file import GltfFile, Json
from core_pipeline.faces.rigs.limits import MAX_VERTICES


def unpack(gltf: GltfFile, primitive: Json) -> None:
    """Give the accessors of a primitive the values its Draco data holds; nothing when it holds none.

    Morph targets are not compressed by Draco: they fit when the vertices were encoded in order, and UserError
    says so when the counts show that they were not.
    """
    packed = gltf.part(gltf.part(primitive, "extensions"), "KHR_draco_mesh_compression")
    if not packed:
        return
    try:
        import DracoPy  # type: ignore[import-not-found, import-untyped, unused-ignore]
    except ImportError:
        raise gltf.fail(
            'it is compressed with Draco: install Lipstitch with the extra “draco” (pip install "lipstitch[draco]"), '
            "or export it without compression."
        ) from None
    attributes, compressed = gltf.part(primitive, "attributes"), gltf.part(packed, "attributes")
    for index in (*attributes.values(), primitive.get("indices")):
        if index is not None and gltf.count(index) > 6 * MAX_VERTICES:
            raise gltf.fail(f"accessor {index} announces {gltf.count(index):,} elements; reduce the mesh.")
    data = gltf.data(packed.get("bufferView"))
    try:
        mesh = DracoPy.decode(data)
    except Exception as error:  # noqa: BLE001 - whatever the library comes up with, the file is to blame
        reason = " ".join(str(error).split())[:80]
        raise gltf.fail(f"its Draco data cannot be unpacked ({reason}); export it again.") from None
    by_id: dict[int, Any] = {attribute["unique_id"]: attribute["data"] for attribute in mesh.attributes}
    for name, unique in compressed.items():
        values = by_id.get(unique) if isinstance(unique, int) else None
        if values is None or name not in attributes:
            raise gltf.fail(f"its Draco data has no {name[:40]}; export the file again.")
        _give(gltf, attributes[name], np.asarray(values).reshape(len(values), -1), name)
    faces = getattr(mesh, "faces", None)
    if faces is not None and primitive.get("indices") is not None:
        _give(gltf, primitive["indices"], np.asarray(faces).reshape(-1, 1), "indices")


def _give(gltf: GltfFile, index: object, values: Any, name: str) -> None:
    announced = gltf.count(index)
    if len(values) != announced:
        raise gltf.fail(
            f"its Draco data holds {len(values):,} {name[:40]} where {announced:,} are announced, so "
            "the shapes would not fit; export it without compression."
        )
    gltf.decoded(index, values)
