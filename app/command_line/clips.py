"""`lipstitch render`: faces saying a sentence, as a clip with sound or as a folder of PNG frames and the sound."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from core_pipeline import pipeline
from core_pipeline.errors import UserError
from core_pipeline.speech.utterance import Utterance
from core_pipeline.weights import Weights
from core_pipeline.weights import bake as bake_weights

from ..rigs import curves_of, face_path, open_rig
from .look_options import angle_of, look_of
from .progress import Progress
from .steps import load_curves, load_model, make_folder, save_sound, say, tell, tell_missing

if TYPE_CHECKING:
    from .frames import GroupFrames

#: Faces side by side.
MOST = 3
#: Weights per frame, and their poses.
Spoken = tuple[Weights, tuple[str, ...]]
#: Kinds of clip a user may ask for in vain, rather than a folder of that name.
OTHER_CLIPS = (".mov", ".m4v", ".webm", ".mkv", ".avi", ".gif", ".apng")


def render(options: argparse.Namespace) -> int:
    """The faces saying a sentence: a clip when the output is named .mp4, else a folder."""
    out: Path = options.out
    kind = out.suffix.lower()
    if not 1 <= options.fps <= 240:
        raise UserError(f"{options.fps:g} frames per second is not possible: choose 1 to 240 for --fps.")
    if kind in OTHER_CLIPS:
        raise UserError(f"Cannot write {out}: name a clip .mp4, or name a folder for PNG frames.")
    faces = [face_path(name) for name in options.face or [None]]
    if len(faces) > MOST:
        raise UserError(f"{len(faces)} faces do not fit side by side: name --face {MOST} times at most.")
    utterance = say(options.text, options.voice)
    voices: dict[Path | None, Spoken] = {}  # by curve set: faces of one pose set share what they say
    cast, rows = [], []
    for path in faces:
        own = curves_of(path) if options.curves is None else None
        if own not in voices:
            voices[own] = _spoken(options, own, utterance)
        weights, poses = voices[own]
        opened = open_rig(path, poses)
        for line in opened.notes if options.face else ():
            tell(line if len(faces) == 1 else f"{opened.face.title}: {line}")
        cast.append((opened.face, poses))
        rows.append(weights.frames)
    if len(voices) > 1:
        names = ", ".join(path.name for path in voices if path is not None)
        tell(f"these faces have different poses: each speaks with its own curves ({names}).")

    from .frames import GroupFrames
    from .mp4 import even

    wanted = options.size or ((512, 512) if len(faces) == 1 else (384 * len(faces), 512))
    size = even(wanted) if kind == ".mp4" else wanted
    if size != wanted:
        tell(f"a clip's width and height are even: it is {size[0]}x{size[1]}.")
    frames = GroupFrames(cast, size, look_of(options), angle_of(options))
    pictures = Pictures(frames, _together(rows), options.fps, not options.still, options.turntable)
    if kind == ".mp4":
        _write_clip(pictures, utterance, out)
    else:
        _write_folder(pictures, utterance, out)
    print(f"{len(pictures.rows)} frames at {options.fps:g} per second in {out}")
    return 0


def _spoken(options: argparse.Namespace, usual: Path | None, utterance: Utterance) -> Spoken:
    """Weights per frame and their poses: by a curve set, or by a method that has learnt."""
    curve_set = load_curves(options, usual)
    stages = pipeline.run(utterance.schedule, curve_set)
    if options.method is not None:
        return load_model(options.method).synthesize(utterance.schedule, stages.poses, options.fps), stages.poses
    tell_missing(stages)
    return bake_weights(stages.magenta, curve_set.effective_settings.spline, options.fps), stages.poses


def _together(rows: Sequence[NDArray[np.floating]]) -> list[list[NDArray[np.floating]]]:
    """Frame by frame what each face shows, (poses,) each; who has said all first, rests."""
    longest = max(len(frames) for frames in rows)
    rested = [np.vstack([frames, np.zeros((longest - len(frames), frames.shape[1]))]) for frames in rows]
    return [[frames[i] for frames in rested] for i in range(longest)]


@dataclass(frozen=True)
class Pictures:
    """What is drawn, frame by frame."""

    frames: GroupFrames
    rows: list[list[NDArray[np.floating]]]
    fps: float
    lively: bool
    turning: bool

    def moments(self) -> Iterator[tuple[list[NDArray[np.floating]], float | None, float | None]]:
        """The arguments of `GroupFrames`: weights, the time of idle life, the time on the turntable."""
        for i, row in enumerate(self.rows):
            seconds = i / self.fps
            yield row, seconds if self.lively else None, seconds if self.turning else None


def _write_clip(pictures: Pictures, utterance: Utterance, out: Path) -> None:
    from .mp4 import Mp4

    clip = Mp4(out, pictures.frames.size, pictures.fps, utterance.audio)
    with clip, Progress(len(pictures.rows), "frames") as progress:
        for number, moment in enumerate(pictures.moments(), 1):
            clip.add(pictures.frames.pixels(*moment))
            progress.step(number)


def _write_folder(pictures: Pictures, utterance: Utterance, out: Path) -> None:
    from .frames import save_png

    make_folder(out)
    with Progress(len(pictures.rows), "frames") as progress:
        for number, moment in enumerate(pictures.moments()):
            save_png(pictures.frames.picture(*moment), out / f"frame_{number:05d}.png")
            progress.step(number + 1)
    if utterance.audio is not None:
        save_sound(utterance, out / "sound.wav")
