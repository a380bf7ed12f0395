"""The cheapest path is the one brute force finds."""

from itertools import pairwise, product

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.methods.viterbi import cheapest_path


@given(st.integers(0, 2**32 - 1))
def test_it_equals_brute_force(seed):
    rng = np.random.default_rng(seed)
    sizes = rng.integers(1, 5, rng.integers(1, 6))
    nodes = [rng.integers(0, 6, n).astype(float) for n in sizes]
    edges = [np.zeros((1, 1)), *(rng.integers(0, 6, (a, b)).astype(float) for a, b in pairwise(sizes))]

    def cost(path):
        steps = sum(edges[i][a, b] for i, (a, b) in enumerate(pairwise(path), 1))
        return sum(nodes[i][k] for i, k in enumerate(path)) + steps

    path = cheapest_path(nodes, lambda i: edges[i])
    assert cost(path) == min(map(cost, product(*(range(n) for n in sizes))))


def test_no_layer_no_path():
    assert cheapest_path([], lambda i: np.zeros((1, 1))) == []
