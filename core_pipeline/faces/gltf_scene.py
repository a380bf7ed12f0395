"""Where glTF puts its meshes: nodes, and joints where a mesh has a skin, as the file's rest pose has them."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core_pipeline.faces.gltf_file import GltfFile, Json
from core_pipeline.faces.limits import LARGEST

#: A second's work.
MAX_NODES = 20_000

Matrix = NDArray[np.floating[Any]]


class Scene:
    """The nodes that the file shows, each with its (4, 4) matrix."""

    def __init__(self, gltf: GltfFile) -> None:
        self._gltf = gltf
        self._world = _world(gltf)

    def meshes(self) -> Iterator[tuple[Json, Matrix]]:
        """Every node that has a mesh, with its matrix; all meshes when the file has no nodes."""
        nodes = self._gltf.items("nodes")
        if not nodes:
            yield from (({"mesh": index}, np.eye(4)) for index in range(len(self._gltf.items("meshes"))))
            return
        for index, matrix in self._world.items():
            if "mesh" in nodes[index]:
                yield nodes[index], matrix

    def placement(self, node: Json, matrix: Matrix, attributes: Json, count: int) -> Matrix:
        """(4, 4), or (n, 4, 4) for a mesh that hangs on joints: its own node's place does not count then."""
        gltf = self._gltf
        if "skin" not in node or not {"JOINTS_0", "WEIGHTS_0"} <= set(attributes):
            return matrix
        skin = gltf.item("skins", node["skin"])
        joints = gltf.numbers(skin, "joints")
        moved = np.array([self._world.get(joint, np.eye(4)) for joint in joints]).reshape(-1, 4, 4)
        if "inverseBindMatrices" in skin:
            inverse = gltf.read(skin["inverseBindMatrices"], "MAT4").reshape(-1, 4, 4).swapaxes(1, 2)
            if len(inverse) < len(joints):
                raise gltf.fail(
                    f"a skin has {len(joints)} joints but {len(inverse)} bind matrices; export the file again."
                )
            moved = moved @ inverse[: len(joints)]
        which = gltf.read(attributes["JOINTS_0"], "VEC4").astype(np.int64)
        weights = gltf.read(attributes["WEIGHTS_0"], "VEC4").astype(np.float32)
        if count and which.max() >= len(joints):
            raise gltf.fail(f"a vertex hangs on joint {which.max()} of {len(joints)}; export the file again.")
        total = weights.sum(1, keepdims=True)
        weights = np.where(total > 0, weights / np.where(total > 0, total, 1), (1.0, 0, 0, 0))
        blended = np.zeros((count, 4, 4), np.float32)
        for slot in range(4):
            blended += weights[:, slot, None, None] * moved[which[:, slot]].astype(np.float32)
        at_rest = count > 0 and np.ptp(blended, axis=0).max() < 1e-6 * np.abs(blended).max()
        return blended[0] if at_rest else blended


def _world(gltf: GltfFile) -> dict[int, Matrix]:
    """Node → matrix, for the nodes of the scene."""
    if len(gltf.items("nodes")) > MAX_NODES:
        raise gltf.fail(f"it has {len(gltf.items('nodes')):,} nodes, more than {MAX_NODES:,}; export the head alone.")
    children = {child for node in gltf.items("nodes") for child in gltf.numbers(node, "children")}
    roots = [index for index in range(len(gltf.items("nodes"))) if index not in children]
    if gltf.items("scenes"):
        roots = gltf.numbers(gltf.item("scenes", gltf.json.get("scene", 0)), "nodes")
    placed: dict[int, Matrix] = {}
    waiting: deque[tuple[int, Matrix]] = deque((root, np.eye(4)) for root in roots)
    while waiting:
        index, above = waiting.popleft()
        node = gltf.item("nodes", index)
        if index in placed:
            raise gltf.fail(f"node {index} is in the scene twice; export the file again.")
        placed[index] = above @ _local(gltf, node)
        if np.abs(placed[index]).max() > LARGEST:
            raise gltf.fail(f"node {index} stands {np.abs(placed[index]).max():.0e} away; export the file again.")
        waiting.extend((child, placed[index]) for child in gltf.numbers(node, "children"))
    return placed


def _local(gltf: GltfFile, node: Json) -> Matrix:
    if "matrix" in node:
        return gltf.floats(node["matrix"], 16).reshape(4, 4).T
    x, y, z, w = gltf.floats(node.get("rotation", (0, 0, 0, 1)), 4)
    length = np.sqrt(x * x + y * y + z * z + w * w) or 1.0
    x, y, z, w = (float(part / length) for part in (x, y, z, w))
    local = np.eye(4)
    local[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    local[:3, :3] *= gltf.floats(node.get("scale", (1, 1, 1)), 3)
    local[:3, 3] = gltf.floats(node.get("translation", (0, 0, 0)), 3)
    return local
