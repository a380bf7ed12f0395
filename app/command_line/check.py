"""`lipstitch check`: what a curve set holds, what is wrong with it, and which of its bigrams are weak."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from core_pipeline import pipeline
from core_pipeline.curve_set import STATUSES, CurveSet
from core_pipeline.diagnose import Corpus, SetFindings, WeakBigram, findings_of, weak_in_set
from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json, frequencies_json
from core_pipeline.files.atomic import read_bytes
from core_pipeline.files.curve_set_merge import open_conflicts
from core_pipeline.files.json_text import shown
from core_pipeline.phonemes import SILENCE, pair_name

from .. import resources
from .corpus import spoken


def check(options: argparse.Namespace) -> int:
    """Counts, problems and weak bigrams; 1 when the file has problems or the corpus needs what says nothing."""
    if options.most < 0:
        raise UserError(f"--most {options.most} is not possible: choose 0 or more.")
    path: Path = options.file
    data = read_bytes(path, curve_set_json.MAX_BYTES, "curve set")
    reading, problems = curve_set_json.examine(data, str(path), path.parent)
    problems = [*problems, *(reading.repairs if reading is not None else ())]
    if reading is not None and reading.newer:
        problems.append(f"{path} was written by a newer Lipstitch; this one may misread it.")
    curve_set = None if reading is None else reading.curve_set
    if curve_set is not None:
        problems += [f"{path}: {what} is undecided since a merge." for what in open_conflicts(curve_set)]
    sentences: list[str] = []
    weak: list[WeakBigram] = []
    if curve_set is not None:
        sentences, weak = _in_corpus(curve_set, options) if options.corpus else ([], _by_itself(curve_set))
    errors = [w for w in weak if w.is_error] if options.corpus else []
    if options.json:
        print(json.dumps(_record(curve_set, problems, weak, sentences, len(errors)), ensure_ascii=False))
    else:
        for line in _lines(curve_set, problems, weak, options.most):
            print(line)
        if errors:
            uses = sum(w.uses for w in errors)
            print(f"{len(errors)} bigrams that this corpus needs {uses} times are missing or empty.")
    return 1 if problems or errors else 0


def _in_corpus(curve_set: CurveSet, options: argparse.Namespace) -> tuple[list[str], list[WeakBigram]]:
    checks, corpus = SetFindings.of(curve_set), Corpus()
    sentences = []
    for text, schedule in spoken(options.corpus, options.voice):
        stages = pipeline.run(schedule, curve_set)
        corpus.add(stages, findings_of(stages, curve_set, checks))
        sentences.append(text)
    return sentences, corpus.ranking()


def _by_itself(curve_set: CurveSet) -> list[WeakBigram]:
    shares = frequencies_json.load(resources.corpus() / "frequencies.json").shares
    return weak_in_set(curve_set, shares)


def _lines(curve_set: CurveSet | None, problems: list[str], weak: list[WeakBigram], most: int) -> list[str]:
    lines = [shown(line, 2000) for line in problems]
    if curve_set is None:
        return lines
    told = [w for w in weak if not w.is_hint and (w.uses or w.worst.kind != "missing")]  # others: see the summary
    lines = [*_summary(curve_set), *lines]
    if told and most:
        lines.append(f"Weak, worst first{f' ({most} of {len(told)})' if most < len(told) else ''}:")
        lines += [_weak_line(w) for w in told[:most]]
    return lines


def _weak_line(weak: WeakBigram) -> str:
    uses = f"{weak.uses:4}× " if weak.uses else ""
    return f"  {pair_name(weak.pair):10}{uses} {weak.reason}"


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


def _record(
    curve_set: CurveSet | None, problems: list[str], weak: list[WeakBigram], sentences: list[str], errors: int
) -> dict[str, object]:
    return {
        "summary": [] if curve_set is None else _summary(curve_set),
        "problems": problems,
        "sentences": len(sentences),
        "errors": errors,
        "weak": [
            {
                "pair": pair_name(w.pair),
                "uses": w.uses,
                "score": round(w.score, 4),
                "findings": [
                    {
                        "kind": f.kind,
                        "reason": f.reason,
                        "severity": round(f.severity, 4),
                        "pose": f.pose or None,
                        "amount": round(f.amount, 4),
                        "sentence": sentences[f.sentence] if sentences else None,
                        "time": None if f.time is None else round(f.time, 4),
                    }
                    for f in w.findings
                ],
            }
            for w in weak
        ],
    }
