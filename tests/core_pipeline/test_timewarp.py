"""Red: every curve over the span of its bigram, and it never forgets which bigram that was."""

import numpy as np
import pytest
from hypothesis import given

from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.pipeline import run
from core_pipeline.schedule import Schedule
from core_pipeline.timewarp import RAMP
from tests.helpers.strategies import curve_sets, schedules


def only(keys, pair=("x", "y")) -> CurveSet:
    """A set with one curve."""
    return CurveSet(phonemes=("x", "y"), poses=("a",), bigrams={pair: Bigram({"a": Curve.of(keys)})}, phoneme_map={})


@given(schedules(), curve_sets())
def test_red_at_t_equals_the_authored_curve_at_s(schedule, curve_set):
    for red in run(schedule, curve_set).red:
        begin, end = schedule.times[red.index], schedule.times[red.index + 2]
        t = np.linspace(begin, end, 60)
        authored = curve_set.bigrams[red.bigram].curves[red.pose].at((t - begin) / (end - begin))
        inside = (t >= begin + RAMP) & (t <= end - RAMP)  # the first and last millisecond may be a closing ramp
        assert np.interp(t, red.t, red.v)[inside] == pytest.approx(authored[inside], abs=1e-9)


@given(schedules(nasty=True), curve_sets(nasty=True))
def test_each_red_curve_knows_its_bigram_and_stays_in_its_span(schedule, curve_set):
    stages = run(schedule, curve_set)
    seen = set()
    for red in stages.red:
        assert red.bigram == (schedule.phones[red.index], schedule.phones[red.index + 1])
        assert curve_set.bigrams[red.bigram].curves[red.pose].v.any()
        assert schedule.times[red.index] - 1e-9 <= red.t[0]
        assert red.t[-1] <= schedule.times[red.index + 2] + 1e-9
        assert red.v[0] == red.v[-1] == 0
        assert (np.diff(red.t) >= 0).all()
        seen.add((red.index, red.pose))
    wanted = {
        (i, pose)
        for i, pair in enumerate(schedule.pairs())
        if pair in curve_set.bigrams
        for pose, curve in curve_set.bigrams[pair].curves.items()
        if curve.v.any()
    }
    assert seen == wanted
    assert len(seen) == len(stages.red)


def test_the_closing_ramps_are_inside_the_span_and_meet_the_curve_on_it():
    (red,) = run(Schedule(["x", "y"], [0, 0.1, 0.2]), only([(0, 0.5), (0.5, 1), (1, 0.2)])).red
    # the slopes are 5/s and −8/s: a millisecond inside, the curve is at .505 and .208
    assert red.t == pytest.approx([0, RAMP, 0.1, 0.2 - RAMP, 0.2])
    assert red.v == pytest.approx([0, 0.505, 1, 0.208, 0])


def test_a_ramp_takes_at_most_a_third_of_the_way_to_the_next_key():
    (red,) = run(Schedule(["x", "y"], [0, 0.1, 0.2]), only([(0, 0.9), (0.003, 0.6), (1, 0)])).red
    assert red.t == pytest.approx([0, 0.0002, 0.0006, 0.2])
    assert red.v == pytest.approx([0, 0.8, 0.6, 0])


def test_a_curve_that_begins_late_at_zero_is_not_touched():
    (red,) = run(Schedule(["x", "y"], [5, 5.1, 5.2]), only([(0.25, 0), (0.5, 1), (0.75, 0)])).red
    assert red.t == pytest.approx([5.05, 5.1, 5.15])
    assert red.v.tolist() == [0, 1, 0]


def test_a_missing_bigram_contributes_nothing():
    stages = run(Schedule(["y", "x", "y", "x"], range(5)), only([(0, 0), (0.5, 1), (1, 0)]))
    assert [red.index for red in stages.red] == [1]
