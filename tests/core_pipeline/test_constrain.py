"""Cyan: of two poses that clash, the one of lower priority gives way, and only where both are active."""

import numpy as np
import pytest
from hypothesis import given

from core_pipeline.constrain import constrain
from core_pipeline.pipeline import run
from core_pipeline.settings import Constraint, Settings
from tests.helpers.strategies import curve_sets, knots, schedules, settings, tracks_of

OPEN = [(0.0, 0.0), (0.2, 0.8), (0.8, 0.8), (1.0, 0.0)]
PBM = [(0.3, 0.0), (0.4, 0.4), (0.6, 0.4), (0.7, 0.0)]


def limits(priorities: str, **pairs: float) -> Settings:
    """limits("ab", ab=.5): C(a, b) = 0.5, and a gives way."""
    made = tuple(Constraint(pair[0], pair[1], limit) for pair, limit in pairs.items())
    return Settings(constraints=made, priorities=tuple(priorities))


def test_by_hand_open_falls_to_a_tenth_where_the_lips_meet():
    low = constrain(tracks_of({"open": OPEN, "PBM": PBM}), Settings.paper())
    track = low["open"]
    assert track.at(np.array([0.4, 0.5, 0.6])) == pytest.approx([0.1, 0.1, 0.1])
    assert track.at(np.array([0.25, 0.2985, 0.7015, 0.75])) == pytest.approx([0.8] * 4)
    assert knots(low["PBM"]) == PBM


def test_by_hand_every_knot():
    made = knots(constrain(tracks_of({"a": OPEN, "b": PBM}), limits("ab", ab=0.5))["a"])
    step = 0.001  # a step to .5 where b begins, drawn outside b's support, and one where it ends
    expected = [(0, 0), (0.2, 0.8), (0.3 - step * 0.3 / 0.5, 0.8), (0.3, 0.5), (0.4, 0.1), (0.6, 0.1), (0.7, 0.5)]
    expected += [(0.7 + step * 0.3 / 0.5, 0.8), (0.8, 0.8), (1, 0)]
    assert np.array(made) == pytest.approx(np.array(expected))


def test_open_is_not_clipped_where_the_other_pose_rests():
    line = [(0, 0), (0.1, 1), (0.9, 1), (1, 0)]
    made = constrain(tracks_of({"open": line, "FV": []}), Settings.paper())
    assert knots(made["open"]) == line
    short = [(0.5, 0), (0.55, 0.2), (0.6, 0)]
    made = constrain(tracks_of({"open": line, "FV": short}), Settings.paper())
    assert made["open"].at(np.array([0.4, 0.49, 0.61, 0.7])) == pytest.approx([1, 1, 1, 1])


def test_a_small_sum_is_left_alone():
    # the printed formula, c_b − (C − c_a − c_b), would raise b here
    low, high = [(0, 0), (0.5, 0.2), (1, 0)], [(0, 0), (0.5, 0.2), (1, 0)]
    tracks = tracks_of({"a": low, "b": high})
    assert knots(constrain(tracks, limits("ab", ab=0.5))["a"]) == low


def test_priority_decides_and_a_pose_without_priority_is_free():
    both = {"a": OPEN, "b": PBM}
    assert knots(constrain(tracks_of(both), limits("ba", ab=0.5))["a"]) == OPEN
    assert constrain(tracks_of(both), limits("ba", ab=0.5))["b"].v.max() == 0
    unnamed = tracks_of(both)
    assert constrain(unnamed, limits("a", ab=0.5)) is unnamed
    assert constrain(unnamed, limits("ab", ab=2.0)) is unnamed


def test_priorities_may_name_poses_that_the_set_does_not_have():
    tracks = tracks_of({"a": OPEN, "b": PBM})
    made = constrain(tracks, limits("azb", ab=0.5, za=0.0, zb=0.0))
    assert knots(made["a"]) == knots(constrain(tracks, limits("ab", ab=0.5))["a"])


@pytest.mark.parametrize(
    ("limit", "middle"), [(0.0, 0.0), (0.4, 0.0), (1.0, 0.6), (1.15, 0.75), (1.2, 0.8), (1.3, 0.8)]
)
def test_limits_below_and_above_one(limit, middle):
    made = constrain(tracks_of({"a": OPEN, "b": PBM}), limits("ab", ab=limit))["a"]
    assert made.at(np.array([0.5]))[0] == pytest.approx(middle)
    assert made.at(np.array([0.25, 0.75])) == pytest.approx([0.8, 0.8])


def test_a_pose_is_lowered_before_it_limits_others():
    # c pushes b to 0, so b leaves a alone
    flat = [(0, 0), (0.1, 0.9), (0.9, 0.9), (1, 0)]
    made = constrain(tracks_of({"a": flat, "b": flat, "c": flat}), limits("abc", ab=0.2, bc=0.2))
    assert made["b"].at(np.linspace(0.11, 0.89, 9)).max() == 0
    assert made["a"].at(np.linspace(0.11, 0.89, 9)) == pytest.approx(0.9)


