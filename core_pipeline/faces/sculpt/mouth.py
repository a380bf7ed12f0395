"""Lips: one section profile swept round the mouth, and the bag of skin behind it.

Upper and lower lip share the line where they meet, so that a mouth that is shut is shut by construction.
A column of vertices is one section. Column 0 is the middle of the lower lip; they go anticlockwise seen from the front.
"""

from __future__ import annotations

import numpy as np

from core_pipeline.faces.sculpt.character import Character, MouthPose
from core_pipeline.faces.sculpt.piece import turn
from core_pipeline.faces.sculpt.sdf import Array, Solid, smoothstep

# (along the visible lip: 0 where the lips meet, 1 at its border; out of the face: 1 is the lip's fullest point)
PROFILE = np.array(
    [
        (1.40, -1.75),
        (1.00, -1.70),
        (0.40, -1.50),
        (0.08, -1.15),
        (0.00, -0.70),
        (0.00, -0.15),
        (0.09, 0.42),
        (0.28, 0.86),
        (0.52, 1.00),
        (0.78, 0.78),
        (1.00, 0.36),
        (1.20, 0.05),
    ]
)
RINGS = len(PROFILE)
MEET = (4, 5)
BAG_RINGS = 5


class Lips:
    """The lips of a character at rest and in its poses: arrays (RINGS, columns, 3)."""

    def __init__(self, character: Character, clay: Solid) -> None:
        self.character = character
        mouth = character.mouth
        columns = character.lip_columns
        even = 2 * np.pi * np.arange(columns) / columns - np.pi / 2
        # columns crowd at the corners of the mouth; this thins them out there
        angle = even + 0.16 * np.sin(2 * even)
        self.cos, self.sin = np.cos(angle), np.sin(angle)
        self.cos[np.abs(self.cos) < 1e-12] = 0.0
        self.sin[np.abs(self.sin) < 1e-12] = 0.0
        self.middle = np.abs(self.sin)
        self.upper = self.sin > 0
        self._clay = clay
        s = self.cos
        x, y = mouth.half_width * s, mouth.height + mouth.smile * s * s
        self.meeting = np.stack([x, y, clay.front(x, y)], -1)
        bow = 1 + mouth.bow * (0.10 * np.exp(-(((np.abs(s) - 0.27) / 0.13) ** 2)) - 0.22 * np.exp(-((s / 0.12) ** 2)))
        full = np.where(self.upper, mouth.upper * bow, mouth.lower)
        self.thickness = mouth.rim * (1 + 10 / 26 * (1 - self.middle) ** 8) + full * self.middle**mouth.taper
        self.depth = 0.012 + np.where(self.upper, mouth.upper_depth, mouth.lower_depth) * self.middle**0.8
        along = np.stack([s * (1 - self.middle) ** 2.4, self.sin, 0 * s], -1)
        self.along = along / np.linalg.norm(along, axis=-1, keepdims=True)
        normal = clay.gradient(self.meeting)
        out = 0.5 * normal + np.array([0, 0, 0.5])
        self.out = out / np.linalg.norm(out, axis=-1, keepdims=True)
        self._sag = self._follow_face()
        self.rest = self.build(MouthPose())
        self.centre = np.array([0.0, mouth.height, self.meeting[0, 2]])

    def _follow_face(self) -> Array:
        """How far in front of the meeting line the face lies at each vertex, (RINGS, columns)."""
        reach = np.clip(PROFILE[:, 0], 0, None)[:, None] * self.thickness
        x, y = (self.meeting[:, i] + reach * self.along[:, i] for i in (0, 1))
        visible = smoothstep(3, 7, np.arange(RINGS, dtype=float))[:, None]
        sag: Array = (self._clay.front(x, y) - self.meeting[:, 2]) * visible
        return sag

    @property
    def jaw_share(self) -> Array:
        """(columns,) how much of the jaw's turn each section takes part in."""
        corner, middle = self.character.mouth.corner_jaw, self.middle
        return np.where(self.upper, corner * (1 - middle) ** 1.5, corner + (1 - corner) * (1 - (1 - middle) ** 1.8))

    def shift(self, pose: MouthPose) -> Array:
        """(columns, 3) movement of the line where the lips meet, without the jaw."""
        mouth = self.character.mouth
        s, e = self.cos, self.middle
        moved = np.zeros((len(s), 3))
        moved[:, 0] = pose.width * self.meeting[:, 0]
        moved[:, 1] = np.where(self.upper, pose.raise_upper, -pose.drop_lower) * e**1.15 + pose.corners * s * s
        slide = pose.slide * e
        moved[:, 1] -= np.where(self.upper, slide, -slide) / 2
        moved[:, 1] += np.where(self.upper, 0, pose.tuck[0] * e**0.8)
        x, y = self.meeting[:, 0] + moved[:, 0], mouth.height + mouth.smile * s * s + pose.corners * s * s
        moved[:, 2] = self._clay.front(x, y) - self.meeting[:, 2]
        moved[:, 2] += pose.forward * e + pose.corner_forward * s * s
        moved[:, 2] += np.where(self.upper, slide, -slide) / 2
        moved[:, 2] -= np.where(self.upper, 0, pose.tuck[1] * e**0.7)
        if pose.rounded:
            hole = np.stack([pose.hole[0] * s, pose.hole[1] * self.sin, 0 * s], -1)
            centre = np.array([0.0, mouth.height, self.meeting[:, 2].max() + pose.forward])
            moved += pose.rounded * (hole + centre - self.meeting - moved)
        return moved

    def build(self, pose: MouthPose) -> Array:
        """(RINGS, columns, 3) without the jaw."""
        mouth = self.character.mouth
        v, n = PROFILE[:, 0, None], PROFILE[:, 1, None]
        v = v * (1 - mouth.inset * (1 - self.middle) ** 4 * smoothstep(-0.7, -1.3, n))
        thin = 1 + (pose.thick + np.where(self.upper, 0, pose.thick_lower)) * smoothstep(0, 0.6, self.middle)
        thickness, depth = self.thickness * thin, self.depth * (1 + 0.5 * pose.thick)
        along, out = self.along, self.out
        sag = self._sag
        if pose.rounded:
            ring = np.stack([self.cos, self.sin, 0 * self.cos], -1)
            along = along + pose.rounded * (ring - along)
            along = along / np.linalg.norm(along, axis=-1, keepdims=True)
            out = out + pose.rounded * (np.array([0, 0, 1.0]) - out)
            out = out / np.linalg.norm(out, axis=-1, keepdims=True)
            thickness = thickness + pose.rounded * (pose.ring - thickness)
            depth = depth + pose.rounded * (0.6 * pose.ring - depth)
            v = v * np.where(n < -0.6, 1 - 0.75 * pose.rounded, 1)
            sag = sag * (1 - pose.rounded) - pose.rounded * 0.55 * pose.ring * np.clip(v, 0, None) ** 2
        roll = np.where(self.upper, pose.roll_upper, pose.roll_lower) * smoothstep(0, 0.8, self.middle)
        # the lip's edge rolls most; its border to the face and the gum side hardly
        firm = np.where(n > 0, smoothstep(0.55, 1.2, PROFILE[:, 0, None]), smoothstep(-0.6, -1.4, n))
        turned = np.radians(roll * (1 - firm))
        c, s = np.cos(turned)[..., None], np.sin(turned)[..., None]
        frame_along, frame_out = along * c + out * s, out * c - along * s
        section = frame_along * (v * thickness)[..., None] + frame_out * (n * depth)[..., None]
        section[..., 2] += sag
        # the lips meet on a slope: the upper one laps over the lower
        section[..., 1] += mouth.lap * (1 - max(pose.rounded, pose.flat)) * self.middle * smoothstep(0.0, -0.85, n)
        built: Array = self.meeting + self.shift(pose) + section
        return built

    def bag(self) -> Array:
        """(BAG_RINGS, columns, 3) the inside of the mouth at rest, from just behind the lips to the throat."""
        wide, high, deep = self.character.mouth.bag
        inner = self.rest[0]
        rings = []
        for number in range(1, BAG_RINGS + 1):
            t = number / BAG_RINGS
            size = 1 - 0.5 * smoothstep(0.55, 1.0, t)
            x = wide * size * np.sign(self.cos) * np.abs(self.cos) ** 0.75
            y = self.centre[1] + high * size * np.sign(self.sin) * self.middle**0.5
            z = self.centre[2] - 0.16 - deep * t - 0.20 * np.abs(self.cos) ** 2.5 * (1 - t)
            goal = np.stack([x, y, z], -1)
            rings.append(inner + (goal - inner) * smoothstep(-0.35, 0.5, t))
        return np.array(rings)

    def bag_share(self) -> tuple[Array, Array]:
        """(BAG_RINGS, columns): how much the bag follows the lips' movement, and the jaw's."""
        t = np.arange(1, BAG_RINGS + 1)[:, None] / BAG_RINGS
        follow = (1 - smoothstep(0.1, 0.7, t)) * np.ones(len(self.cos))
        own = np.where(self.sin < 0, 0.9 * self.middle**0.5, 0.0)
        jaw = self.jaw_share * (1 - smoothstep(0, 0.5, t)) + own * smoothstep(0, 0.5, t)
        return follow, jaw

    def posed(self, pose: MouthPose) -> tuple[Array, Array]:
        """Lips and bag in a pose, with the jaw."""
        hinge = self.character.mouth.hinge
        lips, bag = self.build(pose), self.bag()
        follow, share = self.bag_share()
        bag = bag + follow[..., None] * (lips[0] - self.rest[0])
        lips = lips + self.jaw_share[:, None] * (turn(lips, hinge, pose.jaw) - lips)
        return lips, bag + share[..., None] * (turn(bag, hinge, pose.jaw) - bag)
