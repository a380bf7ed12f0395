"""Every stage against a slow second reading of the design that shares no code with the first."""

import numpy as np
from hypothesis import given
from hypothesis import settings as examples

from core_pipeline.pipeline import STAGES, run
from tests.helpers import brute_force
from tests.helpers.strategies import curve_sets, schedules, settings

SHIFT = 5e-8  # seconds by which either reading may place a knot otherwise: five knots that became one


def compare(schedule, curve_set, settings, tolerance: float) -> None:
    stages, slow = run(schedule, curve_set, settings), brute_force.stages(schedule, curve_set, settings)
    for colour in STAGES:
        for pose in curve_set.poses:
            track = stages.stage(colour)[pose]
            line = slow["cyan" if colour == "magenta" else colour][pose]

            def right(t: float, line=line, colour=colour) -> float:
                if colour == "magenta":
                    return brute_force.magenta(line, settings.speed_limit, t)
                return brute_force.value(line, t)

            t = np.concatenate((track.t, (track.t[1:] + track.t[:-1]) / 2, [s for s, _ in line], schedule.times))
            for at, made in zip(t.tolist(), track.at(t).tolist(), strict=True):
                if abs(made - right(at)) > tolerance:  # then it stands on a step
                    near = [at - SHIFT, at, at + SHIFT, *(s for s, _ in line if abs(s - at) < SHIFT)]
                    heights = [right(s) for s in near]
                    assert min(heights) - tolerance <= made <= max(heights) + tolerance, (colour, pose, at)


@examples(max_examples=500)
@given(schedules(), curve_sets(), settings())
def test_the_pipeline_equals_the_slow_reading(schedule, curve_set, settings):
    compare(schedule, curve_set, settings, 1e-6)


@examples(max_examples=200)
@given(schedules(most=12), curve_sets(at_rest=True), settings())
def test_longer_utterances(schedule, curve_set, settings):
    compare(schedule, curve_set, settings, 1e-6)
