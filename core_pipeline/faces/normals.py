"""Vertex normals of a mesh in many poses: what light needs, and what a blendshape adds to it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from core_pipeline.faces.face import Floats


class VertexNormals:
    """Area-weighted vertex normals for one topology.

    triangles  (m, 3) vertex numbers
    groups     (n,) vertices with the same number share one normal: a texture seam splits vertices, not the surface
    """

    def __init__(self, triangles: NDArray[np.uint32], groups: NDArray[np.intp]) -> None:
        self._triangles = triangles
        self._groups = groups
        rows = groups[triangles].T.ravel()
        columns = np.tile(np.arange(len(triangles)), 3)
        ones = np.ones(len(rows), np.float32)
        shape = (int(groups.max(initial=-1)) + 1, len(triangles))
        self._sum = csr_array((ones, (rows, columns)), shape=shape)

    def of(self, positions: Floats) -> Floats:
        """(n, 3) unit normals at `positions` (n, 3); +z where a vertex belongs to no triangle of any area."""
        a, b, c = (positions[self._triangles[:, i]] for i in range(3))
        summed = self._sum @ np.cross(b - a, c - a)
        length = np.linalg.norm(summed, axis=1, keepdims=True)
        unit = np.where(length > 0, summed / np.where(length > 0, length, 1), (0.0, 0.0, 1.0))
        normals: Floats = unit.astype(np.float32)[self._groups]
        return normals


def seam_groups(positions: Floats, normals: Floats | None = None) -> NDArray[np.intp]:
    """(n,) numbers, equal for vertices at the very same place (and, if given, with the very same normal)."""
    keys = positions if normals is None else np.concatenate([positions, normals], axis=1)
    rows = np.ascontiguousarray(keys, np.float32) + np.float32(0)  # -0.0 and 0.0 are one place
    _, groups = np.unique(rows.view(np.dtype((np.void, rows.shape[1] * 4))).ravel(), return_inverse=True)
    return groups.astype(np.intp)


def shape_normals(
    positions: Floats,
    triangles: NDArray[np.uint32],
    deltas: Floats,
    given: Floats | None = None,
    step: Callable[[], None] = lambda: None,
) -> tuple[Floats, Floats]:
    """Normals (n, 3) at rest, and what each shape of `deltas` (k, n, 3) adds to them.

    given  (n, 3) normals that a file brings, zero where it brings none: they stand, and split what they differ at
    step   called after every shape
    """
    known = np.zeros_like(positions) if given is None else given
    computed = VertexNormals(triangles, seam_groups(positions, known))
    rest = computed.of(positions)
    turned = np.zeros_like(deltas)
    for shape, delta in enumerate(deltas):
        if delta.any():
            turned[shape] = computed.of(positions + delta) - rest
        step()
    return np.where(known.any(axis=1, keepdims=True), known, rest), turned
