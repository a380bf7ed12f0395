"""From a place in the stage overlay back to the bigram that made it, and the words that say so. No Qt.

"Specific segments of the animations can be directly mapped back to their originating phone bigrams" (section 3.2.4).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core_pipeline.phonemes import Pair
from core_pipeline.pipeline import STAGES, Stages
from core_pipeline.timewarp import WarpedCurve

from .stage_lines import INVISIBLE


@dataclass(frozen=True)
class Reading:
    """What stands under the mouse.

    values  the pose's weight at each of STAGES
    index   number of the bigram that made it; None where the utterance has none
    """

    time: float
    pose: str
    values: tuple[float, ...]
    index: int | None
    pair: Pair | None

    @property
    def is_zero(self) -> bool:
        """Whether no stage moves the pose here."""
        return max(self.values) <= INVISIBLE

    def steps(self) -> list[tuple[str, float]]:
        """(stage, weight) of the first stage and of each that changed the weight."""
        steps = [(STAGES[0], self.values[0])]
        for colour, value in zip(STAGES[1:], self.values[1:], strict=True):
            if abs(value - steps[-1][1]) > 0.005:
                steps.append((colour, value))
        return steps


def read(stages: Stages, pose: str, time: float) -> Reading:
    """The weight of `pose` at every stage, and the bigram that made it."""
    values = tuple(float(stages.stage(colour)[pose].at(np.array(time))) for colour in STAGES)
    index = bigram_at(stages, pose, time)
    pair = None if index is None else (stages.schedule.phones[index], stages.schedule.phones[index + 1])
    return Reading(time, pose, values, index, pair)


def bigram_at(stages: Stages, pose: str, time: float) -> int | None:
    """The bigram to open for a place in a row; None only outside the utterance or with fewer than two phones.

    The one that won the maximum; in a filled valley where no curve is above 0, the one with the higher
    peak beside it; where the pose is 0, the one whose phone boundary is nearest.
    """
    bigrams = len(stages.schedule) - 1
    if bigrams < 1 or not stages.schedule.start <= time <= stages.schedule.end:
        return None
    winner = stages.winner(pose, time)
    if winner is not None:
        curve = curve_of(stages, winner, pose)
        if curve is not None and float(np.interp(time, curve.t, curve.v)) > INVISIBLE:
            return winner
    if stages.yellow[pose].at(np.array(time)) > INVISIBLE:
        beside = _beside(stages, pose, time)
        if beside is not None:
            return beside
    boundaries = stages.schedule.times[1:-1]
    return int(np.abs(boundaries - time).argmin())


def curve_of(stages: Stages, index: int, pose: str) -> WarpedCurve | None:
    """The red curve of one bigram and pose; None where that bigram does not move the pose."""
    return next((c for c in stages.red if c.index == index and c.pose == pose), None)


def phone_at(stages: Stages, time: float) -> int:
    """Number of the phone that sounds at `time`; the first or last outside."""
    times = stages.schedule.times
    return int(np.clip(times.searchsorted(time, "right") - 1, 0, len(stages.schedule) - 1))


def _beside(stages: Stages, pose: str, time: float) -> int | None:
    """Of the last curve that ends above 0 before `time` and the first after it, the one with the higher peak."""
    before: tuple[float, float, int] | None = None
    after: tuple[float, float, int] | None = None
    for curve in stages.red:
        if curve.pose != pose:
            continue
        active = curve.t[curve.v > INVISIBLE]
        peak = float(curve.v.max())
        if active.size and active[-1] <= time and (before is None or active[-1] > before[0]):
            before = (float(active[-1]), peak, curve.index)
        if active.size and active[0] >= time and (after is None or active[0] < after[0]):
            after = (float(active[0]), peak, curve.index)
    found = [side for side in (before, after) if side is not None]
    return max(found, key=lambda side: side[1])[2] if found else None
