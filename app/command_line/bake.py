"""`lipstitch bake`: a sentence, a recording, a label file or a schedule becomes weights."""

from __future__ import annotations

import argparse
from pathlib import Path

from core_pipeline import pipeline
from core_pipeline.errors import UserError
from core_pipeline.files import schedule_json, stages_json, utterance_json, weights_files
from core_pipeline.files.labels import textgrid
from core_pipeline.speech.utterance import Utterance
from core_pipeline.weights import bake as bake_weights

from .speech_source import source_of, with_map
from .steps import hear, load_curves, load_model, save_sound, tell_missing

#: Nine hours at 30 frames a second.
MAX_FRAMES = 1_000_000


def bake(options: argparse.Namespace) -> int:
    """Whatever is said → weights, stages, schedule, labels, sound."""
    spoken = options.text is not None or options.audio is not None or options.labels is not None
    if spoken == (options.schedule is not None):
        raise UserError("Say what to bake: a sentence in quotes, --audio, --labels or --schedule FILE, one of these.")
    outputs = [options.out, options.stages, options.schedule_out, options.labels_out, options.sound]
    if not any(outputs):
        raise UserError("Nothing to write: name a file with --out weights.json (or .csv), or with --stages.")
    if not 1 <= options.fps <= 1000:
        raise UserError(f"{options.fps:g} frames per second is not possible: choose 1 to 1000 for --fps.")
    _refuse_same_file([options.curves, options.schedule, options.method, options.audio, options.labels], outputs)
    curve_set = with_map(load_curves(options), options.phoneme_map)
    settings = curve_set.effective_settings
    if options.spline:
        settings = settings.with_spline(options.spline)
    utterance = None
    if options.schedule is not None:
        schedule = schedule_json.load(options.schedule, curve_set)
    else:
        utterance = hear(source_of(options), curve_set)
        schedule = utterance.schedule
    if options.out and schedule.duration * options.fps > MAX_FRAMES:
        raise UserError(
            f"{schedule.duration:g} s at {options.fps:g} frames per second are more than {MAX_FRAMES:,} frames: "
            "choose a lower --fps or a shorter schedule."
        )
    stages = pipeline.run(schedule, curve_set, settings)
    if options.method is None:
        tell_missing(stages)
    if options.out and options.method is not None:
        model = load_model(options.method)
        weights_files.save(model.synthesize(schedule, model.poses, options.fps), options.out)
    elif options.out:
        weights_files.save(
            bake_weights(stages.magenta, settings.spline, options.fps, snap=not options.no_snap), options.out
        )
    if options.stages:
        stages_json.save(stages, options.stages)
    if options.schedule_out:
        schedule_json.save(schedule, options.schedule_out)
    if options.labels_out:
        _save_labels(utterance or Utterance("", schedule), options)
    if options.sound:
        save_sound(utterance, options.sound)
    return 0


def _save_labels(utterance: Utterance, options: argparse.Namespace) -> None:
    """As a TextGrid, or as an utterance of ours where the name ends in .json."""
    path: Path = options.labels_out
    if path.suffix.lower() == ".json":
        utterance_json.save(path, utterance, options.audio.name if options.audio is not None else "")
    else:
        textgrid.save(path, utterance.schedule, utterance.words)


def _refuse_same_file(inputs: list[Path | None], outputs: list[Path | None]) -> None:
    """UserError when an output would destroy what is read, or another output."""
    seen = {path.absolute() for path in inputs if path is not None}
    for path in filter(None, outputs):
        if path.absolute() in seen or (path.is_file() and any(p.exists() and path.samefile(p) for p in seen)):
            raise UserError(f"{path} is named twice, and would be overwritten: give each file a name of its own.")
        seen.add(path.absolute())
