"""A face from a folder of .obj files: one neutral, and one file per pose with the same vertices and faces.

Only `v` and `f` lines count. General mesh readers split vertices where texture coordinates differ, and then
the files no longer correspond; this one keeps every vertex at its own number.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from core_pipeline.errors import UserError
from core_pipeline.faces.face import Face, Floats
from core_pipeline.faces.framing import frame
from core_pipeline.faces.limits import LARGEST, MAX_MORPH_BYTES, MAX_TEXT, MAX_VERTICES
from core_pipeline.faces.normals import shape_normals
from core_pipeline.faces.obj_colours import SKIN, linear, part_colours
from core_pipeline.faces.retarget import normalised
from core_pipeline.faces.scaffold import LEFT_OUT, is_scaffold
from core_pipeline.faces.steps import Report, Steps, silent
from core_pipeline.files.atomic import read_bytes
from core_pipeline.files.json_text import shown

MAX_POSES = 1000
MAX_LINES = 12_000_000
#: Named parts whose names are looked at.
MAX_PARTS = 10_000

_NEUTRAL = frozenset({"neutral", "rest", "base", "basis", "default", "neutralpose", "restpose"})
#: Other heads beside the expressions of one, as sets made from scans have them.
_IDENTITY = re.compile(r"identity_?\d+")
_AFTER_SLASH = re.compile(rb"/\S*")
_NEWLINE, _SPACE, _TAB = 10, 32, 9

Ints = NDArray[np.int64]


def read_obj_folder(folder: Path, report: Report = silent) -> tuple[Face, tuple[str, ...]]:
    """The face in a folder, and notes about it.

    UserError when there is no neutral, a file is damaged or too large, or a pose has other vertices or faces than
    the neutral. `report` is told before every file, and after every shape.
    """
    paths = sorted(path for path in folder.iterdir() if path.suffix.casefold() == ".obj" and path.is_file())
    neutral = _neutral(folder, paths)
    poses = [path for path in paths if path != neutral and not _IDENTITY.fullmatch(path.stem.casefold())]
    others = len(paths) - 1 - len(poses)
    notes: tuple[str, ...] = (
        (f"{others} identity files make other heads, not expressions: they are left out.",) if others else ()
    )
    if not poses:
        raise UserError(f"{folder}: there are no poses beside {neutral.name}; export one .obj per pose.")
    if len(poses) > MAX_POSES:
        raise UserError(f"{folder}: {len(poses):,} .obj files are more than {MAX_POSES:,}; keep the poses only.")
    base = _Obj(neutral, parts=True)
    count = len(base.vertices)
    if count * len(poses) * 24 > MAX_MORPH_BYTES:
        raise UserError(f"{folder}: {count:,} vertices × {len(poses)} poses need more than 512 MB; reduce the mesh.")
    triangles, colours = _dressed(base)
    notes += (LEFT_OUT,) * any(is_scaffold(name) for _, name in base.part_names())
    step = Steps(2 * len(poses), report)
    deltas = np.zeros((len(poses), count, 3), np.float32)
    for row, path in enumerate(poses):
        step()
        deltas[row] = _Obj(path).vertices_like(base) - base.vertices
    positions = base.vertices.astype(np.float32)
    normals, normal_deltas = shape_normals(positions, triangles, deltas, step=step)
    face = Face(
        name=folder.name,
        title=folder.name,
        positions=positions,
        normals=normals,
        triangles=triangles,
        colours=colours,
        shapes=tuple(path.stem for path in poses),
        deltas=deltas,
        normal_deltas=normal_deltas,
        parts={folder.name: (0, len(triangles))},
        camera=frame(positions),
    )
    return face, notes


def _dressed(base: _Obj) -> tuple[NDArray[np.uint32], Floats]:
    """The triangles that can be seen, and a colour for every vertex."""
    triangles, owner = base.triangles(), base.owner()
    colours = np.tile(np.array(SKIN, np.float32), (len(base.vertices), 1))
    names = base.part_names()
    part = np.repeat(np.arange(len(names)), np.diff([*(first for first, _ in names), owner.max() + 1]))[owner]
    shown = np.ones(len(triangles), bool)
    found = part_colours([name for _, name in names], base.path.parent, base.library)
    for number, colour in enumerate(found):
        mine = part == number
        shown[mine] = colour is not None and not is_scaffold(names[number][1])
        if colour is not None:
            colours[triangles[mine].ravel()] = colour
    if base.colours is not None:
        colours[:, :3] = linear(base.colours)
    return triangles[shown] if shown.any() else triangles, colours


def _neutral(folder: Path, paths: list[Path]) -> Path:
    exact = [path for path in paths if normalised(path.stem) in _NEUTRAL]
    found = exact or [path for path in paths if "neutral" in path.stem.casefold()]
    if len(found) == 1:
        return found[0]
    if found:
        names = " and ".join(shown(path.name) for path in found[:2])
        raise UserError(f"{folder}: both {names} could be the neutral face; keep one of them.")
    raise UserError(
        f"{folder}: none of its {len(paths)} .obj files is the neutral face; name the face at rest neutral.obj."
    )


class _Obj:
    """One file: `vertices` (n, 3), `colours` (n, 3) or None; its faces are read only when asked for."""

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
        self._parts = self._named_parts() if parts else []
        del self._raw, self._bytes, self._starts

    def fail(self, what: str) -> UserError:
        """The error to raise about this file."""
        return UserError(f"{self.path}: {what}")

    def vertices_like(self, base: _Obj) -> NDArray[np.float64]:
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

    def part_names(self) -> list[tuple[int, str]]:
        """(first polygon, "group material") of each stretch of polygons, the first beginning at 0."""
        return self._parts

    def _named_parts(self) -> list[tuple[int, str]]:
        starts, lines = self._starts, np.flatnonzero(np.isin(self._bytes[self._starts[:-1]], list(b"ugom")))
        if len(lines) > MAX_PARTS:
            return [(0, "")]
        is_face = self._is(b"f")
        before: Ints = np.cumsum(is_face) - is_face
        parts = [(0, "")]
        now = {"o": "", "g": "", "usemtl": ""}
        for line in lines.tolist():
            key, *words = self._raw[starts[line] : starts[line + 1]].decode("utf-8", "replace").split() or [""]
            if key == "mtllib" and words:
                self.library = " ".join(words)
            elif key in now:
                now[key] = " ".join(words)
                first = int(before[line])
                parts = [part for part in parts if part[0] < first] if parts[-1][0] == first else parts
                parts.append((first, " ".join(now.values())))
        return parts

    def _is(self, key: bytes) -> NDArray[np.bool_]:
        """(lines,) whether a line begins with the key."""
        raw, starts = self._bytes, self._starts
        second = raw[np.minimum(starts[:-1] + 1, len(raw) - 1)]
        found: NDArray[np.bool_] = (raw[starts[:-1]] == key[0]) & ((second == _SPACE) | (second == _TAB))
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
