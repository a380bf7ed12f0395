"""Soft shade baked into colours: from how much of the sky each vertex sees past the whole face (ambient occlusion).

The face is drawn from many directions into small depth buffers; a vertex sees the sky where it is the nearest.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from core_pipeline.faces.sculpt.raster import directions, fragments, looking_along, nearest
from core_pipeline.faces.sculpt.sdf import Array, smoothstep

DIRECTIONS = 56
SIZE = 150
SOFT = (0.02, 0.07)  # buried this deep a vertex is half hidden … hidden


def sky(positions: Array, normals: Array, triangles: NDArray[np.integer]) -> Array:
    """(n,) share of the sky above it that each vertex sees, 0 … 1: all of it on a convex body."""
    seen = np.zeros(len(positions))
    total = np.full(len(positions), 1e-9)
    for direction in directions(DIRECTIONS, 1.6, 0.123):  # but for the floor
        facing = np.clip(normals @ direction, 0, None)
        seen += facing * _visible(positions, triangles, direction)
        total += facing
    return _evened(seen / total, triangles)


def _visible(positions: Array, triangles: NDArray[np.integer], direction: Array) -> Array:
    points = looking_along(positions, direction, SIZE)
    _, covered, near = fragments(points[triangles], SIZE)
    pixel = points[:, :2].astype(int).clip(0, SIZE - 1)
    above = nearest(covered, near, SIZE)[pixel[:, 1] * SIZE + pixel[:, 0]]
    visible: Array = 1 - smoothstep(*SOFT, above - points[:, 2])
    return visible


def _evened(values: Array, triangles: NDArray[np.integer]) -> Array:
    """Without the grain of few directions: half of the neighbours', twice."""
    for _ in range(2):
        total, number = np.zeros(len(values)), np.full(len(values), 1e-9)
        for i in range(3):
            np.add.at(total, triangles[:, i], values[triangles[:, (i + 1) % 3]])
            np.add.at(number, triangles[:, i], 1)
        values = (values + total / number) / 2
    return values
