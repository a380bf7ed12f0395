"""The crab's shell: carapace, face, lips and the inside of the mouth in one mesh, in every pose.

Much like the skin of a head, but without lids: the crab's eyes stand on stalks. The back is closed.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from core_pipeline.faces.sculpt.character import MouthPose
from core_pipeline.faces.sculpt.crab_body import Crab
from core_pipeline.faces.sculpt.fields import SmoothField
from core_pipeline.faces.sculpt.layout import RIM, lay_out
from core_pipeline.faces.sculpt.mouth import BAG_RINGS, PROFILE, RINGS, Lips
from core_pipeline.faces.sculpt.piece import Piece, Triangles, fan, grid, linear, turn
from core_pipeline.faces.sculpt.sdf import Array, Solid, smoothstep

# half the width of the line where the brim's colours meet
BRIM = 0.012


class Shell:
    """Builds the shell: `piece()` is the mesh with all its poses."""

    def __init__(self, crab: Crab, clay: Solid, lips: Lips) -> None:
        self.crab, self.clay, self.lips = crab, clay, lips
        self._middle = np.array(crab.middle)
        forward = lips.centre - self._middle
        forward /= np.linalg.norm(forward)
        self._axes = np.array([(1.0, 0.0, 0.0), np.cross(forward, (1.0, 0.0, 0.0)), forward])
        border = self._to_map(lips.rest[-1])
        brim = self._brim()

        def spacing(flat: Array) -> Array:
            lips = np.min(np.linalg.norm(flat[:, None] - border[None], axis=-1), axis=1)
            away = np.linalg.norm(flat, axis=1)
            near: Array = np.minimum(0.045 + 0.10 * lips, 0.115 + 0.12 * np.clip(away - 1.6, 0, 1))
            return near

        self.layout = lay_out(border, [np.empty((0, 2)), *brim], spacing)
        self.face = self._shape(np.concatenate(brim))
        self._number()
        self._prepare_fields()

    def _to_map(self, points: Array) -> Array:
        away = (points - self._middle) @ self._axes.T
        away /= np.linalg.norm(away, axis=-1, keepdims=True)
        across = np.maximum(np.linalg.norm(away[..., :2], axis=-1, keepdims=True), 1e-12)
        flat: Array = away[..., :2] / across * np.arccos(np.clip(away[..., 2:], -1, 1))
        return flat

    def _brim(self) -> list[Array]:
        """Two lines of the right half's map, on both sides of the brim: its colours meet sharply."""
        towards = np.linspace(0, np.pi - 0.06, 64)
        lines = []
        for height in (self.crab.brim + BRIM, self.crab.brim - BRIM):
            level = np.broadcast_to((0.0, height, 0.0), (len(towards), 3))
            line = self._to_map(self.clay.cast(level, np.stack([np.sin(towards), 0 * towards, np.cos(towards)], -1)))
            steps = np.append(0, np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1)))
            even = np.linspace(0, steps[-1], int(steps[-1] / 0.09))
            line = np.stack([np.interp(even, steps, line[:, i]) for i in range(2)], -1)
            line[0, 0] = 0.0
            lines.append(line[np.linalg.norm(line, axis=1) < RIM - 0.15])
        return lines

    def _shape(self, brim: Array) -> Array:
        """Positions of the layout's points: cast on the clay, then evened out where the map was stretched."""
        flat = self.layout.points
        angle = np.linalg.norm(flat, axis=-1, keepdims=True)
        across = flat / np.maximum(angle, 1e-12)
        directions = np.concatenate([across * np.sin(angle), np.cos(angle)], -1) @ self._axes
        points = self.clay.cast(np.broadcast_to(self._middle, directions.shape), directions)
        points[self.layout.border] = self.lips.rest[-1]
        fixed = angle[:, 0] > 2.2
        fixed[self.layout.border] = True
        fixed |= cKDTree(brim).query(np.abs(flat) * (1, 0) + flat * (0, 1))[0] < 1e-9
        for _ in range(12):
            moved = points + 0.5 * (self.layout.neighbour_mean(points) - points)
            points = np.where(fixed[:, None], points, self.clay.project(moved, 2))
        points[flat[:, 0] == 0.0, 0] = 0.0
        self._back = self.clay.cast(self._middle[None], -self._axes[2:])[0]
        return points

    def _number(self) -> None:
        """Vertex numbers of the whole: bag (deepest first), lips, the end of the throat, the shell, its back."""
        columns, rows = self.crab.lip_columns, BAG_RINGS + RINGS
        inner = rows * columns + 1
        number = np.full(len(self.layout.points), -1)
        number[self.layout.border] = (rows - 1) * columns + np.arange(columns)
        self._own: NDArray[np.bool_] = number < 0
        number[self._own] = inner + np.arange(self._own.sum())
        tube = grid(rows, columns, closed=True)[:, ::-1]
        # the lattice's triangles come in two halves; sort them by row so that each part is one range
        tube = tube[np.argsort(np.tile(np.repeat(np.arange(rows - 1), columns), 2), kind="stable")]
        throat = fan(np.arange(columns), inner - 1)
        back = fan(number[self.layout.rim], inner + int(self._own.sum()))
        shell = np.concatenate([number[self.layout.triangles], back])
        self.triangles: Triangles = np.concatenate([throat, tube, shell])
        mouth, lips = len(throat) + (BAG_RINGS + 2) * 2 * columns, len(throat) + len(tube)
        self.ranges = {"mouth": (0, mouth), "lips": (mouth, lips - mouth), "skin": (lips, len(shell))}

    def _prepare_fields(self) -> None:
        points, mouth = self.face, self.crab.mouth
        border = points[self.layout.border]
        away = np.min(np.linalg.norm(points[:, None] - border[None], axis=-1), axis=1)
        on_border = np.zeros(len(points), bool)
        on_border[self.layout.border] = True
        # nothing moves above the brim of the carapace
        still = (away > 0.55) | (points[:, 1] > self.crab.brim)
        self._move = SmoothField(points, self.layout.triangles, on_border | still)
        x, y, z = points.T
        share = smoothstep(mouth.height + 0.25, mouth.height - 0.28, y) * smoothstep(-0.35, 0.35, z)
        share *= smoothstep(1.0, 0.62, np.abs(x))
        share[self.layout.border] = self.lips.jaw_share
        jaw = SmoothField(points, self.layout.triangles, on_border | (away > 0.34) | (y > self.crab.brim))
        self._jaw = np.clip(jaw.spread(share[:, None]), 0, 1)

    def piece(self) -> Piece:
        """The mesh, its colours and its poses."""
        poses = {name: self._posed(pose) for name, pose in self.crab.poses.items()}
        rest = self._whole(self.lips.rest, self.lips.bag(), self.face)
        return Piece("skin", rest, self.triangles, self._colours(rest), poses, self.ranges)

    def _posed(self, pose: MouthPose) -> Array:
        moved = np.zeros_like(self.face)
        moved[self.layout.border] = self.lips.build(pose)[-1] - self.lips.rest[-1]
        face = self.face + self._move.spread(moved)
        x, y, z = self.face.T
        mouth = self.crab.mouth
        bump = np.exp(-(((np.abs(x) - mouth.half_width - 0.10) / 0.15) ** 2) - ((y - mouth.height - 0.10) / 0.14) ** 2)
        puffed = (pose.cheeks * bump * smoothstep(0.0, 0.3, z))[:, None]
        puffed[self.layout.border] = 0
        face = face + puffed * (np.sign(x)[:, None] * (0.4, 0, 0) + (0, 0.4, 0.8))
        face = face + self._jaw * (turn(face, mouth.hinge, pose.jaw) - face)
        return self._whole(*self.lips.posed(pose), face)

    def _whole(self, lips: Array, bag: Array, face: Array) -> Array:
        inner = np.concatenate([bag[::-1].reshape(-1, 3), lips.reshape(-1, 3), bag[-1].mean(0)[None]])
        return np.concatenate([inner, face[self._own], self._back[None]])

    def _colours(self, rest: Array) -> Array:
        palette, columns = self.crab.palette, self.crab.lip_columns
        colours = np.tile(np.append(linear(palette.skin), 0.5), (len(rest), 1))
        inner = (BAG_RINGS + RINGS) * columns
        tones = self._tones(np.concatenate([self.face, rest[-1:]]))
        colours[inner + 1 :, :3] = tones[np.append(self._own, True)]
        lattice = colours[:inner].reshape(BAG_RINGS + RINGS, columns, 4)
        v, n = PROFILE[:, 0, None], PROFILE[:, 1, None]
        lip = lattice[BAG_RINGS:]
        lip[..., :3] = tones[self.layout.border]
        outer = (np.where(n > -0.5, smoothstep(1.14, 0.84, v), 1.0) * np.ones(columns))[..., None]
        hidden = (smoothstep(-0.1, -1.3, n) * np.ones(columns))[..., None]
        lip[..., :3] += outer * (linear(palette.lip) - lip[..., :3])
        lip[..., :3] += hidden * (linear(palette.inner_lip) - lip[..., :3])
        lip[..., 3:] += 0.12 * outer
        depth = np.linspace(1, 0.1, BAG_RINGS)[:, None, None]
        lattice[:BAG_RINGS, :, :3] = linear(palette.throat) * depth + linear(palette.inner_lip) * 0.7 * (1 - depth)
        lattice[:BAG_RINGS, :, 3] = 0.2
        colours[inner] = np.append(linear(palette.throat), 0.1)
        return colours

    def _tones(self, points: Array) -> Array:
        """(n, 3): red above the brim, orange below it, cream round the mouth and on the belly; darker in folds."""
        palette, mouth = self.crab.palette, self.crab.mouth
        x, y, z = points.T
        red, orange, cream = linear(palette.skin), linear(self.crab.side), linear(self.crab.belly)
        below = smoothstep(self.crab.brim + BRIM, self.crab.brim - BRIM, y)[:, None]
        tone = red + below * smoothstep(-0.6, -0.2, z)[:, None] * (orange - red)
        round_mouth = np.hypot(x / (mouth.half_width + 0.30), (y - mouth.height + 0.12) / 0.46)
        pale = (smoothstep(1.25, 0.55, round_mouth) * smoothstep(-0.1, 0.3, z))[:, None]
        tone = tone + pale * below * (cream - tone)
        blush = np.exp(-(((np.abs(x) - mouth.half_width - 0.17) / 0.11) ** 2) - ((y - mouth.height - 0.05) / 0.09) ** 2)
        tone = tone + (0.55 * blush * smoothstep(0.0, 0.3, z))[:, None] * (linear(palette.blush) - tone)
        free = self.clay.occlusion(points, self.clay.gradient(points), 0.22)
        shade: Array = tone * (0.55 + 0.45 * smoothstep(0.1, 0.8, free))[:, None] ** np.array([0.8, 1.1, 1.2])
        return shade
