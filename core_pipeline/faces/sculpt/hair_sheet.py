"""A sheet of hair: a lattice swept through guide strands, thick, combed into clumps, with tips of uneven length."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicSpline, PchipInterpolator

from core_pipeline.faces.sculpt.character import Sheet
from core_pipeline.faces.sculpt.piece import Triangles, grid
from core_pipeline.faces.sculpt.sdf import Array, Solid, smoothstep

INNER = 6  # one column in so many on the side no one sees


def sheet(layer: Sheet, clay: Solid) -> list[tuple[Array, Triangles, Array]]:
    """Points, triangles and lightness (0…1) of the sheet, and of its mirror image when it has one."""
    points, triangles, light = _build(layer, clay)
    if not layer.mirrored:
        return [(points, triangles, light)]
    return [(points, triangles, light), (points * (-1, 1, 1), triangles[:, ::-1], light)]


def _build(layer: Sheet, clay: Solid) -> tuple[Array, Triangles, Array]:
    known = np.array(layer.guides)
    across = np.linspace(0, 1, layer.columns)
    # every clump tapers to a tip of its own
    phase = np.pi * layer.clumps * across
    ridge = np.abs(np.sin(phase))
    number = np.floor(layer.clumps * across)
    length = 1 - layer.ragged * ((1 - ridge**0.7) + 0.8 * (np.sin(7.1 * number + 2.0) * 0.5 + 0.5))
    along = np.linspace(0, 1, layer.rows)[:, None] * length
    strands = PchipInterpolator(np.linspace(0, 1, len(known)), known)(across)
    middle = np.stack(
        [
            CubicSpline(np.linspace(0, 1, known.shape[1]), strand, bc_type="natural")(v)
            for strand, v in zip(strands, along.T, strict=True)
        ],
        axis=1,
    )
    ahead = np.gradient(middle, axis=0)
    side = np.cross(ahead, clay.gradient(middle))
    side /= np.maximum(np.linalg.norm(side, axis=-1, keepdims=True), 1e-9)
    share = np.linspace(0, 1, layer.rows)[:, None]
    swing = np.sin(2 * np.pi * (layer.waves * share + 0.35 * across))
    middle = middle + side * (layer.wave * swing * smoothstep(0.15, 0.6, share))[..., None]
    for _ in range(3):
        middle = middle + clay.gradient(middle) * np.clip(layer.height - clay.distance(middle), 0, None)[..., None]
    normal = np.cross(np.gradient(middle, axis=0), np.gradient(middle, axis=1))
    normal /= np.maximum(np.linalg.norm(normal, axis=-1, keepdims=True), 1e-9)
    rim = np.sqrt(np.clip(1 - (1 - np.clip(np.minimum(across, 1 - across) / 0.10, 0, 1)) ** 2, 0, 1))
    tip = np.sqrt(np.clip(1 - np.clip((share - 0.72) / 0.28, 0, 1) ** 2, 0, 1))
    root = 0.1 + 0.9 * smoothstep(0, 0.2, share)
    comb = ridge**0.7 * smoothstep(0.0, 0.35, share) + 0.6 * (1 - smoothstep(0.0, 0.35, share))
    full = layer.thickness * rim * tip * root
    outer = middle + normal * (full * (0.45 + 0.55 * comb))[..., None]
    kept = np.unique(np.linspace(0, layer.columns - 1, max(7, layer.columns // INNER)).astype(int))[::-1]
    inner = (middle - normal * (0.35 * full)[..., None])[:, kept]
    points = np.concatenate([outer, inner], axis=1)
    light = 0.12 + 0.62 * comb * rim + 0.22 * smoothstep(0.35, 0.9, share) * rim
    light = np.concatenate([light, np.zeros((layer.rows, len(kept)))], axis=1)
    sides = points.shape[1]
    return points.reshape(-1, 3), grid(layer.rows, sides, closed=True), np.clip(light, 0, 1).ravel()
