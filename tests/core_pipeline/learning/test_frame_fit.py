"""Appendix A: the best non-negative and the best bounded weights, as scipy finds them frame by frame."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import lsq_linear, nnls

from core_pipeline.learning import frame_fit
from core_pipeline.learning.frame_fit import pose_weights, unexplained


def drawn(seed: int, poses: int = 5, d: int = 12, frames: int = 6) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    return rng.normal(size=(d, poses)), rng.normal(size=(frames, d))


@given(st.integers(0, 2**32 - 1))
def test_without_an_upper_bound_it_is_nnls(seed):
    basis, offsets = drawn(seed)
    expected = np.array([nnls(basis, x)[0] for x in offsets])
    assert pose_weights(basis, offsets) == pytest.approx(expected, abs=1e-5)


@settings(max_examples=20)  # scipy takes its time
@given(st.integers(0, 2**32 - 1))
def test_with_one_it_is_lsq_linear(seed):
    basis, offsets = drawn(seed)
    expected = np.array([lsq_linear(basis, x, (0, 1), tol=1e-14).x for x in offsets])
    assert pose_weights(basis, offsets, 1.0) == pytest.approx(expected, abs=1e-4)


@pytest.mark.parametrize("upper", [np.inf, 1.0])
def test_slow_frames_are_finished_exactly(upper, monkeypatch):
    """Nearly parallel poses: the descent does not arrive, scipy does."""
    monkeypatch.setattr(frame_fit, "SWEEPS", 2)
    basis, _ = drawn(3)
    basis[:, 1] = basis[:, 0] + 1e-2 * basis[:, 1]
    offsets = np.array([basis @ [0.2, 0.7, 0, 0.4, 1.0], basis @ [0, 1, 0.5, 0, 0]])
    made = pose_weights(basis, offsets, upper)
    assert made @ basis.T == pytest.approx(offsets, abs=1e-5)


def test_known_weights_come_back_from_vertices():
    rng = np.random.default_rng(1)
    deltas = rng.normal(size=(4, 300, 3))
    weights = rng.random((20, 4))
    vertices = np.einsum("fp,pvc->fvc", weights, deltas)
    basis, offsets = deltas.reshape(4, -1).T, vertices.reshape(20, -1)
    made = pose_weights(basis, offsets, 1.0)
    assert made == pytest.approx(weights, abs=1e-6)
    assert unexplained(basis, offsets, made) < 1e-6


def test_a_pose_that_moves_nothing_stays_at_rest():
    basis, offsets = drawn(2)
    basis[:, 2] = 0
    made = pose_weights(basis, offsets)
    assert not made[:, 2].any()
    assert made.any()


def test_what_no_pose_can_do_is_the_residual():
    basis = np.array([[1.0], [0.0]])
    offsets = np.array([[0.6, 0.8]])
    assert unexplained(basis, offsets, pose_weights(basis, offsets)) == pytest.approx(0.8)
    assert unexplained(basis, offsets * 0, offsets[:, :1] * 0) == 0.0


@pytest.mark.parametrize("frames", [np.zeros((0, 12)), np.zeros((3, 12))])
def test_nothing_moved(frames):
    basis, _ = drawn(2)
    assert pose_weights(basis, frames) == pytest.approx(np.zeros((len(frames), 5)))


def test_sizes_must_fit():
    with pytest.raises(ValueError, match="does not fit"):
        pose_weights(np.zeros((3, 2)), np.zeros((4, 5)))
