"""Clusters of motion segments: k-means for both papers, affinity propagation as the second one has it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.cluster.vq import kmeans, vq

Array = NDArray[np.float64]
Ints = NDArray[np.intp]

#: Points that centres are found from; of more, every second, third, … (scipy takes points × clusters numbers).
MOST = 12_000
#: Points that are given to their clusters at once.
BLOCK = 4096


def k_means(points: Array, k: int, seed: int = 0) -> Ints:
    """(n,) the cluster of each point (n, d); at most k of them, numbered from 0, none empty.

    Lloyd's iterations by scipy, from starts drawn as k-means++ draws them (Arthur and Vassilvitskii, 2007).
    """
    some = points[:: -(-len(points) // MOST)]
    starts = _spread_starts(some, min(k, len(some)), np.random.default_rng(seed))
    book, _ = kmeans(some, starts)
    labels = [vq(points[i : i + BLOCK], book)[0] for i in range(0, len(points), BLOCK)]
    return _renumbered(np.concatenate(labels).astype(np.intp))


def _spread_starts(points: Array, k: int, rng: np.random.Generator) -> Array:
    chosen = [int(rng.integers(len(points)))]
    nearest = ((points - points[chosen[0]]) ** 2).sum(1)
    for _ in range(1, k):
        total = nearest.sum()
        if total <= 1e-12:  # fewer different points than clusters
            break
        chosen.append(int(rng.choice(len(points), p=nearest / total)))
        np.minimum(nearest, ((points - points[chosen[-1]]) ** 2).sum(1), out=nearest)
    return points[chosen]


def affinity_propagation(points: Array, rounds: int = 200, damping: float = 0.7) -> Ints:
    """(n,) the cluster of each point (n, d), their number found by messages (Frey and Dueck, Science 315, 2007).

    The preference is the median similarity, as the authors advise.
    """
    n = len(points)
    if n < 2:
        return np.zeros(n, np.intp)
    squares = (points**2).sum(1)
    similar = -(squares[:, None] + squares[None] - 2 * points @ points.T)
    np.fill_diagonal(similar, np.median(similar[~np.eye(n, dtype=bool)]))
    similar += 1e-12 * np.abs(similar).max() * np.random.default_rng(0).standard_normal((n, n))  # no ties
    responsible, available = np.zeros((n, n)), np.zeros((n, n))
    rows = np.arange(n)
    for _ in range(rounds):
        both = available + similar
        best = both.argmax(1)
        first = both[rows, best]
        both[rows, best] = -np.inf
        rival = np.repeat(first[:, None], n, 1)
        rival[rows, best] = both.max(1)
        responsible = damping * responsible + (1 - damping) * (similar - rival)
        support = np.maximum(responsible, 0.0)
        support[rows, rows] = responsible[rows, rows]
        update = support.sum(0)[None] - support
        own = update[rows, rows].copy()
        update = np.minimum(update, 0.0)
        update[rows, rows] = own
        available = damping * available + (1 - damping) * update
    exemplars = np.flatnonzero((responsible + available)[rows, rows] > 0)
    if not exemplars.size:
        return np.zeros(n, np.intp)
    labels = exemplars[similar[:, exemplars].argmax(1)]
    labels[exemplars] = exemplars
    return _renumbered(labels)


def merged(points: Array, labels: Ints, smallest: int) -> Ints:
    """Clusters of fewer than `smallest` points joined to the one whose centre is nearest, smallest first."""
    labels = _renumbered(labels)
    while True:
        count = np.bincount(labels)
        small = int(count.argmin())
        if count.size < 2 or count[small] >= smallest:
            return labels
        centres = means(points, labels)
        distance = ((centres - centres[small]) ** 2).sum(1)
        distance[small] = np.inf
        labels[labels == small] = int(distance.argmin())
        labels = _renumbered(labels)


def means(points: Array, labels: Ints) -> Array:
    """(clusters, d) the centre of each cluster; labels count from 0 without a gap."""
    total = np.zeros((int(labels.max(initial=-1)) + 1, points.shape[1]))
    np.add.at(total, labels, points)
    return np.asarray(total / np.bincount(labels)[:, None])


def _renumbered(labels: Ints) -> Ints:
    return np.unique(labels, return_inverse=True)[1].reshape(-1).astype(np.intp)
