"""Where the face is looked at from, and before what: a camera that turns about a point, moved by the mouse."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from .face import Camera

_DEGREES_PER_PIXEL = 0.4
_STEEPEST = 85.0
_ZOOM_PER_STEP = 0.9
_NEAREST, _FARTHEST = 0.25, 4.0
_PAN_REACH = 0.5


@dataclass(frozen=True)
class View:
    """A camera about `target`; degrees, and the mesh's own unit. Every move gives a new, clamped view.

    yaw      turns the camera to its right about +y, in (-180, 180]
    pitch    lifts it, within ±85
    home     the face's own camera, where `reset` goes back to; zoom and pan are limited around it
    cutaway  hides the half of the head towards the camera, all but the tongue
    """

    yaw: float = 0.0
    pitch: float = 0.0
    distance: float = 5.0
    target: tuple[float, float, float] = (0.0, 0.0, 0.0)
    fov: float = 24.0
    home: Camera = field(default_factory=Camera)
    cutaway: bool = False

    @classmethod
    def of(cls, camera: Camera) -> View:
        """The view a face asks for."""
        return cls(camera.yaw, camera.pitch, camera.distance, camera.target, camera.fov, camera)

    def orbited(self, dx: float, dy: float) -> View:
        """Turned as if the face were dragged by (dx, dy) pixels; +y is down the screen."""
        yaw = self.yaw - dx * _DEGREES_PER_PIXEL
        pitch = self.pitch + dy * _DEGREES_PER_PIXEL
        return replace(self, yaw=180.0 - (180.0 - yaw) % 360.0, pitch=min(max(pitch, -_STEEPEST), _STEEPEST))

    def zoomed(self, steps: float) -> View:
        """Nearer by `steps` notches of the wheel, farther when negative."""
        distance = self.distance * _ZOOM_PER_STEP ** min(max(steps, -100.0), 100.0)
        nearest, farthest = _NEAREST * self.home.distance, _FARTHEST * self.home.distance
        return replace(self, distance=min(max(distance, nearest), farthest))

    def panned(self, dx: float, dy: float, height: float) -> View:
        """Shifted so that the face follows a drag of (dx, dy) pixels in a picture `height` pixels high."""
        unit = 2.0 * self.distance * math.tan(math.radians(self.fov) / 2.0) / max(height, 1.0)
        right, up, _ = self._axes()
        moved = np.asarray(self.target) - right * (dx * unit) + up * (dy * unit)
        home = np.asarray(self.home.target)
        reach = _PAN_REACH * self.home.distance
        x, y, z = np.clip(moved, home - reach, home + reach).tolist()
        return replace(self, target=(x, y, z))

    def reset(self) -> View:
        """Back to the face's own camera; a cut-away stays."""
        return replace(View.of(self.home), cutaway=self.cutaway)

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


@dataclass(frozen=True)
class Background:
    """A vertical gradient, sRGB in 0…1, with a pool of light behind the head: `glow` 0 for none."""

    top: tuple[float, float, float] = (0.205, 0.230, 0.262)
    bottom: tuple[float, float, float] = (0.086, 0.094, 0.106)
    glow: float = 0.45
