"""The OpenGL half of drawing a face: vertex buffers, framebuffers, the pass, the read-back.

Only `render` imports this module, and late: importing it loads OpenGL, which may be missing.
"""

from __future__ import annotations

import ctypes
import math
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from OpenGL import GL
from pyrender import MetallicRoughnessMaterial, Primitive, Renderer
from pyrender.shader_program import ShaderProgram, ShaderProgramCache

from .face import Face, Floats
from .view import Background, View

_SHADERS = Path(__file__).parent / "shaders"
_WHOLE = ("tongue",)  # how the names of the parts begin that a cut-away leaves whole
_SHADOW_SIZE = 512
_KEY_FROM = np.array([-0.46, 0.64, 0.62]) / np.linalg.norm([-0.46, 0.64, 0.62])  # in the camera's space
_OFF = 0.022  # of the shadow map's reach: five texels, as the shader reads that far
_UPSIDE_DOWN = np.diag([1.0, -1.0, 1.0, 1.0])
_SOFTWARE = ("llvmpipe", "softpipe", "swiftshader", "swrast", "software", "gdi generic")


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
        self._whole, self._cut = _runs(whole), _runs(~whole)  # as (first, count)

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

    def draw(self, cut: float, location: int) -> None:
        """With the program that is in use, which has its uniform `cut` at `location`."""
        self._bind()
        for runs, hidden in ((self._whole, 0.0), (self._cut, cut)):
            GL.glUniform1f(location, hidden)
            for first, count in runs:
                GL.glDrawElements(GL.GL_TRIANGLES, 3 * count, GL.GL_UNSIGNED_INT, ctypes.c_void_p(12 * first))


def _runs(chosen: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Each run of True as (first, count)."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], chosen, [False]])))
    return [(int(a), int(b - a)) for a, b in zip(edges[::2], edges[1::2], strict=True)]


class _Target:
    """A framebuffer of (width, height) with `samples` per pixel, 0 for none."""

    def __init__(self, width: int, height: int, samples: int) -> None:
        self._buffers = GL.glGenRenderbuffers(2)
        self.name = GL.glGenFramebuffers(1)
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, self.name)
        for buffer, form, place in zip(
            self._buffers,
            (GL.GL_RGBA8, GL.GL_DEPTH_COMPONENT24),
            (GL.GL_COLOR_ATTACHMENT0, GL.GL_DEPTH_ATTACHMENT),
            strict=True,
        ):
            GL.glBindRenderbuffer(GL.GL_RENDERBUFFER, buffer)
            GL.glRenderbufferStorageMultisample(GL.GL_RENDERBUFFER, samples, form, width, height)
            GL.glFramebufferRenderbuffer(GL.GL_FRAMEBUFFER, place, GL.GL_RENDERBUFFER, buffer)
        if GL.glCheckFramebufferStatus(GL.GL_FRAMEBUFFER) != GL.GL_FRAMEBUFFER_COMPLETE:
            raise RuntimeError(f"no framebuffer of {width} × {height}")

    def delete(self) -> None:
        GL.glDeleteFramebuffers(1, [self.name])
        GL.glDeleteRenderbuffers(2, self._buffers)


class _ShadowMap:
    """How far the key light reaches, as a depth texture that compares when it is read."""

    def __init__(self) -> None:
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

    def begin(self) -> None:
        """What is drawn from now on casts shadows."""
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, self._name)
        GL.glViewport(0, 0, _SHADOW_SIZE, _SHADOW_SIZE)
        GL.glClear(GL.GL_DEPTH_BUFFER_BIT)

    def bind(self) -> None:
        """For the shader to read."""
        GL.glActiveTexture(GL.GL_TEXTURE0)
        GL.glBindTexture(GL.GL_TEXTURE_2D, self._texture)

    def delete(self) -> None:
        GL.glDeleteFramebuffers(1, [self._name])
        GL.glDeleteTextures([self._texture])


