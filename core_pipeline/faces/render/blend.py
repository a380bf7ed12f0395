"""Amounts → positions and normals, in the layout of the vertex buffer: half of the arrow `Face.deform → pixels`.

The mix is linear (section 3.1.2). Few shapes are active in any one frame, and only those are added, each from the
first vertex that it moves to the last: what takes the time is to fetch the numbers. So shapes of one amount, as left
and right in speech, are fetched as one.
"""

from __future__ import annotations

from collections import OrderedDict

import numpy as np
from scipy.linalg.blas import saxpy

from ..face import Face, Floats
from ..normals import VertexNormals, seam_groups

#: With more active shapes than this, one product is quicker than adding them one by one.
_FEW = 16
#: Sums of shapes that are kept.
_SUMS = 16
#: Columns of one product: small enough for BLAS to stay in this thread.
_COLUMNS = 8192


class Blend:
    """Mixes one face's shapes. Both methods return the same (n, 6) float32 array, overwritten by the next call.

    Columns 0–2 are the position, 3–5 the normal.
    """

    def __init__(self, face: Face) -> None:
        count, n = len(face.shapes), len(face.positions)
        self._rows: Floats = np.empty((count + 1, 6 * n), np.float32)
        layers = self._rows.reshape(count + 1, n, 6)
        layers[0, :, :3], layers[0, :, 3:] = face.positions, face.normals
        layers[1:, :, :3], layers[1:, :, 3:] = face.deltas, face.normal_deltas
        self._moved = [_span(row) for row in self._rows]
        self._sums: OrderedDict[tuple[int, ...], tuple[Floats, slice]] = OrderedDict()
        self._amounts: Floats = np.ones(count + 1, np.float32)
        self._flat: Floats = np.empty(6 * n, np.float32)
        self._face = face
        self._triangle_normals: VertexNormals | None = None
        self._offset: Floats | None = None

    def mixed(self, amounts: Floats) -> Floats:
        """Positions and blended normals at shape amounts (k,); the normals are not of unit length.

        Row 0 of the table is the neutral face, always taken once.
        """
        self._amounts[1:] = amounts
        alike: dict[float, list[int]] = {}
        for row in (np.flatnonzero(self._amounts[1:]) + 1).tolist():
            alike.setdefault(float(self._amounts[row]), []).append(row)
        if len(alike) <= _FEW:
            np.copyto(self._flat, self._rows[0])
            for amount, rows in alike.items():
                numbers, moved = self._sum(tuple(rows))
                saxpy(numbers, self._flat[moved], a=amount)  # in place
        else:
            for start in range(0, len(self._flat), _COLUMNS):
                part = slice(start, start + _COLUMNS)
                np.matmul(self._amounts, self._rows[:, part], out=self._flat[part])
        return self._flat.reshape(-1, 6)

    def _sum(self, rows: tuple[int, ...]) -> tuple[Floats, slice]:
        """The sum of some rows from the first number that is not 0 to the last, and where that is."""
        if len(rows) == 1:
            moved = self._moved[rows[0]]
            return self._rows[rows[0], moved], moved
        if rows not in self._sums:
            total: Floats = self._rows[list(rows)].sum(axis=0)
            moved = _span(total)
            self._sums[rows] = np.ascontiguousarray(total[moved]), moved
            if len(self._sums) > _SUMS:
                self._sums.popitem(last=False)
        self._sums.move_to_end(rows)
        return self._sums[rows]

    def exact(self, amounts: Floats) -> Floats:
        """Positions and the unit normals that the moved triangles have, for a picture that stands still.

        An artist's normals may differ from area-weighted ones: taken from a sculpt, or weighted by angle.
        The difference at rest is kept, else such a face would change its look whenever it stops.
        """
        if self._triangle_normals is None or self._offset is None:
            face = self._face
            self._triangle_normals = VertexNormals(face.triangles, seam_groups(face.positions, face.normals))
            self._offset = face.normals - self._triangle_normals.of(face.positions)
        both = self.mixed(amounts)
        normals = self._triangle_normals.of(both[:, :3]) + self._offset
        length = np.linalg.norm(normals, axis=1, keepdims=True)
        both[:, 3:] = normals / np.where(length > 0.0, length, 1.0)
        return both


def _span(row: Floats) -> slice:
    """From the first number that is not 0 to the last; one number when all are 0, as BLAS takes no fewer."""
    moved = np.flatnonzero(row)
    return slice(int(moved[0]), int(moved[-1]) + 1) if len(moved) else slice(0, 1)
