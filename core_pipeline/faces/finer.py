"""Finer triangles where a picture shows more than a mesh's vertices can: an iris, a brow, the edge of a lash card.

We draw one colour per vertex. An edge along which the picture is not what its two ends make of it is halved, and
so are the triangles beside it; a few rounds bring out what is seen from a portrait's distance.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core_pipeline.faces.face import Floats
from core_pipeline.faces.normals import seam_groups

#: Triangles a whole face may grow to by this.
MOST_TRIANGLES = 45_000
ROUNDS = 3
#: Difference in sRGB (0…1) between picture and straight mix along an edge that is worth a vertex.
_SEEN = 0.06
#: Shortest edge worth halving, in heights of the head.
_SHORTEST = 0.006
#: How much stands around what moves, in sizes of that.
_AROUND = 0.4
_ALONG = (0.25, 0.5, 0.75)

Triangles = NDArray[np.uint32]
Ints = NDArray[np.int64]
Box = tuple[Floats, Floats]
#: (n, 2) texture coordinates → (n, 4) sRGB and alpha, 0…1
Sample = Callable[[NDArray[np.float64]], Floats]


@dataclass(frozen=True)
class Finer:
    """What was halved: `rounds` of (k, 2) ends of edges, each giving k new vertices, and the triangles after all."""

    triangles: Triangles
    rounds: tuple[Ints, ...] = ()

    def of(self, values: NDArray[Any]) -> NDArray[Any]:
        """(n, …) values of the old vertices, with the means of both ends for the new ones behind them."""
        for ends in self.rounds:
            values = np.concatenate([values, (values[ends[:, 0]] + values[ends[:, 1]]) / 2]).astype(values.dtype)
        return values


def refined(
    positions: Floats, places: NDArray[np.float64], triangles: Triangles, sample: Sample, box: Box, most: int
) -> Finer:
    """A mesh, halved where `sample` asks for it, by about `most` new triangles.

    positions (n, 3), places (n, 2) texture coordinates, box: the corners of the head's box; the rest stays as it is
    """
    finer = Finer(triangles)
    for _ in range(ROUNDS):
        room = (most - len(finer.triangles) + len(triangles)) // 2  # an edge has two sides
        ends = _wanted(finer.of(positions), finer.of(places), finer.triangles, sample, box, room)
        if not len(ends):
            break
        count = len(positions) + sum(map(len, finer.rounds))
        finer = Finer(_halved(finer.triangles, ends, count), (*finer.rounds, ends))
    return finer


def head_box(meshes: Iterable[tuple[Floats, Collection[Floats]]]) -> Box | None:
    """The box of all that moves, and almost half as much around, of (positions, deltas); None when nothing does."""
    moving = [points[np.any([delta.any(axis=1) for delta in deltas], axis=0)] for points, deltas in meshes if deltas]
    points = np.concatenate(moving) if moving else np.zeros((0, 3), np.float32)
    if not len(points):
        return None
    low, high = points.min(0), points.max(0)
    around = _AROUND * (high - low).max()
    return low - around, high + around


def _wanted(
    points: Floats, places: NDArray[np.float64], triangles: Triangles, sample: Sample, box: Box, room: int
) -> Ints:
    """(k, 2) ends of the edges to be halved, the worst `room` of them; both sides of a seam alike."""
    if room <= 0:
        return np.zeros((0, 2), np.int64)
    edges = np.unique(np.sort(_edges(triangles), axis=1), axis=0)
    a, b = edges.T
    low, high = box
    long = np.linalg.norm(points[a] - points[b], axis=1) > _SHORTEST * float((high - low)[1])
    middle = (points[a] + points[b]) / 2
    edges = edges[long & ((middle >= low) & (middle <= high)).all(axis=1)]
    a, b = edges.T
    at_ends = sample(places[a]), sample(places[b])
    off = np.zeros(len(edges), np.float32)
    for part in _ALONG:
        mixed = (1 - part) * at_ends[0] + part * at_ends[1]
        here = sample((1 - part) * places[a] + part * places[b])
        off = np.maximum(off, np.abs(here - mixed).max(axis=1))
    groups = seam_groups(points)
    _, same = np.unique(np.sort(groups[edges], axis=1), axis=0, return_inverse=True)
    worst = np.zeros(int(same.max(initial=-1)) + 1, np.float32)
    np.maximum.at(worst, same.ravel(), off)
    off = worst[same.ravel()]
    if np.count_nonzero(off > _SEEN) > room:
        off = np.where(off > np.sort(off)[-room], off, 0)
    chosen: Ints = edges[off > _SEEN]
    return chosen


def _edges(triangles: Triangles) -> Ints:
    """(3 m, 2): all ab, then all bc, then all ca."""
    corners = triangles.astype(np.int64)
    return np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])


def _halved(triangles: Triangles, ends: Ints, first: int) -> Triangles:
    """The triangles once the edges `ends` have got the vertices first, first + 1, …"""
    keys = ends[:, 0] << 32 | ends[:, 1]  # sorted, as np.unique left them
    low_high = np.sort(_edges(triangles), axis=1)
    wanted = low_high[:, 0] << 32 | low_high[:, 1]
    at = np.minimum(np.searchsorted(keys, wanted), len(keys) - 1)
    middle = np.where(keys[at] == wanted, first + at, -1).reshape(3, -1).T
    has = middle >= 0
    number = has.sum(axis=1)
    corners = triangles.astype(np.int64)
    pieces = [corners[number == 0]]

    def turned(mine: NDArray[np.bool_], start: Ints) -> list[Ints]:
        """a, b, c and the middles of ab, bc, ca of some triangles, begun at corner `start` of each."""
        order = (start[:, None] + np.arange(3)) % 3
        rows = np.flatnonzero(mine)[:, None]
        return [*corners[rows, order].T, *middle[rows, order].T]

    one = number == 1
    a, b, c, p, _, _ = turned(one, has[one].argmax(axis=1))
    pieces += [np.stack(part, -1) for part in ((a, p, c), (p, b, c))]
    two = number == 2
    a, b, c, p, q, _ = turned(two, (~has[two]).argmax(axis=1) + 1)
    pieces += [np.stack(part, -1) for part in ((p, b, q), (a, p, q), (a, q, c))]
    three = number == 3
    a, b, c, p, q, r = turned(three, np.zeros(np.count_nonzero(three), np.int64))
    pieces += [np.stack(part, -1) for part in ((a, p, r), (p, b, q), (r, q, c), (p, q, r))]
    return np.concatenate(pieces).astype(np.uint32)
