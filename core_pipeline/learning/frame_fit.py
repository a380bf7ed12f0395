"""Captured motion → how much of each pose, frame by frame (Chen et al., appendix A).

    min ‖B w − (x − neutral)‖²,  w ≥ 0                 blending coefficients of key lip shapes
    min ‖B w − (x − neutral)‖²,  0 ≤ w ≤ 1             controls of a rig

All frames are solved together: B is small, so only BᵀB and the frames' products with B are needed, and coordinates
are improved in turn for every frame at once (the problem is convex: it ends in the one best answer). Frames still on
their way when that ends are finished one by one by scipy's `nnls`, from one Cholesky factor, or by `lsq_linear`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cholesky, solve_triangular
from scipy.optimize import lsq_linear, nnls

Array = NDArray[np.float64]

SWEEPS = 400
#: A frame is done when no weight moves by more than this in a sweep.
STILL = 1e-8
#: Poses of which this share of the largest is missing cannot be told from nothing.
NOTHING = 1e-9


def pose_weights(basis: Array, offsets: Array, upper: float = np.inf) -> Array:
    """(f, poses) best weights within 0 and `upper`; a pose that moves nothing gets 0.

    basis    (d, poses) what each pose does to the d measured numbers: vertices, landmarks or channels
    offsets  (f, d) what was measured, less the neutral face
    ValueError when the sizes do not fit.
    """
    if basis.ndim != 2 or offsets.ndim != 2 or basis.shape[0] != offsets.shape[1]:
        raise ValueError(f"a basis {basis.shape} does not fit frames {offsets.shape}")
    weights = np.zeros((len(offsets), basis.shape[1]))
    gram, products = basis.T @ basis, offsets @ basis
    size = np.diagonal(gram)
    moves = np.flatnonzero(size > NOTHING * size.max(initial=0.0))
    if not moves.size or not len(offsets):
        return weights
    gram, products = gram[np.ix_(moves, moves)], products[:, moves]
    made, moving = _by_coordinates(gram, products, upper)
    if moving.any():
        made[moving] = _one_by_one(gram, products[moving], upper)
    weights[:, moves] = made
    return weights


def _by_coordinates(gram: Array, products: Array, upper: float) -> tuple[Array, NDArray[np.bool_]]:
    """Cyclic coordinate descent; the weights, and which frames had not come to rest."""
    w = np.zeros((products.shape[1], len(products)))
    b = np.ascontiguousarray(products.T)
    change = np.zeros(len(products))
    for _ in range(SWEEPS):
        change[:] = 0.0
        for p in range(len(w)):
            best = w[p] + (b[p] - gram[p] @ w) / gram[p, p]
            np.clip(best, 0.0, upper, out=best)
            np.maximum(change, np.abs(best - w[p]), out=change)
            w[p] = best
        if change.max() <= STILL:
            break
    return np.ascontiguousarray(w.T), change > STILL


def _one_by_one(gram: Array, products: Array, upper: float) -> Array:
    """Exact, at a fraction of a millisecond a frame: ‖B w − x‖ and ‖Lᵀ w − L⁻¹ Bᵀ x‖ have the same minimum."""
    ridge = 1e-12 * float(np.diagonal(gram).max())
    lower = cholesky(gram + ridge * np.eye(len(gram)), lower=True)
    right = solve_triangular(lower, products.T, lower=True).T
    if np.isinf(upper):
        return np.array([nnls(lower.T, row)[0] for row in right])
    return np.array([np.clip(lsq_linear(lower.T, row, (0.0, upper), tol=1e-12).x, 0.0, upper) for row in right])


def unexplained(basis: Array, offsets: Array, weights: Array) -> float:
    """The share of the motion that the weights leave: RMS of B w − x by RMS of x; 0 when nothing moved."""
    moved = float(np.sqrt((offsets**2).mean())) if offsets.size else 0.0
    left = float(np.sqrt(((weights @ basis.T - offsets) ** 2).mean())) if offsets.size else 0.0
    return left / moved if moved > 1e-12 else 0.0
