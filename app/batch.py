"""The commands that work on files, without Qt: bake, check, render, and the demo where there is no display."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from core_pipeline import pipeline
from core_pipeline.curve_set import STATUSES, CurveSet
from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json, schedule_json, stages_json, weights_files
from core_pipeline.files.atomic import read_bytes, reason
from core_pipeline.files.json_text import shown
from core_pipeline.phonemes import SILENCE, pair_name
from core_pipeline.pipeline import Stages
from core_pipeline.poses import FACEFX
from core_pipeline.settings import PRESETS
from core_pipeline.speech.speaker import speak
from core_pipeline.speech.utterance import Utterance
from core_pipeline.speech.wav import write_wav
from core_pipeline.weights import bake as bake_weights
from core_pipeline.weights import sample

from . import resources

if TYPE_CHECKING:
    from core_pipeline.faces.open_face import Opened

#: Nine hours at 30 frames a second.
MAX_FRAMES = 1_000_000


def load_curves(options: argparse.Namespace) -> CurveSet:
    """The curve set the options name, with their preset; repairs are told on stderr."""
    reading = curve_set_json.read(options.curves or resources.english_curves())
    for line in reading.repairs:
        print(f"lipstitch: {line}", file=sys.stderr)
    if reading.newer:
        print(
            f"lipstitch: {options.curves} was written by a newer Lipstitch; this one may misread it.", file=sys.stderr
        )
    curve_set = reading.curve_set
    return curve_set.with_settings(PRESETS[options.preset]) if options.preset else curve_set


def bake(options: argparse.Namespace) -> int:
    """A sentence or a schedule → weights, stages, schedule, sound."""
    if (options.text is None) == (options.schedule is None):
        raise UserError("Say what to bake: either a sentence in quotes, or --schedule FILE.")
    outputs = [options.out, options.stages, options.schedule_out, options.sound]
    if not any(outputs):
        raise UserError("Nothing to write: name a file with --out weights.json (or .csv), or with --stages.")
    if not 1 <= options.fps <= 1000:
        raise UserError(f"{options.fps:g} frames per second is not possible: choose 1 to 1000 for --fps.")
    _refuse_same_file([options.curves, options.schedule], outputs)
    curve_set = load_curves(options)
    settings = curve_set.effective_settings
    if options.spline:
        settings = settings.with_spline(options.spline)
    utterance = None
    if options.schedule is not None:
        schedule = schedule_json.load(options.schedule, curve_set)
    else:
        utterance = _say(options.text, options.voice)
        schedule = utterance.schedule
    if options.out and schedule.duration * options.fps > MAX_FRAMES:
        raise UserError(
            f"{schedule.duration:g} s at {options.fps:g} frames per second are more than {MAX_FRAMES:,} frames: "
            "choose a lower --fps or a shorter schedule."
        )
    stages = pipeline.run(schedule, curve_set, settings)
    _tell_missing(stages)
    if options.out:
        weights_files.save(
            bake_weights(stages.magenta, settings.spline, options.fps, snap=not options.no_snap), options.out
        )
    if options.stages:
        stages_json.save(stages, options.stages)
    if options.schedule_out:
        schedule_json.save(schedule, options.schedule_out)
    if options.sound:
        _save_sound(utterance, options.sound)
    return 0


def _refuse_same_file(inputs: list[Path | None], outputs: list[Path | None]) -> None:
    """UserError when an output would destroy what is read, or another output."""
    seen = {path.absolute() for path in inputs if path is not None}
    for path in filter(None, outputs):
        if path.absolute() in seen or (path.is_file() and any(p.exists() and path.samefile(p) for p in seen)):
            raise UserError(f"{path} is named twice, and would be overwritten: give each file a name of its own.")
        seen.add(path.absolute())


def check(path: Path) -> int:
    """Counts and missing bigrams of a curve set, or one line per problem."""
    data = read_bytes(path, curve_set_json.MAX_BYTES, "curve set")
    reading, problems = curve_set_json.examine(data, str(path))
    problems = [*problems, *(reading.repairs if reading is not None else ())]
    if reading is not None:
        for line in _summary(reading.curve_set):
            print(line)
        if reading.newer:
            problems.append(f"{path} was written by a newer Lipstitch; this one may misread it.")
    for line in problems:
        print(shown(line, 2000))
    return 1 if problems else 0


def _summary(curve_set: CurveSet) -> list[str]:
    pairs = [p for p in curve_set.bigrams if SILENCE not in p]
    with_silence = len(curve_set.bigrams) - len(pairs)
    curves = [c for b in curve_set.bigrams.values() for c in b.curves.values()]
    statuses = [curve_set.status_of(p) for p in pairs]
    counts = ", ".join(f"{statuses.count(s)} {s}" for s in STATUSES if s in statuses)
    missing = [pair_name(p) for p in curve_set.missing()]
    total = len(curve_set.phonemes) ** 2
    keys = sum(map(len, curves))
    return [
        f"{curve_set.name} ({curve_set.language}): {len(pairs)} of {total} bigrams and {with_silence} with silence.",
        f"{len(curves)} curves with {keys} keys over {len(curve_set.poses)} poses.",
        f"Status: {counts or 'none'}.",
        f"Missing: {len(missing)}{': ' + ' '.join(missing) if missing else ''}.",
    ]


def render(options: argparse.Namespace) -> int:
    """The face saying a sentence, as PNG frames and its sound."""
    if not 1 <= options.fps <= 240:
        raise UserError(f"{options.fps:g} frames per second is not possible: choose 1 to 240 for --fps.")
    curve_set = load_curves(options)
    utterance = _say(options.text, options.voice)
    stages = pipeline.run(utterance.schedule, curve_set)
    _tell_missing(stages)
    weights = bake_weights(stages.magenta, curve_set.effective_settings.spline, options.fps)
    opened = open_rig(options.face or resources.face_folder(), stages.poses)
    for line in opened.notes if options.face else ():
        print(f"lipstitch: {line}", file=sys.stderr)
    _make_folder(options.out)

    from .frames import FaceFrames

    frames = FaceFrames(opened.face, stages.poses, options.size)
    total = len(weights.frames)
    for i, row in enumerate(weights.frames):
        frames.save(row, options.out / f"frame_{i:05d}.png")
        if sys.stderr.isatty():
            print(f"\rframe {i + 1} of {total}", end="" if i + 1 < total else "\n", file=sys.stderr, flush=True)
    if utterance.audio is not None:
        _save_sound(utterance, options.out / "sound.wav")
    print(f"{total} frames at {options.fps:g} per second in {options.out}")
    return 0


def open_rig(path: Path, poses: Sequence[str] = FACEFX) -> Opened:
    """Any face: one of ours or a user's rig; kept in the user's cache for the next time."""
    from core_pipeline.faces import rig_cache
    from core_pipeline.faces.mapping_json import load_presets
    from core_pipeline.faces.open_face import open_face

    return open_face(path, load_presets(resources.retarget_presets()), poses, rig_cache.user_cache())


def tell_face(path: Path, curves: Path | None = None) -> int:
    """What a face is made of, and which poses it can make: FaceFX's, or those of a curve set."""
    opened = open_rig(path, curve_set_json.read(curves).curve_set.poses if curves is not None else FACEFX)
    face, made = opened.face, opened.retarget
    print(f"{shown(face.title, 200)}: {len(face.positions):,} vertices, {len(face.triangles):,} triangles.")
    print(f"{len(face.shapes)} shapes: {', '.join(shown(name) for name in face.shapes)}.")
    if made.poses:
        print(f"Poses by {shown(made.title, 200)}:")
    for pose, mix in made.poses.items():
        print(f"  {shown(pose)} = {' + '.join(f'{amount:g} {shown(shape)}' for shape, amount in mix.items())}")
    for line in opened.notes:
        print(shown(line, 2000))
    return 0


