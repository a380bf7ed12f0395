"""The OpenGL half of drawing a face: the passes, and the read-back.

Only `renderer` imports this module, and late: importing it loads OpenGL, which may be missing.
"""

from __future__ import annotations

import math
import weakref
from collections.abc import Collection
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from OpenGL import GL
from pyrender import Renderer

from ..face import Face, Floats
from ..looks import Background, Look
from ..view import View
from .mesh import FaceMesh
from .program import Programs
from .shadow import SHADOW_OFFSET, ShadowMap, camera_to_light, shadow_reach
from .target import DEPTHS, FACINGS, SURFACES, Target

Place = tuple[int, int, int, int]
Matrix = NDArray[np.float64]

_UPSIDE_DOWN = np.diag([1.0, -1.0, 1.0, 1.0])
#: From -1…1 to 0…1.
_HALF = np.array([[0.5, 0, 0, 0.5], [0, 0.5, 0, 0.5], [0, 0, 0.5, 0.5], [0, 0, 0, 1]])
_CUT = ("CUT",)
_SOFTWARE = ("llvmpipe", "softpipe", "swiftshader", "swrast", "software", "gdi generic")
#: A step on the way to the light behind, in halves of what is seen from home.
_RIM_STEP = 0.04
#: Alpha from which on a soft part is there where a pixel has but one sample.
_HALF_THERE = 0.45
#: A picture of more samples is drawn in bands: each sample takes 28 bytes.
_MOST_SAMPLES = 12_000_000
#: Rows by which bands lie over one another: so far the way to the light behind is looked at, as a rule.
_APRON = 64


class Band(NamedTuple):
    """Rows of a picture that are drawn in one go: `rows` from row `top` on, `finer` ² samples a pixel."""

    top: int
    rows: int
    finer: int

    def of(self, place: Place) -> Place:
        """A place of the picture, in samples of the band; it may begin above and end below it."""
        x, y, width, height = place
        return self.finer * x, self.finer * (y - self.top), self.finer * width, self.finer * height


@dataclass(frozen=True)
class _Standing:
    """A face whose surface has been drawn and waits for its light: where, by which camera, in which shadow."""

    place: Place
    projection: Matrix
    to_light: Matrix  # from the camera's space
    lift: float
    seen: float  # half of what is seen of the mesh's space from its home: about half a head
    key_from: NDArray[np.float64]
    shadow: ShadowMap
    look: Look


