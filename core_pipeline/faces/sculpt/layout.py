"""Where the skin's vertices lie, as a flat map round the mouth: finer near lips, eyes and nose, left like right.

The map is azimuthal: the distance from its origin is the angle at the head's middle away from the mouth, in radians.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import Delaunay

from core_pipeline.faces.sculpt.sdf import Array

Indices = NDArray[np.int64]
#: What breaks ties between equally right triangles, in radians of the map.
_NUDGE = 1e-9
RIM = 2.7
CROWDED = 0.9


@dataclass(frozen=True, eq=False)
class Layout:
    """points (n, 2); triangles (m, 3); border (k,) round the lips, eyes: right and left loop (e,) each."""

    points: Array
    triangles: Indices
    border: Indices
    eyes: tuple[Indices, Indices]

    @property
    def rim(self) -> Indices:
        """(r,) vertices along the map's rim, in order, as a fan to its far side wants them."""
        on_rim = np.flatnonzero(np.linalg.norm(self.points, axis=1) > RIM - 1e-6)
        ordered: Indices = on_rim[np.argsort(np.arctan2(*self.points[on_rim].T))]
        return ordered

    def neighbour_mean(self, values: Array) -> Array:
        """(n, c) at each point the mean of its neighbours' values (n, c)."""
        return _neighbour_mean(values, self.triangles)


