"""How often pairs are said: counted once each, summing to one, and set beside the paper's tables."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.phonemes import COMMON, TABLE_1
from core_pipeline.schedule import Schedule
from core_pipeline.statistics import TABLE_2, Frequencies, progress
from tests.helpers import stages as small


def schedule(phones: str) -> Schedule:
    return small.schedule(phones)


def test_pairs_are_counted_after_the_map_and_without_silence() -> None:
    said = Frequencies.of([schedule("sil f ae t s sil"), schedule("k ae t ?"), schedule("t s")], COMMON, TABLE_1)
    assert dict(said.counts) == {("ah", "d"): 2, ("d", "z"): 2, ("f", "ah"): 1, ("kg", "ah"): 1}
    assert (said.total, said.utterances, said.never) == (6, 3, 437)
    assert said.shares["ah", "d"] == pytest.approx(1 / 3)
    assert said.top(2) == (("ah", "d"), ("d", "z"))


def test_the_cumulative_curve_is_figure_2() -> None:
    said = Frequencies(("a", "b"), {("a", "a"): 6, ("b", "b"): 3, ("a", "b"): 1})
    assert said.cumulative == pytest.approx([0.6, 0.9, 1.0, 1.0])
    assert [said.first(cover) for cover in (0.5, 0.6, 0.61, 0.99, 1.0)] == [1, 1, 2, 3, 3]
    assert said.covered([("a", "a"), ("a", "b"), ("a", "a"), ("b", "a")]) == pytest.approx(0.7)


@given(st.lists(st.lists(st.sampled_from([*COMMON[:4], "sil", "?"]), max_size=8), max_size=6))
def test_shares_add_up_and_the_curve_rises_ever_slower(texts: list[list[str]]) -> None:
    said = Frequencies.of([Schedule(t, 0.1 * np.arange(len(t) + 1)) for t in texts], COMMON[:4], {})
    assert sum(said.shares.values()) == pytest.approx(1.0 if said.total else 0.0)
    steps = np.diff(said.cumulative, prepend=0.0)
    assert steps.size == 16
    assert (steps >= 0).all()
    assert (np.diff(steps) <= 1e-12).all()
    assert said.covered(said.counts) == pytest.approx(1.0 if said.total else 0.0)


def test_table_2_is_the_papers() -> None:
    assert len(TABLE_2) == 21
    assert sum(TABLE_2.values()) == pytest.approx(36.79)
    assert list(TABLE_2.values()) == sorted(TABLE_2.values(), reverse=True)
    assert {phone for pair in TABLE_2 for phone in pair} <= set(COMMON)
    same = Frequencies(COMMON, {pair: round(100 * share) for pair, share in TABLE_2.items()})
    assert same.shared_with_paper() == 21


def test_progress_counts_what_is_drawn_and_the_speech_it_covers() -> None:
    said = Frequencies(COMMON, {("f", "ah"): 5, ("d", "ah"): 3, ("ah", "d"): 2})
    curve_set = small.curve_set()
    curve_set = curve_set.with_bigram(("f", "ah"), replace(curve_set.bigrams["f", "ah"], status="approved"))
    curve_set = curve_set.with_bigram(("d", "ah"), replace(curve_set.bigrams["d", "ah"], status="suggestion"))
    curve_set = curve_set.with_bigram(("sil", "ah"), curve_set.bigrams["f", "ah"]).with_bigram(("oy", "oy"), None)
    now = progress(curve_set, said)
    assert (now.possible, now.drawn, now.approved) == (441, 439, 1)
    assert now.speech == pytest.approx(0.7)
    assert now.approved_speech == pytest.approx(0.5)
