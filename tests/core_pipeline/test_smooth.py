"""Yellow: valleys between near peaks are filled to the chord, until nothing changes."""

import numpy as np
import pytest
from hypothesis import given

from core_pipeline.pipeline import run
from core_pipeline.smooth import smooth
from tests.helpers.strategies import curve_sets, knots, schedules, settings, tracks_of

TWO = [(0, 0), (0.1, 0.8), (0.16, 0.2), (0.22, 0.6), (0.4, 0)]


def yellow(line, window: float) -> list[tuple[float, float]]:
    return knots(smooth(tracks_of({"a": line}), np.array([window]))["a"])


def test_by_hand_two_peaks_012_apart():
    assert yellow(TWO, 0.18) == [(0, 0), (0.1, 0.8), (0.22, 0.6), (0.4, 0)]
    assert yellow(TWO, 0.10) == TWO


def test_peaks_exactly_one_window_apart_are_joined():
    assert yellow(TWO, 0.12) == [(0, 0), (0.1, 0.8), (0.22, 0.6), (0.4, 0)]


def test_small_peaks_count_too():
    small = [(t, v / 1000) for t, v in TWO]
    assert yellow(small, 0.18) == [(0, 0), (0.1, 0.0008), (0.22, 0.0006), (0.4, 0)]


def test_a_window_of_zero_changes_nothing():
    assert yellow(TWO, 0.0) == TWO


def test_each_pose_has_its_own_window():
    both = smooth(tracks_of({"a": TWO, "b": TWO, "c": TWO}), np.array([0.1, 0.18, 0.0]))
    assert knots(both["a"]) == knots(both["c"]) == TWO
    assert len(knots(both["b"])) == 4


def test_the_widest_window_does_not_join_two_poses():
    late, early = [(0.8, 0), (0.999, 1), (1, 0)], [(0, 0), (0.001, 1), (0.2, 0)]
    both = smooth(tracks_of({"a": late, "b": early}), np.array([1.0, 1.0]))
    assert knots(both["a"]) == late
    assert knots(both["b"]) == early


def test_a_plateau_counts_once_and_by_the_edge_that_faces_its_neighbour():
    line = [(0, 0), (0.1, 0.5), (0.3, 0.5), (0.35, 0.1), (0.4, 0.9), (0.5, 0)]
    assert yellow(line, 0.1) == [(0, 0), (0.1, 0.5), (0.3, 0.5), (0.4, 0.9), (0.5, 0)]
    assert yellow(line, 0.09) == line


def test_what_stands_above_the_chord_stays():
    # the shoulder at .15 is no peak, but above the line from .8 to .2
    line = [(0, 0), (0.1, 0.8), (0.15, 0.7), (0.2, 0.1), (0.25, 0.2), (0.4, 0)]
    made = yellow(line, 0.2)
    assert [made[k] for k in (0, 1, 2, -2, -1)] == [line[k] for k in (0, 1, 2, -2, -1)]
    assert len(made) == 6
    t, v = made[3]  # where the fall from the shoulder meets the chord .8 → .2
    assert v == pytest.approx(0.8 - 4 * (t - 0.1))
    assert v == pytest.approx(0.7 - 12 * (t - 0.15))


def test_filling_repeats_until_nothing_changes():
    # .5 between 1 and .8 vanishes when both its valleys are filled; then 1 and .8 are neighbours
    line = [(0, 0), (0.1, 1), (0.15, 0), (0.2, 0.5), (0.25, 0), (0.3, 0.8), (0.4, 0)]
    assert yellow(line, 0.2) == [(0, 0), (0.1, 1), (0.3, 0.8), (0.4, 0)]
    assert yellow(line, 0.19) == [(0, 0), (0.1, 1), (0.2, 0.5), (0.3, 0.8), (0.4, 0)]


@given(schedules(nasty=True), curve_sets(nasty=True), settings())
def test_yellow_is_never_below_blue_and_smoothing_twice_changes_nothing(schedule, curve_set, settings):
    stages = run(schedule, curve_set, settings)
    windows = np.array([settings.window_of(pose) for pose in curve_set.poses])
    again = smooth(stages.yellow, windows)
    for pose in curve_set.poses:
        t = np.concatenate((stages.blue[pose].t, stages.yellow[pose].t))
        assert (stages.yellow[pose].at(t) >= stages.blue[pose].at(t) - 1e-6).all()
        assert again[pose].at(t) == pytest.approx(stages.yellow[pose].at(t), abs=1e-6)