def _reach(view: View, radius: float) -> float:
    """Half the side of the shadow map in the mesh's unit: as much of the face as is seen, and a little more."""
    seen = view.distance * math.tan(math.radians(view.fov) / 2.0)
    return min(1.25 * seen, radius + math.dist(view.target, (0.0, 0.0, 0.0)))


def _to_light(view: View, reach: float) -> NDArray[np.float64]:
    """(4, 4) from the camera's space to the shadow map's, -1…1."""
    right = np.cross((0.0, 1.0, 0.0), _KEY_FROM)
    right /= np.linalg.norm(right)
    matrix = np.eye(4)
    matrix[:3, :3] = np.stack([right, np.cross(_KEY_FROM, right), -_KEY_FROM]) / reach
    matrix[:3, 3] = matrix[:3, 2] * view.distance  # the target goes to the middle
    return matrix


class FaceGL(Renderer):  # type: ignore[misc]
    """Draws one face mesh over a backdrop; all calls need the context bound.

    pyrender's own pass walks a scene graph and looks up every uniform by name, which costs more than
    drawing a face; this one sends four matrices and three colours. Its buffers and its program cache are used.
    """

    def __init__(self) -> None:
        super().__init__(1, 1)
        self.dpscale = 1  # the base class doubles every size on macOS
        self._program_cache = ShaderProgramCache(str(_SHADERS))
        self._targets: dict[int, _Target] = {}
        self._size = (0, 0)
        self._pixels: NDArray[np.uint8] = np.empty((0, 0, 4), np.uint8)
        self._mesh: FaceMesh | None = None
        self._shadow = _ShadowMap()
        self._no_vertices = GL.glGenVertexArrays(1)
        self._most_samples = int(GL.glGetIntegerv(GL.GL_MAX_SAMPLES))
        self._largest = int(GL.glGetIntegerv(GL.GL_MAX_RENDERBUFFER_SIZE))
        self._locations: dict[tuple[int, str], int] = {}
        name = GL.glGetString(GL.GL_RENDERER).decode(errors="replace")
        self.name: str = name
        self.software: bool = any(word in name.casefold() for word in _SOFTWARE)

    def set_face(self, face: Face) -> None:
        """Draw this face from now on."""
        if self._mesh is not None:
            self._mesh.delete()
        self._mesh = FaceMesh(face)

    def draw(
        self,
        vertices: Floats,
        view: View,
        radius: float,
        size: tuple[int, int],
        samples: int,
        background: Background,
    ) -> NDArray[np.uint8]:
        """(h, w, 4) BGRA, top row first; the same array until the size changes.

        vertices  (n, 6), all within `radius` of the origin
        samples   per pixel, 0 for hard edges
        """
        width, height = (min(max(int(side), 1), self._largest) for side in size)
        samples = min(samples, self._most_samples)
        target = self._target(width, height, samples)
        from_mesh = view.matrix()
        # The side the camera is on. 0 is no cut: some drivers clip whether clipping is on or not.
        cut = math.copysign(1.0, from_mesh[2, 0]) if view.cutaway else 0.0
        reach = _reach(view, radius)
        to_light = _to_light(view, reach) @ from_mesh
        GL.glEnable(GL.GL_DEPTH_TEST)
        GL.glDepthFunc(GL.GL_LEQUAL)
        GL.glDisable(GL.GL_BLEND)
        GL.glDisable(GL.GL_CULL_FACE)  # users' rigs have single-sided lashes and hair; the shader turns the normals
        GL.glEnable(GL.GL_CLIP_DISTANCE0)
        if self._mesh is not None:
            self._mesh.update(vertices)
            self._shadow.begin()
            GL.glEnable(GL.GL_DEPTH_CLAMP)  # what is nearer to the light than the map reaches casts, too
            program = self._program("shadow")
            self._set_matrix(program, "to_light", to_light)
            self._mesh.draw(cut, self._location(program, "cut"))
            GL.glDisable(GL.GL_DEPTH_CLAMP)
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, target.name)
        GL.glViewport(0, 0, width, height)
        GL.glClear(GL.GL_DEPTH_BUFFER_BIT)
        # The picture is drawn upside down, so that the read-back needs no flip: its first row is the top.
        GL.glFrontFace(GL.GL_CW)
        if self._mesh is not None:
            program = self._program("face")
            self._shadow.bind()
            self._set_matrix(program, "view", from_mesh)
            self._set_matrix(program, "projection", _UPSIDE_DOWN @ view.projection((width, height), radius))
            self._set_matrix(program, "to_light", to_light)
            GL.glUniform1f(self._location(program, "off"), _OFF * reach)
            GL.glUniform3f(self._location(program, "key_from"), *_KEY_FROM)
            self._mesh.draw(cut, self._location(program, "cut"))
        GL.glDisable(GL.GL_CLIP_DISTANCE0)
        # Last, where no face is: what is hidden is not shaded.
        program = self._program("backdrop")
        GL.glUniform3f(self._location(program, "top"), *background.top)
        GL.glUniform3f(self._location(program, "bottom"), *background.bottom)
        GL.glUniform1f(self._location(program, "glow"), background.glow)
        GL.glBindVertexArray(self._no_vertices)
        GL.glDrawArrays(GL.GL_TRIANGLES, 0, 3)
        GL.glBindVertexArray(0)
        return self._read(target, width, height, samples)

    def delete(self) -> None:
        """Free everything on the card."""
        if self._mesh is not None:
            self._mesh.delete()
            self._mesh = None
        self._delete_targets()
        self._shadow.delete()
        GL.glDeleteVertexArrays(1, [self._no_vertices])
        self._program_cache.clear()

    def __del__(self) -> None:  # the base class frees from whatever thread collects it, without the context
        pass

    def _target(self, width: int, height: int, samples: int) -> _Target:
        if (width, height) != self._size:
            self._delete_targets()
            self._size = (width, height)
            self._pixels = np.empty((height, width, 4), np.uint8)
        if samples not in self._targets:
            self._targets[samples] = _Target(width, height, samples)
        return self._targets[samples]

    def _delete_targets(self) -> None:
        for target in self._targets.values():
            target.delete()
        self._targets.clear()

    def _read(self, target: _Target, width: int, height: int, samples: int) -> NDArray[np.uint8]:
        if samples:
            plain = self._target(width, height, 0)
            GL.glBindFramebuffer(GL.GL_READ_FRAMEBUFFER, target.name)
            GL.glBindFramebuffer(GL.GL_DRAW_FRAMEBUFFER, plain.name)
            whole = (0, 0, width, height)
            GL.glBlitFramebuffer(*whole, *whole, GL.GL_COLOR_BUFFER_BIT, GL.GL_NEAREST)
            target = plain
        GL.glBindFramebuffer(GL.GL_READ_FRAMEBUFFER, target.name)
        GL.glReadPixels(0, 0, width, height, GL.GL_BGRA, GL.GL_UNSIGNED_BYTE, self._pixels)
        return self._pixels

    def _program(self, name: str) -> ShaderProgram:
        program = self._program_cache.get_program(f"{name}.vert", f"{name}.frag")
        if not program._in_context():
            program._add_to_context()
        program._bind()
        return program

    def _location(self, program: ShaderProgram, name: str) -> int:
        """Looked up once. pyrender's `set_uniform` swallows a wrong name; here it is an error."""
        key = (int(program._program_id), name)
        if key not in self._locations:
            location = int(GL.glGetUniformLocation(program._program_id, name))
            if location < 0:
                raise RuntimeError(f"the shader has no uniform {name!r}")
            self._locations[key] = location
        return self._locations[key]

    def _set_matrix(self, program: ShaderProgram, name: str, matrix: NDArray[Any]) -> None:
        GL.glUniformMatrix4fv(self._location(program, name), 1, GL.GL_TRUE, np.ascontiguousarray(matrix, np.float32))
