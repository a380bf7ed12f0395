"""Where glTF puts its meshes: nodes, and joints where a mesh has a skin, as the file's rest pose has them."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core_pipeline.faces.rigs.gltf_file import GltfFile, Json
from core_pipeline.faces.rigs.limits import LARGEST

#: A second's work.
MAX_NODES = 20_000
#: Blender writes two sets where it is told to keep all influences.
_MOST_SETS = 4

Matrix = NDArray[np.floating[Any]]


class Scene:
    """The nodes that the file shows, each with its (4, 4) matrix."""

    def __init__(self, gltf: GltfFile) -> None:
        self._gltf = gltf
        self._world = _world(gltf)
        nodes = enumerate(gltf.items("nodes"))
        self._above = {child: index for index, node in nodes for child in gltf.numbers(node, "children")}

    def meshes(self) -> Iterator[tuple[Json, Matrix]]:
        """Every node that has a mesh, with its matrix; all meshes when the file has no nodes.

        A node without any name gets that of the one it hangs on: gltfpack puts meshes below the nodes it keeps.
        """
        nodes = self._gltf.items("nodes")
        if not nodes:
            yield from (({"mesh": index}, np.eye(4)) for index in range(len(self._gltf.items("meshes"))))
            return
        for index, matrix in self._world.items():
            node = nodes[index]
            if "mesh" in node:
                named = node.get("name") or self._gltf.item("meshes", node["mesh"]).get("name")
                above = nodes[self._above[index]].get("name") if index in self._above else None
                yield node if named or not above else node | {"name": above}, matrix

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
        # four joints to a set: a vertex that hangs on more of them has more sets
        sets = [n for n in range(_MOST_SETS) if {f"JOINTS_{n}", f"WEIGHTS_{n}"} <= set(attributes)]
        which = np.hstack([gltf.read(attributes[f"JOINTS_{n}"], "VEC4").astype(np.int64) for n in sets])
        weights = np.hstack([gltf.read(attributes[f"WEIGHTS_{n}"], "VEC4").astype(np.float32) for n in sets])
        if count and which.max() >= len(joints):
            raise gltf.fail(f"a vertex hangs on joint {which.max()} of {len(joints)}; export the file again.")
        total = weights.sum(1, keepdims=True)
        first = np.eye(1, weights.shape[1])
        weights = np.where(total > 0, weights / np.where(total > 0, total, 1), first)
        blended = np.zeros((count, 4, 4), np.float32)
        for slot in range(weights.shape[1]):
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
