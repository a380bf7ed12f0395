"""The lips of one of our faces, section by section: how far apart they are, and how deep they sink into each other."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from core_pipeline.faces.face import Face
from core_pipeline.faces.sculpt.mouth import BAG_RINGS, RINGS
from tests.helpers.zbuffer import deformed

#: Rings 0 is the edge of the bag, deep behind the lip.
FIRST = 1


def lip_sections(face: Face, weights: Mapping[str, float]) -> np.ndarray:
    """(rings, columns, 3): the lips are the first vertices of our faces after the bag's rings."""
    # the bag's end is a fan of one triangle per column, its rings and the hidden half of the lips are bands of two
    columns = face.parts["mouth"][1] // (1 + 2 * (BAG_RINGS + 2))
    points = deformed(face, weights)
    start = BAG_RINGS * columns
    return points[start : start + RINGS * columns].reshape(RINGS, columns, 3).astype(float)


def lip_gap_and_overlap(lips: np.ndarray) -> tuple[float, float]:
    """The widest gap between the lips of any section (corners apart), and how deep one is inside the other anywhere."""
    columns = lips.shape[1]
    gap = overlap = 0.0
    for lower in range(1, columns // 4):
        below, above = lips[FIRST:, lower, 2:0:-1], lips[FIRST:, columns // 2 - lower, 2:0:-1]
        fine_below, fine_above = _finer(below), _finer(above)
        sunk = [_distance(fine_above[_inside(fine_above, below)], below)]
        sunk.append(_distance(fine_below[_inside(fine_below, above)], above))
        deepest = max((float(part.max()) for part in sunk if len(part)), default=None)
        if deepest is None:
            gap = max(gap, float(_distance(fine_above, below).min()))
        else:
            overlap = max(overlap, deepest)
    return gap, overlap


def _finer(line: np.ndarray) -> np.ndarray:
    steps = np.linspace(0, 1, 6)[:-1, None, None]
    return np.concatenate([(line[:-1] + steps * np.diff(line, axis=0)).reshape(-1, 2), line[-1:]])


def _distance(points: np.ndarray, line: np.ndarray) -> np.ndarray:
    if not len(points):
        return np.zeros(0)
    start, step = line[:-1], np.diff(line, axis=0)
    along = np.clip(((points[:, None] - start) * step).sum(-1) / (step * step).sum(-1), 0, 1)
    return np.linalg.norm(points[:, None] - (start + along[..., None] * step), axis=-1).min(1)


def _inside(points: np.ndarray, polygon: np.ndarray) -> np.ndarray:
    odd = np.zeros(len(points), bool)
    x, y = points.T
    for (x0, y0), (x1, y1) in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        if y0 != y1:
            odd ^= ((y0 > y) != (y1 > y)) & (x < (x1 - x0) * (y - y0) / (y1 - y0) + x0)
    return odd
