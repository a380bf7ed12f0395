"""What else a head has: brows, ears, a neck and a shirt."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import PchipInterpolator

from core_pipeline.faces.sculpt.brow_hairs import brow_hairs
from core_pipeline.faces.sculpt.character import Character
from core_pipeline.faces.sculpt.piece import Piece, Triangles, fan, grid, linear, mirror, paint, tube
from core_pipeline.faces.sculpt.sdf import Array, Solid, smoothstep

BROW_ROWS = 14
EAR_AROUND = 20
RIM_ROW = 6  # of the ear's sections: the first that is not in front of its rim
NECK_AROUND = 34


def brows(character: Character, clay: Solid) -> list[Piece]:
    """Both brows; they go up in browUp and a little down in blink."""
    shape = character.brows
    if shape.hairs:
        return brow_hairs(character, clay)
    rest, triangles = _brow(character, clay, 0.0)
    poses = {"browUp": _brow(character, clay, shape.lift)[0], "blink": _brow(character, clay, -0.012)[0]}
    right = Piece("brow_right", rest, triangles, paint(len(rest), character.palette.brow, 0.15), poses)
    return [right, mirror(right, "brow_left")]


def _brow(character: Character, clay: Solid, lift: float) -> tuple[Array, Triangles]:
    known = np.array(character.brows.line)
    knots = np.linspace(0, 1, len(known))
    u = (1 - np.cos(np.pi * np.linspace(0, 1, BROW_ROWS))) / 2
    x, y, half = (PchipInterpolator(knots, known[:, i])(u) for i in range(3))
    y = y + character.eyes.centre[1] + lift
    middle = np.array(character.middle)
    seen = np.stack([x, y, clay.front(x, y)], -1)
    out = clay.gradient(seen)
    path = clay.project(np.maximum(seen, middle - 9))
    ahead = np.gradient(path, axis=0)
    ahead /= np.linalg.norm(ahead, axis=1, keepdims=True)
    across = np.cross(out, ahead)
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    ends = np.sqrt(np.clip(1 - np.clip((0.10 - u) / 0.10, 0, 1) ** 2, 0, 1))
    ends[[0, -1]] = 0.01
    half = half * ends
    return tube(path + out * 0.004, across, np.cross(ahead, across), half, 0.5 * half + 0.004, 8)


def ears(character: Character) -> list[Piece]:
    """A bowl with a rolled rim on each side; none under hair that hides them."""
    shape = character.ears
    if shape is None:
        return []
    wide, high = shape.size
    turn = 2 * np.pi * np.arange(EAR_AROUND) / EAR_AROUND
    # (distance from the middle of the bowl, how far it stands off the head), from inside to the root behind
    section = [(0.0, -0.005), (0.25, -0.008), (0.45, 0.018), (0.60, 0.058), (0.74, 0.046), (0.87, 0.070), (0.96, 0.066)]
    section += [(1.0, 0.044), (0.95, 0.020), (0.82, -0.02), (0.66, -0.18)]
    rows = []
    # from the front of the ear, where the bump before its opening is
    before = np.exp(-(((turn - np.pi) / 0.40) ** 2))
    for number, (size, off) in enumerate(section):
        lobe = 1 - 0.28 * smoothstep(0.0, -1.0, np.sin(turn))
        # the bowl lies in the lower front; the lobe below it is flat
        inner = max(1 - size, 0.0) if number < RIM_ROW else 0.0
        bump = before * np.exp(-(((size - 0.60) / 0.13) ** 2)) * (number < RIM_ROW)
        u = wide * (size * np.cos(turn) * lobe - 0.20 * inner + 0.20 * bump)
        v = high * (size * np.sin(turn) - 0.10 * inner) + 0.02 * size
        ridge = 0.030 * np.exp(-(((size - 0.60) / 0.10) ** 2)) * (np.cos(turn) - 0.4 * np.sin(turn)) + 0.03 * bump
        flat = smoothstep(-0.45, -0.9, np.sin(turn)) * smoothstep(0.3, 0.7, size) * (number < RIM_ROW)
        rows.append(np.stack([off + ridge + flat * (0.052 - off - ridge), v, u], -1))
    local = np.concatenate(rows)
    a = np.radians(shape.stand_off)
    # u runs towards the back of the head, tilted a little like every ear
    tilt = np.radians(-10)
    y = local[:, 1] * np.cos(tilt) - local[:, 2] * np.sin(tilt)
    back = local[:, 2] * np.cos(tilt) + local[:, 1] * np.sin(tilt)
    x, z = local[:, 0] * np.cos(a) + back * np.sin(a), local[:, 0] * np.sin(a) - back * np.cos(a)
    points = np.stack([x, y, z], -1) + np.array(shape.centre)
    palette = character.palette
    colours = paint(len(points), palette.skin, 0.35)
    depth = np.repeat([0.40, 0.44, 0.58, 0.92, 0.78, 1.0, 0.95, 0.80, 0.66, 0.55, 0.50], EAR_AROUND)
    warm = 0.35 * np.repeat([1, 1, 0.8, 0.5, 0.4, 0.4, 0.3, 0.2, 0.1, 0, 0], EAR_AROUND)[:, None]
    colours[:, :3] += warm * (linear(palette.blush) - colours[:, :3])
    colours[:, :3] *= depth[:, None] ** np.array([0.8, 1.1, 1.2])
    triangles = grid(len(section), EAR_AROUND, closed=True)[:, ::-1]
    right = Piece("ear_right", points, triangles, colours)
    return [right, mirror(right, "ear_left")]


def body(character: Character, clay: Solid) -> list[Piece]:
    """Neck and a shirt with a rolled collar, cut off below the frame."""
    shape, palette = character.body, character.palette
    turn = 2 * np.pi * np.arange(NECK_AROUND) / NECK_AROUND
    trunk = np.array([(0.06, 1.06), (0.10, 1.14), (0.09, 1.25), (0.03, 1.33), (-0.04, 1.34), (-0.09, 1.30)])
    slope = np.array(
        [(0.02, 1.22), (-0.06, 1.36), (-0.13, 1.75), (-0.22, 2.20), (-0.36, 2.60), (-0.60, 2.85), (-0.95, 2.95)]
    )
    collar = _lathe(turn, shape.collar + trunk[::-1, 0], shape.neck * trunk[::-1, 1], 1.0, shape.middle)
    shirt = _lathe(turn, shape.collar + slope[::-1, 0], shape.neck * slope[::-1, 1], 0.72, shape.middle)
    # a floor, for who looks from below
    shirt = np.concatenate([shirt, shirt[:NECK_AROUND].mean(0)[None]])
    floor = fan(np.arange(NECK_AROUND), len(shirt) - 1)[:, ::-1]
    lathe = grid(len(slope), NECK_AROUND, closed=True)
    trim, cloth = paint(len(collar), palette.shirt_trim, 0.15), paint(len(shirt), palette.shirt, 0.12)
    return [
        _neck(character, clay, turn),
        Piece("collar", collar, grid(len(trunk), NECK_AROUND, closed=True), trim),
        Piece("shirt", shirt, np.concatenate([lathe, floor]), cloth),
    ]


def _neck(character: Character, clay: Solid, turn: Array) -> Piece:
    """From inside the collar up into the skull: at the back higher than under the chin."""
    shape = character.body
    heights = np.array([shape.collar - 0.12, shape.collar, -1.08, -0.96, -0.84, -0.72, -0.60, -0.46, -0.30])
    radii = shape.neck * np.array([1.22, 1.12, 1.04, 1.0, 0.98, 0.97, 0.97, 0.98, 0.98])
    neck = _lathe(turn, heights, radii, 1.0, shape.middle)
    # it leans back under the head, out of the way of the mouth
    neck[:, 2] -= 0.08 * smoothstep(-0.95, -0.5, neck[:, 1]) + 0.12 * smoothstep(-0.6, -0.2, neck[:, 1])
    before = np.tile(np.clip(np.cos(turn), 0, None), len(heights)) * np.repeat(radii, NECK_AROUND)
    neck[:, 2] -= 0.6 * before * smoothstep(-0.80, -0.55, neck[:, 1])
    # and its upper end goes into the nape
    sunk = np.clip(clay.distance(neck) + 0.03, 0, None) * smoothstep(-0.60, -0.30, neck[:, 1])
    neck = neck - sunk[:, None] * clay.gradient(neck)
    colours = paint(len(neck), character.palette.skin, 0.35)
    # the head's shadow, deepest under the chin
    free = 0.42 + 0.58 * smoothstep(-0.72, -1.25, np.repeat(heights, NECK_AROUND))
    free = 1 - (1 - free) * (0.35 + 0.65 * smoothstep(-0.6, 0.4, np.tile(np.cos(turn), len(heights))))
    colours[:, :3] *= free[:, None] ** np.array([0.8, 1.1, 1.2])
    return Piece("neck", neck, grid(len(heights), NECK_AROUND, closed=True), colours)


def _lathe(turn: Array, heights: Array, radii: Array, depth: float, middle: float) -> Array:
    """Rings (rows × columns) from the bottom to the top; wide rings are flatter from front to back."""
    flat = depth + (1 - depth) * smoothstep(1.9, 1.2, radii / radii.min())[:, None]
    x, z = radii[:, None] * np.sin(turn), flat * radii[:, None] * np.cos(turn)
    return np.stack([x, heights[:, None] + 0 * x, z + middle], -1).reshape(-1, 3)
