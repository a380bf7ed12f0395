"""The OpenGL half of drawing a face: framebuffers, the passes, the read-back.

Only `render` imports this module, and late: importing it loads OpenGL, which may be missing.
"""

from __future__ import annotations

import math
from collections.abc import Collection
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from OpenGL import GL
from pyrender import Renderer
from pyrender.shader_program import ShaderProgram, ShaderProgramCache

from .face import Face, Floats
from .looks import Background, Light, Look
from .render_mesh import FaceMesh
from .render_shadow import SHADOW_OFFSET, ShadowMap, camera_to_light, shadow_reach
from .view import View

Place = tuple[int, int, int, int]

_SHADERS = Path(__file__).parent / "shaders"
_UPSIDE_DOWN = np.diag([1.0, -1.0, 1.0, 1.0])
_SOFTWARE = ("llvmpipe", "softpipe", "swiftshader", "swrast", "software", "gdi generic")


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


class FaceGL(Renderer):  # type: ignore[misc]
    """Draws faces over a backdrop: `begin`, `add` each, `finish`. All calls need the context bound.

    pyrender's own pass walks a scene graph and looks up every uniform by name, which costs more than
    drawing a face; this one sends the few it needs. Its program cache is used, and `FaceMesh` is its primitive.
    """

    def __init__(self) -> None:
        super().__init__(1, 1)
        self.dpscale = 1  # the base class doubles every size on macOS
        self._program_cache = ShaderProgramCache(str(_SHADERS))
        self._targets: dict[int, _Target] = {}
        self._size = (0, 0)
        self._pixels: NDArray[np.uint8] = np.empty((0, 0, 4), np.uint8)
        self._meshes: dict[Face, FaceMesh] = {}
        self._samples = 0
        self._shadows: list[ShadowMap] = []  # one of each place of the picture
        self._no_vertices = GL.glGenVertexArrays(1)
        self._most_samples = int(GL.glGetIntegerv(GL.GL_MAX_SAMPLES))
        self._largest = int(GL.glGetIntegerv(GL.GL_MAX_RENDERBUFFER_SIZE))
        self._locations: dict[tuple[int, str], int] = {}
        name = GL.glGetString(GL.GL_RENDERER).decode(errors="replace")
        self.name: str = name
        self.software: bool = any(word in name.casefold() for word in _SOFTWARE)

    def begin(self, size: tuple[int, int], samples: int) -> None:
        """A new picture of (w, h) pixels, `samples` each, 0 for hard edges."""
        width, height = (min(max(int(side), 1), self._largest) for side in size)
        self._samples = min(samples, self._most_samples)
        self._target = self._made_target(width, height, self._samples)
        GL.glEnable(GL.GL_DEPTH_TEST)
        GL.glDepthFunc(GL.GL_LEQUAL)
        GL.glDisable(GL.GL_BLEND)
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, self._target.name)
        GL.glClear(GL.GL_DEPTH_BUFFER_BIT)
        self._drawn = 0

    def add(
        self, face: Face, vertices: Floats, view: View, radius: float, place: Place, look: Look, fresh_shadow: bool
    ) -> None:
        """Draw a face into (x, y, w, h) of the picture; nothing of it comes to stand outside.

        vertices      (n, 6), at rest within `radius` of the origin
        fresh_shadow  the shadow is that of these vertices; else perhaps of those a few pictures ago
        """
        if face not in self._meshes:
            self._meshes[face] = FaceMesh(face)
        mesh = self._meshes[face]
        mesh.update(vertices)
        self._draw_mesh(mesh, view, radius, place, look, fresh_shadow)
        self._drawn += 1

    def forget(self, but: Collection[Face]) -> None:
        """Free the meshes of all other faces."""
        for face in [face for face in self._meshes if face not in but]:
            self._meshes.pop(face).delete()

    def finish(self, background: Background) -> NDArray[np.uint8]:
        """(h, w, 4) BGRA, top row first; the same array until the size changes."""
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, self._target.name)
        GL.glViewport(0, 0, *self._size)
        self._draw_backdrop(background)
        return self._read()

    def _draw_mesh(
        self, mesh: FaceMesh, view: View, radius: float, place: Place, look: Look, fresh_shadow: bool
    ) -> None:
        from_mesh = view.matrix()
        reach = shadow_reach(view, radius)
        key_from = _unit(look.light.key_from)
        to_light = camera_to_light(view, reach, key_from) @ from_mesh
        # The side the camera is on. 0 is no cut: some drivers clip whether clipping is on or not.
        cut = math.copysign(1.0, from_mesh[2, 0]) if view.cutaway else 0.0
        GL.glEnable(GL.GL_CLIP_DISTANCE0)
        GL.glEnable(GL.GL_CULL_FACE)

        if self._drawn == len(self._shadows):
            self._shadows.append(ShadowMap())
        shadow = self._shadows[self._drawn]
        if not shadow.usable((mesh, to_light.tobytes(), cut)) or fresh_shadow:
            shadow.begin((mesh, to_light.tobytes(), cut))
            GL.glFrontFace(GL.GL_CCW)
            GL.glCullFace(GL.GL_BACK)
            GL.glEnable(GL.GL_DEPTH_CLAMP)  # what is nearer to the light than the map reaches casts, too
            program = self._program("shadow")
            self._set_matrix(program, "to_light", to_light)
            mesh.draw(cut, self._location(program, "cut"))
            GL.glDisable(GL.GL_DEPTH_CLAMP)

        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, self._target.name)
        GL.glViewport(*place)
        # The picture is drawn upside down, so that the read-back needs no flip: its first row is the top.
        GL.glFrontFace(GL.GL_CW)
        program = self._program("face")
        shadow.bind()
        self._set_matrix(program, "view", from_mesh)
        self._set_matrix(program, "projection", _UPSIDE_DOWN @ view.projection(place[2:], radius))
        self._set_matrix(program, "to_light", to_light)
        GL.glUniform1f(self._location(program, "off"), SHADOW_OFFSET * reach)
        self._set_light(program, key_from, look.light, look.background)
        # Inner sides are drawn, too: users' rigs have single-sided lashes and hair. But after the outer
        # sides, which hide most of them before they cost any shading; and not of closed bodies seen from the front.
        GL.glCullFace(GL.GL_BACK)
        mesh.draw(cut, self._location(program, "cut"))
        GL.glCullFace(GL.GL_FRONT)
        shown = view.cutaway or not mesh.inner_sides.hidden_from(from_mesh)
        mesh.draw(cut, self._location(program, "cut"), closed=shown)
        GL.glDisable(GL.GL_CULL_FACE)
        GL.glDisable(GL.GL_CLIP_DISTANCE0)

    def _set_light(
        self, program: ShaderProgram, key_from: NDArray[np.float64], light: Light, background: Background
    ) -> None:
        for name, three in (
            ("key_from", key_from),
            ("rim_from", _unit(light.rim_from)),
            ("key", background.key),
            ("sky", background.sky),
            ("bounce", background.bounce),
            ("rim_light", background.rim),
        ):
            GL.glUniform3f(self._location(program, name), *three)

    def _draw_backdrop(self, background: Background) -> None:
        """Last, where no face is: what is hidden is not shaded."""
        program = self._program("backdrop")
        GL.glUniform3f(self._location(program, "top"), *background.top)
        GL.glUniform3f(self._location(program, "bottom"), *background.bottom)
        GL.glUniform1f(self._location(program, "glow"), background.glow)
        GL.glUniform1f(self._location(program, "checker"), background.checker * min(self._size))
        GL.glBindVertexArray(self._no_vertices)
        GL.glDrawArrays(GL.GL_TRIANGLES, 0, 3)
        GL.glBindVertexArray(0)

    def delete(self) -> None:
        """Free everything on the card."""
        self.forget(())
        self._delete_targets()
        for shadow in self._shadows:
            shadow.delete()
        GL.glDeleteVertexArrays(1, [self._no_vertices])
        self._program_cache.clear()

    def __del__(self) -> None:  # the base class frees from whatever thread collects it, without the context
        pass

    def _made_target(self, width: int, height: int, samples: int) -> _Target:
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

    def _read(self) -> NDArray[np.uint8]:
        width, height = self._size
        target = self._target
        if self._samples:
            plain = self._made_target(width, height, 0)
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


def _unit(direction: tuple[float, float, float]) -> NDArray[np.float64]:
    vector = np.array(direction)
    unit: NDArray[np.float64] = vector / np.linalg.norm(vector)
    return unit
