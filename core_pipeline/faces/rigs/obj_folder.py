"""A face from a folder of .obj files: one neutral, and one file per pose with the same vertices and faces.

What it looks like, the neutral alone says.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from core_pipeline.errors import UserError
from core_pipeline.faces.face import Face
from core_pipeline.faces.framing import frame
from core_pipeline.faces.normals import shape_normals
from core_pipeline.faces.retarget import normalised
from core_pipeline.faces.rigs.limits import MAX_MORPH_BYTES
from core_pipeline.faces.rigs.obj_file import ObjFile
from core_pipeline.faces.rigs.obj_surface import surface
from core_pipeline.faces.rigs.steps import Report, Steps, silent
from core_pipeline.files.json_text import shown

MAX_POSES = 1000

_NEUTRAL = frozenset({"neutral", "rest", "base", "basis", "default", "neutralpose", "restpose"})
#: Other heads beside the expressions of one, as sets made from scans have them.
_IDENTITY = re.compile(r"identity_?\d+")


def read_obj_folder(folder: Path, report: Report = silent) -> tuple[Face, tuple[str, ...]]:
    """The face in a folder, and notes about it.

    UserError when there is no neutral, a file is damaged or too large, or a pose has other vertices or faces than
    the neutral. `report` is told before every file, and after every shape.
    """
    face, _, notes = read_obj_rig(folder, report)
    return face, notes


def read_obj_rig(folder: Path, report: Report = silent) -> tuple[Face, list[Path], tuple[str, ...]]:
    """The face in a folder, all the files it was read from, and notes about it; else as `read_obj_folder`."""
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
    base = ObjFile(neutral, parts=True)
    _check_room(folder, len(base.vertices), len(poses))
    looks = surface(base, folder.name)
    _check_room(folder, len(looks.source), len(poses))
    step = Steps(2 * len(poses), report)
    deltas = np.zeros((len(poses), len(looks.source), 3), np.float32)
    for row, path in enumerate(poses):
        step()
        deltas[row] = (ObjFile(path).vertices_like(base) - base.vertices)[looks.source]
    positions = base.vertices[looks.source].astype(np.float32)
    normals, normal_deltas = shape_normals(positions, looks.triangles, deltas, step=step)
    face = Face(
        name=folder.name,
        title=folder.name,
        positions=positions,
        normals=normals,
        triangles=looks.triangles,
        colours=looks.colours,
        shapes=tuple(path.stem for path in poses),
        deltas=deltas,
        normal_deltas=normal_deltas,
        parts=looks.parts,
        camera=frame(positions),
        textures=looks.textures,
        materials=looks.materials,
        texcoords=looks.texcoords,
    )
    return face, [*paths, *looks.files], (*notes, *looks.notes)


def _check_room(folder: Path, count: int, poses: int) -> None:
    if count * poses * 24 > MAX_MORPH_BYTES:
        raise UserError(f"{folder}: {count:,} vertices × {poses} poses need more than 512 MB; reduce the mesh.")


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
