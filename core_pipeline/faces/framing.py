"""Where to look from, and which way a rig faces: found in the mesh and its shapes, in any unit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from core_pipeline.faces.face import Camera, Face, Floats
from core_pipeline.faces.retarget import normalised

_FOV = 24.0
#: Height of the picture in heights of what moves: brow to chin is about two thirds of a head.
_AROUND = 0.75
#: Vertices that move less than this part of the usual motion do not tell where the face is, nor do wild shapes.
_MOVES, _WILD = 0.05, 10.0
#: Nor do shapes that move so many times as wide a part of the mesh as most do.
_BROAD = 4.0
_LONGER = 1.1
#: Parts below which a picture of a head may end, and how much of them it shows, in heights of the head.
_SHOULDERS = ("shirt", "collar", "neck")
_SHOULDER = 0.06
#: What goes on below the face by more than this part of its height is a body; and how much of its neck is shown.
_BODY, _NECK = 0.5, 0.18
#: Beyond this part of the half picture nothing was meant to be seen.
_SEEN = 1.1
#: So high, in the same parts, a crown may stand over the middle.
_CROWN = 2.0
#: Points that tell the outline of any mesh; of a finer one only some are looked at.
_ENOUGH = 8_000
#: Width of a close view in widths of the mouth.
_ROUND_MOUTH = 1.7
#: The mouth of a rig that names no lips is what its poses move by this part of what they move most.
_LIPS = 0.7
#: Narrower than this part of the face is no mouth.
_POINT = 0.1
_OPEN = frozenset({"jawopen", "open", "mouthopen", "visemeaa", "jawdrop", "vopen", "aa", "fclmtha", "a"})


def frame(positions: Floats) -> Camera:
    """A camera that shows all of a mesh from the front."""
    return _camera(positions.min(0).astype(float), positions.max(0).astype(float))


def head_camera(face: Face) -> Camera:
    """A camera that shows the head: where the shapes move the mesh, and as much again, within the mesh.

    Of a body, what is below the chin is cut to a bit of neck.
    """
    moved = _moving(face)
    if not moved.any():
        return frame(face.positions)
    inside = face.positions[moved].astype(float)
    low, high = inside.min(0), inside.max(0)
    around = _AROUND * max(*(high - low)[:2], 1e-9)
    centre = (low + high) / 2
    mesh_low, mesh_high = face.positions.min(0).astype(float), face.positions.max(0).astype(float)
    head = _head(face, moved)
    if head is None:
        return _camera(np.maximum(centre - around, mesh_low), np.minimum(centre + around, mesh_high))
    low, high = head.min(0).astype(float), head.max(0).astype(float)
    low[1] -= _NECK * (high - low)[1]
    return _camera(low, high)


def head_height(face: Face) -> float:
    """Height of the head, in the mesh's unit: of all that stands around what moves, or of everything."""
    moved = _moving(face)
    return float(np.ptp((_near(face, moved) if moved.any() else face.positions)[:, 1]))


def head_outline(face: Face) -> Floats:
    """(m, 3) of the neutral face: what a picture of it must show, the head from its highest hair to below the chin.

    A bust is cut where the shoulders begin, an avatar where its head ends; a face that names no such parts is
    shown whole, as far as its own camera looks.
    """
    points = face.positions
    for name in _SHOULDERS:
        if name in face.parts:
            top = face.positions[_corners(face, name), 1].max()
            head = points[points[:, 1] >= top]
            x, _, z = face.camera.target
            below = np.array([[x, top - _SHOULDER * (head[:, 1].max() - top), z]], np.float32)
            return np.vstack([_silhouette(head), below])
    moved = _moving(face)
    body = _head(face, moved) if moved.any() else None
    if body is not None:
        x, _, z = face.camera.target
        bottom, top = body[:, 1].min(), body[:, 1].max()
        return np.vstack([_silhouette(body), np.array([[x, bottom - _NECK * (top - bottom), z]], np.float32)])
    camera = face.camera
    reach = _SEEN * camera.distance * np.tan(np.radians(camera.fov / 2))
    across, up = (points[:, :2] - np.asarray(camera.target, np.float32)[:2]).T
    # A jaw tells little of the crown: over the head there is nothing else, so all that is up there belongs to it.
    seen = (np.abs(across) <= reach) & (up >= -reach) & (up <= _CROWN * reach)
    return _silhouette(points[seen] if seen.any() else points)


