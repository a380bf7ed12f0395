"""Splines: pchip is scipy's and keeps every peak, a literal B-spline halves it, none leaves 0…1."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import PchipInterpolator

from core_pipeline.settings import SPLINES
from core_pipeline.spline import interpolate
from tests.helpers.strategies import curves

THREE = (np.array([0.0, 0.5, 1.0]), np.array([0.0, 1.0, 0.0]))
GRID = np.linspace(0, 1, 201)


@given(curves(nasty=True).filter(lambda curve: len(curve) > 1 and np.diff(curve.t).min() > 1e-8))
def test_pchip_equals_scipys(curve):
    at = np.linspace(curve.t[0], curve.t[-1], 97)
    assert interpolate(curve.t, curve.v, "pchip", at) == pytest.approx(
        PchipInterpolator(curve.t, curve.v)(at), abs=1e-9
    )


@given(curves(), st.sampled_from(SPLINES))
def test_no_spline_leaves_zero_to_one(curve, kind):
    made = interpolate(curve.t, curve.v, kind, GRID)
    assert made.shape == GRID.shape
    assert made.min() >= -1e-12
    assert made.max() <= 1 + 1e-12


@given(curves(), st.sampled_from(["pchip", "cardinal", "linear"]))
def test_these_pass_through_every_key(curve, kind):
    assert interpolate(curve.t, curve.v, kind, curve.t) == pytest.approx(curve.v, abs=1e-9)


@given(curves(), st.sampled_from(SPLINES))
def test_outside_its_keys_a_curve_is_flat(curve, kind):
    first, last = interpolate(curve.t, curve.v, kind, [-1.0, 2.0])
    assert (first, last) == (pytest.approx(curve.v[0]), pytest.approx(curve.v[-1]))


def test_a_literal_bspline_halves_the_peak_of_three_keys():
    assert interpolate(*THREE, "bspline", GRID).max() == pytest.approx(0.5, abs=1e-3)
    for kind in ("pchip", "cardinal", "linear"):
        assert interpolate(*THREE, kind, GRID).max() == 1


def test_a_cubic_bspline_of_a_line_is_the_line():
    t = np.array([0.0, 0.2, 0.5, 0.9, 1.0])
    assert interpolate(t, t, "bspline", GRID) == pytest.approx(GRID, abs=1e-6)


def test_a_cardinal_spline_would_overshoot_and_is_clipped():
    t, v = np.array([0, 0.2, 0.4, 0.6, 0.8]), np.array([0, 0.9, 1, 1, 0])
    made = interpolate(t, v, "cardinal", np.linspace(0, 0.8, 321))
    assert made.max() == 1
    assert (made == 1).sum() > 20, "the overshoot between .4 and .6 is cut off flat"
    # between .2 and .4 the slopes are (1 − 0)/.4 and (1 − .9)/.4
    h00, h10, h01, h11 = 0.5, 0.125, 0.5, -0.125
    middle = h00 * 0.9 + h10 * 0.2 * 2.5 + h01 * 1 + h11 * 0.2 * 0.25
    assert interpolate(t, v, "cardinal", 0.3) == pytest.approx(min(middle, 1))


@pytest.mark.parametrize("kind", SPLINES)
def test_one_and_two_keys(kind):
    assert interpolate(np.array([0.5]), np.array([0.3]), kind, [0, 0.5, 1]).tolist() == [0.3] * 3
    assert interpolate(np.array([0.0, 1.0]), np.array([0.0, 1.0]), kind, 0.25) == pytest.approx(0.25)


@pytest.mark.parametrize("keys", [2, 3, 9])
def test_an_unknown_spline_is_refused(keys):
    t = np.linspace(0, 1, keys)
    with pytest.raises(ValueError, match="bezier"):
        interpolate(t, t, "bezier", 0.5)
