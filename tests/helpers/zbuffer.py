"""What of a face can be seen: a small depth buffer in numpy, free of any graphics card."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping

import numpy as np

from core_pipeline.faces.face import Face

HALF = 0.62
SIZE = 220
DEEPEST = 1.1


def deformed(face: Face, weights: Mapping[str, float]) -> np.ndarray:
    amounts = np.zeros(len(face.shapes), np.float32)
    for shape, weight in weights.items():
        amounts[face.shapes.index(shape)] = weight
    return face.deform(amounts)


def seen(
    face: Face,
    weights: Mapping[str, float],
    centre: tuple[float, float, float],
    yaw: float = 0.0,
    pitch: float = 0.0,
    half: float = HALF,
) -> Counter[str]:
    """Pixels of each part in a square window of half width `half` round `centre` (SIZE² pixels)."""
    faces = visible_triangles(face, weights, centre, yaw, pitch, half)
    pixels = np.bincount(faces[faces >= 0], minlength=len(face.triangles))
    shown = {name: int(pixels[first : first + count].sum()) for name, (first, count) in face.parts.items()}
    return Counter({name: number for name, number in shown.items() if number})


def visible_triangles(
    face: Face,
    weights: Mapping[str, float],
    centre: tuple[float, float, float],
    yaw: float = 0.0,
    pitch: float = 0.0,
    half: float = HALF,
) -> np.ndarray:
    """(SIZE, SIZE) the number of the nearest triangle at each pixel, −1 where there is none; pitch looks from above."""
    y, p = np.radians(yaw), np.radians(pitch)
    turn_y = np.array([[np.cos(y), 0, -np.sin(y)], [0, 1, 0], [np.sin(y), 0, np.cos(y)]])
    turn_x = np.array([[1, 0, 0], [0, np.cos(p), -np.sin(p)], [0, np.sin(p), np.cos(p)]])
    local = (deformed(face, weights).astype(float) - centre) @ (turn_x @ turn_y).T
    local[:, :2] = (local[:, :2] / half + 1) * SIZE / 2
    # what lies deeper than any mouth is behind the face, and hidden by it
    numbers = np.flatnonzero(local[face.triangles, 2].max(1) > -DEEPEST)
    corners = local[face.triangles[numbers]]
    low = np.ceil(corners[..., :2].min(1) - 0.5).clip(0, SIZE).astype(int)
    high = np.ceil(corners[..., :2].max(1) - 0.5).clip(0, SIZE).astype(int)
    wide, tall = (high - low).T
    which = np.repeat(np.arange(len(corners)), wide * tall)
    step = np.arange(len(which)) - np.repeat(np.cumsum(wide * tall) - wide * tall, wide * tall)
    column, row = low[which, 0] + step % wide[which], low[which, 1] + step // wide[which]
    depth, inside = _depth(corners, which, column + 0.5, row + 0.5)
    which, pixel = which[inside], (row * SIZE + column)[inside]
    order = np.argsort(depth[inside], kind="stable")
    nearest = np.full(SIZE * SIZE, -1)
    nearest[pixel[order]] = numbers[which[order]]
    return nearest.reshape(SIZE, SIZE)


def _depth(corners: np.ndarray, which: np.ndarray, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Depth at (x, y) on the planes of the triangles `which`, and whether it is inside them."""
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (corners[:, i].T for i in range(3))
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    with np.errstate(invalid="ignore", divide="ignore"):
        # v and w, the shares of b and c, and the depth are linear in x and y
        vx, vy = (cy - ay) / area, (ax - cx) / area
        wx, wy = (ay - by) / area, (bx - ax) / area
        zx, zy = vx * (bz - az) + wx * (cz - az), vy * (bz - az) + wy * (cz - az)
        dx, dy = x - ax[which], y - ay[which]
        v = vx[which] * dx + vy[which] * dy
        w = wx[which] * dx + wy[which] * dy
        inside = (v >= 0) & (w >= 0) & (v + w <= 1)
        return az[which] + zx[which] * dx + zy[which] * dy, inside
