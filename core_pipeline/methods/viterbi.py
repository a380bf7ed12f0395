"""The cheapest path through layers of choices, one choice a layer (what A* finds in Chen et al., section VI).

layer 0     layer 1     layer 2
  o ────────▶ o ────────▶ o
  o ───╲  ╱─▶ o ─╲
  o     ╳         ╲─────▶ o
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def cheapest_path(nodes: Sequence[Array], edges: Callable[[int], Array]) -> list[int]:
    """The choice in each layer with the least sum of node and edge costs; of equal paths, the first choices.

    nodes  per layer (choices,) costs, at least one choice each
    edges  layer i ≥ 1 → (choices of i−1, choices of i) costs of going from one to the other
    """
    if not nodes:
        return []
    cost = nodes[0]
    came_from: list[NDArray[np.intp]] = []
    for i in range(1, len(nodes)):
        through = cost[:, None] + edges(i)
        best = through.argmin(axis=0)
        came_from.append(best)
        cost = through[best, np.arange(best.size)] + nodes[i]
    path = [int(cost.argmin())]
    for best in reversed(came_from):
        path.append(int(best[path[-1]]))
    return path[::-1]
