"""Faces for the commands: which one is meant, with which curves it speaks, and what it is made of."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json
from core_pipeline.files.atomic import write_atomically
from core_pipeline.files.json_text import shown
from core_pipeline.poses import FACEFX

from . import resources

if TYPE_CHECKING:
    from core_pipeline.faces.open_face import Opened


def face_path(face: str | None) -> Path:
    """Where a face is: one of our characters by its name, anything else by its path; Toon when nothing is said.

    A folder that has the name of a character is meant by ./name. UserError for a bare word that is neither.
    """
    if face is None:
        return resources.face_folder()
    ours = {folder.name: folder for folder in resources.characters()}
    if face in ours:
        return ours[face]
    path = Path(face)
    if not path.suffix and path.name == face and not path.exists():
        raise UserError(f"There is no face “{face}”: name {', '.join(ours)}, or a file or folder that is there.")
    return path


def is_ours(path: Path) -> bool:
    """Whether a path is the folder of one of our characters."""
    return path.resolve() in resources.characters()


def curves_of(path: Path) -> Path:
    """The curves a face speaks with unless others are named: those made for its own poses, or English."""
    if is_ours(path):
        own = resources.english_curves().with_name(f"{path.name}.json")
        if own.is_file():
            return own
    return resources.english_curves()


def open_rig(path: Path, poses: Sequence[str] = FACEFX, cancelled: Callable[[], bool] = lambda: False) -> Opened:
    """Any face: one of ours or a user's rig; kept in the user's cache for the next time.

    cancelled  asked now and then; True ends it with a UserError
    """
    from core_pipeline.faces.mapping_json import load_presets
    from core_pipeline.faces.open_face import open_face
    from core_pipeline.faces.rigs import rig_cache

    return open_face(path, load_presets(resources.retarget_presets()), poses, rig_cache.user_cache(), cancelled)


def tell_face(options: argparse.Namespace) -> int:
    """What a face is made of, and which poses of a curve set it can make."""
    path = face_path(options.face)
    opened = open_rig(path, curve_set_json.read(options.curves or curves_of(path)).curve_set.poses)
    face, made = opened.face, opened.retarget
    print(f"{shown(face.title, 200)}: {len(face.positions):,} vertices, {len(face.triangles):,} triangles.")
    print(f"{len(face.shapes)} shapes: {', '.join(shown(name) for name in face.shapes)}.")
    if made.poses:
        print(f"Poses by {shown(made.title, 200)}:")
    for pose, mix in made.poses.items():
        print(f"  {shown(pose)} = {' + '.join(f'{amount:g} {shown(shape)}' for shape, amount in mix.items())}")
    for line in opened.notes:
        print(shown(line, 2000))
    if options.new_set is not None:
        _write_new_set(opened, options.new_set)
    return 0


def _write_new_set(opened: Opened, out: Path) -> None:
    from core_pipeline.faces.pose_set import new_curve_set

    if out.suffix.lower() != ".json":
        raise UserError(f"Cannot write {out}: name the curve set .json.")
    if out.exists():
        raise UserError(f"{out} is already there: choose another name, curves are not overwritten.")
    curve_set = new_curve_set(opened.face)
    write_atomically(out, curve_set_json.dumps(curve_set))
    print(f"An empty curve set over {len(curve_set.poses)} poses in {out}.")
