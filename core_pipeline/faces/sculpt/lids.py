"""The opening of the eye: an almond on a ball around the eyeball, and how it closes."""

from __future__ import annotations

import numpy as np

from core_pipeline.faces.sculpt.character import Eyes
from core_pipeline.faces.sculpt.sdf import Array, smoothstep

LID = 1.075
COLUMNS = 38
CLEAR = 1.03
REACH = 1.9


class Lid:
    """The right eye's lids; all points in head space, right side (x > 0)."""

    def __init__(self, eyes: Eyes) -> None:
        self.eyes = eyes
        self.centre = np.array(eyes.centre)
        a = np.radians(eyes.yaw)
        self.axes = np.array([[np.cos(a), 0, -np.sin(a)], [0, 1, 0], [np.sin(a), 0, np.cos(a)]])

    def edge(self, angle: Array, radius: float = LID, size: float = 1.0) -> Array:
        """Points (…, 3) of the almond at `angle` (radians, anticlockwise from the outer corner)."""
        p, q = self._almond(angle)
        p, q = size * p, size * q
        local = np.stack([p, q, np.sqrt(np.clip(1 - p * p - q * q, 0.01, None))], -1)
        points: Array = self.centre + radius * self.eyes.radius * local @ self.axes
        return points

    def _almond(self, angle: Array) -> tuple[Array, Array]:
        p = self.eyes.half_width * np.cos(angle)
        upper, lower = self.eyes.skew
        height = np.where(
            np.sin(angle) > 0,
            self.eyes.upper * (1 + upper * np.cos(angle)),
            self.eyes.lower * (1 + lower * np.cos(angle)),
        )
        return p, height * np.sign(np.sin(angle)) * np.abs(np.sin(angle)) ** self.eyes.pointed + self.eyes.slant * p

    def place(self, points: Array) -> tuple[Array, Array]:
        """Where points (n, 3) near the ball's front lie in the opening: −1 nose … 1 temple, 0 lower … 1 upper edge."""
        local = (points - self.centre) @ self.axes.T
        unit = local / np.linalg.norm(local, axis=1, keepdims=True)
        across = unit[:, 0] / self.eyes.half_width
        angle = np.arccos(across.clip(-0.97, 0.97))
        top, bottom = self._almond(angle)[1], self._almond(-angle)[1]
        return across, (unit[:, 1] - bottom) / (top - bottom)

    def close(self, points: Array, share: Array) -> Array:
        """`points` (n, 3) with the lids shut; share (n,) 1 at the edge … 0 where the face stays still."""
        eyes = self.eyes
        local = (points - self.centre) @ self.axes.T
        size = np.linalg.norm(local, axis=1)
        unit = local / size[:, None]
        p = np.clip(unit[:, 0], -0.999 * eyes.half_width, 0.999 * eyes.half_width)
        angle = np.arccos(p / eyes.half_width)
        top, bottom = self._almond(angle)[1], self._almond(-angle)[1]
        shut = bottom + eyes.shut * (top - bottom)
        is_upper = unit[:, 1] > (top + bottom) / 2
        edge = np.where(is_upper, top, bottom)
        depth = np.sqrt(np.clip(1 - p * p, 0.02, None))
        turn = np.arcsin(np.clip(shut / depth, -1, 1)) - np.arcsin(np.clip(edge / depth, -1, 1))
        # skin beyond the edge would fold where the lids run together: there it follows less
        corner = smoothstep(1.0, 0.6, np.abs(unit[:, 0]) / eyes.half_width)
        turn = turn * share * (1 - eyes.ease * (1 - corner) * smoothstep(1.0, 0.85, share))
        c, s = np.cos(turn), np.sin(turn)
        # half way the straight line of a blendshape cuts inside the ball: the shut lid stands out to make up for it
        out = np.maximum(1, 2 * CLEAR * eyes.radius / (size * np.cos(turn / 2)) - 1)
        turned = np.stack([local[:, 0], local[:, 1] * c + local[:, 2] * s, local[:, 2] * c - local[:, 1] * s], -1)
        closed: Array = self.centre + (turned * out[:, None]) @ self.axes
        return closed

    def share(self, ratio: Array) -> Array:
        """How far a vertex follows the lid's edge; `ratio` is its distance from the middle over the edge's."""
        return 1 - smoothstep(1.0, REACH, ratio)
