"""Skin that follows: the smoothest movement of a surface that agrees with what is prescribed on part of it.

Minimises the bending ∫|Δd|² with cotangent weights (discrete biharmonic; Botsch & Sorkine 2008, section 3).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csc_array, diags_array
from scipy.sparse.linalg import splu

from core_pipeline.faces.sculpt.sdf import Array


class SmoothField:
    """Fields over a mesh: positions (n, 3), triangles (m, 3); `held` (n,) marks where values are prescribed."""

    def __init__(self, positions: Array, triangles: NDArray[np.int64], held: NDArray[np.bool_]) -> None:
        stiffness, mass = _laplacian(positions, triangles)
        bending = csc_array(stiffness @ diags_array(1 / mass) @ stiffness)
        self._held = held
        self._free = ~held
        self._coupling = bending[self._free][:, held]
        self._solver = splu(csc_array(bending[self._free][:, self._free]))

    def spread(self, values: Array) -> Array:
        """values (n, c), read only where held → the same there, and smooth between."""
        full = values.astype(float).copy()
        full[self._free] = self._solver.solve(-(self._coupling @ full[self._held]))
        return full


def _laplacian(positions: Array, triangles: NDArray[np.int64]) -> tuple[csc_array, Array]:
    rows, columns, weights = [], [], []
    mass = np.full(len(positions), 1e-9)
    for i in range(3):
        a, b, c = (triangles[:, (i + k) % 3] for k in range(3))
        u, v = positions[b] - positions[a], positions[c] - positions[a]
        double_area = np.maximum(np.linalg.norm(np.cross(u, v), axis=1), 1e-9)
        cotangent = np.clip((u * v).sum(1) / double_area, 0.02, 20.0) / 2
        rows += [b, c]
        columns += [c, b]
        weights += [cotangent, cotangent]
        np.add.at(mass, a, double_area / 6)
    size = (len(positions), len(positions))
    adjacency = coo_array(
        (np.concatenate(weights), (np.concatenate(rows), np.concatenate(columns))), shape=size
    ).tocsc()
    return csc_array(diags_array(np.asarray(adjacency.sum(axis=1)).ravel()) - adjacency), mass