def mouth_outline(face: Face) -> Floats:
    """(m, 3) of the neutral face: the mouth and what is round it, for a view from near."""
    if "lips" in face.parts:
        mouth = face.positions[_corners(face, "lips")]
    else:
        mouth = face.positions[_lips(face)]
    low, high = mouth.min(0), mouth.max(0)
    middle, wide = (low + high) / 2, _ROUND_MOUTH * float((high - low)[0])
    corners = np.array([(x, y, z) for x in (-1, 1) for y in (-0.8, 0.8) for z in (0,)], np.float32)
    around: Floats = (middle + corners * wide / 2).astype(np.float32)
    return around


def turned_upright(face: Face) -> tuple[Face, tuple[str, ...]]:
    """The face with +y up and looking along +z, and what had to be done for that.

    Rigs exported with +z up lie on their back. VRM 0 avatars look backwards: what moves lies behind the middle of
    the head.
    """
    notes: list[str] = []
    moved = _moving(face)
    if not moved.any():
        return face, ()
    if _lies(face, moved):
        face = _turned(face, np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]], np.float32))
        notes.append("The rig was made with z up: it is shown turned upright.")
    if _looks_back(face, moved):
        face = _turned(face, np.array([[-1, 0, 0], [0, 1, 0], [0, 0, -1]], np.float32))
        notes.append("The rig looked backwards: it is shown turned round.")
    return face, tuple(notes)


def _camera(low: NDArray[np.float64], high: NDArray[np.float64]) -> Camera:
    x, y, z = ((low + high) / 2).tolist()
    size = float((high - low)[:2].max()) or float((high - low).max()) or 1.0
    # The nearest point is before the middle, and larger for that.
    distance = 0.56 * size / np.tan(np.radians(_FOV / 2)) + 0.25 * float((high - low)[2])
    return Camera(target=(x, y, z), distance=float(distance), fov=_FOV)


def _moving(face: Face) -> NDArray[np.bool_]:
    """(n,) whether a vertex moves noticeably in some shape, of those that move about as far as most do.

    Shapes of the whole body, such as its age or build, tell nothing of where the face is.
    """
    squares = [np.einsum("ij,ij->i", delta, delta) for delta in face.deltas]
    reach = np.sqrt([square.max(initial=0) for square in squares])
    usual = float(np.median(reach[reach > 0])) if reach.any() else 0.0
    moved = [
        square > (_MOVES * usual) ** 2
        for square, far in zip(squares, reach, strict=True)
        if _MOVES * usual < far <= _WILD * usual
    ]
    wide = [float(np.ptp(face.positions[mine], axis=0).max()) for mine in moved]
    most = _BROAD * float(np.median(wide)) if any(wide) else 0.0
    local = [mine for mine, width in zip(moved, wide, strict=True) if width <= most or not most]
    everywhere: NDArray[np.bool_] = np.any(local, axis=0) if local else np.zeros(len(face.positions), bool)
    return everywhere


def _lies(face: Face, moved: NDArray[np.bool_]) -> bool:
    """Whether z is up: the head is higher in z than in y, and the jaw drops along z.

    A jaw drops and goes back; where it goes back along y, it seems to rise.
    """
    _, high, deep = np.ptp(_near(face, moved), axis=0)
    _, up, out = _opening(face).sum(axis=0)
    return bool(deep > _LONGER * high and out < 0 and (up > 0 or out < up))


