"""Teeth and gums: a rounded section swept along a horseshoe, scalloped into single teeth."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from core_pipeline.faces.sculpt.character import Character, MouthPose
from core_pipeline.faces.sculpt.piece import Piece, Triangles, grid, linear, turn
from core_pipeline.faces.sculpt.sdf import Array, smoothstep

# where on a tooth its vertices lie: the gaps are narrow, its front is broad
ON_TOOTH = np.array([0.0, 0.13, 0.87])
# (across the row: −1 tongue side … 1 lip side; along the tooth: 0 at the gum, 1 at the edge)
TOOTH = np.array([(0.95, -0.15), (1.06, 0.35), (0.98, 0.76), (0.68, 0.96), (0.10, 1.0), (-0.70, 0.75), (-0.9, -0.15)])
GUM = np.array([(-0.2, -0.6), (0.8, -0.36), (1.15, 0.03), (0.9, 0.16), (-0.9, 0.16), (-1.4, -0.5)])


def teeth(character: Character, centre: Array) -> list[Piece]:
    """Upper and lower teeth and gums; `centre` is the middle of the mouth."""
    pieces = []
    for upper in (True, False):
        row = _Row(character, centre, upper=upper)
        where = "upper" if upper else "lower"
        for name, section in ((f"teeth_{where}", TOOTH), (f"gums_{where}", GUM)):
            points, triangles = row.sweep(section, is_tooth=section is TOOTH)
            colours = row.colours(points, is_tooth=section is TOOTH)
            poses = {pose: row.moved(points, shape) for pose, shape in character.poses.items()}
            pieces.append(Piece(name, points, triangles, colours, poses))
    return pieces


class _Row:
    def __init__(self, character: Character, centre: Array, *, upper: bool) -> None:
        self.character, self.centre, self.upper = character, centre, upper
        size = character.teeth
        widths = np.array(
            [1.25 if upper else 0.8, 1.0 if upper else 0.85, 0.95, 1.0, 1.0, 1.3, 1.3, 1.3][: size.per_side]
        )
        ends = np.concatenate([[0], np.cumsum(widths)]) / widths.sum()
        fine = np.concatenate([a + (b - a) * ON_TOOTH for a, b in pairwise(ends)])
        half = np.append(fine, 1.0)
        self.along = np.concatenate([-half[::-1], half[1:]])
        inside = np.searchsorted(ends, np.abs(self.along).clip(0, 1 - 1e-9), side="right") - 1
        middle, reach = (ends[inside] + ends[inside + 1]) / 2, (ends[inside + 1] - ends[inside]) / 2
        self.from_middle = np.abs((np.abs(self.along) - middle) / reach).clip(0, 1)

    def _arch(self) -> tuple[Array, Array]:
        """Points (x, z) of the horseshoe relative to its front, and outward directions."""
        size = self.character.teeth
        fine = np.linspace(-2.0, 2.0, 400)
        x = size.half_width * (1 - 0.0 if self.upper else 0.94) * np.sin(np.clip(fine, -np.pi / 2, np.pi / 2))
        z = (
            np.where(np.abs(fine) < np.pi / 2, np.cos(fine) - 1, -1 - 0.8 * (np.abs(fine) - np.pi / 2))
            * size.depth
            * 0.72
        )
        length = np.concatenate([[0], np.cumsum(np.hypot(np.diff(x), np.diff(z)))])
        share = (self.along + 1) / 2 * length[-1]
        x, z = np.interp(share, length, x), np.interp(share, length, z)
        dx, dz = np.gradient(x), np.gradient(z)
        out = np.stack([-dz, dx], -1)
        return np.stack([x, z], -1), out / np.linalg.norm(out, axis=1, keepdims=True)

    def sweep(self, section: Array, *, is_tooth: bool) -> tuple[Array, Triangles]:
        size = self.character.teeth
        arch, out = self._arch()
        height = size.upper_height if self.upper else size.lower_height
        # a gap is a groove on the lip side and a notch in the edge; teeth get lower towards the back
        gap = (
            smoothstep(0.72, 1.0, self.from_middle)[:, None]
            if is_tooth
            else 0.6 * smoothstep(0.3, 1.0, self.from_middle)[:, None]
        )
        # (the lower ones more, and they sink: where the jaw opens a little they would stand up beside the tongue)
        lower_back = 1 - (0.30 if self.upper else 0.55) * np.abs(self.along[:, None]) ** 1.5
        across = section[:, 0] * size.thickness
        down = section[:, 1]
        if is_tooth:
            across = across - 0.30 * size.thickness * gap * (section[:, 0] > 0)
            down = down - 0.07 * gap * smoothstep(0.5, 0.9, down) - 0.03 * self.from_middle[:, None] ** 4 * (down > 0.8)
        else:
            across = across + 0 * gap
            down = down + 0.10 * gap * (section[:, 1] > 0)
        sign = -1.0 if self.upper else 1.0
        edge = size.edge if self.upper else size.edge - 0.006
        y = edge + sign * height * lower_back * (down - 1)
        if not self.upper:
            y = y - 0.02 * (1 - lower_back) - size.sink * smoothstep(0.1, 0.55, np.abs(self.along[:, None]))
        back = size.behind_lips + (0 if self.upper else size.bite)
        x = arch[:, :1] + out[:, :1] * across
        z = arch[:, 1:] + out[:, 1:] * across - back - size.thickness
        # the upper row follows the lips' smile
        mouth = self.character.mouth
        y = y + (0.8 if self.upper else 0.15) * mouth.smile * np.clip(x / mouth.half_width, -1, 1) ** 2
        points = np.stack([x, y, z], -1).reshape(-1, 3) + self.centre
        triangles = grid(len(self.along), len(section), closed=False)
        ends = []
        for row, order in ((0, 1), (len(self.along) - 1, -1)):
            first = row * len(section)
            ends += [(first, first + i, first + i + 1)[::order] for i in range(1, len(section) - 1)]
        triangles = np.concatenate([triangles, np.array(ends)])
        return points, triangles if self.upper else triangles[:, ::-1]

    def colours(self, points: Array, *, is_tooth: bool) -> Array:
        palette = self.character.palette
        base = linear(palette.teeth if is_tooth else palette.gums)
        depth = self.centre[2] - points[:, 2]
        shade = 1 - 0.9 * smoothstep(0.10, 0.33, depth)
        if is_tooth:
            # warmer towards the gum, and towards the back
            warm = 0.16 * np.tile(1 - TOOTH[:, 1].clip(0, 1), len(self.along))
            warm = warm + 0.14 * np.repeat(np.abs(self.along), len(TOOTH))
            # the tongue's side lies in the mouth's own shade, most of all far back
            inside = smoothstep(0.4, -0.6, np.tile(TOOTH[:, 0], len(self.along)))
            shade = shade * (1 - (0.35 + 0.4 * np.repeat(np.abs(self.along), len(TOOTH))) * inside)
            base = base * (1 - palette.variation * warm[:, None] * np.array([0.35, 0.75, 1.6]))
            shade = shade * (1 - 0.34 * np.repeat(smoothstep(0.8, 1.0, self.from_middle), len(TOOTH)))
        # what lies in the dark is warm, and does not shine
        tone = base * shade[:, None] ** np.array([0.85, 1.05, 1.15])
        return np.column_stack([tone, (0.85 if is_tooth else 0.6) * shade])

    def moved(self, points: Array, pose: MouthPose) -> Array:
        up, forward = pose.upper_teeth if self.upper else pose.lower_teeth
        shifted = points + np.array([0, up, forward])
        return shifted if self.upper else turn(shifted, self.character.mouth.hinge, pose.jaw)
