"""How long the pipeline takes; the goals are in the design: 15 phones in half a millisecond, 10,000 in 20.

    python -m pytest tests/bench/test_bench_pipeline.py -o addopts="" --benchmark-only

One round runs TEN different schedules of the same size, so a branch predictor cannot learn one by heart: divide by ten.
"""

import numpy as np
import pytest

from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.packed import PackedSet
from core_pipeline.phonemes import COMMON
from core_pipeline.pipeline import run
from core_pipeline.poses import FACEFX
from core_pipeline.schedule import Schedule
from core_pipeline.settings import PRESETS
from core_pipeline.weights import bake, sample

SCHEDULES = 10


def random_set(seed: int = 1) -> CurveSet:
    """441 bigrams with three of nine poses each, four to six keys a curve, as in an authored set."""
    rng = np.random.default_rng(seed)
    bigrams = {}
    for first in COMMON:
        for second in COMMON:
            curves = {}
            for pose in rng.choice(FACEFX, 3, replace=False):
                inner = int(rng.integers(2, 5))
                t = np.concatenate(([0], (np.arange(inner) + rng.uniform(0.2, 0.8, inner)) / inner, [1]))
                v = np.concatenate(([0], rng.uniform(0, 1, inner), [0]))
                curves[str(pose)] = Curve(t, v)
            bigrams[first, second] = Bigram(curves)
    return CurveSet(bigrams=bigrams)


def random_schedules(phones: int) -> list[Schedule]:
    """Phones of 30 to 160 ms, about as fast as people speak."""
    rng = np.random.default_rng(phones)
    return [
        Schedule(rng.choice(COMMON, phones).tolist(), np.concatenate(([0], rng.uniform(0.03, 0.16, phones).cumsum())))
        for _ in range(SCHEDULES)
    ]


@pytest.fixture(scope="module")
def curve_set() -> CurveSet:
    made = random_set()
    assert made.packed.keys.s.size > 4000
    return made


@pytest.mark.parametrize("preset", ["paper", "smartbody"])
@pytest.mark.parametrize("phones", [15, 100, 1_000, 10_000])
def test_run(benchmark, curve_set, phones, preset):
    schedules, settings = random_schedules(phones), PRESETS[preset]

    def run_all():
        for schedule in schedules:  # each result goes as the next comes, as in the editor
            made = run(schedule, curve_set, settings)
        return made

    made = benchmark(run_all)
    assert len(made.schedule) == phones
    assert made.magenta.x.size


@pytest.mark.parametrize("phones", [15, 100, 1_000])
def test_sample_pchip_at_60_fps(benchmark, curve_set, phones):
    tracks = [run(schedule, curve_set).magenta for schedule in random_schedules(phones)]
    times = [t.start + np.arange(int(t.duration * 60) + 1) / 60 for t in tracks]
    made = benchmark(lambda: [sample(t, "pchip", at) for t, at in zip(tracks, times, strict=True)])
    assert all(0 < weights.max() <= 1 for weights in made)


@pytest.mark.parametrize("snap", [True, False])
def test_bake_1000_phones_at_30_fps(benchmark, curve_set, snap):
    tracks = [run(schedule, curve_set).magenta for schedule in random_schedules(1_000)]
    made = benchmark(lambda: [bake(t, "pchip", 30, snap=snap) for t in tracks])
    assert all(weights.frames.max() > 0 for weights in made)


def test_repack_after_one_edit(benchmark, curve_set):
    rng = np.random.default_rng(3)

    def edits() -> tuple[tuple[list[CurveSet]], dict]:
        made = []
        for _ in range(SCHEDULES):
            pair = (str(rng.choice(COMMON)), str(rng.choice(COMMON)))
            curve = Curve.of([(0, 0), (0.5, float(rng.random())), (1, 0)])
            made.append(curve_set.with_bigram(pair, curve_set.bigrams[pair].with_curve("open", curve)))
        return (made,), {}

    packed = benchmark.pedantic(lambda sets: [PackedSet.of(s) for s in sets], setup=edits, rounds=60)
    assert all(p.keys.s.size > 4000 for p in packed)


def test_edit_and_run_a_sentence(benchmark, curve_set):
    """What a drag of one key costs: a new set, packed, and 15 phones through all stages."""
    schedules, bigram = random_schedules(15), curve_set.bigrams["ah", "l"]
    heights = iter(np.random.default_rng(5).random(1_000_000))

    def drag():
        found = []
        for schedule in schedules:
            curve = Curve.of([(0, 0), (0.5, float(next(heights))), (1, 0)])
            found.append(run(schedule, curve_set.with_bigram(("ah", "l"), bigram.with_curve("open", curve))))
        return found

    assert all(stages.magenta.x.size for stages in benchmark(drag))
