"""A face's triangles on the graphics card."""

from __future__ import annotations

import ctypes

import numpy as np
from numpy.typing import NDArray
from OpenGL import GL
from pyrender import MetallicRoughnessMaterial, Primitive

from .face import Face, Floats
from .inner_sides import InnerSides

_WHOLE = ("tongue",)  # how the names of the parts begin that a cut-away leaves whole


class FaceMesh(Primitive):  # type: ignore[misc]
    """A face's triangles. Positions and normals, interleaved, live in a buffer that changes with every frame."""

    def __init__(self, face: Face) -> None:
        super().__init__(
            positions=face.positions,
            normals=face.normals,
            color_0=face.colours,
            indices=face.triangles,
            material=MetallicRoughnessMaterial(alphaMode="OPAQUE"),
        )
        # The base class keeps indices as float32; these go to the card as they are.
        self.corners: NDArray[np.uint32] = np.ascontiguousarray(face.triangles, np.uint32)
        self._moving = 0
        whole = np.zeros(len(self.corners), bool)
        for name, (first, count) in face.parts.items():
            whole[first : first + count] = name.startswith(_WHOLE)
        self.inner_sides = InnerSides(face)
        may_show = self.inner_sides.may_show
        # what a cut leaves whole, and the rest, each as runs of (first, count)
        self._all = _runs(whole), _runs(~whole)
        self._showing_inside = _runs(whole & may_show), _runs(~whole & may_show)

    def _add_to_context(self) -> None:
        self._vaid = GL.glGenVertexArrays(1)
        GL.glBindVertexArray(self._vaid)
        self._moving, still, corners = (int(name) for name in GL.glGenBuffers(3))
        self._buffers = [self._moving, still, corners]

        GL.glBindBuffer(GL.GL_ARRAY_BUFFER, self._moving)
        GL.glBufferData(GL.GL_ARRAY_BUFFER, 24 * len(self.positions), None, GL.GL_STREAM_DRAW)
        for location in (0, 1):
            GL.glVertexAttribPointer(location, 3, GL.GL_FLOAT, GL.GL_FALSE, 24, ctypes.c_void_p(12 * location))
            GL.glEnableVertexAttribArray(location)

        colours = np.ascontiguousarray(self.color_0, np.float32)
        GL.glBindBuffer(GL.GL_ARRAY_BUFFER, still)
        GL.glBufferData(GL.GL_ARRAY_BUFFER, colours.nbytes, colours, GL.GL_STATIC_DRAW)
        GL.glVertexAttribPointer(2, 4, GL.GL_FLOAT, GL.GL_FALSE, 16, ctypes.c_void_p(0))
        GL.glEnableVertexAttribArray(2)

        GL.glBindBuffer(GL.GL_ELEMENT_ARRAY_BUFFER, corners)
        GL.glBufferData(GL.GL_ELEMENT_ARRAY_BUFFER, self.corners.nbytes, self.corners, GL.GL_STATIC_DRAW)
        GL.glBindVertexArray(0)

    def update(self, vertices: Floats) -> None:
        """Replace positions and normals: (n, 6), contiguous."""
        if not self._in_context():
            self._add_to_context()
        GL.glBindBuffer(GL.GL_ARRAY_BUFFER, self._moving)
        GL.glBufferSubData(GL.GL_ARRAY_BUFFER, 0, vertices.nbytes, vertices)

    def draw(self, cut: float, location: int, closed: bool = True) -> None:
        """With the program that is in use, which has its uniform `cut` at `location`; perhaps without closed bodies."""
        self._bind()
        for runs, hidden in zip(self._all if closed else self._showing_inside, (0.0, cut), strict=True):
            GL.glUniform1f(location, hidden)
            for first, count in runs:
                GL.glDrawElements(GL.GL_TRIANGLES, 3 * count, GL.GL_UNSIGNED_INT, ctypes.c_void_p(12 * first))


def _runs(chosen: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Each run of True as (first, count)."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], chosen, [False]])))
    return [(int(a), int(b - a)) for a, b in zip(edges[::2], edges[1::2], strict=True)]
