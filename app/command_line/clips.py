"""`lipstitch render`: a face saying a sentence, as a clip with sound or as a folder of PNG frames and the sound."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from core_pipeline import pipeline
from core_pipeline.errors import UserError
from core_pipeline.speech.utterance import Utterance
from core_pipeline.weights import Weights
from core_pipeline.weights import bake as bake_weights

from ..rigs import curves_of, face_path, open_rig
from .progress import Progress
from .steps import load_curves, load_model, make_folder, save_sound, say, tell, tell_missing

if TYPE_CHECKING:
    from .frames import FaceFrames

#: Kinds of clip a user may ask for in vain, rather than a folder of that name.
OTHER_CLIPS = (".mov", ".m4v", ".webm", ".mkv", ".avi", ".gif", ".apng")


def render(options: argparse.Namespace) -> int:
    """The face saying a sentence: a clip when the output is named .mp4, else a folder."""
    out: Path = options.out
    kind = out.suffix.lower()
    if not 1 <= options.fps <= 240:
        raise UserError(f"{options.fps:g} frames per second is not possible: choose 1 to 240 for --fps.")
    if kind in OTHER_CLIPS:
        raise UserError(f"Cannot write {out}: name a clip .mp4, or name a folder for PNG frames.")
    face = face_path(options.face)
    curve_set = load_curves(options, curves_of(face))
    utterance = say(options.text, options.voice)
    stages = pipeline.run(utterance.schedule, curve_set)
    if options.method is None:
        tell_missing(stages)
    weights = bake_weights(stages.magenta, curve_set.effective_settings.spline, options.fps)
    if options.method is not None:
        weights = load_model(options.method).synthesize(utterance.schedule, stages.poses, options.fps)
    opened = open_rig(face, stages.poses)
    for line in opened.notes if options.face else ():
        tell(line)

    from .frames import FaceFrames
    from .mp4 import even

    size = even(options.size) if kind == ".mp4" else options.size
    if size != options.size:
        tell(f"a clip's width and height are even: it is {size[0]}x{size[1]}.")
    frames = FaceFrames(opened.face, stages.poses, size)
    if kind == ".mp4":
        _write_clip(frames, weights, utterance, out, options.still)
    else:
        _write_folder(frames, weights, utterance, out, options.still)
    print(f"{len(weights.frames)} frames at {options.fps:g} per second in {out}")
    return 0


def _write_clip(frames: FaceFrames, weights: Weights, utterance: Utterance, out: Path, still: bool) -> None:
    from .mp4 import Mp4

    with Mp4(out, frames.size, weights.fps, utterance.audio) as clip, _progress(weights) as progress:
        for i, row in enumerate(weights.frames, 1):
            clip.add(frames.pixels(row, life=None if still else (i - 1) / weights.fps))
            progress.step(i)


def _write_folder(frames: FaceFrames, weights: Weights, utterance: Utterance, out: Path, still: bool) -> None:
    from .frames import save_png

    make_folder(out)
    with _progress(weights) as progress:
        for i, row in enumerate(weights.frames):
            picture = frames.picture(row, life=None if still else i / weights.fps)
            save_png(picture, out / f"frame_{i:05d}.png")
            progress.step(i + 1)
    if utterance.audio is not None:
        save_sound(utterance, out / "sound.wav")


def _progress(weights: Weights) -> Progress:
    return Progress(len(weights.frames), "frames")
