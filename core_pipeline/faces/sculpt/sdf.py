"""The clay: a head as a smooth union of ellipsoids, given by its signed distance."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Point = tuple[float, float, float]


def smoothstep(a: float, b: float, x: Array | float) -> Array:
    """0 at `a`, 1 at `b` (a > b allowed), without a kink."""
    t = np.clip((np.asarray(x, float) - a) / (b - a), 0, 1)
    stepped: Array = t * t * (3 - 2 * t)
    return stepped


@dataclass(frozen=True)
class Blob:
    """An ellipsoid of clay; `mirrored` puts one on each side, `carve` takes clay away.

    blend  over which distance it melts into what is there already
    tilt   degrees about the z axis (mirrored with the blob)
    """

    centre: Point
    radii: Point
    blend: float
    mirrored: bool = False
    carve: bool = False
    tilt: float = 0.0


class Solid:
    """Blobs, melted in the order given; distances are approximate far away and good near the surface."""

    def __init__(self, blobs: tuple[Blob, ...]) -> None:
        self.blobs = blobs

    def distance(self, points: Array) -> Array:
        """Signed distance (…) of points (…, 3): negative inside."""
        folded = points.copy()
        folded[..., 0] = np.abs(folded[..., 0])
        total = np.full(points.shape[:-1], 9.0)
        for blob in self.blobs:
            near = _ellipsoid(folded if blob.mirrored else points, blob)
            total = -_smooth_min(-total, near, blob.blend) if blob.carve else _smooth_min(total, near, blob.blend)
        return total

    def gradient(self, points: Array, step: float = 2e-3) -> Array:
        """Unit outward direction (…, 3)."""
        axes = np.eye(3) * step
        parts = [self.distance(points + axis) - self.distance(points - axis) for axis in axes]
        gradient = np.stack(parts, axis=-1)
        unit: Array = gradient / np.maximum(np.linalg.norm(gradient, axis=-1, keepdims=True), 1e-12)
        return unit

    def cast(self, origins: Array, directions: Array, start: float = 2.2) -> Array:
        """Where rays coming in from `start` along −direction first meet the surface: (…, 3)."""
        along = np.full(directions.shape[:-1], start)
        for _ in range(70):
            gap = self.distance(origins + directions * along[..., None])
            if np.abs(gap).max(initial=0.0) < 1e-11:
                break
            along = np.maximum(along - np.clip(gap, -0.3, 0.3) * 0.75, 0.0)
        hit: Array = origins + directions * along[..., None]
        return hit

    def project(self, points: Array, rounds: int = 4) -> Array:
        """The nearest surface points, for points already near it."""
        for _ in range(rounds):
            points = points - self.gradient(points) * np.clip(self.distance(points), -0.05, 0.05)[..., None]
        return points

    def front(self, x: Array, y: Array) -> Array:
        """The z of the surface seen from the front at (x, y)."""
        origins = np.stack([x, y, np.zeros_like(x)], axis=-1)
        directions = np.broadcast_to(np.array([0.0, 0.0, 1.0]), origins.shape)
        z: Array = self.cast(origins, directions)[..., 2]
        return z

    def occlusion(self, points: Array, normals: Array, reach: float = 0.16) -> Array:
        """How open the sky is above each point, 0 (buried) … 1 (free): distances along the normal that fall short."""
        shade = np.zeros(points.shape[:-1])
        total = 0.0
        for part, weight in ((0.15, 1.0), (0.35, 0.8), (0.65, 0.6), (1.0, 0.5)):
            away = reach * part
            short = 1 - self.distance(points + normals * away) / away
            shade += weight * np.clip(short, 0, 1)
            total += weight
        free: Array = np.clip(1 - shade / total, 0, 1)
        return free


def _ellipsoid(points: Array, blob: Blob) -> Array:
    local = points - np.array(blob.centre)
    if blob.tilt:
        c, s = np.cos(np.radians(blob.tilt)), np.sin(np.radians(blob.tilt))
        local = np.stack(
            [local[..., 0] * c + local[..., 1] * s, local[..., 1] * c - local[..., 0] * s, local[..., 2]], -1
        )
    radii = np.array(blob.radii)
    scaled = local / radii
    size, slope = _length(scaled), _length(scaled / radii)
    distance: Array = size * (size - 1) / np.maximum(slope, 1e-9)
    return distance


def _length(vectors: Array) -> Array:
    """As np.linalg.norm over the last axis, which is slow where that has three values."""
    length: Array = np.sqrt(np.einsum("...i,...i->...", vectors, vectors))
    return length


def _smooth_min(a: Array, b: Array, blend: float) -> Array:
    mix = np.clip(0.5 + 0.5 * (b - a) / blend, 0, 1)
    smooth: Array = b * (1 - mix) + a * mix - blend * mix * (1 - mix)
    return smooth
