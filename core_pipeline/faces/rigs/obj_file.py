"""One .obj as numbers: `v`, `vt` and `f` lines, and what names its faces.

General mesh readers split vertices where texture coordinates differ, and then the files of a rig no longer
correspond; this one keeps every vertex at its own number.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from core_pipeline.errors import UserError
from core_pipeline.faces.face import Floats
from core_pipeline.faces.rigs.limits import LARGEST, MAX_TEXT, MAX_VERTICES
from core_pipeline.files.atomic import read_bytes

MAX_LINES = 12_000_000
#: Named parts whose names are looked at.
MAX_PARTS = 10_000

_AFTER_SLASH = re.compile(rb"/\S*")
_BEFORE_SLASH = re.compile(rb"[^\s/]+/([^\s/]*)\S*")
_WITHOUT_SLASH = re.compile(rb"(?<!\S)([^\s/]+)(?!\S)")
_NEWLINE, _SPACE, _TAB = 10, 32, 9

Ints = NDArray[np.int64]


class Stretch(NamedTuple):
    """Polygons from `first` on that go by one name ("object group material") and have one material."""

    first: int
    name: str
    material: str


class ObjFile:
    """One file: `vertices` (n, 3), `colours` (n, 3) or None; its faces are read only when asked for.

    parts  whether names and texture coordinates matter too: `stretches`, and `library`, its material file's name
    """

    def __init__(self, path: Path, parts: bool = False) -> None:
        self.path = path
        raw = read_bytes(path, MAX_TEXT, "mesh")
        if b"\\" in raw:  # a line goes on after a backslash
            raw = raw.replace(b"\\\r\n", b" ").replace(b"\\\n", b" ")
        if b"\n" not in raw:
            raw = raw.replace(b"\r", b"\n")
        self._raw = raw if raw.endswith(b"\n") else raw + b"\n"
        if self._raw.count(b"\n") > MAX_LINES:
            raise self.fail(f"it has more than {MAX_LINES:,} lines; reduce the mesh.")
        self._bytes = np.frombuffer(self._raw, np.uint8)
        self._starts = np.concatenate([[0], np.flatnonzero(self._bytes == _NEWLINE) + 1])
        self.colours: NDArray[np.float64] | None = None
        self.library: str | None = None
        self.vertices = self._vertices()
        self._faces = self._lines(b"f")
        self.stretches = self._stretches() if parts else []
        self._places = self._lines(b"vt") if self.library is not None else b""
        del self._raw, self._bytes, self._starts

    def fail(self, what: str) -> UserError:
        """The error to raise about this file."""
        return UserError(f"{self.path}: {what}")

    def vertices_like(self, base: ObjFile) -> NDArray[np.float64]:
        """The vertices, once it is sure that they are the same points of the same surface as `base`'s."""
        if len(self.vertices) != len(base.vertices):
            raise self.fail(
                f"it has {len(self.vertices):,} vertices, {base.path.name} has {len(base.vertices):,}; "
                "export all poses of one mesh, with the order of vertices kept."
            )
        if self._faces != base._faces and not np.array_equal(self.triangles(), base.triangles()):
            raise self.fail(f"its faces are not those of {base.path.name}; export all poses of one mesh.")
        return self.vertices

    def triangles(self) -> NDArray[np.uint32]:
        """(m, 3): polygons cut into fans."""
        plain = _AFTER_SLASH.sub(b"", self._faces).replace(b"\t", b" ")
        sizes = np.array([len(line.split()) for line in plain.split(b"\n") if line.strip()], np.int64)
        numbers = self._numbers(plain, "faces")
        if not (np.abs(numbers) <= MAX_VERTICES).all():
            raise self.fail(f"a face uses a vertex beyond the first {MAX_VERTICES:,}; the file is damaged.")
        corners = numbers.astype(np.int64)
        if not len(sizes) or sizes.min() < 3 or sizes.sum() != len(corners):
            raise self.fail("it has no faces, or some with fewer than three corners; export it as a mesh.")
        count = len(self.vertices)
        corners = np.where(corners < 0, corners + count, corners - 1)
        if corners.min() < 0 or corners.max() >= count:
            raise self.fail(f"a face uses a vertex that is not among its {count:,}; the file is damaged.")
        self._sizes = sizes
        return _fans(corners, sizes).astype(np.uint32)

    def owner(self) -> Ints:
        """(m,) the polygon each triangle was cut from; after `triangles`."""
        return np.repeat(np.arange(len(self._sizes)), self._sizes - 2)

    def texture_corners(self) -> tuple[Floats, Ints] | None:
        """Texture coordinates (t, 2), +v up, and which of them the corners (m, 3) of `triangles` have, -1 for none.

        After `triangles`. None when there are none, or they do not fit: a face without its pictures is still a face.
        """
        rows = self._places.count(b"\n")
        with_slash = _WITHOUT_SLASH.sub(rb"\1/0", self._faces.replace(b"//", b"/0/"))
        try:
            places = np.fromstring(self._places, np.float64, sep=" ")
            corners = np.fromstring(_BEFORE_SLASH.sub(rb"\1", with_slash), np.float64, sep=" ")
        except ValueError:
            return None
        width = len(places) // rows if rows else 0
        if width not in (2, 3) or len(places) != rows * width or len(corners) != self._sizes.sum():
            return None
        corners = np.where(corners < 0, corners + rows, corners - 1)
        if not (np.abs(places) <= LARGEST).all() or not ((corners >= -1) & (corners < rows)).all():
            return None
        return places.reshape(rows, width)[:, :2].astype(np.float32), _fans(corners.astype(np.int64), self._sizes)

    def _stretches(self) -> list[Stretch]:
        """One after the other, the first beginning at 0."""
        starts, lines = self._starts, np.flatnonzero(np.isin(self._bytes[self._starts[:-1]], list(b"ugom")))
        found = [Stretch(0, "", "")]
        if len(lines) > MAX_PARTS:
            return found
        is_face = self._is(b"f")
        before: Ints = np.cumsum(is_face) - is_face
        now = {"o": "", "g": "", "usemtl": ""}
        for line in lines.tolist():
            key, *words = self._raw[starts[line] : starts[line + 1]].decode("utf-8", "replace").split() or [""]
            if key == "mtllib" and words:
                self.library = " ".join(words)
            elif key in now:
                now[key] = " ".join(words)
                first = int(before[line])
                if found[-1].first == first:
                    found.pop()
                found.append(Stretch(first, " ".join(now.values()), now["usemtl"]))
        return found

    def _is(self, key: bytes) -> NDArray[np.bool_]:
        """(lines,) whether a line begins with the key."""
        raw, starts = self._bytes, self._starts[:-1]
        found = np.ones(len(starts), bool)
        for place, allowed in enumerate((*((byte,) for byte in key), (_SPACE, _TAB))):
            found &= np.isin(raw[np.minimum(starts + place, len(raw) - 1)], allowed)
        return found

    def _vertices(self) -> NDArray[np.float64]:
        text = self._lines(b"v")
        rows = text.count(b"\n")
        if rows > MAX_VERTICES:
            raise self.fail(f"it has {rows:,} vertices, more than {MAX_VERTICES:,}; reduce the mesh.")
        numbers = self._numbers(text, "vertices")
        width = len(numbers) // rows if rows else 0
        if width not in (3, 4, 6, 7) or len(numbers) != rows * width:
            raise self.fail("its vertices are not three numbers each; the file is damaged or no .obj mesh.")
        if width >= 6:
            self.colours = numbers.reshape(rows, width)[:, 3:6]
        vertices = numbers.reshape(rows, width)[:, :3]
        if not (np.abs(vertices) <= LARGEST).all():
            raise self.fail(f"a vertex is not a number, or above {LARGEST:,.0f}; export it in metres or centimetres.")
        return vertices

    def _numbers(self, text: bytes, what: str) -> NDArray[np.float64]:
        try:
            return np.fromstring(text, np.float64, sep=" ")  # text only: the quickest parser there is
        except ValueError:
            raise self.fail(f"its {what} hold something that is no number; the file is damaged.") from None

    def _lines(self, key: bytes) -> bytes:
        """What follows the key on all lines that begin with it, one line each."""
        starts = self._starts
        edges = np.flatnonzero(np.diff(np.concatenate([[False], self._is(key), [False]])))
        runs = [self._raw[starts[a] : starts[b]] for a, b in edges.reshape(-1, 2)]
        return b"".join(runs).replace(key, b" ")


def _fans(corners: Ints, sizes: Ints) -> Ints:
    """Polygons of `sizes` corners, one after the other → (m, 3)."""
    first = np.cumsum(sizes) - sizes
    each = sizes - 2
    owner = np.repeat(np.arange(len(sizes)), each)
    step = np.arange(len(owner)) - np.repeat(np.cumsum(each) - each, each)
    start = first[owner]
    return np.stack([corners[start], corners[start + step + 1], corners[start + step + 2]], -1)
