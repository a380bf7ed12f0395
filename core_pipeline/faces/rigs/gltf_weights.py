"""Shapes that a file has set already: a person made by shapes stands so in the neutral face, a look on it does not.

MakeHuman's people in Blender are one mesh with shapes for sex, age and build, set as that person is; an exporter
writes the mesh as it is without them, and the amounts beside it. A mouth left open by its sculptor is no such thing.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from core_pipeline.faces.face import Floats
from core_pipeline.faces.normals import VertexNormals, seam_groups
from core_pipeline.faces.rigs.gltf_file import GltfFile, Json
from core_pipeline.files.json_text import shown

#: All shapes → those that are expressions, and not of the person.
Expressions = Callable[[Sequence[str]], Collection[str]]

_LISTED = 4


def all_of_them(shapes: Sequence[str]) -> Collection[str]:
    """Nothing is of the person."""
    return shapes


def set_shapes(
    gltf: GltfFile, meshes: Iterable[tuple[Json, Sequence[str]]], expressions: Collection[str]
) -> dict[str, float]:
    """Shape → how much of it is in the neutral face, of those that have any; the file's notes tell of all set shapes.

    meshes  nodes that have a mesh, and the names of its shapes
    """
    amounts: dict[str, float] = {}
    for node, names in meshes:
        written = node.get("weights", gltf.item("meshes", node["mesh"]).get("weights"))
        if isinstance(written, list) and len(written) == len(names):
            for name, amount in zip(names, gltf.floats(written, len(names)).tolist(), strict=True):
                if abs(amount) > abs(amounts.get(name, 0.0)):
                    amounts[name] = amount
    person = {name: amount for name, amount in amounts.items() if name not in expressions}
    if person:
        gltf.note(f"Set in the file, and so part of the neutral face: {_listed(person)}.")
    if len(person) < len(amounts):
        left = [name for name in amounts if name not in person]
        gltf.note(f"Set in the file, but left out of the neutral face: {_listed(left)}.")
    return person


def with_shapes(
    amounts: Mapping[str, float],
    shapes: Sequence[str],
    deltas: Floats,
    positions: Floats,
    triangles: NDArray[np.uint32],
    normals: Floats,
) -> tuple[Floats, Floats]:
    """Positions (n, 3) and normals (n, 3) once shapes are set; `normals` are the file's own, zero where it has none."""
    rows = [row for row, shape in enumerate(shapes) if shape in amounts]
    if not rows:
        return positions, normals
    weights = np.array([amounts[shapes[row]] for row in rows], np.float32)
    moved: Floats = (positions + np.tensordot(weights, deltas[rows], 1)).astype(np.float32)
    computed = VertexNormals(triangles, seam_groups(positions, normals))
    turned = normals + computed.of(moved) - computed.of(positions)
    length = np.linalg.norm(turned, axis=1, keepdims=True)
    unit: Floats = np.where(length > 0, turned / np.where(length > 0, length, 1), normals).astype(np.float32)
    return moved, np.where(normals.any(axis=1, keepdims=True), unit, normals)


def _listed(names: Iterable[str]) -> str:
    names = list(names)
    return ", ".join(shown(name) for name in names[:_LISTED]) + (" …" if len(names) > _LISTED else "")
