"""What the key light sees: the shadow map, and how to get from the camera's space into it."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from OpenGL import GL

from ..view import View

_SHADOW_SIZE = 512
#: So many pictures in motion are drawn with one map: its edges are soft, and it lags by 33 ms at most at 60 a second.
_PICTURES = 3

#: How far above the surface to ask for shadow, in the map's reach: five texels, as the shader reads that far.
SHADOW_OFFSET = 0.022


class ShadowMap:
    """How far the key light reaches, as a depth texture that compares when it is read."""

    def __init__(self) -> None:
        self._of: tuple[object, ...] = ()  # what it shows
        self._pictures = 0  # for which it was used
        self._texture = GL.glGenTextures(1)
        GL.glBindTexture(GL.GL_TEXTURE_2D, self._texture)
        side = _SHADOW_SIZE
        form = GL.GL_DEPTH_COMPONENT
        GL.glTexImage2D(GL.GL_TEXTURE_2D, 0, GL.GL_DEPTH_COMPONENT24, side, side, 0, form, GL.GL_FLOAT, None)
        for key, value in (
            (GL.GL_TEXTURE_MIN_FILTER, GL.GL_LINEAR),
            (GL.GL_TEXTURE_MAG_FILTER, GL.GL_LINEAR),
            (GL.GL_TEXTURE_WRAP_S, GL.GL_CLAMP_TO_BORDER),
            (GL.GL_TEXTURE_WRAP_T, GL.GL_CLAMP_TO_BORDER),
            (GL.GL_TEXTURE_COMPARE_MODE, GL.GL_COMPARE_REF_TO_TEXTURE),
        ):
            GL.glTexParameteri(GL.GL_TEXTURE_2D, key, value)
        nothing_there = np.ones(4, np.float32)  # outside the map all is lit
        GL.glTexParameterfv(GL.GL_TEXTURE_2D, GL.GL_TEXTURE_BORDER_COLOR, nothing_there)
        self._name = GL.glGenFramebuffers(1)
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, self._name)
        GL.glFramebufferTexture2D(GL.GL_FRAMEBUFFER, GL.GL_DEPTH_ATTACHMENT, GL.GL_TEXTURE_2D, self._texture, 0)
        GL.glDrawBuffer(GL.GL_NONE)
        GL.glReadBuffer(GL.GL_NONE)

    def usable(self, of: tuple[object, ...]) -> bool:
        """Whether it shows `of` as it was not long ago; every question counts as a picture."""
        self._pictures += 1
        return of == self._of and self._pictures < _PICTURES

    def begin(self, of: tuple[object, ...]) -> None:
        """What is drawn from now on casts shadows: `of`, a mesh and how the light sees it."""
        self._of, self._pictures = of, 0
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, self._name)
        GL.glViewport(0, 0, _SHADOW_SIZE, _SHADOW_SIZE)
        GL.glClear(GL.GL_DEPTH_BUFFER_BIT)

    def bind(self) -> None:
        """For the shader to read, as texture 0."""
        GL.glActiveTexture(GL.GL_TEXTURE0)
        GL.glBindTexture(GL.GL_TEXTURE_2D, self._texture)

    def delete(self) -> None:
        """Free it."""
        GL.glDeleteFramebuffers(1, [self._name])
        GL.glDeleteTextures([self._texture])


def shadow_reach(view: View, radius: float) -> float:
    """Half the side of the shadow map in the mesh's unit: as much of the face as is seen, and a little more."""
    seen = view.distance * math.tan(math.radians(view.fov) / 2.0)
    return min(1.25 * seen, radius + math.dist(view.target, (0.0, 0.0, 0.0)))


def camera_to_light(view: View, reach: float, key_from: NDArray[np.float64]) -> NDArray[np.float64]:
    """(4, 4) from the camera's space to the shadow map's, -1…1, for a light in the unit direction `key_from`."""
    x, y, z = key_from.tolist()
    level = math.hypot(x, z)
    right, up = (z / level, 0.0, -x / level), (-x * y / level, level, -y * z / level)
    matrix = np.eye(4)
    matrix[:3, :3] = np.array([right, up, (-x, -y, -z)]) / reach
    matrix[:3, 3] = matrix[:3, 2] * view.distance  # the target goes to the middle
    return matrix
