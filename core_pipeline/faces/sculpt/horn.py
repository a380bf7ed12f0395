"""Limbs, claws and spikes: round sections along a bent line, thick or thin as wanted, closed at both ends."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import PchipInterpolator

from core_pipeline.faces.sculpt.piece import Triangles, fan, tube
from core_pipeline.faces.sculpt.sdf import Array, Point


@dataclass(frozen=True)
class Horn:
    """A line through `points` with (share of its length, half thickness) at `girth`.

    flat       half thickness along `reference` over that across it
    reference  a direction the line never takes: its sections keep to it
    """

    points: tuple[Point, ...]
    girth: tuple[tuple[float, float], ...]
    flat: float = 1.0
    reference: Point = (0.0, 0.0, 1.0)
    rows: int = 16
    sides: int = 12


def horn(shape: Horn) -> tuple[Array, Triangles, Array]:
    """Points (n, 3), triangles, and how far along the line each point lies, (n,) 0…1."""
    fine = curve(shape.points, np.linspace(0, 1, 200))
    length = np.append(0, np.cumsum(np.linalg.norm(np.diff(fine, axis=0), axis=1)))
    length /= length[-1]
    # rows crowd at the ends, which are round
    share = (1 - np.cos(np.pi * np.linspace(0, 1, shape.rows))) / 2
    path = np.stack([np.interp(share, length, fine[:, i]) for i in range(3)], -1)
    ahead = np.stack([np.interp(share, length, np.gradient(fine[:, i])) for i in range(3)], -1)
    across = np.cross(shape.reference, ahead)
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    high = np.cross(ahead, across)
    high /= np.linalg.norm(high, axis=1, keepdims=True)
    known = np.array(shape.girth)
    wide = PchipInterpolator(known[:, 0], known[:, 1])(share)
    points, triangles = tube(path, across, high, wide, shape.flat * wide, shape.sides)
    first, last = np.arange(shape.sides), len(points) - shape.sides + np.arange(shape.sides)
    ends = [fan(first[::-1], len(points)), fan(last, len(points) + 1)]
    points = np.concatenate([points, path[[0, -1]]])
    return points, np.concatenate([triangles, *ends]), np.append(np.repeat(share, shape.sides), (0.0, 1.0))


def curve(points: Sequence[Point], t: Array) -> Array:
    """(len(t), 3) a Bézier curve of any order, by de Casteljau's construction."""
    level = np.array(points, float)[:, None] + 0 * t[None, :, None]
    while len(level) > 1:
        level = level[:-1] + t[None, :, None] * np.diff(level, axis=0)
    line: Array = level[0]
    return line
