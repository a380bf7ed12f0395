"""Blue: the larger of two overlapping curves, with a knot where they cross."""

import numpy as np
import pytest
from hypothesis import given

from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.pipeline import Stages, run
from core_pipeline.schedule import Schedule
from tests.helpers.strategies import curve_sets, knots, schedules


def blue(curves, times, phones="xxxxx") -> list[tuple[float, float]]:
    """Blue knots of one pose for the curves of x-x, or of the pairs given."""
    pairs = curves if isinstance(curves, dict) else {"xx": curves}
    bigrams = {(pair[0], pair[1]): Bigram({"a": Curve.of(keys)}) for pair, keys in pairs.items()}
    curve_set = CurveSet(phonemes=("x", "y", "z"), poses=("a",), bigrams=bigrams)
    return knots(run(Schedule(phones[: len(times) - 1], times), curve_set).blue["a"])


def heights(stages: Stages, pose: str, t) -> np.ndarray:
    """(curves, times) of every red curve of a pose."""
    reds = [np.interp(t, r.t, r.v, left=0, right=0) for r in stages.red if r.pose == pose]
    return np.array(reds).reshape(-1, len(t))


@given(schedules(), curve_sets())
def test_blue_is_above_every_red_and_equals_one_of_them(schedule, curve_set):
    stages = run(schedule, curve_set)
    for pose in curve_set.poses:
        track = stages.blue[pose]
        t = np.unique(np.concatenate((track.t, (track.t[1:] + track.t[:-1]) / 2)))
        red = heights(stages, pose, t)
        highest = red.max(0, initial=0)
        assert track.at(t) == pytest.approx(highest, abs=1e-6)


@given(schedules(), curve_sets())
def test_the_winner_is_the_bigram_whose_red_curve_is_seen(schedule, curve_set):
    stages = run(schedule, curve_set)
    for pose in curve_set.poses:
        for t in np.linspace(schedule.start, schedule.end, 15):
            winner = stages.winner(pose, t)
            own = {r.index: np.interp(t, r.t, r.v) for r in stages.red if r.pose == pose and r.t[0] <= t <= r.t[-1]}
            assert (winner is None) == (not own)
            if winner is not None:
                assert own[winner] == max(own.values())
                assert stages.blue[pose].at(t) == pytest.approx(own[winner], abs=1e-6)
                assert schedule.times[winner] - 1e-9 <= t <= schedule.times[winner + 2] + 1e-9


def test_two_hills_cross_in_the_middle():
    hill = [(0, 0), (0.5, 1), (1, 0)]
    assert blue(hill, [0, 0.1, 0.2, 0.3]) == [(0, 0), (0.1, 1), (0.15, 0.5), (0.2, 1), (0.3, 0)]


def test_a_low_curve_under_a_high_one_is_not_seen():
    assert blue({"xy": [(0, 0), (0.5, 1), (1, 0)], "yz": [(0, 0), (0.25, 0.1), (0.5, 0)]}, [0, 1, 2, 3], "xyz") == [
        (0, 0),
        (1, 1),
        (2, 0),
    ]


def test_curves_that_touch_in_one_point_keep_it():
    # bigram 0 ends at 2 where bigram 1 has its peak; and two plateaus of equal height join to one
    assert blue([(0.25, 0), (0.5, 1), (0.75, 0)], [0, 2, 4, 6]) == [(1, 0), (2, 1), (3, 0), (4, 1), (5, 0)]
    flat = [(0, 0), (0.25, 0.5), (0.75, 0.5), (1, 0)]
    assert blue(flat, [0, 2, 4, 6]) == [(0, 0), (1, 0.5), (5, 0.5), (6, 0)]


def test_rounding_dust_is_zero():
    dust = {"xy": [(0, 1e-12), (0.5, 1), (0.6, 0), (1, 0)], "yz": [(0, 0), (0.5, 1e-10), (0.75, 0), (0.9, 1), (1, 0)]}
    made = blue(dust, [0, 1, 2, 3], "xyz")
    assert made == [(0.0, 0.0), (1.0, 1.0), (1.2, 0.0), (2.5, 0.0), (2.8, 1.0), (3.0, 0.0)]
    assert blue({"xy": [(0, 1e-12)]}, [0, 1, 2], "xy") == [(0, 0), (2, 0)]


def test_a_valley_down_to_rounding_dust_ends_the_support():
    valley = Curve.of([(0, 0), (0.3, 1), (0.4, 1e-12), (0.6, 1e-12), (0.7, 1), (1, 0)])
    curve_set = CurveSet(phonemes=("x", "y"), poses=("a",), bigrams={("x", "y"): Bigram({"a": valley})})
    for phones in ("xy", "xyxy"):  # one half of the bigrams alone, and both
        track = run(Schedule(phones, range(len(phones) + 1)), curve_set).blue["a"]
        assert track.v[2:4].tolist() == [0, 0], "exactly"


def test_a_step_of_a_few_nanoseconds_is_a_step_and_no_slope():
    # phones of 10 µs: the closing ramp lasts some nanoseconds, and the long phone after it must not tilt it
    times = [0, 1.01e-5, 2.02e-5, 0.5, 1.0]
    made = blue({"xy": [(0, 0), (0.999, 0.9), (1, 1)], "zx": [(0, 0), (0.5, 0.5), (1, 0)]}, times, "xyzx")
    t, v = np.array(made).T
    assert np.interp(1e-4, t, v) == pytest.approx(0, abs=1e-3)
    assert v.max() == pytest.approx(1, abs=0.05)
    assert made[-1] == (1.0, 0.0)
