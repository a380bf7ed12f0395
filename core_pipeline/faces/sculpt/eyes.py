"""Eyeballs: white, iris and pupil as rings of vertices, so that their borders are sharp at any size; and a glint."""

from __future__ import annotations

import numpy as np

from core_pipeline.faces.sculpt.character import Character
from core_pipeline.faces.sculpt.piece import Piece, fan, grid, linear, mirror, paint
from core_pipeline.faces.sculpt.sdf import Array

AROUND = 28


def eyes(character: Character) -> list[Piece]:
    """Right and left eyeball and their glints."""
    ball = _eyeball(character)
    glint = _glint(character)
    # both eyes are lit by the same lamp: the left glint is moved across, not mirrored
    shift = -2 * np.array([character.eyes.centre[0], 0, 0])
    other = Piece("glint_left", glint.positions + shift, glint.triangles, glint.colours)
    return [ball, mirror(ball, "eye_left"), glint, other]


def _axes(character: Character) -> Array:
    """Rows: right, up, towards what the right eye looks at."""
    yaw, pitch = np.radians(character.eyes.gaze)
    ahead = np.array([np.sin(yaw) * np.cos(pitch), np.sin(pitch), np.cos(yaw) * np.cos(pitch)])
    right = np.cross((0, 1, 0), ahead)
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(ahead, right), ahead])


def _cap(character: Character, angles: Array, radius: float, around: int = AROUND) -> Array:
    """Rings of a ball at `angles` degrees from where it looks, and its foremost point last."""
    turn = 2 * np.pi * np.arange(around) / around
    a = np.radians(angles)[:, None]
    local = np.stack([np.sin(a) * np.cos(turn), np.sin(a) * np.sin(turn), np.cos(a) + 0 * turn], -1).reshape(-1, 3)
    local = np.concatenate([local, [(0.0, 0.0, 1.0)]])
    points: Array = np.array(character.eyes.centre) + radius * local @ _axes(character)
    return points


def _eyeball(character: Character) -> Piece:
    eyes = character.eyes
    iris, pupil = eyes.iris, eyes.pupil
    angles = np.array(
        [125, 100, 78, 60, 45, iris + 0.8, iris, iris - 3.5, (iris + pupil) / 2, pupil + 0.5, pupil, 0.6 * pupil]
    )
    white, colour = linear((0.97, 0.97, 0.96)), linear(eyes.iris_colour)
    black = linear((0.03, 0.02, 0.03))
    tints = [white * 0.45, white * 0.6, white * 0.85, white, white, white, colour * 0.25, colour * 0.8, colour * 1.15]
    tints += [colour * 0.75, black, black]
    points = _cap(character, angles, eyes.radius)
    colours = np.concatenate([np.repeat(tints, AROUND, axis=0), [black]])
    # light falls in from above and lights the lower half of the iris; the upper lid shades the ball
    height = (points[:, 1] - eyes.centre[1]) / eyes.radius
    rings = np.repeat(angles, AROUND)
    in_iris = np.append((rings < iris - 1) & (rings > pupil + 0.2), False)
    colours[in_iris] *= (1.15 - 1.5 * height[in_iris, None]).clip(0.55, 1.8)
    around = np.append(np.tile(np.arange(AROUND), len(angles)), 0)
    colours[in_iris] *= 1 + eyes.streaks * np.sin(around * 2.4 + 3 * np.sin(1.7 * around))[in_iris, None]
    colours *= (1 - 0.45 * np.clip((height - 0.30) / 0.45, 0, 1))[:, None]
    colours = np.column_stack([np.clip(colours, 0, 1), np.full(len(points), 1.0)])
    last = (len(angles) - 1) * AROUND + np.arange(AROUND)
    triangles = np.concatenate([grid(len(angles), AROUND, closed=True), fan(last, len(points) - 1)])
    return Piece("eye_right", points, triangles, colours)


def _glint(character: Character) -> Piece:
    eyes = character.eyes
    flat = _cap(character, np.array([4.6, 3.0]), eyes.radius * 1.02, 12)
    up, side = 9.5, -9.0
    axes = _axes(character)
    local = (flat - np.array(eyes.centre)) @ axes.T
    a, b = np.radians(up), np.radians(side)
    raised = np.stack(
        [
            local[:, 0],
            local[:, 1] * np.cos(a) + local[:, 2] * np.sin(a),
            local[:, 2] * np.cos(a) - local[:, 1] * np.sin(a),
        ],
        -1,
    )
    moved = np.stack(
        [
            raised[:, 0] * np.cos(b) + raised[:, 2] * np.sin(b),
            raised[:, 1],
            raised[:, 2] * np.cos(b) - raised[:, 0] * np.sin(b),
        ],
        -1,
    )
    points = np.array(eyes.centre) + moved @ axes
    triangles = np.concatenate([grid(2, 12, closed=True), fan(12 + np.arange(12), 24)])
    return Piece("glint_right", points, triangles, paint(len(points), (1.0, 1.0, 1.0), 0.0))
