"""Where a face is looked at from: a camera that turns about a point, moved by the mouse, and never too near."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from .face import Camera, Face, Floats
from .framing import head_outline, mouth_outline
from .looks import Angle

_DEGREES_PER_PIXEL = 0.4
_STEEPEST = 85.0
_ZOOM_PER_STEP = 0.9
_NEAREST, _FARTHEST = 0.25, 4.0
_PAN_REACH = 0.5
#: Part of the half picture that stays free beside what must be seen.
_AIR = 0.05


@dataclass(frozen=True)
class View:
    """A camera about `target`; degrees, and the mesh's own unit. Every move gives a new, clamped view.

    yaw      turns the camera to its right about +y, in (-180, 180]
    pitch    lifts it, within ±85
    home     the face's own camera, where `reset` goes back to; zoom and pan are limited around it
    cutaway  hides the half of the head towards the camera, all but the tongue
    outline  (m, 3) points that must be seen from home, whatever the picture's shape; None: the camera stays put
    """

    yaw: float = 0.0
    pitch: float = 0.0
    distance: float = 5.0
    target: tuple[float, float, float] = (0.0, 0.0, 0.0)
    fov: float = 24.0
    home: Camera = field(default_factory=Camera)
    cutaway: bool = False
    outline: Floats | None = field(default=None, compare=False, repr=False)

    @classmethod
    def of(cls, camera: Camera, outline: Floats | None = None) -> View:
        """The view a face asks for; with an `outline`, from where all of it is seen."""
        if outline is not None:
            x, _, z = camera.target
            low, high = float(outline[:, 1].min()), float(outline[:, 1].max())
            camera = replace(camera, target=(x, (low + high) / 2.0, z))
        return cls(camera.yaw, camera.pitch, camera.distance, camera.target, camera.fov, camera, outline=outline)

    @classmethod
    def on(cls, face: Face, angle: Angle | None = None) -> View:
        """The whole head, or what an angle asks for."""
        angle = angle or Angle()
        outline = mouth_outline(face) if angle.mouth else head_outline(face)
        camera = face.camera
        if angle.mouth:
            x, y, _ = ((outline.min(0) + outline.max(0)) / 2.0).tolist()
            camera = replace(camera, target=(x, y, camera.target[2]))
        view = cls.of(camera, outline)
        return replace(view, yaw=_wrapped(view.yaw + angle.yaw), pitch=view.pitch + angle.pitch)

    def like(self, other: View) -> View:
        """This face turned, enlarged and cut as another is, each from its own home."""
        turned = replace(self, yaw=_wrapped(self.home.yaw + other.yaw - other.home.yaw), cutaway=other.cutaway)
        pitch = min(max(self.home.pitch + other.pitch - other.home.pitch, -_STEEPEST), _STEEPEST)
        return replace(turned, pitch=pitch, distance=self.home.distance * other.distance / other.home.distance)

    def fitted(self, size: tuple[int, int]) -> View:
        """Moved back as far as a picture of (w, h) pixels needs to hold the outline, and no farther; zoom counts on.

        What stands above or below the middle is taken to be half as near as it comes in a turn, at least, so
        that a turning head does not seem to breathe.
        """
        if self.outline is None:
            return self
        width, height = max(size[0], 1), max(size[1], 1)
        half = (1.0 - _AIR) * math.tan(math.radians(self.home.fov) / 2.0) / min(width, height)
        right, up, back = self._axes()
        away = self.outline - np.asarray(self.home.target)
        near = away @ back
        nearest = np.hypot(away[:, 0], away[:, 2])
        beside = np.abs(away @ right) / (half * width) + near
        above = np.abs(away @ up) / (half * height) + np.maximum(near, 0.5 * nearest)
        needed = max(float(beside.max()), float(above.max()))
        return replace(self, distance=self.distance * needed / self.home.distance)

    def turned(self, degrees: float) -> View:
        """Turned about the upright axis, to the camera's right."""
        return replace(self, yaw=_wrapped(self.yaw + degrees))

    def orbited(self, dx: float, dy: float) -> View:
        """Turned as if the face were dragged by (dx, dy) pixels; +y is down the screen."""
        yaw = self.yaw - dx * _DEGREES_PER_PIXEL
        pitch = self.pitch + dy * _DEGREES_PER_PIXEL
        return replace(self, yaw=_wrapped(yaw), pitch=min(max(pitch, -_STEEPEST), _STEEPEST))

    def zoomed(self, steps: float) -> View:
        """Nearer by `steps` notches of the wheel, farther when negative."""
        distance = self.distance * _ZOOM_PER_STEP ** min(max(steps, -100.0), 100.0)
        nearest, farthest = _NEAREST * self.home.distance, _FARTHEST * self.home.distance
        return replace(self, distance=min(max(distance, nearest), farthest))

    def panned(self, dx: float, dy: float, size: tuple[int, int]) -> View:
        """Shifted so that the face follows a drag of (dx, dy) pixels in a picture of (w, h) pixels."""
        unit = 2.0 * self.fitted(size).distance * math.tan(math.radians(self.fov) / 2.0) / max(min(size), 1)
        right, up, _ = self._axes()
        moved = np.asarray(self.target) - right * (dx * unit) + up * (dy * unit)
        home = np.asarray(self.home.target)
        reach = _PAN_REACH * self.home.distance
        x, y, z = np.clip(moved, home - reach, home + reach).tolist()
        return replace(self, target=(x, y, z))

    def reset(self) -> View:
        """Back to the face's own camera; a cut-away stays."""
        return replace(View.of(self.home), cutaway=self.cutaway, outline=self.outline)

    def matrix(self) -> NDArray[np.float64]:
        """(4, 4) from the mesh's space to the camera's, which looks along its own -z."""
        turn = np.stack(self._axes())
        matrix = np.eye(4)
        matrix[:3, :3] = turn
        matrix[:3, 3] = -turn @ np.asarray(self.target)
        matrix[2, 3] -= self.distance
        return matrix

    def projection(self, size: tuple[int, int], radius: float) -> NDArray[np.float64]:
        """(4, 4) OpenGL projection to a picture of (w, h) pixels, for a mesh within `radius` of the origin at rest.

        `fov` is the angle over the shorter side: in a picture higher than wide the cheeks stay in.
        """
        width, height = max(size[0], 1), max(size[1], 1)
        scale = min(width, height) / math.tan(math.radians(self.fov) / 2.0)
        reach = 1.5 * radius + math.dist(self.target, (0.0, 0.0, 0.0))
        near = max(self.distance - reach, 0.02 * self.distance)
        far = self.distance + reach
        matrix = np.zeros((4, 4))
        matrix[0, 0], matrix[1, 1] = scale / width, scale / height
        matrix[2, 2], matrix[2, 3] = (far + near) / (near - far), 2.0 * far * near / (near - far)
        matrix[3, 2] = -1.0
        return matrix

    def _axes(self) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """The camera's right, up and backward, each (3,), in the mesh's space."""
        yaw, pitch = math.radians(self.yaw), math.radians(self.pitch)
        cy, sy, cp, sp = math.cos(yaw), math.sin(yaw), math.cos(pitch), math.sin(pitch)
        return np.array([cy, 0.0, -sy]), np.array([-sy * sp, cp, -cy * sp]), np.array([sy * cp, sp, cy * cp])


def places(size: tuple[int, int], count: int) -> list[tuple[int, int, int, int]]:
    """Where each of `count` faces stands in a picture of (w, h) pixels: (x, y, w, h), +y down.

    Side by side; on top of one another in a picture so narrow that they become larger that way.
    """
    width, height = size
    count = max(count, 1)
    stacked = min(width, height / count) > min(width / count, height)
    across = [round(i * (height if stacked else width) / count) for i in range(count + 1)]
    if stacked:
        return [(0, a, width, b - a) for a, b in pairwise(across)]
    return [(a, 0, b - a, height) for a, b in pairwise(across)]


def _wrapped(degrees: float) -> float:
    """In (-180, 180]."""
    return 180.0 - (180.0 - degrees) % 360.0
