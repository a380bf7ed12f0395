"""Where no window can be shown: the editor's main job on files, into lipstitch-out/."""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
from pathlib import Path

from core_pipeline import pipeline
from core_pipeline.errors import UserError
from core_pipeline.files import stages_json, weights_files
from core_pipeline.weights import bake as bake_weights
from core_pipeline.weights import sample

from .. import resources
from ..rigs import open_rig
from .steps import load_curves, make_folder, save_sound, say


def demo(sentence: str, curves: Path | None) -> int:
    """Say the sentence into weights, stages, sound, a strip of faces and a picture of the window."""
    folder = Path("lipstitch-out")
    curve_set = load_curves(argparse.Namespace(curves=curves, preset=None))
    utterance = say(sentence, "en-us")
    settings = curve_set.effective_settings
    stages = pipeline.run(utterance.schedule, curve_set)
    make_folder(folder)
    weights_files.save(bake_weights(stages.magenta, settings.spline, 60), folder / "weights.json")
    stages_json.save(stages, folder / "stages.json")
    if utterance.audio is not None:
        save_sound(utterance, folder / "sound.wav")

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
    command = [sys.executable, "-m", "app", "screenshot", "--out", str(out)]
    if curves is not None:
        command += ["--curves", str(curves)]
    command += ["--", sentence]  # which may begin with a dash
    environment = {**os.environ, "QT_QPA_PLATFORM": "offscreen"}
    result = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    if result.returncode:
        told = result.stderr.strip().rpartition("lipstitch: ")[2].splitlines()[:1]
        raise UserError(f"The window could not be drawn: {told[0] if told else f'code {result.returncode}'}")
