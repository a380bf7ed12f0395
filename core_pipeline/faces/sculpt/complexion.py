"""Complexion: how the colour of skin changes over a face, and where a beard grows."""

from __future__ import annotations

import numpy as np

from core_pipeline.faces.sculpt.character import Character
from core_pipeline.faces.sculpt.piece import linear
from core_pipeline.faces.sculpt.sdf import Array, smoothstep


def uneven(character: Character, points: Array, tone: Array) -> Array:
    """(n, 3) what to add to the skin's `tone`: under the eyes, at the wings of the nose, on brow, jaw and chin."""
    x, y, z = points.T
    eyes, palette = character.eyes, character.palette
    side, low = np.abs(x) - eyes.centre[0], y - eyes.centre[1]
    added = np.zeros_like(tone)

    def toward(colour: Array, share: Array) -> None:
        added[:] += share[:, None] * (colour - tone - added)

    under = np.exp(-((side / (0.8 * eyes.radius)) ** 2) - (((low + 0.75 * eyes.radius) / (0.3 * eyes.radius)) ** 2))
    toward(linear(palette.lid) * (0.95, 0.92, 1.0), 0.40 * under)
    _, nose_y, nose_z = character.nose
    away = np.linalg.norm((np.abs(x) - 0.10, y - nose_y + 0.03, z - nose_z + 0.06), axis=0)
    beside = np.exp(-((away / 0.06) ** 2))
    toward(linear(palette.blush) * 0.85, 0.30 * beside)
    chin = np.exp(-((x / 0.16) ** 2) - (((y - character.mouth.height + 0.30) / 0.12) ** 2))
    toward(linear(palette.blush), 0.16 * chin)
    forehead = smoothstep(0.25, 0.5, low) * smoothstep(0.6, 0.3, np.abs(x))
    added += 0.05 * forehead[:, None] * tone * (1.0, 0.9, 0.5)
    jaw = smoothstep(-0.35, -0.75, y) * smoothstep(0.15, 0.4, np.abs(x))
    added -= 0.10 * jaw[:, None] * tone * (1.0, 0.7, 0.5)
    mottled = np.sin(9 * x + 4 * y) * np.sin(11 * y - 5 * z + 2) + 0.6 * np.sin(23 * x - 9 * z) * np.sin(19 * y + 1)
    added += 0.022 * mottled[:, None] * tone * (0.6, 1.0, 0.9)
    line = np.array(character.brows.line)
    if character.brows.hairs:
        height = np.interp(np.abs(x), line[:, 0], line[:, 1])
        half = np.interp(np.abs(x), line[:, 0], line[:, 2], left=0.0, right=0.0)
        ground = np.exp(-(((low - height) / (0.6 * half + 0.006)) ** 2)) * (half > 0)
        toward(linear(palette.brow), 0.55 * ground)
    return added


def beard(character: Character, points: Array) -> Array:
    """(n,) 1 where a beard grows: on jaw, chin and upper lip, not on cheeks and nose."""
    x, y, z = points.T
    mouth = character.mouth
    line = mouth.height + 0.10 + 0.9 * np.clip(np.abs(x) - 0.34, 0, None)
    jaw = smoothstep(line + 0.06, line - 0.08, y) * smoothstep(-0.10, 0.06, z + 0.25 * (y - mouth.height))
    over_lip = np.exp(-(((y - mouth.height - 0.12) / 0.07) ** 2)) * smoothstep(0.30, 0.20, np.abs(x))
    bare = np.exp(-((x / 0.04) ** 2)) * smoothstep(0.0, 0.10, y - mouth.height)
    full: Array = np.maximum(jaw, over_lip) * (1 - 0.6 * bare)
    return full * smoothstep(0.16, 0.22, np.linalg.norm(points - np.array(character.nose), axis=1))
