"""Suggestions: near to what was hidden, honest about where they come from, and harmless whatever the set."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.files.curve_set_json import load
from core_pipeline.phonemes import COMMON, SILENCE, Pair
from core_pipeline.suggest import EDGES, FEW, PEAK, REST, TOLERANCE, Suggestions, fill, is_drawn
from tests.helpers import strategies as ours
from tests.helpers.animators import drawn_set

CURVES = Path(__file__).parents[2] / "assets" / "curves"
TIMES = np.linspace(0, 1, 51)


def english() -> CurveSet:
    return load(CURVES / "english.json")


def heights(bigram: Bigram | None, poses: tuple[str, ...]) -> np.ndarray:
    curves = {} if bigram is None else bigram.curves
    return np.array([curves[p].at(TIMES) if p in curves else np.zeros(TIMES.size) for p in poses])


def hide(curve_set: CurveSet, share: float, seed: int) -> tuple[CurveSet, list[Pair]]:
    """The set without some of its pairs, and which are gone."""
    pairs = [pair for pair in curve_set.bigrams if SILENCE not in pair]
    order = np.random.default_rng(seed).permutation(len(pairs))
    gone = [pairs[i] for i in order[: round(share * len(pairs))]]
    return replace(curve_set, bigrams={p: b for p, b in curve_set.bigrams.items() if p not in set(gone)}), gone


def error(curve_set: CurveSet, suggested: dict[Pair, Bigram], gone: list[Pair]) -> tuple[float, float]:
    """RMSE of the suggestions, and of drawing nothing."""
    truth = np.array([heights(curve_set.bigrams[p], curve_set.poses) for p in gone])
    guess = np.array([heights(suggested[p], curve_set.poses) for p in gone])
    return float(np.sqrt(((truth - guess) ** 2).mean())), float(np.sqrt((truth**2).mean()))


@pytest.mark.parametrize("name", ["english", "crab"])
def test_a_fifth_hidden_of_our_sets_comes_back(name: str) -> None:
    curve_set = load(CURVES / f"{name}.json")
    part, gone = hide(curve_set, 0.2, seed=1)
    ours, empty = error(curve_set, fill(part), gone)
    assert len(gone) == 88
    assert ours <= 0.25 * empty
    assert ours <= 0.030


@pytest.mark.parametrize(("share", "most"), [(0.2, 0.030), (0.8, 0.045)])
def test_so_it_does_of_a_set_with_the_scatter_of_a_hand(share: float, most: float) -> None:
    """And better than the mean of row and column, which knows no likeness of phones."""
    curve_set = drawn_set(seed=3)
    part, gone = hide(curve_set, share, seed=2)
    ours, empty = error(curve_set, fill(part), gone)
    assert ours <= min(most, 0.25 * empty)
    table = {pair: heights(b, part.poses) for pair, b in part.bigrams.items()}
    mean = np.mean(list(table.values()), axis=0)
    additive = []
    for a, b in gone:
        row = [h for pair, h in table.items() if pair[0] == a]
        column = [h for pair, h in table.items() if pair[1] == b]
        guess = np.mean(row, axis=0) + np.mean(column, axis=0) - mean
        additive.append(((guess - heights(curve_set.bigrams[a, b], part.poses)) ** 2).mean())
    assert ours < 0.95 * np.sqrt(np.mean(additive))


def test_what_is_drawn_is_left_alone_and_all_the_rest_is_filled_and_marked() -> None:
    part, gone = hide(english(), 0.3, seed=4)
    note = Bigram(status="empty", note="mind the teeth", extra={"colour": "red"})
    part = part.with_bigram(gone[0], note)
    filled = fill(part)
    assert set(filled) == set(gone)
    assert {b.status for b in filled.values()} == {"suggestion"}
    assert filled[gone[0]].note == "mind the teeth"
    assert filled[gone[0]].extra == {"colour": "red"}


def test_pairs_with_silence_come_back_where_some_are_drawn() -> None:
    curve_set = english()
    edges = [pair for pair in curve_set.bigrams if SILENCE in pair]
    gone = [pair for i, pair in enumerate(edges) if i % 3]
    part = replace(curve_set, bigrams={p: b for p, b in curve_set.bigrams.items() if p not in set(gone)})
    filled = fill(part)
    assert set(filled) == set(gone)
    ours, empty = error(curve_set, filled, gone)
    assert ours <= 0.4 * empty
    few = [pair for pair in edges if pair[0] == SILENCE][: EDGES - 1]
    rest = {p: b for p, b in curve_set.bigrams.items() if SILENCE not in p or p in few}
    assert not fill(replace(curve_set, bigrams=rest))


def test_the_source_counts_row_and_column_without_the_pair_itself() -> None:
    curve_set = english()
    bigrams = {p: b for p, b in curve_set.bigrams.items() if p[0] == "f" or p == ("d", "ah")}
    suggestions = Suggestions.of(replace(curve_set, bigrams=bigrams))
    in_row = len([p for p in bigrams if p[0] == "f"])
    assert suggestions.source(("f", "ah")) == f"suggested from {in_row - 1} in its row, 1 in its column"
    assert suggestions.source(("d", "ih")) == "suggested from 1 in its row, 1 in its column"
    assert suggestions.bigram(("d", "ih")).source == suggestions.source(("d", "ih"))


def test_before_few_are_drawn_phone_parts_speak_and_what_is_drawn_corrects_them() -> None:
    prior, curve_set = english(), drawn_set(seed=5)
    empty = CurveSet()
    told = fill(empty, prior)
    assert len(told) == 441
    assert "phone parts" in told["f", "ah"].source
    assert error(prior, told, list(told))[0] < 0.02
    lower = {
        pair: Bigram({pose: Curve(c.t, 0.5 * c.v) for pose, c in b.curves.items()})
        for pair, b in prior.bigrams.items()
        if pair[0] in ("f", "d") and SILENCE not in pair
    }
    part = replace(prior, bigrams=dict(list(lower.items())[: FEW - 4]))
    plain = Suggestions.of(replace(prior, bigrams={}), prior).bigram(("d", "oy")).curves["open"].v.max()
    corrected = Suggestions.of(part, prior).bigram(("d", "oy")).curves["open"].v.max()
    assert 0.4 * plain < corrected < 0.9 * plain
    assert not Suggestions.of(curve_set, prior).prior


def test_a_phone_of_another_set_finds_its_parts_through_the_map() -> None:
    prior = english()
    split = CurveSet(phonemes=("ah", "b", "m", "ü"), phoneme_map={})
    told = fill(split, prior)
    assert told["b", "ah"].curves["PBM"].v.max() > 0.5
    assert told["ü", "ü"].is_empty  # nobody knows it


def test_an_unseen_row_takes_after_phones_that_are_made_alike() -> None:
    curve_set = english()
    part = replace(curve_set, bigrams={p: b for p, b in curve_set.bigrams.items() if "f" not in p and SILENCE not in p})
    suggested = Suggestions.of(part).bigram(("f", "ah"))
    assert "from 0 in its row" in suggested.source
    truth, mean = heights(curve_set.bigrams["d", "ah"], part.poses)[0], heights(suggested, part.poses)[0]
    assert np.abs(truth - mean).max() < 0.25  # the vowel is known from its column


def test_suggestions_are_few_keys_and_never_specks() -> None:
    curves = [c for b in fill(hide(drawn_set(seed=3), 0.5, seed=1)[0]).values() for c in b.curves.values()]
    assert np.mean([len(c) for c in curves]) < 6.5
    tops = np.array([c.v.max() for c in curves])
    assert tops.min() > PEAK - TOLERANCE
    assert REST < PEAK


def test_suggestions_teach_nothing() -> None:
    curve_set = english()
    part, gone = hide(curve_set, 0.4, seed=6)
    filled = replace(part, bigrams={**part.bigrams, **fill(part)})
    again = Suggestions.of(filled).bigram(gone[0])
    first = Suggestions.of(part).bigram(gone[0])
    assert np.allclose(heights(again, part.poses), heights(first, part.poses))
    assert not is_drawn(filled.bigrams[gone[0]])


def test_the_shortcuts_give_what_the_formula_says() -> None:
    """One pair by itself equals the pair out of many; leaving one out equals learning without it."""
    part, gone = hide(drawn_set(seed=7), 0.85, seed=1)
    alone, many = Suggestions.of(part), Suggestions.of(part).prepared()
    assert np.allclose(heights(alone.bigram(gone[0]), part.poses), heights(many.bigram(gone[0]), part.poses))
    astray = many.astray
    assert astray.keys() == part.bigrams.keys()
    i = 7
    k, y = many._covariance, many.curves
    others = np.arange(len(k)) != i
    left_out = k[i, others] @ np.linalg.solve(k[np.ix_(others, others)], y[others])
    a, b = many.pairs[i]
    assert astray[many.phones[a], many.phones[b]] == pytest.approx(np.sqrt(((y[i] - left_out) ** 2).mean()))


def test_an_odd_bigram_is_far_from_what_the_others_suggest() -> None:
    curve_set = english()
    astray = Suggestions.of(curve_set).astray
    odd = Bigram({"open": Curve.of([(0, 0), (0.5, 1), (1, 0)]), "W": Curve.of([(0, 1), (1, 1)])})
    changed = Suggestions.of(curve_set.with_bigram(("d", "ih"), odd)).astray
    assert astray["d", "ih"] < 0.05
    assert changed["d", "ih"] == max(changed.values()) > 0.2


@settings(max_examples=60)
@given(ours.curve_sets(nasty=True), ours.curve_sets(), st.booleans())
def test_any_set_gets_suggestions_within_bounds(curve_set: CurveSet, prior: CurveSet, with_prior: bool) -> None:
    filled = fill(curve_set, prior if with_prior else None)
    empty = {(a, b) for a in curve_set.phonemes for b in curve_set.phonemes if curve_set.status_of((a, b)) == "empty"}
    assert filled.keys() == empty
    for bigram in filled.values():
        assert bigram.curves.keys() <= set(curve_set.poses)
    assert all(np.isfinite(r) and r >= 0 for r in Suggestions.of(curve_set).astray.values())


def test_sets_with_next_to_nothing_are_no_trouble() -> None:
    for curve_set in (CurveSet(phonemes=("x",), poses=()), CurveSet(phonemes=("x",), poses=("a",)), CurveSet()):
        assert all(b.is_empty for b in fill(curve_set).values())
    one = CurveSet(bigrams={("f", "ah"): Bigram({"FV": Curve.of([(0, 0), (0.3, 0.9), (1, 0)])}, "approved")})
    filled = fill(one)
    assert len(filled) == len(COMMON) ** 2 - 1
    assert filled["f", "d"].curves["FV"].v.max() > 0.3  # what little is known, is used
