"""Eyeballs: white, iris and pupil as rings of vertices, so that their borders are sharp at any size; and a glint."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from core_pipeline.faces.sculpt.character import Character
from core_pipeline.faces.sculpt.lids import Lid
from core_pipeline.faces.sculpt.piece import Piece, fan, grid, linear, mirror, paint
from core_pipeline.faces.sculpt.sdf import Array, smoothstep

AROUND = 28
FINE = 36  # with fibres in the iris


def eyes(character: Character, *, lids: bool = True) -> list[Piece]:
    """Right and left eyeball and their glints; shaded by the lids when the skin has any."""
    ball = _eyeball(character, lids=lids)
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


def _eyeball(character: Character, *, lids: bool) -> Piece:
    eyes = character.eyes
    iris, pupil = eyes.iris, eyes.pupil
    around = FINE if eyes.streaks else AROUND
    white, colour = linear((0.94, 0.925, 0.91)), linear(eyes.iris_colour)
    black = linear((0.03, 0.02, 0.03))
    # (degrees from where it looks, colour): the iris has a dark rim, and is palest half way in
    rings: list[tuple[float, Array]] = [
        (125, white * 0.45),
        (100, white * 0.6),
        (76, white * 0.95),
        (58, white),
        (44, white),
    ]
    rings += [(iris + 1.0, white * 0.92), (iris, colour * 0.22), (iris - 3.0, colour * 0.62)]
    rings += [
        ((iris + pupil) / 2 + 1.5, colour),
        ((iris + pupil) / 2 - 2.5, colour * 1.25),
        (pupil + 1.0, colour * 0.6),
    ]
    rings += [(pupil, black), (0.6 * pupil, black)]
    angles = np.array([angle for angle, _ in rings])
    points = _cap(character, angles, eyes.radius, around)
    colours = np.concatenate([np.repeat([tint for _, tint in rings], around, axis=0), [black]])
    # light falls in from above and lights the lower half of the iris
    height = (points[:, 1] - eyes.centre[1]) / eyes.radius
    ring = np.append(np.repeat(angles, around), 0.0)
    in_iris = (ring < iris - 1) & (ring > pupil + 0.2)
    colours[in_iris] *= (1.15 - 1.5 * height[in_iris, None]).clip(0.55, 1.8)
    turn = 2 * np.pi * np.append(np.tile(np.arange(around), len(angles)), 0) / around
    fibres = np.sin(15 * turn + 2 * np.sin(4 * turn)) + 0.6 * np.sin(9 * turn + 1)
    colours[in_iris] *= 1 + eyes.streaks * fibres[in_iris, None]
    if lids:
        colours *= _under_lids(character, points, ring > iris + 0.5)
    else:
        colours *= (1 - 0.45 * np.clip((height - 0.30) / 0.45, 0, 1))[:, None]
    colours = np.column_stack([np.clip(colours, 0, 1), np.full(len(points), 1.0)])
    last = (len(angles) - 1) * around + np.arange(around)
    triangles = np.concatenate([grid(len(angles), around, closed=True), fan(last, len(points) - 1)])
    return Piece("eye_right", points, triangles, colours)


def _under_lids(character: Character, points: Array, white: NDArray[np.bool_]) -> Array:
    """(n, 3) what the lids leave of the light; and red in the corners."""
    lid = Lid(character.eyes)
    across, place = lid.place(points)
    ahead = (points - np.array(character.eyes.centre))[:, 2] > 0
    shade = 0.55 * smoothstep(0.55, 1.05, place) + 0.22 * smoothstep(0.22, -0.1, place)
    shade = shade + 0.25 * smoothstep(0.6, 1.05, np.abs(across))
    free = (1 - np.where(ahead, shade, 0.3).clip(0, 0.75))[:, None] ** np.array([0.9, 1.05, 1.05])
    red = np.where(ahead & white, 0.8 * smoothstep(-0.72, -0.98, across) + 0.3 * smoothstep(0.75, 1.0, across), 0.0)
    red = red * smoothstep(1.2, 1.0, np.abs(across)) * smoothstep(-0.4, -0.1, place) * smoothstep(1.4, 1.1, place)
    left: Array = free * (1 - red[:, None] * np.array([0.08, 0.55, 0.5]))
    return left


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
