"""What several commands do on their way: read curves, speak, save the sound, and tell what is worth knowing."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from core_pipeline.curve_set import CurveSet
from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json
from core_pipeline.files.atomic import reason
from core_pipeline.phonemes import pair_name
from core_pipeline.pipeline import Stages
from core_pipeline.settings import PRESETS
from core_pipeline.speech.intake import Intake, Source
from core_pipeline.speech.speaker import speak
from core_pipeline.speech.utterance import Utterance
from core_pipeline.speech.wav import write_wav

if TYPE_CHECKING:
    from core_pipeline.methods.method import Method

from .. import resources
from .progress import Progress


def tell(line: str) -> None:
    """One line on stderr, marked as ours."""
    print(f"lipstitch: {line}", file=sys.stderr)


def load_curves(options: argparse.Namespace, usual: Path | None = None) -> CurveSet:
    """The curve set the options name, else `usual`, else English; with their preset. Repairs are told."""
    path = options.curves or usual or resources.english_curves()
    reading = curve_set_json.read(path)
    for line in reading.repairs:
        tell(line)
    if reading.newer:
        tell(f"{path} was written by a newer Lipstitch; this one may misread it.")
    curve_set = reading.curve_set
    return curve_set.with_settings(PRESETS[options.preset]) if options.preset else curve_set


def load_model(path: Path) -> Method:
    """A learned model, .npz; UserError when it is none."""
    from core_pipeline.files import model_npz

    return model_npz.load(path)


def say(text: str, voice: str) -> Utterance:
    """The text spoken; what is odd about it is told. UserError when there is nothing to say."""
    utterance = speak(text, voice)
    for note in utterance.notes:
        tell(note)
    return utterance


def hear(source: Source, curve_set: CurveSet) -> Utterance:
    """What a source says, with a bar for long recordings; what is odd about it is told. UserError."""
    intake = Intake()
    try:
        with Progress(100, "percent") as bar:
            known = [*curve_set.phonemes, *curve_set.phoneme_map]
            utterance = intake.utter(source, known, lambda done: bar.step(round(100 * done)))
    finally:
        intake.close()
    for note in utterance.notes:
        tell(note)
    return utterance


def tell_missing(stages: Stages) -> None:
    """Which bigrams of the text the curve set lacks."""
    if stages.missing:
        names = " ".join(f"{pair_name(pair)}×{count}" for pair, count in stages.missing.items())
        tell(f"the curve set lacks {len(stages.missing)} bigrams of this text: {names}")


def save_sound(utterance: Utterance | None, path: Path) -> None:
    """The sound as .wav; UserError when there is none, or it cannot be written."""
    if utterance is None or utterance.audio is None:
        raise UserError(f"There is no sound to write to {path}: a sentence and espeak-ng are needed for that.")
    write_wav(path, utterance.audio)


def make_folder(folder: Path) -> None:
    """The folder and those above it, unless they are there; UserError when it cannot be made."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UserError(f"Cannot make the folder {folder}: {reason(error)}.") from error
