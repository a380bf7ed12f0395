"""`lipstitch bake`: a sentence or a schedule becomes weights."""

from __future__ import annotations

import argparse
from pathlib import Path

from core_pipeline import pipeline
from core_pipeline.errors import UserError
from core_pipeline.files import schedule_json, stages_json, weights_files
from core_pipeline.weights import bake as bake_weights

from .steps import load_curves, load_model, save_sound, say, tell_missing

#: Nine hours at 30 frames a second.
MAX_FRAMES = 1_000_000


def bake(options: argparse.Namespace) -> int:
    """A sentence or a schedule → weights, stages, schedule, sound."""
    if (options.text is None) == (options.schedule is None):
        raise UserError("Say what to bake: either a sentence in quotes, or --schedule FILE.")
    outputs = [options.out, options.stages, options.schedule_out, options.sound]
    if not any(outputs):
        raise UserError("Nothing to write: name a file with --out weights.json (or .csv), or with --stages.")
    if not 1 <= options.fps <= 1000:
        raise UserError(f"{options.fps:g} frames per second is not possible: choose 1 to 1000 for --fps.")
    _refuse_same_file([options.curves, options.schedule, options.method], outputs)
    curve_set = load_curves(options)
    settings = curve_set.effective_settings
    if options.spline:
        settings = settings.with_spline(options.spline)
    utterance = None
    if options.schedule is not None:
        schedule = schedule_json.load(options.schedule, curve_set)
    else:
        utterance = say(options.text, options.voice)
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
    if options.sound:
        save_sound(utterance, options.sound)
    return 0


def _refuse_same_file(inputs: list[Path | None], outputs: list[Path | None]) -> None:
    """UserError when an output would destroy what is read, or another output."""
    seen = {path.absolute() for path in inputs if path is not None}
    for path in filter(None, outputs):
        if path.absolute() in seen or (path.is_file() and any(p.exists() and path.samefile(p) for p in seen)):
            raise UserError(f"{path} is named twice, and would be overwritten: give each file a name of its own.")
        seen.add(path.absolute())
