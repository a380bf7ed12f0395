"""What a see-through picture leaves of the triangles it lies on: a lash card is mostly nothing."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from core_pipeline.faces.face import Floats
from core_pipeline.faces.texture import Texture, Wrap

#: Alpha below which something that lets light through is never seen at all, or not at this place.
VISIBLE, FAINT = 0.4, 0.05
_STEPS = 8
#: (45, 3) points all over a triangle, an eighth of its edges apart.
_ALL_OVER = np.array(
    [(a, b, _STEPS - a - b) for a in range(_STEPS + 1) for b in range(_STEPS + 1 - a)], np.float64
) / float(_STEPS)
#: Triangles looked at together.
_TOGETHER = 20_000


def seen_through(
    texture: Texture, texcoords: Floats, triangles: NDArray[np.uint32], alpha: NDArray[np.floating[Any]] | float
) -> NDArray[np.bool_]:
    """(m,) which triangles of a part with soft edges can be seen; none, when all are as thin as a cornea.

    alpha  (m,) what multiplies the picture's; or one for all
    """
    most = alpha * highest_alpha(texture, texcoords, triangles)
    return (most >= FAINT) & bool((most >= VISIBLE).any())


def highest_alpha(texture: Texture, texcoords: Floats, triangles: NDArray[np.uint32]) -> Floats:
    """(m,) the highest alpha (0…1) that a picture has on each triangle, or a little beside it.

    A little: less than a quarter of the triangle's longer side, and nothing beyond a pixel where that is short.

    texcoords  (n, 2) of the vertices, +v down
    """
    levels = _levels(texture.picture[..., 3])
    height, width = levels[0].shape
    found = np.zeros(len(triangles), np.float32)
    for first in range(0, len(triangles), _TOGETHER):
        corners = texcoords[triangles[first : first + _TOGETHER]].astype(np.float64)
        edges = np.abs(corners - np.roll(corners, 1, axis=1)) * (width, height)
        apart = np.maximum(edges.max(axis=(1, 2)) / _STEPS, 1.0)
        level = np.minimum(np.ceil(np.log2(apart)), len(levels) - 1).astype(np.int64)
        for number in np.unique(level).tolist():
            mine = np.flatnonzero(level == number)
            points = _ALL_OVER @ corners[mine]
            column = _pixel(points[..., 0], texture.wrap[0], width) >> number
            row = _pixel(points[..., 1], texture.wrap[1], height) >> number
            found[first + mine] = levels[number][row, column].max(axis=1) / np.float32(255)
    return found


def wrapped(values: NDArray[np.float64], wrap: Wrap) -> NDArray[np.float64]:
    """Coordinates as a picture goes on beyond its edges: in 0…1."""
    if wrap == "clamp":
        return np.clip(values, 0, 1)
    if wrap == "mirror":
        return 1 - np.abs(values % 2 - 1)
    return values % 1


def _pixel(values: NDArray[np.float64], wrap: Wrap, side: int) -> NDArray[np.int64]:
    return np.minimum((wrapped(values, wrap) * side).astype(np.int64), side - 1)


def _levels(alpha: NDArray[np.uint8]) -> list[NDArray[np.uint8]]:
    """The picture, then ever smaller ones of which a pixel is the highest of four, down to a single one."""
    levels = [alpha]
    while max(levels[-1].shape) > 1:
        height, width = levels[-1].shape
        even = np.pad(levels[-1], ((0, height % 2), (0, width % 2)), mode="edge")
        pairs = np.maximum(even[::2], even[1::2])
        levels.append(np.maximum(pairs[:, ::2], pairs[:, 1::2]))
    return levels
