"""Any face a user brings, opened: read, put upright, looked at from the front, its shapes matched to the poses."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain
from pathlib import Path

import numpy as np

from core_pipeline.errors import UserError
from core_pipeline.faces import face_folder
from core_pipeline.faces.face import Face
from core_pipeline.faces.framing import head_camera, head_height, turned_upright
from core_pipeline.faces.mapping_json import load_mapping, mapping_path
from core_pipeline.faces.retarget import OWN_NAMES, Mix, Preset, Retarget, Rig, best, normalised
from core_pipeline.faces.rigs import rig_cache
from core_pipeline.faces.rigs.glb import read_rig
from core_pipeline.faces.rigs.gltf_weights import Expressions
from core_pipeline.faces.rigs.obj_folder import read_obj_rig
from core_pipeline.faces.rigs.steps import Report, silent
from core_pipeline.files.atomic import reason
from core_pipeline.files.json_text import shown
from core_pipeline.poses import FACEFX

_NAMED = 4
#: Shapes that are there to move nothing: the silence among visemes, the neutral among expressions.
_AT_REST = re.compile(r"(^|viseme|v)sil(ence)?$|neutral$|^basis$|^rest$")

Cancelled = Callable[[], bool]
Read = tuple[Face, tuple[str, ...]]


@dataclass(frozen=True)
class Opened:
    """A face ready to be drawn, how its poses are made, and what is worth knowing, one sentence each."""

    face: Face
    retarget: Retarget
    notes: tuple[str, ...] = ()


def open_face(
    path: Path,
    presets: Iterable[Preset],
    poses: Sequence[str] = FACEFX,
    cache: Path | None = None,
    cancelled: Cancelled = lambda: False,
    progress: Report = silent,
) -> Opened:
    """The face at `path`: a folder of ours, a .glb, .gltf or .vrm file, or a folder of .obj poses.

    presets    naming conventions to try, when no mapping is saved beside the rig and none comes with it
    poses      the pose set of the curves that shall play
    cache      folder in which rigs are kept as read, for the next time
    cancelled  asked after every shape; True ends it with a UserError
    progress   told the share that is read, 0…1
    UserError when there is nothing to open, or it is damaged, or too large.
    """

    def report(share: float) -> None:
        if cancelled():
            raise UserError(f"{path}: opening was cancelled.")
        progress(share)

    presets = tuple(presets)
    ours = path.is_dir() and (path / "face.glb").is_file()
    face, notes = (face_folder.load(path), ()) if ours else _rig(path, cache, report, _expressions_by(presets))
    retarget = _retarget(path, face, presets, poses, ours)
    face = replace(face, pose_map=retarget.poses)
    return Opened(face, retarget, (*notes, *retarget.notes, *_still_poses(face, retarget.poses)))


def _expressions_by(presets: Sequence[Preset]) -> Expressions:
    """Which shapes of a rig any naming convention knows: what is not among them may be of the person."""

    def among(shapes: Sequence[str]) -> set[str]:
        rig = Rig(shapes)
        known = ((preset, name) for preset in presets for name in {*preset.names, *chain(*preset.poses.values())})
        return {shape for preset, name in known for shape in rig.shapes(name, preset)}

    return among


def _rig(path: Path, cache: Path | None, report: Report, among: Expressions) -> Read:
    kept = rig_cache.recall(path, cache) if cache is not None else None
    if kept is not None:
        return kept
    face, files, notes = _read(path, report, among)
    report(1.0)
    face, turned = turned_upright(face)
    face = replace(face, camera=head_camera(face))
    notes = (*notes, *turned, *_health(face))
    if cache is not None:
        rig_cache.keep(path, files, face, notes, cache)
    return face, notes


def _read(path: Path, report: Report, among: Expressions) -> tuple[Face, list[Path], tuple[str, ...]]:
    """The face, the files it was read from, and notes."""
    if path.is_dir():
        if not _obj_files(path):
            raise UserError(f"{path}: there is neither a face.glb nor any .obj file; choose a folder of poses.")
        face, files, notes = read_obj_rig(path, report)
        return face, [path, *files], notes
    kind = path.suffix.casefold()
    if kind == ".obj":
        raise UserError(f"{path}: one .obj has no poses; choose its folder, with one .obj per pose.")
    if kind not in (".glb", ".gltf", ".vrm") and path.is_file():
        raise UserError(f"{path}: faces are .glb, .gltf or .vrm files or folders of .obj; export it as .glb.")
    return read_rig(path, report, among)


def _obj_files(folder: Path) -> list[Path]:
    try:
        return sorted(path for path in folder.iterdir() if path.suffix.casefold() == ".obj")
    except OSError as error:
        raise UserError(f"Cannot read {folder}: {reason(error)}.") from error


def _retarget(path: Path, face: Face, presets: Iterable[Preset], poses: Sequence[str], ours: bool) -> Retarget:
    """The mapping saved beside the rig; else what comes with the face; else the preset that fits best."""
    saved = load_mapping(path)
    if saved is not None and not set(poses).isdisjoint(saved[1]):  # else it was made for another pose set
        return _saved(face, *saved, poses, mapping_path(path))
    if ours:
        mixes = {pose: face.mix(pose) for pose in dict.fromkeys((*face.pose_map, *poses)) if face.mix(pose)}
        return _settled(OWN_NAMES, "its own face.json", mixes, poses)
    return best(face.shapes, presets, poses, face.expressions)


def _saved(face: Face, preset: str, mixes: Mapping[str, Mix], poses: Sequence[str], path: Path) -> Retarget:
    gone = sorted({shape for mix in mixes.values() for shape in mix} - set(face.shapes))
    kept = {
        pose: {shape: amount for shape, amount in mix.items() if shape in face.shapes} for pose, mix in mixes.items()
    }
    note = f"{path.name} uses shapes this face does not have ({_listed(gone)}): they are left out."
    retarget = _settled(preset, f"saved in {path.name}", {pose: mix for pose, mix in kept.items() if mix}, poses)
    return replace(retarget, notes=(note, *retarget.notes)) if gone else retarget


def _settled(name: str, title: str, mixes: Mapping[str, Mix], poses: Sequence[str]) -> Retarget:
    missing = tuple(pose for pose in poses if pose not in mixes)
    notes = (f"Not available on this face: {', '.join(missing)}.",) if missing else ()
    return Retarget(name, title, mixes, missing, notes)


def _health(face: Face) -> tuple[str, ...]:
    """What is odd about the shapes, though they can be played."""
    largest = [float(np.sqrt(np.einsum("ij,ij->i", delta, delta).max(initial=0))) for delta in face.deltas]
    head = head_height(face)
    still = [
        shape
        for shape, motion in zip(face.shapes, largest, strict=True)
        if motion == 0 and not _AT_REST.search(normalised(shape))
    ]
    wild = [shape for shape, motion in zip(face.shapes, largest, strict=True) if motion > head]
    notes = []
    if still:
        notes.append(f"{_counted(still, 'shape moves', 'shapes move')} nothing: {_listed(still)}.")
    if wild:
        notes.append(
            f"{_counted(wild, 'shape moves', 'shapes move')} farther than the head is high: {_listed(wild)}; "
            "was it exported in another unit than the mesh?"
        )
    return tuple(notes)


def _still_poses(face: Face, mixes: Mapping[str, Mix]) -> tuple[str, ...]:
    moving = {shape for shape, delta in zip(face.shapes, face.deltas, strict=True) if delta.any()}
    still = [pose for pose, mix in mixes.items() if not moving & set(mix)]
    return (f"{_counted(still, 'pose moves', 'poses move')} nothing: {_listed(still)}.",) if still else ()


def _counted(names: Sequence[str], one: str, many: str) -> str:
    return f"{len(names)} {one if len(names) == 1 else many}"


def _listed(names: Sequence[str]) -> str:
    return ", ".join(shown(name) for name in names[:_NAMED]) + (" …" if len(names) > _NAMED else "")