class FaceGL(Renderer):  # type: ignore[misc]
    """Draws faces over a backdrop: `begin`, `add` each, `finish`. All calls need the context bound.

    pyrender's own pass walks a scene graph and looks up every uniform by name, which costs more than
    drawing a face; this one sends the few it needs. `FaceMesh` is its primitive.
    """

    def __init__(self) -> None:
        super().__init__(1, 1)
        self.dpscale = 1  # the base class doubles every size on macOS
        self._programs = Programs()
        self._targets: dict[int, Target] = {}  # by how many of their pixels make one, in each direction
        self._size = (0, 0)
        self._pixels: NDArray[np.uint8] = np.empty((0, 0, 4), np.uint8)
        self._meshes: dict[Face, FaceMesh] = {}
        self._band = Band(0, 1, 1)
        self._shadows: list[ShadowMap] = []  # one of each place of the picture
        self._standing: list[_Standing] = []
        self._no_vertices = GL.glGenVertexArrays(1)
        self._largest = int(GL.glGetIntegerv(GL.GL_MAX_RENDERBUFFER_SIZE))
        name = GL.glGetString(GL.GL_RENDERER).decode(errors="replace")
        self.name: str = name
        self.software: bool = any(word in name.casefold() for word in _SOFTWARE)

    def bands(self, size: tuple[int, int], smooth: bool) -> list[Band]:
        """How to draw a picture of (w, h) pixels: one after another, each from `begin` to `finish`.

        smooth  with four samples a pixel
        """
        width, height = (min(max(int(side), 1), self._largest // 2) for side in size)
        if (width, height) != self._size:
            self._delete_targets()
            self._size = (width, height)
            self._pixels = np.empty((height, width, 4), np.uint8)
        finer = 2 if smooth else 1
        rows = max(_MOST_SAMPLES // (width * finer * finer), 4 * _APRON)
        return [Band(top, min(rows, height), finer) for top in _tops(height, rows)]

    def begin(self, band: Band) -> None:
        """A new picture, or part of one."""
        self._band = band
        GL.glEnable(GL.GL_DEPTH_TEST)
        GL.glDepthFunc(GL.GL_LEQUAL)
        GL.glDepthMask(True)
        GL.glDisable(GL.GL_BLEND)
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, self._target(band.finer).surfaces)
        GL.glClear(GL.GL_DEPTH_BUFFER_BIT)
        self._standing.clear()

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
        from_mesh = view.matrix()
        reach = shadow_reach(view, radius)
        key_from = _unit(look.light.key_from)
        to_light = camera_to_light(view, reach, key_from)
        # The side the camera is on. 0 is no cut, and has shaders without one: some clip even when clipping is off.
        cut = math.copysign(1.0, from_mesh[2, 0]) if view.cutaway else 0.0
        if len(self._standing) == len(self._shadows):
            self._shadows.append(ShadowMap())
        shadow = self._shadows[len(self._standing)]
        (GL.glEnable if cut else GL.glDisable)(GL.GL_CLIP_DISTANCE0)
        GL.glEnable(GL.GL_CULL_FACE)
        cast = (weakref.ref(mesh), (to_light @ from_mesh).tobytes(), cut)
        if not shadow.usable(cast) or fresh_shadow:
            shadow.begin(cast)
            self._draw_shadow(mesh, to_light @ from_mesh, cut)
        projection = _UPSIDE_DOWN @ view.projection(place[2:], radius)
        inside = view.cutaway or not mesh.inner_sides.hidden_from(from_mesh)
        self._draw_surface(mesh, from_mesh, projection, place, cut, inside)
        GL.glDisable(GL.GL_CULL_FACE)
        GL.glDisable(GL.GL_CLIP_DISTANCE0)
        lift = SHADOW_OFFSET * reach
        seen = view.home.distance * math.tan(math.radians(view.home.fov) / 2.0)
        self._standing.append(_Standing(place, projection, to_light, lift, seen, key_from, shadow, look))

    def forget(self, but: Collection[Face]) -> None:
        """Free the meshes of all other faces."""
        for face in [face for face in self._meshes if face not in but]:
            self._meshes.pop(face).delete()

    def finish(self, background: Background) -> NDArray[np.uint8]:
        """(h, w, 4) BGRA, top row first; the same array until the size changes."""
        target = self._target(self._band.finer)
        GL.glDepthMask(False)
        GL.glBindVertexArray(self._no_vertices)
        if target.shows != (background, self._band.top):
            self._draw_backdrop(target, background)
        target.light()
        for standing in self._standing:
            self._draw_light(standing)
        GL.glBindVertexArray(0)
        GL.glDepthMask(True)
        return self._read(target)

    def delete(self) -> None:
        """Free everything on the card."""
        self.forget(())
        self._delete_targets()
        for shadow in self._shadows:
            shadow.delete()
        GL.glDeleteVertexArrays(1, [self._no_vertices])
        self._programs.delete()

    def __del__(self) -> None:  # the base class frees from whatever thread collects it, without the context
        pass

    def _draw_shadow(self, mesh: FaceMesh, to_light: Matrix, cut: float) -> None:
        GL.glFrontFace(GL.GL_CCW)
        GL.glCullFace(GL.GL_BACK)
        GL.glEnable(GL.GL_DEPTH_CLAMP)  # what is nearer to the light than the map reaches casts, too
        program = self._programs.use("shadow", "shadow", *_CUT[: bool(cut)])
        program.matrix("to_light", to_light)
        for batch in mesh.batches:
            if batch.solid:
                if cut:
                    program.number("cut", 0.0 if batch.whole else cut)
                mesh.draw(batch)
        GL.glDisable(GL.GL_DEPTH_CLAMP)

    def _draw_surface(
        self, mesh: FaceMesh, from_mesh: Matrix, projection: Matrix, place: Place, cut: float, inside: bool
    ) -> None:
        """Colours and normals. Inner sides, too: users' rigs have single-sided lashes and hair."""
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, self._target(self._band.finer).surfaces)
        GL.glViewport(*self._band.of(place))
        # The picture is drawn upside down, so that the read-back needs no flip: its first row is the top.
        GL.glFrontFace(GL.GL_CW)
        for batch in mesh.batches:
            one_sided = batch.closed and not inside
            pictured = () if batch.material is None else ("PICTURED",) if batch.solid else ("PICTURED", "CUT_OUT")
            sides = () if one_sided else ("TWO_SIDED",)
            program = self._programs.use("surface", "surface", *_CUT[: bool(cut)], *sides, *pictured)
            program.matrix("view", from_mesh)
            program.matrix("projection", projection)
            if cut:
                program.number("cut", 0.0 if batch.whole else cut)
            if batch.material is not None:
                mesh.bind_picture(batch)
                program.texture("picture", 0)
                if not batch.solid:
                    soft, cutoff = batch.material.soft, batch.material.cutoff
                    program.number("cutoff", max(cutoff, _HALF_THERE) if soft else cutoff)
                    program.number("fade", float(soft and self._band.finer > 1))
            (GL.glEnable if one_sided else GL.glDisable)(GL.GL_CULL_FACE)
            mesh.draw(batch)

    def _draw_light(self, standing: _Standing) -> None:
        """On a face's pixels alone: they are before the far plane."""
        x, y, width, height = self._band.of(standing.place)
        GL.glViewport(x, y, width, height)
        GL.glDepthFunc(GL.GL_GREATER)
        program = self._programs.use("light", "light")
        standing.shadow.bind()
        for name, unit in (("shadow", 0), ("surfaces", SURFACES), ("facings", FACINGS), ("depths", DEPTHS)):
            program.texture(name, unit)
        projection = standing.projection
        to_light = _HALF @ standing.to_light @ np.linalg.inv(projection)
        program.matrix("to_light", to_light)
        program.vector("deeper", 2.0 * to_light[:, 2])
        program.matrix("lift", 0.5 * standing.lift * standing.to_light[:3, :3])
        program.vector("spread", (1.0 / projection[0, 0], 1.0 / projection[1, 1]))
        bottom = min(y + height, self._band.rows * self._band.finer) - 1
        program.vector("bounds", (x, max(y, 0), x + width - 1, bottom))
        program.vector("depth_of", (-projection[2, 2], -projection[2, 3]))
        light, background = standing.look.light, standing.look.background
        step = _RIM_STEP * standing.seen * _unit(light.rim_from)
        pixels = 0.5 * step[:2] * (projection[0, 0] * width, projection[1, 1] * height)
        program.vector("to_rim", (*pixels, -step[2]))
        for name, three in (
            ("key_from", standing.key_from),
            ("rim_from", _unit(light.rim_from)),
            ("key", background.key),
            ("sky", background.sky),
            ("bounce", background.bounce),
            ("rim_light", background.rim),
        ):
            program.vector(name, three)
        GL.glDrawArrays(GL.GL_TRIANGLES, 0, 3)

    def _draw_backdrop(self, target: Target, background: Background) -> None:
        """It is kept: no face changes it."""
        band = self._band
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, target.backdrop)
        GL.glViewport(*band.of((0, 0, *self._size)))
        GL.glDepthFunc(GL.GL_ALWAYS)
        program = self._programs.use("backdrop", "backdrop")
        program.vector("top", background.top)
        program.vector("bottom", background.bottom)
        program.number("glow", background.glow)
        program.number("above", band.top * band.finer)
        program.number("checker", background.checker * min(self._size) * band.finer)
        GL.glDrawArrays(GL.GL_TRIANGLES, 0, 3)
        target.shows = (background, band.top)

    def _target(self, finer: int) -> Target:
        """For the present band; of one sample a pixel it may be higher."""
        size = (finer * self._size[0], finer * self._band.rows)
        found = self._targets.get(finer)
        if found is None or found.size[1] < size[1] or (finer > 1 and found.size != size):
            if found is not None:
                found.delete()
            self._targets[finer] = found = Target(*size)
        return found

    def _delete_targets(self) -> None:
        for target in self._targets.values():
            target.delete()
        self._targets.clear()

    def _read(self, target: Target) -> NDArray[np.uint8]:
        band = self._band
        if band.finer > 1:
            plain = self._target(1)
            target.shrink_into(plain)
            target = plain
        GL.glBindFramebuffer(GL.GL_READ_FRAMEBUFFER, target.canvas)
        width, height = self._size
        first = _APRON if band.top else 0
        last = band.rows if band.top + band.rows == height else band.rows - _APRON
        rows = self._pixels[band.top + first : band.top + last]
        GL.glReadPixels(0, first, width, last - first, GL.GL_BGRA, GL.GL_UNSIGNED_BYTE, rows)
        return self._pixels


def _tops(height: int, rows: int) -> list[int]:
    """Where bands of `rows` begin that lie over one another by an apron's height on both sides."""
    last = max(height - rows, 0)
    return [*range(0, last, rows - 2 * _APRON), last]


def _unit(direction: tuple[float, float, float]) -> NDArray[np.float64]:
    vector = np.array(direction)
    unit: NDArray[np.float64] = vector / np.linalg.norm(vector)
    return unit
