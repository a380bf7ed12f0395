"""Which bigrams of a sentence are weak, and why: the reason for typing test sentences (section 3.1.2)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .curve_set import CurveSet
from .phonemes import SILENCE, Pair
from .pipeline import Stages
from .tracks import Array

#: A curve that stays below this is as good as none.
FLAT = 0.02
#: Losing more than this share of a peak to the speed limit is worth a look.
SLOWED = 0.20


@dataclass(frozen=True)
class Weakness:
    """One bigram of the sentence that needs work.

    kind      "missing", "flat", "slowed" or "unreviewed"
    time      where in the sentence it is worst, seconds
    uses      how often the sentence has it
    amount    for "slowed": the share of the peak that is lost, 0…1; else 0
    pose      for "slowed": the pose
    severity  0…1; the list is sorted by severity · uses
    """

    pair: Pair
    kind: str
    time: float
    uses: int
    severity: float
    amount: float = 0.0
    pose: str = ""


def weak_bigrams(stages: Stages, curve_set: CurveSet) -> list[Weakness]:
    """The weak bigrams of a sentence, worst first, one entry a bigram."""
    times = stages.schedule.times
    uses: dict[Pair, int] = {}
    first: dict[Pair, int] = {}
    for i, pair in enumerate(stages.schedule.pairs()):
        uses[pair] = uses.get(pair, 0) + 1
        first.setdefault(pair, i)
    slowed = _slowed(stages)
    found = []
    for pair, count in uses.items():
        if SILENCE in pair:
            continue
        middle = float(times[first[pair] + 1])
        bigram = curve_set.bigrams.get(pair)
        if bigram is None:
            found.append(Weakness(pair, "missing", middle, count, 1.0))
        elif max((float(c.v.max()) for c in bigram.curves.values()), default=0.0) < FLAT:
            found.append(Weakness(pair, "flat", middle, count, 0.9))
        elif pair in slowed:
            share, time, pose = slowed[pair]
            found.append(Weakness(pair, "slowed", time, count, 0.3 + 0.5 * share, share, pose))
        elif bigram.status in ("empty", "suggestion"):
            found.append(Weakness(pair, "unreviewed", middle, count, 0.1))
    return sorted(found, key=lambda w: (-w.severity * w.uses, w.time))


def _slowed(stages: Stages) -> dict[Pair, tuple[float, float, str]]:
    """Bigram → (share of a peak lost to the speed limit, when, pose), the worst place of each."""
    worst: dict[Pair, tuple[float, float, str]] = {}
    after = {pose: stages.magenta[pose] for pose in stages.poses}
    before = {pose: stages.cyan[pose] for pose in stages.poses}
    for curve in stages.red:
        top = int(curve.v.argmax())
        time, height = float(curve.t[top]), float(curve.v[top])
        reached = float(before[curve.pose].at(np.array([time]))[0])
        if height < 0.1 or reached < height - 1e-6:  # another bigram or a constraint decides here
            continue
        kept = _highest(after[curve.pose].t, after[curve.pose].v, curve.t[0], curve.t[-1])
        share = 1.0 - kept / height
        if share > SLOWED and share > worst.get(curve.bigram, (0.0,))[0]:
            worst[curve.bigram] = (share, time, curve.pose)
    return worst


def _highest(t: Array, v: Array, start: float, end: float) -> float:
    inside = v[(t >= start) & (t <= end)]
    edges = np.interp([start, end], t, v)
    return float(max(inside.max(initial=0.0), edges.max()))