def lay_out(border: Array, eye_rings: list[Array], spacing: Callable[[Array], Array]) -> Layout:
    """border (k, 2) anticlockwise from the bottom of the mouth, k a multiple of 4.

    eye_rings  the first is the hole (empty for none); the others are lines where vertices shall lie
    spacing    points (p, 2) → wished distance between vertices there (p,)
    """
    half = border[: len(border) // 2 + 1].copy()
    half[[0, -1], 0] = 0.0
    loop = eye_rings[0]
    seeds = [half, loop]
    seeds += [ring[(ring[:, 0] > 0.02) | (ring[:, 0] == 0)] for ring in eye_rings[1:]]
    seeds += _lip_rings(half)
    seeds.append(np.stack([RIM * np.sin(np.linspace(0, np.pi, 15)), -RIM * np.cos(np.linspace(0, np.pi, 15))], -1))
    fixed = np.concatenate(seeds)
    fixed[np.abs(fixed[:, 0]) < 1e-9, 0] = 0.0
    points, triangles = _meshed(fixed, half, loop, spacing)
    if _missing_steps(triangles, half, loop):
        points, triangles = _meshed(_uncrowded(fixed, half, loop), half, loop, spacing)
    if missing := _missing_steps(triangles, half, loop):
        raise ValueError(f"{missing} steps of a loop are no edges of the skin: space the rings round it more widely")
    return _both_sides(points, triangles, len(half), len(loop))


def _meshed(fixed: Array, half: Array, loop: Array, spacing: Callable[[Array], Array]) -> tuple[Array, Indices]:
    """All the right half's points, and its triangles without those inside mouth and eye."""
    points = _scatter(fixed, half, loop, spacing)
    triangles = _triangulated(points)
    a, b, c = (points[triangles[:, i]] for i in range(3))
    area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    triangles[area < 0] = triangles[area < 0][:, ::-1]
    middle = (a + b + c) / 3
    kept = (np.abs(area) > 1e-9) & ~_inside(middle, half) & ~_inside(middle, loop)
    return points, triangles[kept]


def _triangulated(points: Array) -> Indices:
    """(m, 3) Delaunay triangles, the same whatever version of the library finds them.

    Rings and mirrored points lie on common circles, where several triangulations are right: a nudge, far below
    what can be seen, leaves one. The order is our own too.
    """
    number = np.arange(len(points))[:, None]
    nudge = _NUDGE * ((number * (0.7548776662466927, 0.5698402909980532)) % 1 - 0.5)
    triangles = Delaunay(points + nudge).simplices.astype(np.int64)
    start = triangles.argmin(axis=1)[:, None]
    triangles = np.take_along_axis(triangles, (start + np.arange(3)) % 3, axis=1)
    ordered: Indices = triangles[np.lexsort(np.sort(triangles, axis=1).T[::-1])]
    return ordered


def _uncrowded(fixed: Array, half: Array, loop: Array) -> Array:
    """`fixed` (loops first) without the points so near to a step of a loop that the mesh would not follow that step."""
    count = len(half) + len(loop)
    start = np.concatenate([half[:-1], loop])
    end = np.concatenate([half[1:], np.roll(loop, -1, axis=0)])
    middle, reach = (start + end) / 2, np.linalg.norm(end - start, axis=1) / 2
    crowding = (np.linalg.norm(fixed[count:, None] - middle, axis=-1) < CROWDED * reach).any(axis=1)
    return np.concatenate([fixed[:count], fixed[count:][~crowding]])


def _missing_steps(triangles: Indices, half: Array, loop: Array) -> int:
    """How many steps of the loops are no edges of the mesh: there the lips or lids would gape."""
    corners = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    edges = {(int(a), int(b)) for a, b in np.sort(corners, axis=1)}
    lips, eye = np.arange(len(half)), np.append(np.arange(len(loop)), 0) + len(half)
    paths = [lips, eye] if len(loop) else [lips]
    steps = np.concatenate([np.stack([path[:-1], path[1:]], -1) for path in paths])
    return sum((int(a), int(b)) not in edges for a, b in np.sort(steps, axis=1))


def _lip_rings(half: Array) -> list[Array]:
    """Three rings of vertices just outside the lips, every other one half a step on."""
    edge = np.roll(half, -1, axis=0) - np.roll(half, 1, axis=0)
    edge[0], edge[-1] = (1.0, 0.0), (-1.0, 0.0)
    outward = np.stack([edge[:, 1], -edge[:, 0]], -1)
    for _ in range(6):
        outward[1:-1] = (outward[:-2] + 2 * outward[1:-1] + outward[2:]) / 4
    outward /= np.linalg.norm(outward, axis=1, keepdims=True)
    rings = []
    for number, gap in enumerate((0.024, 0.052, 0.086)):
        ring = half + gap * outward
        rings.append((ring[:-1] + ring[1:]) / 2 if number % 2 == 0 else ring)
    return rings


def _scatter(fixed: Array, lips: Array, loop: Array, spacing: Callable[[Array], Array]) -> Array:
    """`fixed` and, in a low-discrepancy order, every candidate that keeps its distance; then evened out a little."""
    golden = 1.32471795724474602596
    step = np.arange(1, 9000)
    u, v = (step / golden) % 1, (step / golden**2) % 1
    radius, angle = RIM * u**0.75, np.pi * (v - 0.5)
    candidates = np.stack([radius * np.cos(angle), radius * np.sin(angle)], -1)
    middle = np.stack([np.zeros(220), np.linspace(-RIM, RIM, 220)], -1)
    candidates = np.concatenate([middle, candidates])
    want = spacing(candidates)
    candidates[:, 0][candidates[:, 0] < 0.45 * want] = 0.0
    free = ~_inside(candidates, lips) & ~_inside(candidates, loop) & (np.linalg.norm(candidates, axis=1) < RIM - 0.12)
    points = np.empty((len(fixed) + len(candidates), 2))
    points[: len(fixed)] = fixed
    count = len(fixed)
    for candidate, gap in zip(candidates[free], want[free], strict=True):
        if np.min(np.sum((points[:count] - candidate) ** 2, axis=1)) > gap * gap:
            points[count] = candidate
            count += 1
    points = points[:count]
    on_axis = points[:, 0] == 0.0
    for _ in range(3):
        triangles = _triangulated(points)
        middle_of = _neighbour_mean(points, triangles)
        middle_of[on_axis, 0] = 0.0
        points[len(fixed) :] = middle_of[len(fixed) :]
    return points


def _neighbour_mean(points: Array, triangles: NDArray[Any]) -> Array:
    edges = np.unique(
        np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), 1), axis=0
    )
    total = np.zeros_like(points)
    number = np.zeros(len(points))
    for a, b in (edges.T, edges.T[::-1]):
        np.add.at(total, a, points[b])
        np.add.at(number, a, 1)
    mean: Array = total / number[:, None]
    return mean


def _inside(points: Array, polygon: Array) -> NDArray[np.bool_]:
    """Even-odd rule."""
    odd = np.zeros(len(points), bool)
    x, y = points.T
    for (x0, y0), (x1, y1) in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        if y0 != y1:
            odd ^= ((y0 > y) != (y1 > y)) & (x < (x1 - x0) * (y - y0) / (y1 - y0) + x0)
    return odd


def _both_sides(points: Array, triangles: Indices, lips: int, loop: int) -> Layout:
    """The right half and its mirror image, sewn together along x = 0."""
    off_axis = points[:, 0] > 0
    other = np.arange(len(points))
    other[off_axis] = len(points) + np.arange(off_axis.sum())
    both = np.concatenate([points, points[off_axis] * (-1, 1)])
    sewn = np.concatenate([triangles, other[triangles][:, ::-1]])
    used = np.unique(sewn)
    number = np.full(len(both), -1)
    number[used] = np.arange(len(used))
    right = np.arange(lips)
    border = np.concatenate([right, other[right[-2:0:-1]]])
    eye = np.arange(lips, lips + loop)
    return Layout(both[used], number[sewn], number[border], (number[eye], number[other[eye]]))
