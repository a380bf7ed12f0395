"""Small but nasty values for property tests: curves, curve sets with few phones, schedules, settings.

`nasty` adds what a file may hold though no animator draws it: keys a millionth apart, phones of 10 µs, weights of
1e-12. Without it all times keep so far apart that two readings of the pipeline must agree to rounding.
"""

from __future__ import annotations

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

_TIMES = st.one_of(st.sampled_from([0, 250, 500, 1000]), st.integers(0, 1000)).map(lambda k: k / 1000)
_WEIGHTS = st.one_of(st.sampled_from([0, 50, 100]), st.integers(0, 100)).map(lambda k: k / 100)
_NASTY_TIMES = st.builds(lambda t, d: min(max(t + d, 0.0), 1.0), _TIMES, st.sampled_from([0, 1e-6, -1e-6, 1e-9, 1e-15]))
_NASTY_WEIGHTS = st.one_of(_WEIGHTS, st.sampled_from([1e-12, 1e-9, 1e-6, 1 - 1e-9]))
_DURATIONS = st.one_of(st.sampled_from([0.005, 0.05, 0.1, 0.5]), st.integers(5, 300).map(lambda k: k / 1000))
_NASTY_DURATIONS = st.one_of(_DURATIONS, st.sampled_from([1.1e-5, 1e-4, 1e-3]))


@st.composite
def curves(draw: st.DrawFn, *, nasty: bool = False, at_rest: bool = False) -> Curve:
    """One to five keys; a plateau, a single key, all zeros, steep: whatever comes. `at_rest` begins and ends at 0."""
    times, weights = (_NASTY_TIMES, _NASTY_WEIGHTS) if nasty else (_TIMES, _WEIGHTS)
    keys = draw(st.lists(st.tuples(times, weights), min_size=1, max_size=5, unique_by=lambda key: key[0]))
    keys.sort()
    if at_rest or draw(st.booleans()):
        keys[0], keys[-1] = (keys[0][0], 0.0), (keys[-1][0], 0.0)
    return Curve.of(keys)


@st.composite
def curve_sets(draw: st.DrawFn, *, nasty: bool = False, at_rest: bool = False) -> CurveSet:
    """Two phonemes, three poses; every curve and every bigram may be missing."""
    curve = curves(nasty=nasty, at_rest=at_rest)
    pairs = [(p, q) for p in PHONES for q in PHONES] + [("sil", "x"), ("y", "sil")]
    bigrams = {
        pair: Bigram(draw(st.dictionaries(st.sampled_from(POSES), curve, max_size=3)))
        for pair in pairs
        if draw(st.integers(0, 5))
    }
    return CurveSet(phonemes=PHONES, poses=POSES, bigrams=bigrams, phoneme_map={})


@st.composite
def schedules(draw: st.DrawFn, *, nasty: bool = False, most: int = 7) -> Schedule:
    """None to a few phones, with `sil` and unknown ones, anywhere in time."""
    phone = st.sampled_from([*PHONES, *PHONES, "sil", "?"])
    length = _NASTY_DURATIONS if nasty else _DURATIONS
    phones = draw(st.lists(st.tuples(phone, length), max_size=most))
    times = [draw(st.sampled_from([0.0, -2.5, 100.0]))]
    for _, seconds in phones:
        times.append(times[-1] + seconds)
    return Schedule([p for p, _ in phones], times)


@st.composite
def settings(draw: st.DrawFn) -> Settings:
    """Windows from 0 to 1 s, limits from 0 to 2, slow and fast, any priorities."""
    pairs = [("a", "b"), ("b", "c"), ("c", "a")]
    limit = st.sampled_from([0.0, 0.3, 0.5, 1.0, 1.3, 2.0])
    window = st.sampled_from([0.0, 0.05, 0.1, 0.18, 1.0])
    return Settings(
        window=draw(window),
        windows=draw(st.dictionaries(st.sampled_from(POSES), window, max_size=1)),
        constraints=tuple(Constraint(p, q, draw(limit)) for p, q in pairs if draw(st.booleans())),
        priorities=tuple(draw(st.permutations(POSES)))[: draw(st.integers(0, 3))],
        speed_limit=draw(st.sampled_from([0.01, 1.0, 6.0, 15.0, 50.0, 1e3])),
        spline=draw(st.sampled_from(SPLINES)),
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
