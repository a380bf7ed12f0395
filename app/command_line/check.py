"""`lipstitch check`: what a curve set holds, or what is wrong with it."""

from __future__ import annotations

import argparse
from pathlib import Path

from core_pipeline.curve_set import STATUSES, CurveSet
from core_pipeline.files import curve_set_json
from core_pipeline.files.atomic import read_bytes
from core_pipeline.files.curve_set_merge import open_conflicts
from core_pipeline.files.json_text import shown
from core_pipeline.phonemes import SILENCE, pair_name


def check(options: argparse.Namespace) -> int:
    """Counts and missing bigrams of a curve set, or one line per problem."""
    path: Path = options.file
    data = read_bytes(path, curve_set_json.MAX_BYTES, "curve set")
    reading, problems = curve_set_json.examine(data, str(path), path.parent)
    problems = [*problems, *(reading.repairs if reading is not None else ())]
    if reading is not None:
        for line in _summary(reading.curve_set):
            print(line)
        problems += [f"{path}: {what} is undecided since a merge." for what in open_conflicts(reading.curve_set)]
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
