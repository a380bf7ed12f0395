"""The five stages in a row: Schedule and CurveSet in, Stages out (section 3.2, figure 5).

    red ─→ blue ─→ yellow ─→ cyan ─→ magenta

Everything is recomputed after every edit: a sentence takes a fraction of a millisecond.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .constrain import constrain
from .curve_set import CurveSet
from .phonemes import SILENCE, Pair
from .schedule import Schedule
from .settings import Settings
from .smooth import smooth
from .speed_limit import limit_speed
from .stitch import stitch
from .timewarp import Warped, WarpedCurve, timewarp
from .tracks import Tracks

__all__ = ["STAGES", "Settings", "Stages", "run"]

#: The stages after the time-warp, in order, by the colours of the paper's figures.
STAGES = ("blue", "yellow", "cyan", "magenta")


@dataclass(frozen=True, eq=False)
class Stages:
    """What every stage made of one utterance. `stages.magenta["open"]` has `.t` and `.v`.

    schedule  with the set's common phonemes, as the pipeline saw it
    missing   bigram → how often it was wanted and not there; pairs with `sil` never count
    unknown   phones that the set does not have
    """

    schedule: Schedule
    warped: Warped
    blue: Tracks
    yellow: Tracks
    cyan: Tracks
    magenta: Tracks
    missing: Mapping[Pair, int]
    unknown: tuple[str, ...]

    @property
    def poses(self) -> tuple[str, ...]:
        """The pose set."""
        return self.magenta.poses

    @cached_property
    def red(self) -> tuple[WarpedCurve, ...]:
        """Every warped curve, with the number of the bigram it comes from."""
        return tuple(self.warped.curves())

    def stage(self, colour: str) -> Tracks:
        """One of STAGES by its colour."""
        return {"blue": self.blue, "yellow": self.yellow, "cyan": self.cyan, "magenta": self.magenta}[colour]

    def winner(self, pose: str, time: float) -> int | None:
        """Index of the bigram whose red curve is the highest at `time`; None where there is none.

        Where a filled valley lies (yellow above every red), the higher of the two bigrams there.
        """
        best: tuple[float, int] | None = None
        for curve in self.red:
            if curve.pose == pose and curve.t[0] <= time <= curve.t[-1]:
                height = float(np.interp(time, curve.t, curve.v))
                if best is None or height > best[0]:
                    best = (height, curve.index)
        return None if best is None else best[1]


def run(schedule: Schedule, curve_set: CurveSet, settings: Settings | None = None) -> Stages:
    """Run all stages. `settings` defaults to the set's own, and those to the preset "Paper".

    The schedule may hold the language's phones: the set's phoneme map is applied first.
    """
    settings = curve_set.effective_settings if settings is None else settings
    schedule = schedule.mapped(curve_set.phonemes, curve_set.phoneme_map)
    red = timewarp(curve_set.packed, schedule.phones, schedule.times)
    missing: dict[Pair, int] = {}
    for i in red.absent.tolist():
        pair = schedule.phones[i], schedule.phones[i + 1]
        if SILENCE not in pair:
            missing[pair] = missing.get(pair, 0) + 1
    blue = stitch(red)
    yellow = smooth(blue, np.array([settings.window_of(pose) for pose in curve_set.poses]))
    cyan = constrain(yellow, settings)
    magenta = limit_speed(cyan, settings.speed_limit)
    unknown = tuple(schedule.unknown(curve_set.phonemes))
    return Stages(schedule, red, blue, yellow, cyan, magenta, missing, unknown)
