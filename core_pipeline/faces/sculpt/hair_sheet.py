"""A sheet of hair: a lattice swept through guide strands, thick, combed into clumps, with tips of uneven length."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicSpline, PchipInterpolator

from core_pipeline.faces.sculpt.character import Sheet
from core_pipeline.faces.sculpt.piece import Triangles, grid
from core_pipeline.faces.sculpt.sdf import Array, Solid, smoothstep


def sheet(layer: Sheet, clay: Solid) -> list[tuple[Array, Triangles, Array]]:
    """Points, triangles and lightness (0…1) of the sheet, and of its mirror image when it has one."""
    points, triangles, light = _build(layer, clay)
    if not layer.mirrored:
        return [(points, triangles, light)]
    return [(points, triangles, light), (points * (-1, 1, 1), triangles[:, ::-1], light)]


def _build(layer: Sheet, clay: Solid) -> tuple[Array, Triangles, Array]:
    share = np.linspace(0, 1, layer.rows)[:, None]
    across, number, ridge = _clumps(layer)
    length = _lengths(layer, number, ridge)
    middle = _middle(layer, clay, across, length)
    # across strands of even length: uneven ones would fold the layer where one ends beside another
    step = 0.5 / layer.columns
    beside = _middle(layer, clay, across + step, length) - _middle(layer, clay, across - step, length)
    normal = np.cross(np.gradient(middle, axis=0), beside)
    if not layer.edge:
        normal[:, [0, -1]] = (normal[:, :1] + normal[:, -1:]) / 2
    normal /= np.maximum(np.linalg.norm(normal, axis=-1, keepdims=True), 1e-9)
    side = np.clip(np.minimum(across, 1 - across) / layer.edge, 0, 1) if layer.edge else np.ones(layer.columns)
    rim = np.sqrt(1 - (1 - side) ** 2)
    tip = 0.16 + 0.84 * np.sqrt(np.clip(1 - np.clip((share - 0.72) / 0.28, 0, 1) ** 2, 0, 1))
    root = 0.1 + 0.9 * smoothstep(0, 0.2, share)
    combed = smoothstep(0.0, 0.35, share)
    comb = ridge * combed + 0.6 * (1 - combed)
    full = layer.thickness * rim * tip * root
    high = 1 + 0.25 * combed * np.sin(5.3 * number + 1.0)
    outer = middle + normal * (full * (1 - layer.relief + layer.relief * comb * high))[..., None]
    inner = (middle - normal * (0.35 * full)[..., None])[:, ::-1]
    points = np.concatenate([outer, inner], axis=1)
    light = np.concatenate([_light(layer, number, comb, rim), np.zeros((layer.rows, layer.columns))], axis=1)
    sides = points.shape[1]
    # the ends, which may be seen
    column = np.arange(layer.columns - 1)
    roots = np.stack([column, column + 1, sides - 2 - column, column, sides - 2 - column, sides - 1 - column], -1)
    tips = roots[:, ::-1] + (layer.rows - 1) * sides
    triangles = np.concatenate(
        [grid(layer.rows, sides, closed=True)[:, ::-1], roots.reshape(-1, 3), tips.reshape(-1, 3)]
    )
    return points.reshape(-1, 3), triangles, np.clip(light, 0, 1).ravel()


def _clumps(layer: Sheet) -> tuple[Array, Array, Array]:
    """(columns,) each: where a strand lies in the sheet, the number of its clump, how high it lies there, 0 … 1.

    Some clumps are wider than others. In a sheet whose sides meet they meet in the middle of one.
    """
    even = np.linspace(0, 1, layer.columns)
    uneven = 0.18 / layer.clumps * np.sin(2 * np.pi * even * round(layer.clumps / 2.6))
    place = layer.clumps * even + (0.0 if layer.edge else 0.5)
    return even + uneven, np.floor(place + 1e-9) % layer.clumps, np.abs(np.sin(np.pi * place)) ** 0.7


def _lengths(layer: Sheet, number: Array, ridge: Array) -> Array:
    """(columns,) part of its guides that each strand reaches: every clump tapers to a tip of its own."""
    length: Array = 1 - layer.ragged * (1.4 * (1 - ridge) + 0.8 * ridge * (np.sin(7.1 * number + 2.0) * 0.5 + 0.5))
    return length


def _middle(layer: Sheet, clay: Solid, across: Array, length: Array) -> Array:
    """(rows, columns, 3) the sheet without its thickness."""
    known = np.array(layer.guides)
    share = np.linspace(0, 1, layer.rows)[:, None]
    strands = PchipInterpolator(np.linspace(0, 1, len(known)), known)(across)
    knots = np.linspace(0, 1, known.shape[1])
    splines = [CubicSpline(knots, strand, bc_type="natural") for strand in strands]
    middle = np.stack([spline(v) for spline, v in zip(splines, (share * length).T, strict=True)], axis=1)
    ahead = np.gradient(middle, axis=0)
    side = np.cross(ahead, clay.gradient(middle))
    side /= np.maximum(np.linalg.norm(side, axis=-1, keepdims=True), 1e-9)
    swing = np.sin(2 * np.pi * (layer.waves * share + 0.35 * across))
    middle = middle + side * (layer.wave * swing * smoothstep(0.15, 0.6, share))[..., None]
    for _ in range(3):
        middle = middle + clay.gradient(middle) * np.clip(layer.height - clay.distance(middle), 0, None)[..., None]
    return middle


def _light(layer: Sheet, number: Array, comb: Array, rim: Array) -> Array:
    """(rows, columns) how light each place of the outer side is: a sheen across it, strands and tips of their own."""
    share = np.linspace(0, 1, layer.rows)[:, None]
    column = np.arange(layer.columns)
    strand = np.sin(2.4 * column + 2.0 * np.sin(1.3 * column))
    sheen = np.exp(-(((share - 0.34 - 0.05 * np.sin(2.3 * number)) / 0.14) ** 2))
    light = 0.10 + 0.46 * comb + 0.24 * sheen * comb + 0.16 * smoothstep(0.45, 0.95, share)
    light = light + layer.streaks * (0.6 * strand + 0.5 * np.sin(4.7 * number + 0.5)) * smoothstep(0.0, 0.25, share)
    lit: Array = light * rim
    return lit
