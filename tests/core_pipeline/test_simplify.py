"""Few keys: never further off than the tolerance allows, rest stays rest, and a drawn curve comes back."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.curves import Curve
from core_pipeline.simplify import simplified
from tests.helpers import strategies as ours

T = np.linspace(0.0, 1.0, 41)


@given(ours.curves(), st.sampled_from([0.01, 0.05, 0.1]))
def test_the_result_stays_near_with_no_more_keys_than_points(curve: Curve, tolerance: float) -> None:
    v = curve.at(T)
    few = simplified(T, v, tolerance)
    assert 1 < len(few) <= T.size
    assert np.sqrt(((few.at(T) - v) ** 2).mean()) <= tolerance
    assert np.abs(few.at(T) - v).max() <= 4 * tolerance


def test_a_drawn_curve_on_the_grid_comes_back() -> None:
    drawn = Curve.of([(0, 0), (0.25, 0.8), (0.5, 0.3), (0.75, 0.6), (1, 0)])
    assert np.allclose(simplified(T, drawn.at(T), 0.02).keys(), drawn.keys())


def test_rest_stays_rest_and_a_scattered_line_gets_the_best_fit() -> None:
    assert not simplified(T, np.zeros(T.size), 0.05).v.any()
    noise = 0.5 + 0.02 * np.where(np.arange(T.size) % 2, 1, -1)
    few = simplified(T, noise, 0.05)
    assert len(few) == 2
    assert np.allclose(few.v, 0.5, atol=0.005)


def test_one_point_is_one_key() -> None:
    assert simplified(np.array([0.5]), np.array([0.2]), 0.05).keys() == [(0.5, 0.2)]
