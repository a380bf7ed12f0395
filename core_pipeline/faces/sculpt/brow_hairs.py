"""Brows of single hairs, that lie on the skin and go with it."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import PchipInterpolator

from core_pipeline.faces.sculpt.character import Character
from core_pipeline.faces.sculpt.piece import Piece, mirror, paint
from core_pipeline.faces.sculpt.sdf import Array, Solid, smoothstep

STEPS = np.array([0.0, 0.4, 0.75, 1.0])
WIDE = 0.0038


def brow_hairs(character: Character, clay: Solid) -> list[Piece]:
    """Both brows; they go up in browUp and a little down in blink."""
    shape = character.brows
    rest = _hairs(character, clay, 0.0)
    poses = {"browUp": _hairs(character, clay, shape.lift), "blink": _hairs(character, clay, -0.012)}
    per_hair = 2 * len(STEPS) - 1
    strip = [(0, 1, 2), (1, 3, 2), (2, 3, 4), (3, 5, 4), (4, 5, 6)]
    triangles = (np.arange(shape.hairs)[:, None, None] * per_hair + np.array(strip)).reshape(-1, 3)
    colours = paint(len(rest), character.palette.brow, 0.15)
    own = 0.8 + 0.9 * ((np.arange(shape.hairs) * 0.3819660) % 1)
    colours[:, :3] *= np.repeat(own, per_hair)[:, None]
    right = Piece("brow_right", rest, triangles, colours, poses)
    return [right, mirror(right, "brow_left")]


def _hairs(character: Character, clay: Solid, lift: float) -> Array:
    """(7 · hairs, 3); hairs lean from the nose up, over the arch, and down along the outer end."""
    shape = character.brows
    known = np.array(shape.line)
    knots = np.linspace(0, 1, len(known))
    number = np.arange(shape.hairs)
    u = (number + 0.5) / shape.hairs
    # roots from the lower to the upper edge in an order without a pattern
    level = 2 * ((number * 0.618034) % 1) - 1
    x, y, half = (PchipInterpolator(knots, known[:, i])(u) for i in range(3))
    half = half * (0.45 + 0.55 * smoothstep(0.0, 0.16, u))
    slope = np.gradient(y, x)
    lean = np.radians(30 * (1 - u) ** 2 + 40 * np.exp(-u / 0.05) - 12 * u - 11 * level) + 0.8 * np.arctan(slope)
    length = (0.042 + 0.022 * np.sin(np.pi * u)) * (0.7 + 0.6 * ((number * 0.754878) % 1))
    root_y = y + level * 0.85 * half + character.eyes.centre[1] + lift
    length = length * (1 - 0.5 * smoothstep(0.75, 1.0, u))
    bend = -0.18 * level * STEPS[:, None]
    px = x + STEPS[:, None] * length * np.cos(lean + bend)
    py = root_y + STEPS[:, None] * length * np.sin(lean + bend)
    wide = WIDE * np.array([0.7, 1.0, 0.7, 0.0])[:, None]
    across_x, across_y = -np.sin(lean), np.cos(lean)
    # counted so that the hair's front looks out of the face
    row, side = np.array([0, 0, 1, 1, 2, 2, 3]), np.array([-1, 1, -1, 1, -1, 1, 0])[:, None]
    sx, sy = px[row] - side * wide[row] * across_x, py[row] - side * wide[row] * across_y
    points: Array = np.stack([sx, sy, clay.front(sx, sy) + 0.012], -1).transpose(1, 0, 2).reshape(-1, 3)
    return points
