"""A curve's rules: rising key times and weights within 0 and 1, never changed in place."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.curves import MIN_GAP, Curve
from tests.helpers.strategies import curves


@pytest.mark.parametrize(
    ("t", "v", "why"),
    [
        ([], [], "at least one key"),
        ([0, 1], [0], "as many values as times"),
        ([[0, 1]], [[0, 1]], "as many values as times"),
        ([0, np.nan], [0, 0], "finite"),
        ([0, 1], [0, np.inf], "finite"),
        ([-0.1, 1], [0, 0], "rise strictly within 0 and 1"),
        ([0, 1.1], [0, 0], "rise strictly within 0 and 1"),
        ([0.5, 0.5], [0, 0], "rise strictly"),
        ([0.6, 0.5], [0, 0], "rise strictly"),
        ([0, 1], [0, 1.01], "values must lie within"),
        ([0, 1], [-0.01, 1], "values must lie within"),
    ],
)
def test_keys_that_break_the_rules_are_refused(t, v, why):
    with pytest.raises(ValueError, match=why):
        Curve(np.array(t, float), np.array(v, float))


def test_a_curve_is_read_only_and_apart_from_what_it_was_made_of():
    t, v = np.array([0.0, 1.0]), np.array([0.0, 1.0])
    curve = Curve(t, v)
    v[1] = 0.5
    assert curve.keys() == [(0.0, 0.0), (1.0, 1.0)]
    with pytest.raises(ValueError, match="read-only"):
        curve.v[0] = 1


@given(curves(nasty=True))
def test_keys_come_back_as_given(curve):
    again = Curve.of(curve.keys())
    assert again.same_as(curve)
    assert len(again) == len(curve.keys())
    assert not curve.same_as(None)


@given(curves(nasty=True), st.floats(0, 1))
def test_the_polygon_passes_every_key_and_is_flat_outside(curve, t):
    assert curve.at(curve.t) == pytest.approx(curve.v)
    assert curve.at(-1) == curve.v[0]
    assert curve.at(2) == curve.v[-1]
    assert curve.v.min() <= curve.at(t) <= curve.v.max()


@given(curves(), st.integers(0, 1000), st.integers(0, 100))
def test_a_key_is_added_in_its_place_or_refused(curve, k, percent):
    t, v = k / 1000, percent / 100
    if np.abs(curve.t - t).min() < MIN_GAP:
        with pytest.raises(ValueError, match="already a key"):
            curve.with_key(t, v)
    else:
        more = curve.with_key(t, v)
        assert sorted([*curve.keys(), (t, v)]) == more.keys()
        gone = more.without([more.keys().index((t, v))])
        assert gone is not None
        assert gone.same_as(curve)


def test_without_its_last_key_there_is_no_curve():
    curve = Curve.of([(0, 0), (0.5, 1)])
    assert curve.without([0, 0]).keys() == [(0.5, 1)]
    assert curve.without([0, 1]) is None
    assert curve.without([]).same_as(curve)
