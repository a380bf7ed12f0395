"""A folder as a corpus: every animation with the labels (or recording and transcript) of the same name.

    take1.csv    Live Link Face or ARKit, or weights over poses    take1.TextGrid        labels
    take2.json   weights, as `bake` writes them                     take2.schedule.json   labels
    take3.glb    an animated face                                   take3.wav take3.txt   to be aligned
    take4.csv    captured points, with a key_shapes.csv beside      take4.phn             labels

What cannot be used is left out and said; a corpus of which nothing can be used is refused.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from ..curve_set import CurveSet
from ..errors import UserError
from ..faces.retarget import Preset
from ..files import weights_read
from ..files.atomic import read_bytes, reason
from ..files.labels.read import read as read_labels
from ..files.labels.text import decode
from ..methods.method import Progress, no_progress
from ..schedule import Schedule
from ..speech.labels import utterance_of
from . import capture_csv, gltf_animation, key_shapes
from .corpus import Clip, Corpus
from .cross_map import clip_of
from .key_shapes import KeyShapes

#: Recording, transcript → schedule; None where nothing can align.
Aligner = Callable[[Path, str], Schedule]

MAX_FILES = 20_000
MAX_TRANSCRIPT = 2**20
_SOUNDS = (".wav", ".flac", ".ogg", ".mp3", ".m4a", ".mov", ".mp4")
_LABELS = (".textgrid", ".phn", ".mlf", ".rec", ".phones")
_SCHEDULE = ".schedule.json"
_MESHES = (".glb", ".gltf")
#: Live Link Face's extra files beside a take.
_NO_TAKES = ("_neutral", "_cal_neutral")


@dataclass(frozen=True, eq=False)
class Reader:
    """How a folder's files become clips.

    curve_set  whose poses and phonemes the corpus shall have
    presets    what makes a pose out of a rig's channels
    align      for clips without labels
    """

    curve_set: CurveSet
    presets: tuple[Preset, ...] = field(default=())
    align: Aligner | None = None

    def read(self, folder: Path, progress: Progress = no_progress) -> Corpus:
        """The corpus in a folder and the folders in it; UserError when there is nothing to learn from."""
        animations, files = _animations(folder)
        clips: list[Clip] = []
        notes: list[str] = []
        for done, animation in enumerate(animations):
            progress(done / len(animations), animation.name)
            try:
                clip = self._clip(animation, files)
            except UserError as error:
                notes.append(f"{animation.name} is left out: {error}")
                continue
            clips.append(clip)
        if not clips:
            why = f" {notes[0]}" if notes else ""
            raise UserError(f"Nothing in {folder} can be learned from.{why}")
        return Corpus.of(clips, self.curve_set.phonemes, self.curve_set.phoneme_map, [*notes, *told_once(clips)])

    def _clip(self, animation: Path, files: Sequence[Path]) -> Clip:
        schedule, notes = self._schedule(animation, files)
        if animation.suffix.lower() in _MESHES:
            clip = clip_of(animation.name, gltf_animation.load(animation), schedule, self._poses, self.presets)
        elif (shapes := self._key_shapes(animation)) is not None:
            capture = capture_csv.load(animation, points=True)
            clip = shapes.clip_of(animation.name, capture, schedule, self._poses)
        elif animation.suffix.lower() == ".csv" and capture_csv.is_capture(capture_csv.header_of(animation)):
            clip = clip_of(animation.name, capture_csv.load(animation), schedule, self._poses, self.presets)
        else:
            clip = Clip.of(animation.name, schedule, weights_read.load(animation))
            clip = with_poses(clip, self._poses)
        return trimmed(replace(clip, notes=(*clip.notes, *notes)))

    def _key_shapes(self, animation: Path) -> KeyShapes | None:
        """Those in the animation's folder, when it has their columns."""
        path = animation.with_name(key_shapes.NAME)
        if animation.suffix.lower() != ".csv" or not path.is_file():
            return None
        shapes = key_shapes.load(path)
        return shapes if shapes.fits(capture_csv.header_of(animation)) else None

    @property
    def _poses(self) -> tuple[str, ...]:
        return self.curve_set.poses

    def _schedule(self, animation: Path, files: Sequence[Path]) -> tuple[Schedule, tuple[str, ...]]:
        """The labels whose name is the animation's, or the longest beginning of it."""
        labels = _beside(animation, files, _are_labels)
        if labels is not None:
            known = {*self.curve_set.phonemes, *self.curve_set.phoneme_map}
            named = utterance_of(read_labels(labels), known=known)
            return named.utterance.schedule, named.utterance.notes
        sound = _beside(animation, files, lambda f: f.suffix.lower() in _SOUNDS)
        text = _beside(animation, files, lambda f: f.suffix.lower() in (".txt", ".lab"))
        if sound is None or text is None:
            raise UserError(f"it has no labels; put {animation.stem}.TextGrid, or a recording and its text, beside it.")
        if self.align is None:
            raise UserError(f"{sound.name} cannot be aligned here; put {animation.stem}.TextGrid beside it.")
        words = decode(read_bytes(text, MAX_TRANSCRIPT, "transcript"), str(text), "transcript")
        return self.align(sound, words), ()


