"""The tongue: a flat oval swept along a Bézier curve, with a groove; its root goes with the jaw."""

from __future__ import annotations

import numpy as np

from core_pipeline.faces.sculpt.character import Character, MouthPose, TongueBend
from core_pipeline.faces.sculpt.piece import Piece, grid, linear, turn
from core_pipeline.faces.sculpt.sdf import Array, smoothstep

ROWS, SIDES = 22, 16


def tongue(character: Character, centre: Array) -> Piece:
    """The tongue at rest and in the poses that move it; `centre` is the middle of the mouth."""
    rest = _bend(character.rest_tongue, centre)
    palette = character.palette
    depth = centre[2] - rest[:, 2]
    shade = 1 - 0.75 * smoothstep(0.28, 0.62, depth)
    groove = 1 - 0.18 * np.exp(-((rest[:, 0] / 0.03) ** 2))
    tone = np.tile(linear(palette.tongue), (len(rest), 1))
    # paler and rougher on top, redder at the edges and the tip
    grain = np.sin(170 * rest[:, 0] + 40 * rest[:, 2]) * np.sin(150 * rest[:, 2])
    edge = smoothstep(0.05, 0.19, np.abs(rest[:, 0])) + 0.6 * smoothstep(0.32, 0.22, depth)
    tone *= 1 + palette.variation * (0.09 * grain[:, None] - 0.30 * edge[:, None] * np.array([0.5, 1.0, 1.0]))
    colours = np.column_stack([tone * (shade * groove)[:, None], np.full(len(rest), 0.7)])
    poses = {name: _posed(character, pose, centre) for name, pose in character.poses.items()}
    return Piece("tongue", rest, grid(ROWS, SIDES, closed=True), colours, poses)


def _posed(character: Character, pose: MouthPose, centre: Array) -> Array:
    bent = _bend(pose.tongue or character.rest_tongue, centre)
    return turn(bent, character.mouth.hinge, 0.85 * pose.jaw)


def _bend(bend: TongueBend, centre: Array) -> Array:
    # rows bunch at the round tip
    t = np.sin(np.linspace(0, 1, ROWS) * np.pi / 2) ** 0.9
    u = t[:, None]
    a, b, c, d = (np.array(point) for point in bend.line)
    line = (1 - u) ** 3 * a + 3 * (1 - u) ** 2 * u * b + 3 * (1 - u) * u**2 * c + u**3 * d
    forward = 3 * ((1 - u) ** 2 * (b - a) + 2 * (1 - u) * u * (c - b) + u**2 * (d - c))
    forward /= np.linalg.norm(forward, axis=1, keepdims=True)
    up = np.stack([forward[:, 1], -forward[:, 0]], -1)
    wide_tip = np.sqrt(np.clip(1 - (np.clip(t - 0.66, 0, None) / 0.34) ** 2, 0, 1))
    high_tip = np.sqrt(np.clip(1 - (np.clip(t - 0.86, 0, None) / 0.14) ** 2, 0, 1))
    wide = (0.17 + 0.035 * np.sin(np.pi * t)) * wide_tip * (1 + (bend.tip_width - 1) * smoothstep(0.5, 1, t))
    high = (0.085 - 0.048 * t) * high_tip
    angle = 2 * np.pi * np.arange(SIDES) / SIDES
    x = wide[:, None] * np.cos(angle)
    groove = -0.014 * np.exp(-((np.cos(angle) / 0.28) ** 2)) * (np.sin(angle) > 0)
    offset = high[:, None] * np.sin(angle) + groove * (wide_tip * high_tip * smoothstep(0, 0.3, t))[:, None]
    y = line[:, :1] + offset * up[:, :1]
    z = line[:, 1:] + offset * up[:, 1:]
    return np.stack([x, y, z], -1).reshape(-1, 3) + centre
