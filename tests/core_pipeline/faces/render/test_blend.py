"""Mixing shapes: the one product agrees with the definition, and the normals with the surface."""

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from core_pipeline.faces.render.blend import Blend
from tests.helpers.ball import ball
from tests.helpers.rigs import head

BALL = ball()
MANY = head([f"shape {number}" for number in range(24)])
AMOUNTS = hnp.arrays(np.float32, 2, elements=st.floats(-0.5, 1.5, width=32))


@given(AMOUNTS)
def test_positions_are_those_of_the_face(amounts):
    np.testing.assert_allclose(Blend(BALL).mixed(amounts)[:, :3], BALL.deform(amounts), atol=1e-6)


@given(AMOUNTS)
def test_blended_normals_are_the_neutral_ones_plus_each_shapes_share(amounts):
    expected = BALL.normals + np.tensordot(amounts, BALL.normal_deltas, 1)
    np.testing.assert_allclose(Blend(BALL).mixed(amounts)[:, 3:], expected, atol=1e-5)


@given(st.lists(AMOUNTS, min_size=2, max_size=4))
def test_no_mix_leaves_a_trace_in_the_next(mixes):
    blend = Blend(BALL)
    for amounts in mixes:
        blend.exact(amounts)
        np.testing.assert_array_equal(blend.mixed(amounts), Blend(BALL).mixed(amounts))


@given(st.lists(hnp.arrays(np.float32, 24, elements=st.sampled_from([0, 0, 0.25, 0.5, -0.3, 0.7])), max_size=5))
def test_shapes_of_one_amount_may_be_many_and_change(mixes):
    blend = Blend(MANY)
    for amounts in mixes:
        np.testing.assert_allclose(blend.mixed(amounts)[:, :3], MANY.deform(amounts), atol=2e-5)


def test_the_sums_that_are_kept_are_few():
    blend = Blend(MANY)
    for first, second in combinations(range(24), 2):
        amounts = np.zeros(24, np.float32)
        amounts[[first, second]] = 0.5
        np.testing.assert_allclose(blend.mixed(amounts)[:, :3], MANY.deform(amounts), atol=1e-6)
    kept = [value for value in vars(blend).values() if isinstance(value, dict)]
    assert all(len(value) <= 16 for value in kept)


@given(AMOUNTS)
def test_exact_normals_stand_on_the_moved_surface(amounts):
    blend = Blend(BALL)
    both = blend.exact(amounts)
    # The ball at these amounts is an ellipsoid, whose normals are known.
    expected = BALL.positions / (1 + 0.4 * amounts[1], 1 + 0.4 * amounts[0], 1)
    expected /= np.linalg.norm(expected, axis=1, keepdims=True)
    cosines = np.einsum("ij,ij->i", both[:, 3:], expected)
    assert cosines.min() > np.cos(np.radians(4))
    np.testing.assert_allclose(np.linalg.norm(both[:, 3:], axis=1), 1, atol=1e-5)


def test_at_rest_the_exact_normals_are_the_faces_own():
    tilted = BALL.normals + np.array([0.2, 0.0, 0.1])
    tilted = (tilted / np.linalg.norm(tilted, axis=1, keepdims=True)).astype(np.float32)
    face = replace(BALL, normals=tilted)
    np.testing.assert_allclose(Blend(face).exact(np.zeros(2))[:, 3:], tilted, atol=1e-6)


def test_a_seam_does_not_show():
    """The first and last column of the ball are the same places: their normals stay the same, too."""
    normals = Blend(BALL).exact(np.array([1.0, 0.3]))[:, 3:].reshape(25, 49, 3)
    np.testing.assert_array_equal(normals[:, 0], normals[:, -1])


def test_a_hard_edge_stays_hard():
    """Two triangles in a roof, each with its own corners on the ridge."""
    positions = np.array([(-1, 0, 0), (0, 1, 0), (0, 1, 1), (1, 0, 0), (0, 1, 1), (0, 1, 0)], np.float32)
    left, right = (-(0.5**0.5), 0.5**0.5, 0), (0.5**0.5, 0.5**0.5, 0)
    normals = np.array([left] * 3 + [right] * 3, np.float32)
    face = replace(
        BALL,
        positions=positions,
        normals=normals,
        triangles=np.array([(0, 2, 1), (3, 5, 4)], np.uint32),
        deltas=np.zeros((2, 6, 3), np.float32),
        normal_deltas=np.zeros((2, 6, 3), np.float32),
    )
    np.testing.assert_allclose(Blend(face).exact(np.zeros(2))[:, 3:], normals, atol=1e-6)


def test_the_same_array_is_filled_again():
    blend = Blend(BALL)
    assert np.shares_memory(blend.mixed(np.zeros(2)), blend.mixed(np.ones(2)))


def test_amounts_of_another_face_are_refused():
    with pytest.raises(ValueError, match="shape"):
        Blend(BALL).mixed(np.zeros(3))


@pytest.mark.parametrize("moved", [[], [0], [70, 400], [-1]])
def test_a_shape_that_moves_few_vertices_or_none(moved):
    deltas = np.zeros_like(BALL.deltas)
    deltas[0, moved] = (0.1, -0.2, 0.3)
    face = replace(BALL, deltas=deltas, normal_deltas=np.zeros_like(deltas))
    both = Blend(face).mixed(np.array([0.5, 0.0], np.float32))
    np.testing.assert_allclose(both[:, :3], face.deform(np.array([0.5, 0.0])), atol=1e-6)
    np.testing.assert_array_equal(both[:, 3:], BALL.normals)


@pytest.mark.parametrize("active", [1, 16, 17, 40])
def test_few_or_many_active_shapes_are_the_same_sum(active):
    deltas = np.random.default_rng(active).normal(0, 0.1, (40, len(BALL.positions), 3)).astype(np.float32)
    face = replace(BALL, shapes=tuple(f"s{i}" for i in range(40)), deltas=deltas, normal_deltas=-deltas)
    amounts = np.where(np.arange(40) < active, 0.3, 0).astype(np.float32)
    both = Blend(face).mixed(amounts)
    np.testing.assert_allclose(both[:, :3], face.deform(amounts), atol=1e-5)
    np.testing.assert_allclose(both[:, 3:], BALL.normals - np.tensordot(amounts, deltas, 1), atol=1e-5)
