"""Tracks: knots are minimal and rise, a pose that nothing moves is 0 all along, poses never touch on the long axis."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.tracks import COLLINEAR, NEAR, Tracks, apart, minimal
from tests.helpers.strategies import knots, tracks_of

HILL = [(0.2, 0.0), (0.5, 1.0), (0.8, 0.0)]


def test_each_pose_is_a_track_in_seconds():
    tracks = tracks_of({"a": HILL, "b": [], "c": [HILL[0], (0.6, 0.5), HILL[2]]}, start=-3.0, end=1.0)
    assert list(tracks) == ["a", "b", "c"]
    assert len(tracks) == 3
    assert knots(tracks["a"]) == HILL
    assert knots(tracks["c"]) == [HILL[0], (0.6, 0.5), HILL[2]]
    with pytest.raises(KeyError, match="nose"):
        tracks["nose"]


def test_a_pose_that_nothing_moves_is_zero_from_start_to_end():
    assert knots(tracks_of({"a": HILL, "b": []}, start=-1.0, end=2.0)["b"]) == [(-1.0, 0.0), (2.0, 0.0)]
    assert knots(Tracks(("a",), np.zeros(0), np.zeros(0), 3.0, 0.0)["a"]) == [(3.0, 0.0)]


def test_a_track_is_zero_outside_its_knots():
    track = tracks_of({"a": HILL})["a"]
    assert track.at(np.array([[-5.0, 0.2], [0.35, 9.0]])).tolist() == [[0.0, 0.0], [pytest.approx(0.5), 0.0]]


@given(st.lists(st.tuples(st.integers(1, 40), st.integers(0, 8)), min_size=1, max_size=20))
def test_minimal_keeps_the_function_and_no_knot_too_many(steps):
    x = np.cumsum([0, *[dx for dx, _ in steps], 5]) / 100
    v = np.array([0, *[k for _, k in steps], 0]) / 8
    xm, vm = minimal(x, v)
    if not v.any():
        assert not xm.size
        return
    at = np.linspace(x[0], x[-1], 400)
    assert np.interp(at, xm, vm, left=0, right=0) == pytest.approx(np.interp(at, x, v), abs=1e-7)
    turn = np.diff(np.diff(vm) / np.diff(xm))
    assert (np.abs(turn) > COLLINEAR).all()
    assert set(xm) <= set(x)


@pytest.mark.parametrize(
    ("v", "left"),
    [
        ([0, 0, 0, 1, 0, 0, 0], [2, 3, 4]),  # doubled zeros at the ends would act as a support of one point
        ([0, 1, 0, 0, 0, 1, 0], [0, 1, 2, 4, 5, 6]),
        ([0, 1, 1, 1, 0], [0, 1, 3, 4]),
        ([0, 0.5, 1, 0.5, 0], [0, 2, 4]),
        ([0, 0, 0, 0], []),
        ([0, 0, 1e-8, 0, 0], [1, 2, 3]),
    ],
)
def test_minimal_by_hand(v, left):
    x, _ = minimal(np.arange(len(v), dtype=float), np.array(v, float))
    assert x.tolist() == left


def test_the_point_where_a_pose_comes_to_rest_is_kept_however_gently_it_does():
    x = np.array([0, 0.1, 0.2, 0.2 + 1e-6, 2.0, 2.1, 2.2])
    v = np.array([0, 1e-5, 0, 0, 0, 1, 0])
    for _xm, vm in (minimal(x, v), minimal(x[:4], v[:4]), minimal(2.2 - x[3::-1], v[3::-1])):
        assert vm[0] == vm[-1] == 0
        assert (vm > 0).any()
    assert minimal(x[:4], v[:4])[0].tolist() == [0, 0.1, 0.2]


def test_a_corner_of_two_close_knots_is_kept():
    # 30 ns apart on gentle slopes, each of the two is within 1e-9 of the line between its neighbours
    x = np.array([0, 0.5, 0.5 + 3e-8, 1.0])
    v = np.array([0, 5e-3, 5e-3, 0])
    for valley in (v, np.array([1, 0.995, 0.995, 1])):
        line = np.concatenate(([-1.0], x, [2.0])), np.concatenate(([0], valley, [0]))
        made = minimal(*line)
        assert np.interp(x, *made) == pytest.approx(valley, abs=1e-8)


def test_near_equal_knots_become_one_before_anything_is_called_collinear():
    x, v = apart(np.array([0, 0.1, 0.1 + NEAR / 10, 0.2]), np.array([0, 0.5, 0.5, 0.6]))
    assert (x.tolist(), v.tolist()) == ([0, 0.1, 0.2], [0, 0.5, 0.6])
    assert minimal(x, v)[0].size == 3, "both of a near pair look collinear, yet there is a corner"


def test_a_step_survives_however_steep():
    for width in (0.0, NEAR / 100, NEAR / 2):
        x, v = apart(np.array([0, 0.3, 0.3 + width, 0.5]), np.array([0, 0.2, 0.9, 0]))
        assert v.tolist() == [0, 0.2, 0.9, 0]
        assert (np.diff(x) > 0).all()
        assert x == pytest.approx([0, 0.3, 0.3, 0.5], abs=NEAR)


def test_a_run_that_reaches_zero_becomes_zero():
    _, v = apart(np.array([0, 0.3, 0.3 + NEAR / 4, 0.3 + NEAR / 2]), np.array([0, 1e-7, 5e-8, 0]))
    assert v.tolist() == [0, 0]
