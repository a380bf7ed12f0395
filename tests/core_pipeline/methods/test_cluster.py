"""Clusters: the ones anybody would see are found, and small ones are joined."""

import numpy as np
import pytest

from core_pipeline.methods import cluster
from core_pipeline.methods.cluster import affinity_propagation, k_means, means, merged


def blobs(seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    centres = np.array([[0, 0], [5, 0], [0, 5]])
    truth = np.repeat([0, 1, 2], [20, 12, 5])
    return centres[truth] + rng.normal(0, 0.2, (37, 2)), truth


@pytest.mark.parametrize("find", [lambda points: k_means(points, 3), affinity_propagation])
def test_three_heaps_are_found(find):
    points, truth = blobs()
    labels = find(points)
    assert len({(a, b) for a, b in zip(labels.tolist(), truth.tolist(), strict=True)}) == 3
    assert sorted(set(labels.tolist())) == [0, 1, 2]


def test_a_long_list_is_clustered_by_a_part_of_it(monkeypatch):
    monkeypatch.setattr(cluster, "MOST", 20)
    monkeypatch.setattr(cluster, "BLOCK", 7)
    points, truth = blobs()
    assert len({(a, b) for a, b in zip(k_means(points, 3).tolist(), truth.tolist(), strict=True)}) == 3


def test_small_heaps_are_joined_to_the_nearest():
    points, truth = blobs()
    points[truth == 2] = points[truth == 2] * 0.5
    labels = merged(points, truth, 12)
    assert set(labels.tolist()) == {0, 1}
    assert (labels[truth == 2] == labels[0]).all()


def test_fewer_points_than_clusters():
    points = np.array([[1.0, 1.0], [1.0, 1.0], [2.0, 2.0]])
    assert k_means(points, 5).tolist() in ([0, 0, 1], [1, 1, 0])
    assert affinity_propagation(points[:1]).tolist() == [0]


def test_means_of_clusters():
    assert means(np.array([[0.0], [2.0], [5.0]]), np.array([0, 0, 1])).tolist() == [[1.0], [5.0]]
