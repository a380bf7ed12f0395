"""The full set that speaks for phones of which next to nothing is drawn yet: one of ours with the same poses."""

from __future__ import annotations

from functools import cache

from core_pipeline.curve_set import CurveSet
from core_pipeline.files import curve_set_json

from . import resources


def prior_for(curve_set: CurveSet) -> CurveSet | None:
    """Ours that has most of the set's poses, if it has at least half of them; made from phone parts."""
    known = [(len({*curve_set.poses} & {*ours.poses}), ours) for ours in _ours()]
    shared, best = max(known, key=lambda item: item[0])
    return best if 2 * shared >= max(len(curve_set.poses), 1) else None


@cache
def _ours() -> tuple[CurveSet, ...]:
    folder = resources.english_curves().parent
    return tuple(curve_set_json.load(folder / f"{name}.json") for name in ("english", "crab"))
