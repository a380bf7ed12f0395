"""Pieces a face is put together from: one mesh, the same in every pose but for its positions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from core_pipeline.faces.sculpt.sdf import Array, Point

Triangles = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Piece:
    """positions (n, 3) neutral, triangles (m, 3) anticlockwise from outside, colours (n, 4) linear RGB + gloss,

    poses   pose → positions (n, 3); a pose not named leaves the piece alone
    ranges  part → (first triangle, number) when the piece is more than one part; else the whole is the part `name`
    """

    name: str
    positions: Array
    triangles: Triangles
    colours: Array
    poses: Mapping[str, Array] = field(default_factory=dict)
    ranges: Mapping[str, tuple[int, int]] = field(default_factory=dict)


def linear(colour: Point) -> Array:
    """A colour as a painter picks it (sRGB, 0…1) → linear light."""
    c = np.array(colour)
    value: Array = np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)
    return value


def paint(count: int, colour: Point, gloss: float) -> Array:
    """(count, 4) of one colour."""
    return np.tile(np.append(linear(colour), gloss), (count, 1))


def grid(rows: int, columns: int, *, closed: bool) -> Triangles:
    """Triangles of a rows × columns lattice, row by row; `closed` joins the last column to the first."""
    row = np.arange(rows - 1)[:, None]
    column = np.arange(columns if closed else columns - 1)[None]
    after = (column + 1) % columns
    a, b = row * columns + column, row * columns + after
    d, c = a + columns, b + columns
    return np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)])


def fan(ring: NDArray[np.int64], centre: int) -> Triangles:
    """Triangles from a closed ring of vertex numbers to one vertex."""
    return np.stack([ring, np.roll(ring, -1), np.full(len(ring), centre)], -1)


def turn(points: Array, pivot: Point | Array, degrees: float | Array) -> Array:
    """Turned about the x axis through `pivot`; positive takes the front down, as a jaw opens."""
    angle = np.radians(degrees)
    c, s = np.cos(angle), np.sin(angle)
    y, z = points[..., 1] - pivot[1], points[..., 2] - pivot[2]
    turned: Array = np.stack([points[..., 0] + 0 * s, pivot[1] + y * c - z * s, pivot[2] + y * s + z * c], -1)
    return turned


def tube(
    path: Array, across: Array, along_normal: Array, wide: Array, high: Array, sides: int
) -> tuple[Array, Triangles]:
    """An elliptic tube: path (r, 3), unit directions (r, 3) each, half sizes (r,). Closed round, open ended."""
    angle = 2 * np.pi * np.arange(sides) / sides
    ring = across[:, None] * (wide[:, None] * np.cos(angle))[..., None]
    ring = ring + along_normal[:, None] * (high[:, None] * np.sin(angle))[..., None]
    points = (path[:, None] + ring).reshape(-1, 3)
    return points, grid(len(path), sides, closed=True)


def mirror(piece: Piece, name: str) -> Piece:
    """The same on the other side: x turned round, and the triangles with it."""
    flip = np.array([-1.0, 1.0, 1.0])
    poses = {pose: points * flip for pose, points in piece.poses.items()}
    return Piece(name, piece.positions * flip, piece.triangles[:, ::-1], piece.colours, poses, piece.ranges)
