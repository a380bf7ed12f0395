"""Triangles seen along one direction, in numpy: which of them cover which pixels, and how near."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from core_pipeline.faces.sculpt.sdf import Array

HALF = 2.0  # half the side of what a picture shows, in head radii


def directions(count: int, depth: float, turn: float) -> Array:
    """(count, 3) evenly over a ball of radius 1 from its top `depth` down, 2 for all of it: a spiral.

    It is turned by `turn` radians, so that nothing lies on the face's own axes.
    """
    step = np.arange(count) + 0.5
    up = 1 - depth * step / count
    angle = step * np.pi * (3 - np.sqrt(5)) + turn
    across = np.sqrt(1 - up * up)
    spread: Array = np.stack([across * np.cos(angle), up, across * np.sin(angle)], -1)
    return spread


def looking_along(positions: Array, direction: Array, size: int) -> Array:
    """(n, 3) pixels to the right and up in a picture of size × size, and nearness to the eye in `direction`."""
    right = np.cross((0.0, 1.0, 0.0), direction)
    right /= np.linalg.norm(right)
    points: Array = positions @ np.stack([right, np.cross(direction, right), direction], -1)
    points[:, :2] = (points[:, :2] / HALF + 1) * size / 2
    return points


def fragments(corners: Array, size: int) -> tuple[NDArray[np.intp], NDArray[np.intp], Array]:
    """Each pixel whose middle lies in a triangle: the triangle's number, the pixel's, nearness there.

    corners  (m, 3, 3) as `looking_along` gives them
    """
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (corners[:, i].T for i in range(3))
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    area = np.where(area == 0, np.nan, area)
    # each corner's share of a point, and its nearness, as offset + slope · (x, y)
    slopes_b, slopes_c = np.array([cy - ay, ax - cx]) / area, np.array([ay - by, bx - ax]) / area
    low = np.ceil(corners[..., 1].min(1) - 0.5).clip(0, size).astype(int)
    high = np.ceil(corners[..., 1].max(1) - 0.5).clip(0, size).astype(int)
    line, row = _repeated(low, high)
    y = row + 0.5
    shares = []
    for slope in (slopes_b, slopes_c):
        offset = -slope[0] * ax - slope[1] * ay
        shares.append((offset[line] + slope[1, line] * y, slope[0, line]))
    (b, b_x), (c, c_x) = shares
    left, right = np.zeros(len(line)), np.full(len(line), float(size))
    for value, slope in ((b, b_x), (c, c_x), (1 - b - c, -b_x - c_x)):
        with np.errstate(divide="ignore", invalid="ignore"):
            edge = -value / slope
        left = np.where(slope > 0, np.maximum(left, edge), left)
        right = np.where(slope < 0, np.minimum(right, edge), right)
        right = np.where((slope > 0) | (slope < 0) | (value >= 0), right, -1.0)
    first, last = np.ceil(left - 0.5).astype(int), np.floor(right - 0.5).astype(int) + 1
    span, column = _repeated(first, np.clip(last, first, size))
    which = line[span]
    near = az[line] + b * (bz - az)[line] + c * (cz - az)[line]
    along = b_x * (bz - az)[line] + c_x * (cz - az)[line]
    return which, row[span] * size + column, near[span] + along[span] * (column + 0.5)


def _repeated(low: NDArray[np.intp], high: NDArray[np.intp]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """The numbers low ≤ n < high of each pair, one after another: which pair, and the number."""
    count = np.clip(high - low, 0, None)
    which = np.repeat(np.arange(len(low)), count)
    return which, low[which] + np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count)


def nearest(pixel: NDArray[np.intp], near: Array, size: int) -> Array:
    """(size²,) how near the nearest fragment of each pixel is, very far where there is none."""
    buffer = np.full(size * size, -9.0)
    np.maximum.at(buffer, pixel, near)
    return buffer
