"""Magenta: the largest tracks under cyan whose slope is nowhere above l_max."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import settings as examples
from hypothesis import strategies as st

from core_pipeline.pipeline import run
from core_pipeline.speed_limit import limit_speed
from tests.helpers import brute_force
from tests.helpers.strategies import curve_sets, knots, schedules, settings, tracks_of

HILL = [(0.0, 0.0), (0.1, 1.0), (0.2, 0.0)]
SPEEDS = st.sampled_from([0.01, 1.0, 6.0, 15.0, 200.0, 1e4])


def magenta(line, speed: float) -> list[tuple[float, float]]:
    return knots(limit_speed(tracks_of({"a": line}), speed)["a"])


def test_by_hand_a_hill_of_slope_10():
    assert magenta(HILL, 15) == HILL
    assert magenta(HILL, 6) == [(0, 0), (0.1, 0.6), (0.2, 0)]


def test_a_slow_limit_leaves_the_curve_where_it_is_slow_enough():
    line = [(0, 0), (0.01, 0.5), (0.5, 0.6), (0.51, 0), (0.6, 0)]
    made = magenta(line, 5)
    rise = 0.5 - 0.01 * 0.1 / 0.49  # the slow line, drawn back to t = 0
    meets = rise / (5 - 0.1 / 0.49)
    assert made[1] == (pytest.approx(meets), pytest.approx(5 * meets))
    assert made[0] == (0, 0)
    assert made[-1] == (0.51, 0)
    assert len(made) == 4


def test_a_spike_is_cut_to_nothing_but_its_cone():
    made = magenta([(0, 0), (0.3, 0), (0.4, 1), (0.41, 0), (0.5, 0)], 0.01)
    assert made == [(0.3, 0), (0.355, 0.00055), (0.41, 0)]


@pytest.mark.parametrize("speed", [0.0, -1.0, float("nan")])
def test_a_limit_of_nothing_is_refused(speed):
    with pytest.raises(ValueError, match="above 0"):
        limit_speed(tracks_of({"a": HILL}), speed)


def test_nothing_to_limit():
    nothing = tracks_of({"a": []})
    assert limit_speed(nothing, 1.0) is nothing


@given(schedules(nasty=True), curve_sets(nasty=True), settings(), SPEEDS)
def test_no_two_points_are_further_apart_than_the_limit_allows(schedule, curve_set, settings, speed):
    cyan = run(schedule, curve_set, settings).cyan
    made = limit_speed(cyan, speed)
    rounding = 2e-9 + speed * np.spacing(100.0) * 64  # times near 100 s have that many digits and no more
    for pose in curve_set.poses:
        track = made[pose]
        dt = np.abs(track.t[:, None] - track.t)
        assert (np.abs(track.v[:, None] - track.v) <= speed * dt + rounding).all()
        t = np.concatenate((track.t, cyan[pose].t))
        assert (track.at(t) <= cyan[pose].at(t) + 1e-6).all()
        assert track.v.min() >= 0
        assert track.v.max() <= 1


@given(schedules(), curve_sets(), settings(), SPEEDS)
def test_limiting_twice_changes_nothing(schedule, curve_set, settings, speed):
    once = limit_speed(run(schedule, curve_set, settings).cyan, speed)
    twice = limit_speed(once, speed)
    for pose in curve_set.poses:
        assert twice[pose].at(once[pose].t) == pytest.approx(once[pose].v, abs=1e-7)


@given(schedules(most=4), curve_sets(), settings())
def test_it_is_the_lowest_cone_everywhere(schedule, curve_set, settings):
    stages = run(schedule, curve_set, settings)
    for pose in curve_set.poses:
        line = list(zip(stages.cyan[pose].t.tolist(), stages.cyan[pose].v.tolist(), strict=True))
        t = np.linspace(schedule.start, schedule.end, 80)
        lowest = [brute_force.magenta(line, settings.speed_limit, s) for s in t.tolist()]
        assert stages.magenta[pose].at(t) == pytest.approx(np.array(lowest), abs=1e-7)


@examples(max_examples=40)
@given(schedules(most=3), curve_sets(), st.sampled_from([1.0, 6.0, 15.0]))
def test_it_equals_a_grid_of_a_tenth_of_a_millisecond(schedule, curve_set, speed):
    cyan = run(schedule, curve_set).cyan
    made = limit_speed(cyan, speed)
    for pose in curve_set.poses:
        grid = np.linspace(schedule.start, schedule.end, int(schedule.duration * 1e4) + 2)
        grid = np.union1d(grid, cyan[pose].t)  # a valley may be narrower than the grid
        slow, step = cyan[pose].at(grid), np.diff(grid)
        for k in range(1, grid.size):  # one step after the other, there and back
            slow[k] = min(slow[k], slow[k - 1] + speed * step[k - 1])
        for k in range(grid.size - 2, -1, -1):
            slow[k] = min(slow[k], slow[k + 1] + speed * step[k])
        assert made[pose].at(grid) == pytest.approx(slow, abs=1e-6)


def test_a_long_utterance_loses_no_digits():
    # 900 s of hills on nine poses: running minima of v ∓ l_max·t reach 10^5
    hills = [(t / 10, (0.0, 0.05)[t % 2]) for t in range(9001)]
    poses = dict.fromkeys("abcdefghi", hills)
    tracks = tracks_of(poses, end=900.0)
    made = limit_speed(tracks, 15.0)
    assert made.x.size == tracks.x.size
    assert np.abs(made.v - tracks.v).max() < 1e-9