def demo(sentence: str, curves: Path | None) -> int:
    """Where no window can be shown: the editor's main job on files, into lipstitch-out/."""
    folder = Path("lipstitch-out")
    options = argparse.Namespace(curves=curves, preset=None)
    curve_set = load_curves(options)
    utterance = _say(sentence, "en-us")
    settings = curve_set.effective_settings
    stages = pipeline.run(utterance.schedule, curve_set)
    _make_folder(folder)
    weights_files.save(bake_weights(stages.magenta, settings.spline, 60), folder / "weights.json")
    stages_json.save(stages, folder / "stages.json")
    if utterance.audio is not None:
        _save_sound(utterance, folder / "sound.wav")

    from .frames import FaceFrames

    times = [utterance.schedule.start + utterance.schedule.duration * (i + 0.5) / 12 for i in range(12)]
    face = open_rig(resources.face_folder(), stages.poses).face
    FaceFrames(face, stages.poses, (256, 256)).save_strip(
        sample(stages.magenta, settings.spline, times), folder / "face.png"
    )
    _draw_window(sentence, curves, folder / "window.png")
    print(
        f'No display here, so Lipstitch said "{sentence}" into {folder}/: '
        f"{', '.join(sorted(p.name for p in folder.iterdir()))}."
    )
    print("For the window start it on a desktop, or here with: apt-get install xvfb && xvfb-run python3 run.py")
    return 0


def _draw_window(sentence: str, curves: Path | None, out: Path) -> None:
    """In a process of its own: Qt wants its platform chosen before anything else, and GL one owner."""
    import os
    import subprocess

    command = [sys.executable, "-m", "app", "screenshot", "--out", str(out)]
    if curves is not None:
        command += ["--curves", str(curves)]
    command += ["--", sentence]  # which may begin with a dash
    environment = {**os.environ, "QT_QPA_PLATFORM": "offscreen"}
    result = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    if result.returncode:
        told = result.stderr.strip().rpartition("lipstitch: ")[2].splitlines()[:1]
        raise UserError(f"The window could not be drawn: {told[0] if told else f'code {result.returncode}'}")


def _say(text: str, voice: str) -> Utterance:
    utterance = speak(text, voice)
    for note in utterance.notes:
        print(f"lipstitch: {note}", file=sys.stderr)
    return utterance


def _tell_missing(stages: Stages) -> None:
    if stages.missing:
        names = " ".join(f"{pair_name(pair)}×{count}" for pair, count in stages.missing.items())
        print(f"lipstitch: the curve set lacks {len(stages.missing)} bigrams of this text: {names}", file=sys.stderr)


def _save_sound(utterance: Utterance | None, path: Path) -> None:
    if utterance is None or utterance.audio is None:
        raise UserError(f"There is no sound to write to {path}: a sentence and espeak-ng are needed for that.")
    write_wav(path, utterance.audio)


def _make_folder(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UserError(f"Cannot make the folder {folder}: {reason(error)}.") from error
