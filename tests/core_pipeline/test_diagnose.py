"""Weak bigrams: each kind is found where it is, and a good sentence has none."""

from dataclasses import replace

import pytest
from hypothesis import given

from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.diagnose import FLAT, SLOWED, Weakness, weak_bigrams
from core_pipeline.phonemes import SILENCE
from core_pipeline.pipeline import Settings, run
from core_pipeline.schedule import Schedule
from tests.helpers import stages as small
from tests.helpers import strategies as ours

PHONES = "f ah d ah f ah"


def diagnose(curve_set: CurveSet, phones: str = PHONES, each: float = 0.1) -> list[Weakness]:
    return weak_bigrams(run(small.schedule(phones, each=each), curve_set), curve_set)


def edited(pair: tuple[str, str], bigram: Bigram | None, *, height: float = 0.5) -> CurveSet:
    return small.curve_set(height=height).with_bigram(pair, bigram)


def test_a_good_sentence_has_no_weak_bigram() -> None:
    assert diagnose(small.curve_set(height=0.5), each=0.2) == []


def test_a_missing_bigram_is_found_at_its_boundary_with_its_uses() -> None:
    (weak,) = diagnose(edited(("f", "ah"), None), each=0.2)
    assert (weak.pair, weak.kind, weak.uses) == (("f", "ah"), "missing", 2)
    assert weak.time == pytest.approx(0.2)


@pytest.mark.parametrize(
    ("bigram", "flat"),
    [
        (Bigram(), True),
        (Bigram({"open": Curve.of([(0, 0), (0.5, 0.9 * FLAT), (1, 0)])}), True),
        (Bigram({"open": Curve.of([(0, 0), (0.5, 1.1 * FLAT), (1, 0)])}), False),
    ],
)
def test_a_bigram_that_does_nothing_is_flat(bigram: Bigram, flat: bool) -> None:
    kinds = {weak.pair: weak.kind for weak in diagnose(edited(("ah", "d"), bigram), each=0.2)}
    assert kinds == ({("ah", "d"): "flat"} if flat else {})


def test_a_suggestion_is_told_as_not_reviewed() -> None:
    good = small.curve_set(height=0.5).bigrams["d", "ah"]
    (weak,) = diagnose(edited(("d", "ah"), replace(good, status="suggestion")), each=0.2)
    assert (weak.pair, weak.kind) == (("d", "ah"), "unreviewed")


def test_a_peak_cut_by_the_speed_limit_is_told_with_its_share_pose_and_place() -> None:
    # One triangle of 0.1 s over 0.9: at a limit of 6 a flank of 0.05 s reaches 0.3, a third.
    bigram = Bigram({"W": Curve.of([(0, 0), (0.5, 0.9), (1, 0)])})
    settings = replace(Settings.paper(), speed_limit=6.0, window=0.0)
    curve_set = CurveSet(bigrams={("w", "ah"): bigram}, settings=settings)
    (weak,) = diagnose(curve_set, "w ah", each=0.05)
    assert (weak.kind, weak.pose, weak.uses) == ("slowed", "W", 1)
    assert weak.amount == pytest.approx(2 / 3, abs=0.01)
    assert weak.time == pytest.approx(0.05)
    fast = curve_set.with_settings(replace(settings, speed_limit=18.0 / (1 - 0.9 * SLOWED)))
    assert diagnose(fast, "w ah", each=0.05) == []


def test_what_a_constraint_takes_is_not_blamed_on_the_speed_limit() -> None:
    hill = Curve.of([(0, 0), (0.5, 1.0), (1, 0)])
    curve_set = CurveSet(bigrams={("f", "ah"): Bigram({"open": hill, "FV": hill})})
    assert diagnose(curve_set, "f ah", each=0.5) == []


def test_the_worst_stands_first() -> None:
    curve_set = edited(("d", "ah"), None).with_bigram(("f", "ah"), None)
    assert [weak.pair for weak in diagnose(curve_set, each=0.2)] == [("f", "ah"), ("d", "ah")]  # twice, once


@given(ours.schedules(), ours.curve_sets(), ours.settings())
def test_each_bigram_of_any_sentence_is_told_at_most_once(
    schedule: Schedule, curve_set: CurveSet, settings: Settings
) -> None:
    stages = run(schedule, curve_set, settings)
    weak = weak_bigrams(stages, curve_set)
    pairs = stages.schedule.pairs()
    assert len({w.pair for w in weak}) == len(weak)
    for w in weak:
        assert SILENCE not in w.pair
        assert w.uses == pairs.count(w.pair) > 0
        assert schedule.start <= w.time <= schedule.end
        assert 0 < w.severity <= 1
        assert 0 <= w.amount <= 1
    weights = [w.severity * w.uses for w in weak]
    assert weights == sorted(weights, reverse=True)
    missing = {pair for pair in pairs if pair not in curve_set.bigrams and SILENCE not in pair}
    assert {w.pair for w in weak if w.kind == "missing"} == missing
