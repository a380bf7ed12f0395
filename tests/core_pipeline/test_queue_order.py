"""The order of work: everything once, frequent pairs first, and soon a few of every row and column."""

from collections import Counter
from dataclasses import replace

from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.curve_set import CurveSet
from core_pipeline.phonemes import COMMON
from core_pipeline.queue_order import SPREAD, next_after, work_order
from tests.helpers import stages as small

OFTEN = {("ah", "d"): 0.5, ("d", "ih"): 0.3, ("ih", "d"): 0.15, ("f", "ah"): 0.05}


@given(st.dictionaries(st.tuples(st.sampled_from(COMMON[:5]), st.sampled_from(COMMON[:5])), st.floats(0, 1)))
def test_every_pair_comes_once_and_two_of_three_are_the_most_frequent_left(often: dict) -> None:
    curve_set = CurveSet(phonemes=COMMON[:5])
    order = work_order(curve_set, often)
    assert sorted(order) == sorted((a, b) for a in COMMON[:5] for b in COMMON[:5])
    for i, pair in enumerate(order):
        if i % 3 != 2:
            assert often.get(pair, 0) == max(often.get(p, 0) for p in order[i:])


def test_every_row_and_column_is_taught_early() -> None:
    order = work_order(CurveSet(), OFTEN)
    assert order[:2] == [("ah", "d"), ("d", "ih")]
    early = order[:150]
    for side in (0, 1):
        count = Counter(pair[side] for pair in early)
        assert set(count) == set(COMMON)
        assert min(count.values()) >= min(SPREAD, 2)


def test_the_next_is_the_first_after_the_current_that_is_not_approved_round_the_end() -> None:
    curve_set = small.curve_set()
    order = work_order(curve_set, OFTEN)
    done = curve_set
    for pair in order[1:3]:
        done = done.with_bigram(pair, replace(done.bigrams[pair], status="approved"))
    assert next_after(order, done, order[0]) == order[3]
    assert next_after(order, done, order[-1]) == order[0]
    assert next_after(order, done, None) == order[0]
    assert next_after(order, done, ("sil", "ah")) == order[0]
    all_done = replace(done, bigrams={p: replace(b, status="approved") for p, b in done.bigrams.items()})
    assert next_after(order, all_done, order[5]) is None
