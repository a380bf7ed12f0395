"""How much the bigrams of two curve sets differ."""

from __future__ import annotations

import numpy as np

from .curve_set import Bigram, CurveSet
from .phonemes import Pair
from .suggest import sampled


def differences(one: CurveSet, other: CurveSet) -> dict[Pair, float]:
    """Pair → RMS difference of the weights over all poses and moments, for pairs that differ at all.

    A bigram or a pose that one of them lacks counts as rest; the poses are those of both.
    """
    poses = tuple(dict.fromkeys((*one.poses, *other.poses)))
    nothing = Bigram()
    found = {}
    for pair in dict.fromkeys((*one.bigrams, *other.bigrams)):
        a, b = one.bigrams.get(pair, nothing), other.bigrams.get(pair, nothing)
        if a is not b:
            rms = float(np.sqrt(np.mean((sampled(a, poses) - sampled(b, poses)) ** 2))) if poses else 0.0
            if rms > 0:
                found[pair] = rms
    return found