def test_several_uppers_that_cross_in_one_point():
    flat = [(0, 0), (0.01, 1), (0.99, 1), (1, 0)]
    up, down = [(0.1, 0), (0.9, 0.8), (0.95, 0)], [(0.05, 0), (0.1, 0.8), (0.9, 0)]
    peak = [(0.1, 0), (0.5, 0.4), (0.9, 0)]
    made = constrain(tracks_of({"a": flat, "b": up, "c": down, "d": peak}), limits("abcd", ab=1, ac=1, ad=1))["a"]
    at = np.linspace(0.12, 0.88, 153)
    tops = [np.interp(at, *np.array(line).T) for line in (up, down, peak)]
    assert made.at(at) == pytest.approx(1 - np.max(tops, axis=0))
    assert (0.5, 0.6) in knots(made)


def test_a_support_that_touches_zero_in_one_point_is_one_support():
    flat = [(0, 0), (0.01, 0.9), (0.99, 0.9), (1, 0)]
    twin = [(0.2, 0), (0.3, 0.5), (0.4, 0), (0.5, 0.5), (0.6, 0)]
    made = constrain(tracks_of({"a": flat, "b": twin}), limits("ab", ab=0.5))["a"]
    assert made.at(np.array([0.4]))[0] == pytest.approx(0.5), "C − 0, as on either side"


@pytest.mark.parametrize(("gap", "ramp"), [(0.1, 1e-3), (0.0015, 0.0005), (3e-5, 1e-5)])
def test_a_step_is_a_ramp_outside_the_upper_support(gap, ramp):
    flat = [(0, 0), (0.01, 1), (0.99, 1), (1, 0)]
    twin = [(0.2, 0), (0.3, 0.5), (0.4, 0), (0.4 + gap, 0), (0.55, 0.5), (0.6, 0)]
    made = constrain(tracks_of({"a": flat, "b": twin}), limits("ab", ab=0.5))["a"]
    edges = np.array([0.2, 0.4, 0.4 + gap, 0.6])
    assert made.at(edges) == pytest.approx([0.5] * 4)
    assert made.at(np.array([0.2 - 1e-3, 0.4 + ramp, 0.4 + gap - ramp, 0.6 + 1e-3])) == pytest.approx([1.0] * 4)
    assert made.at(np.array([0.4 + ramp / 2, 0.4 + gap - ramp / 2])) == pytest.approx([0.75] * 2)


def test_rounding_dust_does_not_count_as_active():
    # b comes back to zero on a slope: behind it, a is free again
    high = [(0.1, 0), (0.3, 0.7), (0.3 + 0.1 / 3, 0.0), (0.9, 0.0), (0.95, 0.1), (1.0, 0)]
    made = constrain(tracks_of({"a": OPEN, "b": high}), limits("ab", ab=0.5))["a"]
    assert made.at(np.array([0.34, 0.5, 0.8])) == pytest.approx([0.8] * 3)


def test_what_is_left_of_a_pose_below_rounding_is_exactly_zero():
    high = [(0.1, 0), (0.3, 0.3 - 1e-12), (0.7, 0.3 - 1e-12), (0.9, 0)]
    made = constrain(tracks_of({"a": OPEN, "b": high}), limits("ab", ab=0.3))["a"]
    assert made.at(np.array([0.3, 0.5, 0.7])).tolist() == [0, 0, 0]


@given(schedules(), curve_sets(), settings())
def test_the_sum_law(schedule, curve_set, settings):
    stages = run(schedule, curve_set, settings)
    for low, uppers in settings.clashes.items():
        for high, limit in uppers:
            for colour in ("cyan", "magenta"):
                a, b = stages.stage(colour)[high], stages.stage(colour)[low]
                # constraints are stated for cyan; limiting speed raises nothing, so they hold behind it
                t = np.unique(np.concatenate((a.t, b.t, (a.t[1:] + a.t[:-1]) / 2, (b.t[1:] + b.t[:-1]) / 2)))
                va, vb = a.at(t), b.at(t)
                both = (va > 1e-9) & (vb > 1e-9)
                assert (va + vb)[both].max(initial=0) <= limit + 3e-9


@given(schedules(nasty=True), curve_sets(nasty=True), settings())
def test_cyan_is_never_above_yellow_and_the_first_pose_is_untouched(schedule, curve_set, settings):
    stages = run(schedule, curve_set, settings)
    for pose in curve_set.poses:
        t = np.concatenate((stages.yellow[pose].t, stages.cyan[pose].t))
        around = [stages.yellow[pose].at(t + shift) for shift in (-2e-8, 0, 2e-8)]  # a step may stand that far off
        assert (stages.cyan[pose].at(t) <= np.max(around, axis=0) + 1e-6).all()
        if pose not in settings.clashes:
            assert stages.cyan[pose].t == pytest.approx(stages.yellow[pose].t, abs=1e-8)
            assert np.array_equal(stages.cyan[pose].v, stages.yellow[pose].v)
