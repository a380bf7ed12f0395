"""Small but nasty values for property tests: curves, curve sets with few phones, schedules, settings.

`nasty` adds what a file may hold though no animator draws it: keys a millionth apart, phones of 10 µs, weights of
1e-12. Without it all times keep so far apart that two readings of the pipeline must agree to rounding.
"""

from __future__ import annotations

from random import Random

import numpy as np
from hypothesis import strategies as st

from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.pipeline import Settings
from core_pipeline.schedule import Schedule
from core_pipeline.settings import SPLINES, Constraint
from core_pipeline.tracks import Track, Tracks

POSES = ("a", "b", "c")
PHONES = ("x", "y")


def _curve(r: Random, nasty: bool, at_rest: bool) -> Curve:
    times: list[float] = []
    while len(times) < r.choice([1, 2, 3, 3, 4, 5]):
        t = r.choice([0, 250, 500, 1000, r.randint(0, 1000), r.randint(0, 1000)]) / 1000
        times.append(t)
        if nasty and r.random() < 0.3:
            times.append(min(max(t + r.choice([1e-6, -1e-6, 1e-9, 1e-15]), 0.0), 1.0))
    times = sorted(set(times))
    weights = [r.choice([0.0, 0.5, 1.0, r.randint(0, 100) / 100, r.randint(0, 100) / 100]) for _ in times]
    if nasty:
        weights = [r.choice([1e-12, 1e-9, 1e-6, 1 - 1e-9]) if r.random() < 0.15 else v for v in weights]
    if at_rest or r.random() < 0.5:
        weights[0] = weights[-1] = 0.0
    return Curve(np.array(times), np.array(weights))


def _seeds() -> st.SearchStrategy[Random]:
    # Sets drawn key by key come out nearly empty, and then no two poses ever meet; a seed gives the full breadth.
    return st.integers(0, 2**32 - 1).map(Random)


@st.composite
def curves(draw: st.DrawFn, *, nasty: bool = False, at_rest: bool = False) -> Curve:
    """One to ten keys; a plateau, a single key, all zeros, steep: whatever comes. `at_rest` begins and ends at 0."""
    return _curve(draw(_seeds()), nasty, at_rest)


@st.composite
def curve_sets(draw: st.DrawFn, *, nasty: bool = False, at_rest: bool = False) -> CurveSet:
    """Two phonemes, three poses; every curve and every bigram may be missing."""
    r = draw(_seeds())
    pairs = [(p, q) for p in PHONES for q in PHONES] + [("sil", "x"), ("y", "sil")]
    bigrams = {
        pair: Bigram({pose: _curve(r, nasty, at_rest) for pose in POSES if r.random() < 0.85})
        for pair in pairs
        if r.random() < 0.9
    }
    return CurveSet(phonemes=PHONES, poses=POSES, bigrams=bigrams, phoneme_map={})


@st.composite
def schedules(draw: st.DrawFn, *, nasty: bool = False, most: int = 7) -> Schedule:
    """None to a few phones, with `sil` and unknown ones, anywhere in time."""
    r = draw(_seeds())
    count = r.choice([0, 1, *range(2, most + 1), *range(2, most + 1)])
    phones = [r.choice(["sil", "?"]) if r.random() < 0.15 else r.choice(PHONES) for _ in range(count)]
    lengths = [0.005, 0.05, 0.1, 0.1, 0.5, *([1.1e-5, 1e-4, 1e-3] if nasty else [])]
    times = [r.choice([0.0, -2.5, 100.0])]
    for _ in phones:
        times.append(times[-1] + r.choice([*lengths, r.uniform(0.005, 0.3), r.uniform(0.005, 0.3)]))
    return Schedule(phones, times)


@st.composite
def settings(draw: st.DrawFn) -> Settings:
    """Windows from 0 to 1 s, limits from 0 to 2, slow and fast, any priorities."""
    r = draw(_seeds())
    pairs = [("a", "b"), ("b", "c"), ("c", "a")]
    limits = [0.0, 0.3, 0.5, 0.5, 1.0, 1.3, 2.0]
    windows = [0.0, 0.05, 0.1, 0.18, 1.0]
    return Settings(
        window=r.choice(windows),
        windows={r.choice(POSES): r.choice(windows)} if r.random() < 0.5 else {},
        constraints=tuple(Constraint(p, q, r.choice(limits)) for p, q in pairs if r.random() < 0.8),
        priorities=tuple(r.sample(POSES, r.choice([0, 2, 3, 3, 3, 3]))),
        speed_limit=r.choice([0.01, 1.0, 6.0, 15.0, 15.0, 50.0, 1e3]),
        spline=r.choice(SPLINES),
    )


def tracks_of(lines: dict[str, list[tuple[float, float]]], end: float = 1.0, start: float = 0.0) -> Tracks:
    """Tracks of an utterance from `start` to `end` from (seconds, weight) knots per pose."""
    stride = end - start + 1.0
    knots = [(t - start + p * stride, v) for p, line in enumerate(lines.values()) for t, v in line]
    x, v = np.array(knots).T if knots else np.zeros((2, 0))
    return Tracks(tuple(lines), x, v, start, end - start)


def knots(track: Track) -> list[tuple[float, float]]:
    """A track as (seconds, weight) pairs, rounded to what a test can write down."""
    return [(round(t, 9), round(v, 9)) for t, v in zip(track.t.tolist(), track.v.tolist(), strict=True)]
