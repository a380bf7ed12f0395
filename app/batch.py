"""The commands on curves, schedules and weights: bake and check."""

from __future__ import annotations

import argparse
from pathlib import Path

from core_pipeline import pipeline
from core_pipeline.curve_set import STATUSES, CurveSet
from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json, schedule_json, stages_json, weights_files
from core_pipeline.files.atomic import read_bytes
from core_pipeline.files.json_text import shown
from core_pipeline.phonemes import SILENCE, pair_name
from core_pipeline.weights import bake as bake_weights

from .steps import load_curves, save_sound, say, tell_missing

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
    _refuse_same_file([options.curves, options.schedule], outputs)
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
    tell_missing(stages)
    if options.out:
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


def check(options: argparse.Namespace) -> int:
    """Counts and missing bigrams of a curve set, or one line per problem."""
    path: Path = options.file
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
