"""Soft shade baked into colours: from how much of the sky each vertex sees past the whole face (ambient occlusion).

The face is drawn from many directions into small depth buffers; a vertex sees the sky where it is the nearest.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from core_pipeline.faces.sculpt.sdf import Array, smoothstep

DIRECTIONS = 56
SIZE = 150
HALF = 2.0
SOFT = (0.02, 0.07)  # buried this deep a vertex is half hidden … hidden


def sky(positions: Array, normals: Array, triangles: NDArray[np.integer]) -> Array:
    """(n,) share of the sky above it that each vertex sees, 0 … 1: all of it on a convex body."""
    seen = np.zeros(len(positions))
    total = np.full(len(positions), 1e-9)
    for direction in _directions():
        facing = np.clip(normals @ direction, 0, None)
        seen += facing * _visible(positions, triangles, direction)
        total += facing
    return _evened(seen / total, triangles)


def _directions() -> Array:
    """Evenly over the ball but for its floor: a spiral, turned so that nothing lies on the face's own axes."""
    step = np.arange(DIRECTIONS) + 0.5
    up = 1 - 1.6 * step / DIRECTIONS
    angle = step * np.pi * (3 - np.sqrt(5)) + 0.123
    across = np.sqrt(1 - up * up)
    spread: Array = np.stack([across * np.cos(angle), up, across * np.sin(angle)], -1)
    return spread


def _visible(positions: Array, triangles: NDArray[np.integer], direction: Array) -> Array:
    right = np.cross((0.0, 1.0, 0.0), direction)
    right /= np.linalg.norm(right)
    points = positions @ np.stack([right, np.cross(direction, right), direction], -1)
    points[:, :2] = (points[:, :2] / HALF + 1) * SIZE / 2
    nearest = _depth_buffer(points[triangles])
    pixel = points[:, :2].astype(int).clip(0, SIZE - 1)
    visible: Array = 1 - smoothstep(*SOFT, nearest[pixel[:, 1] * SIZE + pixel[:, 0]] - points[:, 2])
    return visible


def _depth_buffer(corners: Array) -> Array:
    """(SIZE²,) the greatest depth over the middle of each pixel; corners (m, 3, 3) in pixels and depth."""
    low = np.ceil(corners[..., :2].min(1) - 0.5).clip(0, SIZE).astype(int)
    high = np.ceil(corners[..., :2].max(1) - 0.5).clip(0, SIZE).astype(int)
    wide, tall = (high - low).T
    which = np.repeat(np.arange(len(corners)), wide * tall)
    step = np.arange(len(which)) - np.repeat(np.cumsum(wide * tall) - wide * tall, wide * tall)
    column, row = low[which, 0] + step % wide[which], low[which, 1] + step // wide[which]
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (corners[which, i].T for i in range(3))
    x, y = column + 0.5, row + 0.5
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    area = np.where(area == 0, np.nan, area)
    v = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / area
    w = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / area
    inside = (v >= 0) & (w >= 0) & (v + w <= 1)
    nearest = np.full(SIZE * SIZE, -9.0)
    depth = az + v * (bz - az) + w * (cz - az)
    np.maximum.at(nearest, (row * SIZE + column)[inside], depth[inside])
    return nearest


def _evened(values: Array, triangles: NDArray[np.integer]) -> Array:
    """Without the grain of few directions: half of the neighbours', twice."""
    for _ in range(2):
        total, number = np.zeros(len(values)), np.full(len(values), 1e-9)
        for i in range(3):
            np.add.at(total, triangles[:, i], values[triangles[:, (i + 1) % 3]])
            np.add.at(number, triangles[:, i], 1)
        values = (values + total / number) / 2
    return values
