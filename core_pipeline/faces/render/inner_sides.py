"""Which triangles may show their inner side: those of closed bodies do not, and need to be drawn only once."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from ..face import Face
from ..normals import seam_groups

#: A camera this part of the face's size before it is outside in every pose.
_AIR = 0.1


class InnerSides:
    """Where a face may show inner sides, and to whom.

    may_show  (m,) bool, one of each triangle: False in the parts that the face names as closed and in all watertight
              bodies wound outwards
    """

    def __init__(self, face: Face) -> None:
        self.may_show = ~_closed_bodies(face)
        for name in face.closed:
            first, count = face.parts[name]
            self.may_show[first : first + count] = False
        size = np.linalg.norm(np.ptp(face.positions, axis=0))
        self._before = float(face.positions[:, 2].max() + _AIR * size)

    def hidden_from(self, from_mesh: NDArray[np.float64]) -> bool:
        """Whether the camera with this (4, 4) matrix stands in front of the face: outside, and not behind its hair."""
        eye = -from_mesh[:3, :3].T @ from_mesh[:3, 3]
        return bool(eye[2] > self._before)


def _closed_bodies(face: Face) -> NDArray[np.bool_]:
    """(m,) bool: the connected surface of the triangle has no edge, encloses a volume, and does so in every pose."""
    corners = _welded(face)[face.triangles]
    count = int(corners.max(initial=-1)) + 1
    a, b, c = corners.T.astype(np.int64)
    area = (a != b) & (b != c) & (c != a)
    starts, ends = np.concatenate([a[area], b[area], c[area]]), np.concatenate([b[area], c[area], a[area]])
    links = coo_array((np.ones(len(starts), bool), (starts, ends)), shape=(count, count))
    bodies, body = connected_components(links, directed=False)
    there, back = np.sort(starts * count + ends), np.sort(ends * count + starts)
    once = np.diff(there, prepend=-1) > 0
    open_edges = there[~(once & np.isin(there, back))] // max(count, 1)
    closed = np.ones(bodies, bool)
    closed[body[open_edges]] = False
    corner = face.positions[face.triangles].astype(np.float64)
    sixfold = np.einsum("ij,ij->i", corner[:, 0], np.cross(corner[:, 1], corner[:, 2]))
    closed &= np.bincount(body[a], sixfold, bodies) > 0.0
    of_each: NDArray[np.bool_] = closed[body[a]]
    return of_each


def _welded(face: Face) -> NDArray[np.intp]:
    """(n,) numbers, equal for vertices that are at the same place in every pose: lips that only touch are two."""
    groups = seam_groups(face.positions)
    _, first = np.unique(groups, return_index=True)
    number = first[groups]
    twins = np.flatnonzero(number != np.arange(len(number)))
    parted = (face.deltas[:, twins] != face.deltas[:, number[twins]]).any(axis=(0, 2))
    number[twins[parted]] = twins[parted]
    return number