def told_once(clips: Sequence[Clip]) -> list[str]:
    """The notes of all clips; what is true of many is said once."""
    names: dict[str, list[str]] = {}
    for clip in clips:
        for note in clip.notes:
            names.setdefault(note, []).append(clip.name)
    return [f"{who[0]}{f' and {len(who) - 1} more' if len(who) > 1 else ''}: {note}" for note, who in names.items()]


def _animations(folder: Path) -> tuple[list[Path], list[Path]]:
    """The files that may hold an animation, and all files."""
    if not folder.is_dir():
        raise UserError(f"{folder} is not a folder: name the folder with the clips and their labels.")
    try:
        files = sorted(path for path in folder.rglob("*") if path.is_file() and not path.name.startswith("."))
    except OSError as error:
        raise UserError(f"Cannot read {folder}: {reason(error)}.") from error
    if len(files) > MAX_FILES:
        raise UserError(f"{folder} has {len(files):,} files, more than a corpus: name a smaller folder.")
    found = [
        path
        for path in files
        if path.suffix.lower() in (".csv", ".json", *_MESHES)
        and not path.name.lower().endswith((_SCHEDULE, ".lipstitch.json"))
        and not path.stem.lower().endswith(_NO_TAKES)
        and path.name.lower() not in ("take.json", "frame_log.csv", key_shapes.NAME)
    ]
    better = {str(path).lower().replace("_cal.csv", ".csv") for path in found if not _is_raw(path)}
    found = [path for path in found if not _is_raw(path) or str(path).lower().replace("_raw.csv", ".csv") not in better]
    if not found:
        raise UserError(f"{folder} holds no animation: .csv, .json, .glb or .gltf, each with its labels beside it.")
    return found, files


def _is_raw(path: Path) -> bool:
    """Live Link Face writes a take twice: as seen, and calibrated, which is the better one."""
    return path.stem.lower().endswith("_raw")


def _are_labels(path: Path) -> bool:
    return path.suffix.lower() in _LABELS or path.name.lower().endswith(_SCHEDULE)


def _beside(animation: Path, files: Iterable[Path], fits: Callable[[Path], bool]) -> Path | None:
    """The file in the animation's folder whose name is the longest beginning of the animation's."""
    best: tuple[int, Path] | None = None
    for path in files:
        stem = path.name[: -len(_SCHEDULE)] if path.name.lower().endswith(_SCHEDULE) else path.stem
        if path != animation and path.parent == animation.parent and fits(path) and _begins(animation.stem, stem):
            best = max(best or (0, path), (len(stem), path))
    return best[1] if best else None


def _begins(name: str, stem: str) -> bool:
    return name == stem or (name.startswith(stem) and name[len(stem)] in "_-. ")


def with_poses(clip: Clip, poses: Sequence[str]) -> Clip:
    """The clip over other poses: those it lacks rest at 0, those that are not wanted go; both are said.

    UserError when it has none of them.
    """
    own = clip.weights.poses
    if own == tuple(poses):
        return clip
    shared = [pose for pose in poses if pose in own]
    if not shared:
        raise UserError(f"its columns ({', '.join(own[:6])}) are none of the poses {', '.join(poses[:9])}.")
    frames = np.zeros((len(clip.weights.frames), len(poses)), np.float32)
    for p, pose in enumerate(poses):
        if pose in own:
            frames[:, p] = clip.weights.frames[:, own.index(pose)]
    blind = tuple(pose for pose in poses if pose not in own)
    notes = [f"{pose} is not in it and stays at 0." for pose in blind]
    notes += [f"{pose} is no pose of the set and is left out." for pose in own if pose not in poses]
    shown = replace(clip.weights, poses=tuple(poses), frames=frames)
    return replace(clip, weights=shown, blind=blind, notes=(*clip.notes, *notes))


def trimmed(clip: Clip) -> Clip:
    """Says how much of labels and animation does not overlap; UserError when hardly anything does."""
    schedule, times = clip.schedule, clip.frame_times
    start, end = max(schedule.start, float(times[0])), min(schedule.end, float(times[-1]))
    if end - start < min(0.05, schedule.duration / 2):
        raise UserError(
            f"labels ({schedule.start:.2f} to {schedule.end:.2f} s) and animation "
            f"({times[0]:.2f} to {times[-1]:.2f} s) do not overlap; give both the same beginning."
        )
    step = 1.5 / clip.weights.fps
    notes = list(clip.notes)
    if (late := schedule.end - float(times[-1])) > max(step, 0.1):
        notes.append(f"the labels last {late:.2f} s longer than the animation; that end is left out.")
    if (early := float(times[0]) - schedule.start) > max(step, 0.1):
        notes.append(f"the animation begins {early:.2f} s after the labels; that beginning is left out.")
    if (rest := float(times[-1]) - schedule.end) > 0.5:
        notes.append(f"the animation lasts {rest:.2f} s longer than the labels; that end is left out.")
    return replace(clip, notes=tuple(notes))
