"""A curve set as people draw it: phone parts of its own, scatter in time and height, slips, a few gaps."""

from __future__ import annotations

import numpy as np

from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.phone_features import FEATURES, ROWS
from core_pipeline.phonemes import COMMON, Pair
from core_pipeline.simplify import simplified

POSES = ("jaw", "round", "sneer", "shut", "tuck", "grin", "back", "tip")
#: Which feature of a phone moves which pose.
_MOVES = (
    "jaw down", "lips rounded", "teeth together", "lips shut", "lip to teeth", "corners out", "back raised",
    "tip on the ridge",
)  # fmt: skip
_T = np.linspace(0.0, 1.0, 51)


def drawn_set(seed: int, *, scatter: float = 0.08, slips: float = 0.03, gaps: int = 2) -> CurveSet:
    """All pairs but `gaps`.

    scatter  relative spread of heights; times spread by a third of it
    slips    share of bigrams with a pose forgotten or one too many
    """
    random = np.random.default_rng(seed)
    size = {
        phone: {
            pose: float(np.clip(ROWS[phone][FEATURES.index(feature)] * random.uniform(0.4, 0.9), 0, 1))
            for pose, feature in zip(POSES, _MOVES, strict=True)
        }
        for phone in COMMON
    }
    bigrams: dict[Pair, Bigram] = {}
    for first in COMMON:
        for second in COMMON:
            curves = {pose: _drawn(random, size[first][pose], size[second][pose], scatter) for pose in POSES}
            if random.random() < slips:
                curves[POSES[random.integers(len(POSES))]] = _drawn(random, random.choice([0.0, 0.4]), 0.0, scatter)
            bigrams[first, second] = Bigram({p: c for p, c in curves.items() if c.v.max() > 0.02}, "approved")
    for k in random.choice(len(bigrams), gaps, replace=False):
        del bigrams[COMMON[k // 21], COMMON[k % 21]]
    return CurveSet("Drawn", poses=POSES, bigrams=bigrams)


def _drawn(random: np.random.Generator, early: float, late: float, scatter: float) -> Curve:
    v = np.zeros(_T.size)
    for height, at in ((early, 0.3), (late, 0.7)):
        high = height * (1 + scatter * random.normal())
        when = at + scatter / 3 * random.normal()
        v = np.maximum(v, high * np.clip(1 - np.abs(_T - when) / 0.42, 0.0, 1.0))
    v[[0, -1]] = 0.0
    return simplified(_T, np.clip(v, 0.0, 1.0), 0.01)
