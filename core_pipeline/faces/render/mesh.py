"""A face's triangles on the graphics card."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from OpenGL import GL
from pyrender import MetallicRoughnessMaterial, Primitive

from ..face import Face, Floats
from ..texture import Material, Texture
from .inner_sides import InnerSides

_WHOLE = ("tongue",)  # how the names of the parts begin that a cut-away leaves whole
_WRAP = {"repeat": GL.GL_REPEAT, "clamp": GL.GL_CLAMP_TO_EDGE, "mirror": GL.GL_MIRRORED_REPEAT}


@dataclass(frozen=True)
class Batch:
    """Triangles that are drawn in one go, `count` from the number `first` on.

    whole     a cut-away leaves them whole
    closed    someone in front sees no inner side of theirs
    material  what lies on them, if anything does
    """

    first: int
    count: int
    whole: bool
    closed: bool
    material: Material | None

    @property
    def solid(self) -> bool:
        """Whether every triangle is there from edge to edge, whatever its picture shows."""
        return self.material is None or (self.material.cutoff == 0.0 and not self.material.soft)


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
        self._moving = 0
        self._texcoords = face.texcoords
        self._pictures = face.textures
        self._textures: dict[tuple[int, bool], int] = {}  # by picture, and whether its alpha counts
        self.inner_sides = InnerSides(face)
        order, self.batches = _batches(face, ~self.inner_sides.may_show)
        # The base class keeps indices as float32; these go to the card as they are.
        self._corners: NDArray[np.uint32] = np.ascontiguousarray(face.triangles[order], np.uint32)

    def _add_to_context(self) -> None:
        self._vaid = GL.glGenVertexArrays(1)
        GL.glBindVertexArray(self._vaid)
        self._moving = int(GL.glGenBuffers(1))
        self._buffers = [self._moving]
        GL.glBindBuffer(GL.GL_ARRAY_BUFFER, self._moving)
        GL.glBufferData(GL.GL_ARRAY_BUFFER, 24 * len(self.positions), None, GL.GL_STREAM_DRAW)
        for location in (0, 1):
            GL.glVertexAttribPointer(location, 3, GL.GL_FLOAT, GL.GL_FALSE, 24, ctypes.c_void_p(12 * location))
            GL.glEnableVertexAttribArray(location)
        self._add_still(2, self.color_0)
        if self._texcoords is not None:
            self._add_still(3, self._texcoords)
        corners = int(GL.glGenBuffers(1))
        self._buffers.append(corners)
        GL.glBindBuffer(GL.GL_ELEMENT_ARRAY_BUFFER, corners)
        GL.glBufferData(GL.GL_ELEMENT_ARRAY_BUFFER, self._corners.nbytes, self._corners, GL.GL_STATIC_DRAW)
        GL.glBindVertexArray(0)
        for batch in self.batches:
            if batch.material is not None:
                key = (batch.material.texture, batch.solid)
                if key not in self._textures:
                    self._textures[key] = _texture(self._pictures[key[0]], not batch.solid)

    def _add_still(self, location: int, values: Floats) -> None:
        values = np.ascontiguousarray(values, np.float32)
        name = int(GL.glGenBuffers(1))
        self._buffers.append(name)
        GL.glBindBuffer(GL.GL_ARRAY_BUFFER, name)
        GL.glBufferData(GL.GL_ARRAY_BUFFER, values.nbytes, values, GL.GL_STATIC_DRAW)
        GL.glVertexAttribPointer(location, values.shape[1], GL.GL_FLOAT, GL.GL_FALSE, 0, ctypes.c_void_p(0))
        GL.glEnableVertexAttribArray(location)

    def _remove_from_context(self) -> None:
        super()._remove_from_context()
        if self._textures:
            GL.glDeleteTextures(list(self._textures.values()))
            self._textures = {}

    def update(self, vertices: Floats) -> None:
        """Replace positions and normals: (n, 6), contiguous."""
        if not self._in_context():
            self._add_to_context()
        GL.glBindBuffer(GL.GL_ARRAY_BUFFER, self._moving)
        GL.glBufferSubData(GL.GL_ARRAY_BUFFER, 0, vertices.nbytes, vertices)

    def bind_picture(self, batch: Batch) -> None:
        """What lies on a batch, for the shader to read, in texture unit 0."""
        if batch.material is not None:
            GL.glActiveTexture(GL.GL_TEXTURE0)
            GL.glBindTexture(GL.GL_TEXTURE_2D, self._textures[batch.material.texture, batch.solid])

    def draw(self, batch: Batch) -> None:
        """With the program that is in use."""
        self._bind()
        first = ctypes.c_void_p(12 * batch.first)
        GL.glDrawElements(GL.GL_TRIANGLES, 3 * batch.count, GL.GL_UNSIGNED_INT, first)


def _batches(face: Face, closed: NDArray[np.bool_]) -> tuple[NDArray[np.intp], list[Batch]]:
    """In which order to keep the triangles, and the batches they then make; what closes comes first: it hides most."""
    count = len(face.triangles)
    materials = list(dict.fromkeys(face.materials.values()))
    whole, number = np.zeros(count, bool), np.zeros(count, np.int64)
    for name, (first, length) in face.parts.items():
        part = slice(first, first + length)
        whole[part] = name.startswith(_WHOLE)
        if name in face.materials:
            number[part] = 1 + materials.index(face.materials[name])
    key = 4 * number + 2 * ~closed + whole
    order = np.argsort(key, kind="stable")
    keys, starts = np.unique(key[order], return_index=True)
    batches = []
    for kind, start, end in zip(keys.tolist(), starts.tolist(), [*starts.tolist()[1:], count], strict=True):
        material = materials[kind // 4 - 1] if kind >= 4 else None
        batches.append(Batch(start, end - start, bool(kind & 1), not kind & 2, material))
    return order, batches


def _texture(texture: Texture, premultiplied: bool) -> int:
    """Upload a picture, with smaller ones of it for when it is seen from afar.

    premultiplied  by its alpha: what is not there is often black, and must not darken the edge of what is
    """
    name = int(GL.glGenTextures(1))
    GL.glBindTexture(GL.GL_TEXTURE_2D, name)
    picture = np.ascontiguousarray(texture.picture)
    if premultiplied:
        alpha = picture[..., 3:].astype(np.uint16)
        picture = np.concatenate([((picture[..., :3] * alpha + 127) // 255).astype(np.uint8), picture[..., 3:]], axis=2)
    height, width = picture.shape[:2]
    GL.glTexImage2D(GL.GL_TEXTURE_2D, 0, GL.GL_RGBA8, width, height, 0, GL.GL_RGBA, GL.GL_UNSIGNED_BYTE, picture)
    GL.glGenerateMipmap(GL.GL_TEXTURE_2D)
    for key, value in (
        (GL.GL_TEXTURE_MIN_FILTER, GL.GL_LINEAR_MIPMAP_NEAREST),
        (GL.GL_TEXTURE_MAG_FILTER, GL.GL_LINEAR),
        (GL.GL_TEXTURE_WRAP_S, _WRAP[texture.wrap[0]]),
        (GL.GL_TEXTURE_WRAP_T, _WRAP[texture.wrap[1]]),
    ):
        GL.glTexParameteri(GL.GL_TEXTURE_2D, key, value)
    return name
