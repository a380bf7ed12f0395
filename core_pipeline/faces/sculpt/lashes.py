"""Lashes: tapered and curved, on the edge of the upper lid, going with it in a blink."""

from __future__ import annotations

import numpy as np

from core_pipeline.faces.sculpt.character import Character
from core_pipeline.faces.sculpt.lids import LID, Lid
from core_pipeline.faces.sculpt.piece import Piece, mirror, paint
from core_pipeline.faces.sculpt.sdf import Array, smoothstep

ROWS = 4
THICK = 0.0004


def lashes(character: Character) -> list[Piece]:
    """Both rows of lashes; none when the character has no single lashes."""
    number = character.eyes.lashes
    if not number:
        return []
    rest = _row(character, closed=False)
    poses = {"blink": _row(character, closed=True)}
    first = np.arange(number)[:, None, None] * (2 * ROWS - 1)
    strip = [(2 * i, 2 * i + 1, 2 * i + 2) for i in range(ROWS - 1)]
    strip += [(2 * i + 1, 2 * i + 3, 2 * i + 2) for i in range(ROWS - 2)]
    single = np.array(strip)
    triangles = (first + single[None]).reshape(-1, 3)
    # a front and, a hair's breadth behind, a back
    triangles = np.concatenate([triangles, triangles[:, ::-1] + len(rest)])
    both = {name: _doubled(points) for name, points in poses.items()}
    colours = paint(2 * len(rest), character.palette.lash, 0.3)
    right = Piece("lashes_right", _doubled(rest), triangles, colours, both)
    return [right, mirror(right, "lashes_left")]


def _doubled(points: Array) -> Array:
    """Lashes, and the same a little behind them."""
    single = points.reshape(-1, 2 * ROWS - 1, 3)
    out = np.cross(single[:, 1] - single[:, 0], single[:, 2] - single[:, 0])
    out /= np.linalg.norm(out, axis=1, keepdims=True)
    return np.concatenate([single, single - THICK * out[:, None]]).reshape(-1, 3)


def _row(character: Character, *, closed: bool) -> Array:
    eyes = character.eyes
    lid = Lid(eyes)
    # from the outer corner to the inner one, where they are short
    place = np.linspace(0.03, 0.86, eyes.lashes)
    angle = np.pi * place
    root = lid.edge(angle, radius=LID * 1.005)
    side = lid.edge(angle + 0.06, radius=LID * 1.005) - root
    if closed:
        shut = lid.close(np.concatenate([root, root + side]), np.ones(2 * len(root)))
        root, side = shut[: len(root)], shut[len(root) :] - shut[: len(root)]
    out = root - lid.centre
    out /= np.linalg.norm(out, axis=1, keepdims=True)
    fan = np.cos(angle)[:, None] * lid.axes[0] * 0.75
    length = eyes.lash_length * eyes.radius * (0.45 + 0.55 * smoothstep(0.95, 0.25, place))
    length = length * (1 - 0.22 * (np.arange(eyes.lashes) % 3 == 1)) * (0.75 + 0.25 * smoothstep(0.0, 0.12, place))
    # three by three their tips draw together
    drawn = (1 - np.arange(eyes.lashes) % 3)[:, None] * (root - np.roll(root, 1, axis=0))[len(root) // 2] * 0.55
    up = np.array([0.0, -0.55 if closed else 0.35, 0.0])
    curl = np.array([0.0, 0.35 if closed else 0.75, 0.0])
    rows = []
    for t in np.linspace(0, 1, ROWS):
        line = root + length[:, None] * (t * (0.9 * out + fan + up) + t * t * curl) + t * t * drawn
        wide = side * (1 - t)
        rows += [line - wide / 2, line + wide / 2] if t < 1 else [line]
    points: Array = np.stack(rows, axis=1).reshape(-1, 3)
    return points
