"""Keys as foreign hands wrote them → a curve: clipped into 0…1, sorted, equal times merged, and counted."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..curves import Curve

#: Keys this far outside 0…1 are drawing noise; further is an error.
SLACK = 0.05


@dataclass(frozen=True)
class Mends:
    """What was done to the keys of one curve: how many keys were clipped and merged, and whether they were sorted."""

    clipped: int = 0
    sorted: bool = False
    merged: int = 0


def mend(keys: NDArray[np.float64]) -> tuple[Curve, Mends]:
    """The curve of finite (m, 2) times and values, m > 0; of keys at one time the highest stays."""
    inside = np.clip(keys, 0.0, 1.0)
    clipped = int((inside != keys).any(1).sum())
    t, v = inside[:, 0], inside[:, 1]
    unsorted = bool((np.diff(t) < 0).any())
    if unsorted:
        order = t.argsort(kind="stable")
        t, v = t[order], v[order]
    merged = 0
    if (np.diff(t) == 0).any():
        times, group = np.unique(t, return_inverse=True)
        highest = np.zeros(times.size)
        np.maximum.at(highest, group, v)
        merged = t.size - times.size
        t, v = times, highest
    return Curve(t, v), Mends(clipped, unsorted, merged)
