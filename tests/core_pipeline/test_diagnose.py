"""Weak bigrams: each kind is found where it is, told in words, and a good sentence has none."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given

from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.diagnose import (
    ERRORS,
    FLAT,
    HINTS,
    KINDS,
    Corpus,
    Finding,
    SetFindings,
    WeakBigram,
    findings_of,
    weak_bigrams,
    weak_in_set,
)
from core_pipeline.diagnose.played import CLIPPED, HOLD, HOLE, SLOWED
from core_pipeline.files.curve_set_json import load
from core_pipeline.phonemes import SILENCE, Pair
from core_pipeline.pipeline import Settings, run
from core_pipeline.schedule import Schedule
from tests.helpers import stages as small
from tests.helpers import strategies as ours
from tests.helpers.lip_measures import sentences

PHONES = "f ah d ah f ah"
CALM = "d ah kg ah d"
ENGLISH = Path(__file__).parents[2] / "assets" / "curves" / "english.json"
HILL = [(0, 0), (0.5, 1.0), (1, 0)]
STILL = Settings(window=0.0, speed_limit=1000.0)


def diagnose(curve_set: CurveSet, phones: str = PHONES, each: float = 0.2) -> list[WeakBigram]:
    return weak_bigrams(run(small.schedule(phones, each=each), curve_set), curve_set)


def only(curve_set: CurveSet, phones: str, each: float, kind: str) -> list[Finding]:
    """The findings of one kind."""
    return [f for weak in diagnose(curve_set, phones, each) for f in weak.findings if f.kind == kind]


def edited(pair: Pair, bigram: Bigram | None) -> CurveSet:
    return small.curve_set(height=0.5).with_bigram(pair, bigram)


def one(pair: Pair, settings: Settings = STILL, **curves: list[tuple[float, float]]) -> CurveSet:
    """A set with one bigram."""
    bigram = Bigram({pose: Curve.of(keys) for pose, keys in curves.items()})
    return CurveSet(bigrams={pair: bigram}, settings=settings)


def test_a_good_sentence_has_no_weak_bigram() -> None:
    assert diagnose(small.curve_set(height=0.5), CALM) == []


def test_a_missing_bigram_is_found_at_its_boundary_with_its_uses() -> None:
    weak = diagnose(edited(("f", "ah"), None))[0]
    assert (weak.pair, weak.uses, weak.worst.kind, weak.reason) == (("f", "ah"), 2, "missing", "missing")
    assert weak.worst.time == pytest.approx(0.2)
    assert weak.score == pytest.approx(2.0)
    assert weak.is_error


@pytest.mark.parametrize(
    ("bigram", "flat"),
    [
        (Bigram(), True),
        (Bigram({"open": Curve.of([(0, 0), (0.5, 0.9 * FLAT), (1, 0)])}), True),
        (Bigram({"open": Curve.of([(0, 0), (0.5, 1.1 * FLAT), (1, 0)])}), False),
    ],
)
def test_a_bigram_that_does_nothing_is_flat(bigram: Bigram, flat: bool) -> None:
    kinds = {weak.pair: weak.worst.kind for weak in diagnose(edited(("ah", "d"), bigram))}
    assert (kinds.get(("ah", "d")) == "flat") is flat


def test_a_suggestion_is_told_as_not_reviewed_and_is_a_hint() -> None:
    good = small.curve_set(height=0.5).bigrams["d", "ah"]
    (weak,) = diagnose(edited(("d", "ah"), replace(good, status="suggestion")), CALM)
    assert (weak.pair, weak.worst.kind, weak.is_hint) == (("d", "ah"), "unreviewed", True)


# ── what the pipeline takes ──────────────────────────────────────────────────────────────────────


def test_a_peak_cut_by_the_speed_limit_is_told_with_its_share_pose_and_place() -> None:
    # One triangle of 0.1 s over 0.9: at a limit of 6 a flank of 0.05 s reaches 0.3, a third.
    settings = replace(Settings.paper(), speed_limit=6.0, window=0.0)
    curve_set = one(("w", "ah"), settings, W=[(0, 0), (0.5, 0.9), (1, 0)])
    (found,) = only(curve_set, "w ah", 0.05, "slowed")
    assert found.pose == "W"
    assert found.amount == pytest.approx(2 / 3, abs=0.01)
    assert found.time == pytest.approx(0.05)
    assert found.reason == "speed limit takes 67 % of W"
    fast = curve_set.with_settings(replace(settings, speed_limit=18.0 / (1 - 0.9 * SLOWED)))
    assert only(fast, "w ah", 0.05, "slowed") == []


def test_a_curve_cut_by_a_constraint_is_told_with_the_share_of_its_area_and_what_it_gives_way_to() -> None:
    # Both hills are 1 high over 1 s. open may reach .5 − FV: none of it is left but where FV is below a half.
    curve_set = one(("f", "ah"), Settings.paper(), open=HILL, FV=HILL)
    stages = run(small.schedule("f ah", each=0.5), curve_set)
    (found,) = only(curve_set, "f ah", 0.5, "clipped")
    t = np.linspace(0, 1, 20001)
    left = stages.cyan["open"].at(t).mean() / (1 - 2 * np.abs(t - 0.5)).mean()
    assert found.amount == pytest.approx(1 - left, abs=0.01)
    assert (found.pose, found.other) == ("open", "FV")
    assert 0.3 < found.time < 0.7
    assert found.reason == f"FV takes {100 * (1 - left):.0f} % of open"
    assert only(curve_set, "f ah", 0.5, "slowed") == []  # the speed limit is not to blame
    a_little = one(("f", "ah"), Settings.paper(), open=HILL, FV=[(0.4, 0), (0.5, 0.6), (0.6, 0)])
    assert CLIPPED > 0.5
    assert only(a_little, "f ah", 0.5, "clipped") == []


def test_lips_that_do_not_close_are_told_with_how_far_they_get_and_the_pair_that_draws_less() -> None:
    english = load(ENGLISH)
    lazy = english.bigrams["ah", "bmp"].with_curve("PBM", Curve.of([(0, 0), (0.7, 0.3), (1, 0.2)]))
    half = english.bigrams["bmp", "ah"].with_curve("PBM", Curve.of([(0, 0.2), (0.3, 0.4), (1, 0)]))
    curve_set = english.with_bigram(("ah", "bmp"), lazy).with_bigram(("bmp", "ah"), half)
    (found,) = only(curve_set, "sil ah bmp ah sil", 0.15, "closure")
    assert found.pair == ("ah", "bmp")
    assert found.amount == pytest.approx(0.4 / 0.8, abs=0.02)
    assert 0.3 < found.time < 0.45
    assert found.reason == "not closed: PBM reaches 50 % of its usual height"
    assert only(english, "sil ah bmp ah sil", 0.15, "closure") == []


def test_a_held_closure_counts_once_and_a_forgotten_one_is_found() -> None:
    english = load(ENGLISH)
    forgotten = english
    for pair in (("ah", "f"), ("f", "f"), ("f", "ah")):
        forgotten = forgotten.with_bigram(pair, english.bigrams[pair].with_curve("FV", None))
    found = only(forgotten, "sil ah f f ah sil", 0.15, "closure")
    assert [(f.pose, f.amount) for f in found] == [("FV", 0.0)]


def test_which_poses_close_is_read_from_the_set() -> None:
    assert SetFindings.of(load(ENGLISH)).closures == {"bmp": ("PBM", 0.8), "f": ("FV", 0.8)}
    assert SetFindings.of(load(ENGLISH.with_name("crab.json"))).closures == {"bmp": ("lips shut", 0.8)}
    assert SetFindings.of(CurveSet()).closures == {}


# ── how the face moves ───────────────────────────────────────────────────────────────────────────


def test_a_pose_that_turns_too_often_inside_one_bigram_trembles() -> None:
    teeth = [(0, 0), (0.2, 0.6), (0.4, 0.2), (0.6, 0.6), (0.8, 0.2), (0.9, 0.5), (1, 0)]
    (found,) = only(one(("w", "ah"), W=teeth), "w ah", 0.5, "jitter")
    assert (found.pose, found.amount, found.time) == ("W", 5.0, pytest.approx(0.5))
    assert found.reason == "jitter: W turns 5×"
    calm = [(0, 0), (0.2, 0.6), (0.4, 0.59), (0.6, 0.6), (0.8, 0.59), (0.9, 0.6), (1, 0)]
    assert only(one(("w", "ah"), W=calm), "w ah", 0.5, "jitter") == []


@pytest.mark.parametrize(("width", "pops"), [(0.9 * HOLD, True), (1.1 * HOLD, False)])
def test_a_pose_that_comes_and_goes_too_fast_pops(width: float, pops: bool) -> None:
    keys = [(0.5 - width / 2, 0), (0.5, 0.5), (0.5 + width / 2, 0)]  # of a bigram of 1 s
    found = only(one(("w", "ah"), W=keys), "w ah", 0.5, "short")
    assert len(found) == pops
    for f in found:
        assert f.amount == pytest.approx(width)
        assert f.time == pytest.approx(0.5)


@pytest.mark.parametrize(("width", "hole"), [(0.8 * HOLE, False), (1.5 * HOLE, True)])
def test_a_face_at_rest_within_a_phrase_is_a_hole(width: float, hole: bool) -> None:
    rest = [(0.5 - width / 2, 0.5), (0.501 - width / 2, 0), (0.499 + width / 2, 0), (0.5 + width / 2, 0.5)]
    keys = [(0.0, 0.5), *rest, (1.0, 0.5)]
    found = only(one(("w", "ah"), W=keys), "w ah", 0.5, "hole")
    assert len(found) == hole
    for f in found:
        assert f.amount == pytest.approx(width, abs=0.01)
        assert f.time == pytest.approx(0.5, abs=0.01)


def test_rest_between_phrases_is_no_hole() -> None:
    assert only(small.curve_set(height=0.5), "sil ah d sil d ah sil", 0.2, "hole") == []


# ── the set by itself ────────────────────────────────────────────────────────────────────────────


def test_a_bigram_unlike_its_row_and_column_is_told_with_how_far() -> None:
    english = load(ENGLISH)
    odd = Bigram({"open": Curve.of(HILL), "W": Curve.of(HILL)}, "approved")
    checks = SetFindings.of(english.with_bigram(("d", "ih"), odd))
    (far,) = [f for f in checks.findings["d", "ih"] if f.kind == "far"]
    assert 0.15 < far.amount < 0.5
    assert far.reason == f"unlike its row and column, by {far.amount:.2f}"
    assert not [f for f in SetFindings.of(english).findings.get(("d", "ih"), ()) if f.kind == "far"]


def test_poses_that_only_one_of_two_mirror_pairs_has_are_a_hint_for_both() -> None:
    checks = SetFindings.of(edited(("f", "ah"), Bigram({"FV": Curve.of(HILL), "W": Curve.of(HILL)})))
    told = {f.reason for f in checks.findings["f", "ah"] if f.kind == "mirror"}
    assert told == {"W, which ah – f lacks", "no open, which ah – f has"}
    assert {f.kind for f in checks.findings["ah", "f"]} == {"mirror"}
    assert {"mirror", "unreviewed"} == HINTS


def test_a_set_without_a_sentence_is_ranked_by_how_often_pairs_are_said() -> None:
    curve_set = edited(("d", "ah"), None).with_bigram(("f", "ah"), None).with_bigram(("oy", "oy"), None)
    weak = weak_in_set(curve_set, {("f", "ah"): 0.1, ("d", "ah"): 0.3})
    assert [w.pair for w in weak[:3]] == [("d", "ah"), ("f", "ah"), ("oy", "oy")]
    assert weak[0].score == pytest.approx(0.3, abs=1e-5)


# ── sentences added up ───────────────────────────────────────────────────────────────────────────


def test_the_worst_stands_first_by_severity_times_frequency() -> None:
    curve_set = edited(("d", "ah"), None).with_bigram(("f", "ah"), None)
    assert [weak.pair for weak in diagnose(curve_set)][:2] == [("f", "ah"), ("d", "ah")]  # twice, once


def test_a_corpus_is_the_sum_of_its_sentences_and_says_in_which_it_is_worst() -> None:
    curve_set = edited(("f", "ah"), None)
    checks, corpus = SetFindings.of(curve_set), Corpus()
    for phones in ("d ah d", "f ah d", "f ah f ah"):
        stages = run(small.schedule(phones, each=0.2), curve_set)
        corpus.add(stages, findings_of(stages, curve_set, checks))
    weak = corpus.ranking()[0]
    assert (weak.pair, weak.uses, weak.score) == (("f", "ah"), 3, pytest.approx(3.0))
    assert weak.worst.sentence == 1
    assert corpus.sentences == 3


def test_our_own_set_has_no_errors_in_fifty_sentences_and_little_else() -> None:
    english = load(ENGLISH)
    checks, corpus = SetFindings.of(english), Corpus()
    kinds: list[str] = []
    for _, schedule in sentences():
        stages = run(schedule, english)
        found = findings_of(stages, english, checks)
        kinds += [f.kind for f in found]
        corpus.add(stages, found)
    assert not ERRORS & set(kinds)
    assert kinds.count("hole") == 0
    assert kinds.count("closure") <= 5
    assert kinds.count("slowed") <= 5
    assert len(kinds) < 0.2 * sum(len(schedule) for _, schedule in sentences())
    assert corpus.ranking()[0].score > 1


@given(ours.schedules(nasty=True), ours.curve_sets(nasty=True), ours.settings())
def test_any_sentence_of_any_set_is_told_in_order_with_places_and_reasons(
    schedule: Schedule, curve_set: CurveSet, settings: Settings
) -> None:
    curve_set = curve_set.with_settings(settings)
    stages = run(schedule, curve_set)
    weak = weak_bigrams(stages, curve_set)
    pairs = stages.schedule.pairs()
    assert len({w.pair for w in weak}) == len(weak)
    assert [w.score for w in weak] == sorted((w.score for w in weak), reverse=True)
    for w in weak:
        assert SILENCE not in w.pair
        assert w.uses == pairs.count(w.pair) > 0
        assert w.worst.severity == max(f.severity for f in w.findings) <= w.score + 1e-12
        for f in w.findings:
            assert f.kind in KINDS
            assert f.reason
            assert f.time is not None
            assert schedule.start <= f.time <= schedule.end
            assert 0 < f.severity <= 1
    missing = {pair for pair in pairs if pair in stages.missing and set(pair) <= set(curve_set.phonemes)}
    assert {w.pair for w in weak if w.worst.kind == "missing"} == missing