def _opening(face: Face) -> Floats:
    """(n, 3) what opens the mouth: by its name, else the shape that moves most."""
    named = [row for row, shape in enumerate(face.shapes) if normalised(shape) in _OPEN]
    most = int(np.abs(face.deltas).sum(axis=(1, 2)).argmax())
    opening: Floats = face.deltas[named[0] if named else most]
    return opening


def _looks_back(face: Face, moved: NDArray[np.bool_]) -> bool:
    near = _near(face, moved)
    low, high = near[:, 2].min(), near[:, 2].max()
    middle = float(face.positions[moved, 2].mean())
    return bool(middle < low + 0.4 * (high - low))


def _near(face: Face, moved: NDArray[np.bool_]) -> Floats:
    """The vertices around what moves: the head, without the body of an avatar."""
    inside = face.positions[moved]
    centre, reach = (inside.min(0) + inside.max(0)) / 2, np.ptp(inside, axis=0).max()
    near: Floats = face.positions[(np.abs(face.positions - centre) <= reach).all(axis=1)]
    return near


def _head(face: Face, moved: NDArray[np.bool_]) -> Floats | None:
    """(m, 3) the head on a body, from the chin to all that stands over it; None where hardly anything is below."""
    inside, points = face.positions[moved], face.positions
    (low_x, chin, _), (high_x, brow, _) = inside.min(0), inside.max(0)
    if points[:, 1].min() > chin - _BODY * (brow - chin):
        return None
    reach = max(high_x - low_x, brow - chin)
    head: Floats = points[(points[:, 1] >= chin) & (np.abs(points[:, 0] - (low_x + high_x) / 2) <= reach)]
    return head


def _turned(face: Face, turn: Floats) -> Face:
    return replace(
        face,
        positions=face.positions @ turn.T,
        normals=face.normals @ turn.T,
        deltas=face.deltas @ turn.T,
        normal_deltas=face.normal_deltas @ turn.T,
    )


def _corners(face: Face, part: str) -> NDArray[np.uint32]:
    """The vertices of a part."""
    first, count = face.parts[part]
    return np.unique(face.triangles[first : first + count])


def _lips(face: Face) -> NDArray[np.bool_]:
    """(n,) the lips of a rig that names none: what most of its poses move most, those apart that drop the jaw.

    Where that is a mere point, the lower half of what moves.
    """
    moving = _moving(face)
    if not moving.any():
        return np.ones(len(face.positions), bool)
    x, y, _ = face.positions.T
    jaw = {shape for shape in face.shapes if normalised(shape) in _OPEN}
    share = np.zeros(len(face.positions), np.float32)
    for pose in face.pose_map:
        mix = face.mix(pose)
        rows = [face.shapes.index(shape) for shape in mix if shape in face.shapes and shape not in jaw]
        if rows and len(rows) >= len(mix) / 2:
            amounts = np.array([mix[face.shapes[row]] for row in rows], np.float32)
            moved = np.linalg.norm(np.tensordot(amounts, face.deltas[rows], 1), axis=1)
            share += moved / max(float(moved.max()), 1e-12)
    lips: NDArray[np.bool_] = share > _LIPS * share.max()
    if lips.any() and np.ptp(x[lips]) > _POINT * np.ptp(x[moving]):
        return lips
    lower: NDArray[np.bool_] = moving & (y <= np.median(y[moving]))
    return lower


def _silhouette(points: Floats) -> Floats:
    """Those of the points that stand out farthest in some direction: as good as all for a frame, and few."""
    turn, lift = np.meshgrid(np.linspace(0, 2 * np.pi, 24, endpoint=False), np.linspace(-1.4, 1.4, 9))
    rays = np.stack([np.cos(lift) * np.sin(turn), np.sin(lift), np.cos(lift) * np.cos(turn)], -1).reshape(-1, 3)
    ends = points[np.concatenate([points.argmin(axis=0), points.argmax(axis=0)])]
    points = np.vstack([ends, points[:: max(len(points) // _ENOUGH, 1)]])
    outline: Floats = points[np.unique((points @ rays.T.astype(np.float32)).argmax(axis=0))]
    return outline
