"""The skin: face, lips, lids and the inside of the mouth in one seamless mesh, in every pose."""

from __future__ import annotations

import numpy as np

from core_pipeline.faces.sculpt.character import Character, MouthPose
from core_pipeline.faces.sculpt.complexion import beard, uneven
from core_pipeline.faces.sculpt.fields import SmoothField
from core_pipeline.faces.sculpt.layout import Layout, lay_out
from core_pipeline.faces.sculpt.lids import COLUMNS, LID, REACH, Lid
from core_pipeline.faces.sculpt.mouth import BAG_RINGS, PROFILE, RINGS, Lips
from core_pipeline.faces.sculpt.piece import Piece, Triangles, fan, grid, linear, turn
from core_pipeline.faces.sculpt.sdf import Array, Solid, smoothstep

# sizes of the almonds round the eye: on the flat map; and (radius, size) of the lid's band inside the first of them
EYE_RINGS = (1.14, 1.24, 1.36, 1.52, 1.74)
BAND = ((LID, 1.065), (LID, 1.0), (1.035, 0.985), (0.94, 0.99))
CREASE = 1.36  # where the upper lid folds, as a size of the almond
EDGE = 1  # the row of the band that is the lid's edge


class Skin:
    """Builds the skin of one character: `piece()` is the mesh with all its poses."""

    def __init__(self, character: Character, clay: Solid, lips: Lips) -> None:
        self.character, self.clay, self.lips = character, clay, lips
        self.lid = Lid(character.eyes)
        self._middle = np.array(character.middle)
        forward = lips.centre - self._middle
        forward /= np.linalg.norm(forward)
        self._axes = np.array([(1.0, 0.0, 0.0), np.cross(forward, (1.0, 0.0, 0.0)), forward])
        self.layout = self._lay_out()
        self._ratio = self._eye_ratio()
        self.face = self._shape()
        self._number()

    def _to_map(self, points: Array) -> Array:
        away = (points - self._middle) @ self._axes.T
        away /= np.linalg.norm(away, axis=-1, keepdims=True)
        across = np.maximum(np.linalg.norm(away[..., :2], axis=-1, keepdims=True), 1e-12)
        flat: Array = away[..., :2] / across * np.arccos(np.clip(away[..., 2:], -1, 1))
        return flat

    def _directions(self, flat: Array) -> Array:
        angle = np.linalg.norm(flat, axis=-1, keepdims=True)
        across = flat / np.maximum(angle, 1e-12)
        directions: Array = np.concatenate([across * np.sin(angle), np.cos(angle)], -1) @ self._axes
        return directions

    def _lay_out(self) -> Layout:
        steps = 2 * np.pi * np.arange(COLUMNS) / COLUMNS
        rings = []
        for number, size in enumerate(EYE_RINGS):
            loop = self._to_map(self.lid.edge(steps + (number % 2) * np.pi / COLUMNS, size=EYE_RINGS[0]))
            grow = size / EYE_RINGS[0] * np.ones(2)
            grow[1] += self.character.eyes.spread * (grow[1] - 1)
            rings.append(loop.mean(0) + grow * (loop - loop.mean(0)))
        border = self._to_map(self.lips.rest[-1])
        self._eye_loop = rings[0]
        eye = rings[0].mean(0)
        nose = self._to_map(np.array(self.character.nose))

        def spacing(flat: Array) -> Array:
            lips = np.min(np.linalg.norm(flat[:, None] - border[None], axis=-1), axis=1)
            lids = np.maximum(np.linalg.norm(flat - eye, axis=1) - 0.5, 0)
            tip = np.maximum(np.linalg.norm(flat - nose, axis=1) - 0.16, 0)
            near: Array = np.minimum.reduce([0.045 + 0.10 * lips, 0.075 + 0.16 * lids, 0.034 + 0.20 * tip])
            return np.clip(near, 0, 0.24) / self.character.density

        return lay_out(border, rings, spacing)

    def _shape(self) -> Array:
        """Positions of the layout's points: cast on the clay, then evened out where the map was stretched."""
        flat = self.layout.points
        directions = self._directions(flat)
        points = self.clay.cast(np.broadcast_to(self._middle, directions.shape), directions)
        points[self.layout.border] = self.lips.rest[-1]
        steps = 2 * np.pi * np.arange(COLUMNS) / COLUMNS
        edge = self.lid.edge(steps, size=EYE_RINGS[0])
        points[self.layout.eyes[0]], points[self.layout.eyes[1]] = edge, edge * (-1, 1, 1)
        fixed = np.zeros(len(flat), bool)
        fixed[self.layout.border] = True
        for eye in self.layout.eyes:
            fixed[eye] = True
        fixed |= (np.linalg.norm(flat, axis=1) > 2.2) | (self._ratio < 1.45)
        for _ in range(12):
            moved = points + 0.5 * (self.layout.neighbour_mean(points) - points)
            points = np.where(fixed[:, None], points, self.clay.project(moved, 2))
        points[flat[:, 0] == 0.0, 0] = 0.0
        self._nape = self.clay.cast(self._middle[None], -self._axes[2:])
        return self._round_lids(points)

    def _round_lids(self, points: Array) -> Array:
        """The lids lie on a ball close around the eye; from there they run out into the face."""
        centre = self.lid.centre * np.where(points[:, :1] < 0, (-1, 1, 1), (1, 1, 1))
        away = points - centre
        ball = centre + away * (LID * self.character.eyes.radius / np.linalg.norm(away, axis=1, keepdims=True))
        share = smoothstep(1.5, EYE_RINGS[0], self._ratio)[:, None]
        points = points + share * (ball - points)
        # the crease between lid and face is softer than the clay's
        loose = (self._ratio > EYE_RINGS[0] + 0.01) * smoothstep(2.3, 1.5, self._ratio)
        x, y, _ = points.T
        height = y - self.lid.centre[1]
        # the brows lie on the clay as it is
        line = np.array(self.character.brows.line)
        loose = loose * smoothstep(-0.01, -0.08, height - np.interp(np.abs(x), line[:, 0], line[:, 1]))
        bridge = smoothstep(0.14, 0.0, np.abs(x)) * smoothstep(0.18, 0.02, height)
        # where the bridge of the nose runs out between them
        between = np.exp(-((x / 0.055) ** 2) - ((height - 0.20) / 0.09) ** 2)
        pull = (0.5 * np.maximum(loose * (1 - 0.75 * bridge), 0.8 * between))[:, None]
        for _ in range(40):
            points = points + pull * (self.layout.neighbour_mean(points) - points)
        depth = 0.085 * self.character.eyes.crease * self.character.eyes.radius * self._crease(points)
        away = points - centre
        creased: Array = points - away * (depth / np.linalg.norm(away, axis=1))[:, None]
        return creased

    def _crease(self, points: Array) -> Array:
        """(layout points,) 1 in the fold above the upper lid."""
        height = points[:, 1] - self.lid.centre[1]
        across = np.abs(np.abs(points[:, 0]) - self.lid.centre[0]) / self.character.eyes.radius
        # it follows a ring of the mesh; above the eye the rings lie farther apart
        ring = EYE_RINGS[0] + (1 + self.character.eyes.spread) * (CREASE - EYE_RINGS[0])
        fold: Array = np.exp(-(((self._ratio - ring) / 0.18) ** 2)) * smoothstep(0.0, 0.05, height)
        return self._smoothed(fold * smoothstep(1.15, 0.7, across))

    def _smoothed(self, values: Array) -> Array:
        """(layout points,) values without the grain of the mesh."""
        for _ in range(4):
            values = (values + self.layout.neighbour_mean(values[:, None])[:, 0]) / 2
        return values

    def _number(self) -> None:
        """Vertex numbers of the whole: bag (deepest first), lips, throat's end, face, its nape, rims of the lids."""
        columns = self.character.lip_columns
        rows = BAG_RINGS + RINGS
        inner = rows * columns + 1
        self._face_number = np.full(len(self.layout.points), -1)
        self._face_number[self.layout.border] = (rows - 1) * columns + np.arange(columns)
        rest = self._face_number < 0
        self._face_number[rest] = inner + np.arange(rest.sum())
        self._face_own = rest
        tube = grid(rows, columns, closed=True)[:, ::-1]
        throat = fan(np.arange(columns), inner - 1)
        face = self._face_number[self.layout.triangles]
        nape = inner + int(rest.sum())
        face = np.concatenate([face, fan(self._face_number[self.layout.rim], nape)])
        rims = self._rim_triangles(nape + 1)
        per_row = 2 * columns
        # the lattice's triangles come in two halves; sort them by row so that each part is one range
        by_row = np.argsort(np.tile(np.repeat(np.arange(rows - 1), columns), 2), kind="stable")
        tube = tube[by_row]
        self.triangles: Triangles = np.concatenate([throat, tube, face, rims])
        mouth, lips = len(throat) + (BAG_RINGS + 2) * per_row, len(throat) + len(tube)
        self.ranges = {
            "mouth": (0, mouth),
            "lips": (mouth, lips - mouth),
            "skin": (lips, len(face)),
            "lid_rims": (lips + len(face), len(rims)),
        }

    def _rim_triangles(self, start: int) -> Triangles:
        rims = []
        for side, eye in enumerate(self.layout.eyes):
            own = start + side * len(BAND) * COLUMNS + np.arange(len(BAND) * COLUMNS).reshape(len(BAND), COLUMNS)
            lattice = np.concatenate([self._face_number[eye][None], own])
            triangles = lattice.ravel()[grid(len(BAND) + 1, COLUMNS, closed=True)]
            rims.append(triangles if side == 0 else triangles[:, ::-1])
        return np.concatenate(rims)

    def _eye_ratio(self) -> Array:
        """(layout points,) distance from the nearer eye's middle over the lid edge's, on the map."""
        middle = self._eye_loop.mean(0)
        loop = self._eye_loop - middle
        flat = np.abs(self.layout.points * (1, 0)) + self.layout.points * (0, 1) - middle
        around, size = np.arctan2(loop[:, 1], loop[:, 0]), np.linalg.norm(loop, axis=1)
        order = np.argsort(around)
        edge = np.interp(np.arctan2(flat[:, 1], flat[:, 0]), around[order], size[order], period=2 * np.pi)
        ratio: Array = EYE_RINGS[0] * np.linalg.norm(flat, axis=1) / edge
        return ratio

    def piece(self) -> Piece:
        """The mesh, its colours and its poses."""
        self._prepare_fields()
        poses = {name: self._posed(pose) for name, pose in self.character.poses.items()}
        face = self.face
        poses["blink"] = self._whole(self.lips.rest, self.lips.bag(), self._blink(face), closed=True)
        poses["browUp"] = self._whole(self.lips.rest, self.lips.bag(), self._brow_up(face), closed=False)
        rest = self._whole(self.lips.rest, self.lips.bag(), face, closed=False)
        return Piece("skin", rest, self.triangles, self._colours(rest), poses, self.ranges)

    def _prepare_fields(self) -> None:
        points, mouth = self.face, self.character.mouth
        border = points[self.layout.border]
        away = np.min(np.linalg.norm(points[:, None] - border[None], axis=-1), axis=1)
        on_border = np.zeros(len(points), bool)
        on_border[self.layout.border] = True
        nose = np.linalg.norm(points - np.array(self.character.nose), axis=1) < 0.15
        still = nose | (self._ratio < 1.5)
        self._move = SmoothField(points, self.layout.triangles, on_border | still | (away > 0.60))
        share = smoothstep(mouth.height + 0.32, mouth.height - 0.34, points[:, 1]) * smoothstep(
            -0.55, 0.30, points[:, 2]
        )
        share[self.layout.border] = self.lips.jaw_share
        jaw = SmoothField(points, self.layout.triangles, on_border | still | (away > 0.40))
        self._jaw = np.clip(jaw.spread(np.where(still, 0, share)[:, None]), 0, 1)

    def _posed(self, pose: MouthPose) -> Array:
        lips = self.lips.build(pose)
        moved = np.zeros_like(self.face)
        moved[self.layout.border] = lips[-1] - self.lips.rest[-1]
        face = self.face + self._move.spread(moved)
        if pose.cheeks:
            x, y, z = self.face.T
            bump = np.exp(-(((np.abs(x) - 0.50) / 0.20) ** 2) - ((y + 0.24) / 0.17) ** 2) * smoothstep(0.1, 0.4, z)
            face = face + (pose.cheeks * bump * smoothstep(1.0, 1.6, self._ratio))[:, None] * (
                np.sign(x)[:, None] * (0.5, 0, 0) + (0, 0.6, 0.5)
            )
        face = face + self._jaw * (turn(face, self.character.mouth.hinge, pose.jaw) - face)
        return self._whole(*self.lips.posed(pose), face, closed=False)

    def _whole(self, lips: Array, bag: Array, face: Array, *, closed: bool) -> Array:
        end = bag[-1].mean(0)
        inner = np.concatenate([bag[::-1].reshape(-1, 3), lips.reshape(-1, 3), end[None]])
        return np.concatenate([inner, face[self._face_own], self._nape, *self._rims(closed=closed)])

    def _rims(self, *, closed: bool) -> list[Array]:
        angle = 2 * np.pi * np.arange(COLUMNS) / COLUMNS
        rows = [self.lid.edge(angle, radius, size) for radius, size in BAND]
        if closed:
            # what lies behind the edge moves as the edge does
            sizes = [max(size, 1.0) for _, size in BAND]
            fronts = [self.lid.edge(angle, size=size) for size in sizes]
            shares = [self.lid.share(np.full(COLUMNS, size)) for size in sizes]
            rows = [
                row + self.lid.close(front, share) - front
                for row, front, share in zip(rows, fronts, shares, strict=True)
            ]
        right = np.concatenate(rows)
        return [right, right * (-1, 1, 1)]

    def _blink(self, face: Array) -> Array:
        near = self._ratio < REACH
        right = face * np.where(face[:, :1] < 0, (-1, 1, 1), (1, 1, 1))
        closed = self.lid.close(right[near], self.lid.share(self._ratio[near]))
        moved = np.zeros_like(face)
        moved[near] = closed * np.where(face[near, :1] < 0, (-1, 1, 1), (1, 1, 1)) - face[near]
        # away from the edge the skin follows as a whole: each ray of the mesh on its own would show as a pleat
        loose = (0.6 * smoothstep(1.05, 1.35, self._ratio) * (self._ratio < REACH + 0.6))[:, None]
        for _ in range(16):
            moved = moved + loose * (self.layout.neighbour_mean(moved) - moved)
        return face + moved

    def _brow_up(self, face: Array) -> Array:
        eyes = self.character.eyes
        x, y, z = face.T
        height = y - eyes.centre[1]
        share = np.exp(-(((np.abs(x) - eyes.centre[0]) / 0.36) ** 2) - ((height - 0.46) / 0.20) ** 2)
        share *= smoothstep(1.0, 1.5, self._ratio) * smoothstep(-0.2, 0.3, z)
        lifted = self.clay.project(face + (0, self.character.brows.lift, 0) * share[:, None])
        raised: Array = face + share[:, None] * (lifted - face)
        return raised

    def _colours(self, rest: Array) -> Array:
        palette, columns = self.character.palette, self.character.lip_columns
        colours = np.tile(np.append(linear(palette.skin), 0.35), (len(rest), 1))
        lattice = colours[: (BAG_RINGS + RINGS) * columns].reshape(BAG_RINGS + RINGS, columns, 4)
        tones = self._tones()
        v, n = PROFILE[:, 0, None], PROFILE[:, 1, None]
        outer = np.where(n > -0.5, smoothstep(1.16, 0.84, v), 1.0) * np.ones(columns)
        inner = smoothstep(-0.1, -1.3, n) * np.ones(columns)
        lip = lattice[BAG_RINGS:]
        lip[..., :3] = tones[self.layout.border]
        lip[..., :3] += outer[..., None] * (linear(palette.lip) - lip[..., :3])
        lip[..., :3] += inner[..., None] * (linear(palette.inner_lip) - lip[..., :3])
        lip[..., 3] += (0.55 - 0.35) * outer
        # lips are darker where they meet and towards the corners, the upper one in its own shade; and finely lined
        lined = 0.04 * np.sin(2.7 * np.arange(columns)) + 0.30 * smoothstep(0.45, 0.0, v)
        lined = lined + 0.25 * (1 - self.lips.middle) ** 3 + 0.12 * self.lips.upper
        lip[..., :3] *= 1 - palette.variation * (outer * lined)[..., None]
        depth = np.linspace(1, 0.1, BAG_RINGS)[:, None, None]
        lattice[:BAG_RINGS, :, :3] = linear(palette.throat) * depth + linear(palette.inner_lip) * 0.7 * (1 - depth)
        lattice[:BAG_RINGS, :, 3] = 0.2
        first = (BAG_RINGS + RINGS) * columns
        colours[first] = np.append(linear(palette.throat), 0.1)
        last = first + 1 + int(self._face_own.sum())
        colours[first + 1 : last, :3] = tones[self._face_own]
        colours[last, :3] = tones[self.layout.rim].mean(0)
        colours[last + 1 :, :3] = np.tile(self._rim_tones(tones), (2, 1))
        return colours

    def _rim_tones(self, tones: Array) -> Array:
        """(band · columns, 3) of a lid's rim: the colour of the lashes above, of the lid below."""
        palette = self.character.palette
        angle = 2 * np.pi * np.arange(COLUMNS) / COLUMNS
        upper = smoothstep(-0.15, 0.25, np.sin(angle)) * self.character.eyes.lash
        edge = linear(palette.lid) * 0.85 + upper[:, None] * (linear(palette.lash) - linear(palette.lid) * 0.85)
        outer = tones[self.layout.eyes[0]]
        outer = outer + 0.5 * (linear(palette.lid) - outer)
        return np.concatenate([outer, *[edge] * (len(BAND) - EDGE)])

    def _tones(self) -> Array:
        """(layout points, 3) the colours of the face."""
        palette, points = self.character.palette, self.face
        x, y, z = points.T
        tone = np.tile(linear(palette.skin), (len(points), 1))
        cheek = np.exp(-(((np.abs(x) - 0.50) / 0.19) ** 2) - ((y + 0.20) / 0.15) ** 2) * smoothstep(0.1, 0.4, z)
        nose = np.exp(-(np.linalg.norm(points - np.array(self.character.nose), axis=1) ** 2) / 0.12**2)
        warm = np.clip(0.40 * cheek + 0.30 * nose, 0, 1)[:, None]
        tone += warm * (linear(palette.blush) - tone)
        if palette.stubble:
            tone += palette.stubble * beard(self.character, points)[:, None] * (linear(palette.brow) - tone)
        tone += palette.variation * uneven(self.character, points, tone)
        lid = smoothstep(1.45, 1.1, self._ratio)[:, None]
        tone += 0.7 * lid * (linear(palette.lid) - tone)
        free = self._smoothed(self.clay.occlusion(points, self.clay.gradient(points)))
        tone *= (0.74 + 0.26 * smoothstep(0.15, 0.75, free))[:, None] ** np.array([0.8, 1.1, 1.2])
        fold = 0.55 * self.character.eyes.crease * self._crease(points)
        tone *= (1 - fold)[:, None] ** np.array([0.6, 1.0, 1.1])
        if self.character.nostrils is not None:
            away = np.linalg.norm(
                np.abs(points * (1, 0, 0)) + points * (0, 1, 1) - np.array(self.character.nostrils), axis=1
            )
            tone *= (1 - 0.93 * np.exp(-((away / 0.031) ** 2)))[:, None] ** np.array([0.75, 1.1, 1.1])
        return tone
