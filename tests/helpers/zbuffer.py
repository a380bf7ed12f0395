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
    corners = local[face.triangles]
    flat = corners[..., :2]
    inside = ((flat.max(1) > 0) & (flat.min(1) < SIZE)).all(1) & (corners[..., 2].max(1) > -DEEPEST)
    numbers = np.flatnonzero(inside)
    corners = corners[numbers]
    which, pixel, depth = _covered(corners)
    order = np.argsort(depth, kind="stable")
    nearest = np.full(SIZE * SIZE, -1)
    nearest[pixel[order]] = numbers[which[order]]
    return nearest.reshape(SIZE, SIZE)


def _covered(corners: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Row by row, the pixels whose middles lie in each triangle: its number, the pixel, the depth there.

    An edge is cut at the same place for both its triangles, so that no pixel falls between them.
    """
    upwards = np.take_along_axis(corners, np.argsort(corners[..., 1], axis=1, kind="stable")[..., None], axis=1)
    (x0, y0, z0), (x1, y1, z1), (x2, y2, z2) = (upwards[:, i].T for i in range(3))
    bottom, top = (np.ceil(y - 0.5).clip(0, SIZE).astype(int) for y in (y0, y2))
    which, step = _repeated(top - bottom)
    row = bottom[which] + step
    y = row + 0.5
    with np.errstate(invalid="ignore", divide="ignore"):
        long, first, second = (x2 - x0) / (y2 - y0), (x1 - x0) / (y1 - y0), (x2 - x1) / (y2 - y1)
        area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
        across = ((z1 - z0) * (y2 - y0) - (z2 - z0) * (y1 - y0)) / area
        along = ((z2 - z0) * (x1 - x0) - (z1 - z0) * (x2 - x0)) / area
        beyond = y >= y1[which]
        cut = x0[which] + (y - y0[which]) * long[which]
        other = np.where(
            beyond, x1[which] + (y - y1[which]) * second[which], x0[which] + (y - y0[which]) * first[which]
        )
        start, stop = (np.ceil(f(cut, other) - 0.5).clip(0, SIZE).astype(int) for f in (np.minimum, np.maximum))
        span, step = _repeated(stop - start)
        column = start[span] + step
        edge = z0[which] + along[which] * (y - y0[which]) + across[which] * (0.5 - x0[which])
        return which[span], (row * SIZE)[span] + column, edge[span] + across[which][span] * column


def _repeated(times: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Each index so many times, and the count within each."""
    index = np.repeat(np.arange(len(times)), times)
    return index, np.arange(len(index)) - np.repeat(np.cumsum(times) - times, times)
