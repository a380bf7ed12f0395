"""Packing: every curve closed to 0 at both ends, and an edit repacks to what packing from scratch gives."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.packed import GAP, PackedSet, closed
from core_pipeline.timewarp import timewarp
from tests.helpers.strategies import PHONES, POSES, curve_sets, curves


@pytest.mark.parametrize(
    ("keys", "s", "v"),
    [
        ([(0, 0), (0.5, 1), (1, 0)], [0, 0.5, 1], [0, 1, 0]),  # already closed: nothing is added
        ([(0.2, 0), (0.5, 1), (0.7, 0)], [0.2, 0.5, 0.7], [0, 1, 0]),
        ([(0, 1), (1, 0)], [0, 0, 1], [0, 1, 0]),
        ([(0, 0), (1, 1)], [0, 1, 1], [0, 1, 0]),
        ([(0.5, 1)], [0, 0, 0.5, 1, 1], [0, 1, 1, 1, 0]),  # held flat to both ends of the span
        ([(0, 1)], [0, 0, 1, 1], [0, 1, 1, 0]),
        ([(1, 1)], [0, 0, 1, 1], [0, 1, 1, 0]),
        ([(0, 0), (1, 0)], [], []),
        ([(0.3, 0)], [], []),
    ],
)
def test_a_curve_is_closed(keys, s, v):
    made = closed(Curve.of(keys))
    assert made.s.tolist() == s
    assert made.v.tolist() == v


@given(curves(nasty=True))
def test_closing_keys_are_finite_and_in_order(curve):
    made = closed(curve)
    assert np.isfinite(np.array(made)).all()
    assert (np.diff(made.s) >= 0).all()
    assert made is closed(curve), "made once per curve"
    if made.s.size:
        assert made.v[0] == made.v[-1] == 0
        assert 0 <= made.s[0] <= made.s[-1] <= 1


def test_keys_that_all_but_coincide_are_moved_apart():
    made = closed(Curve.of([(0, 1), (5e-324, 0), (0.5, 1), (1 - 1e-16, 0), (1, 1)]))
    assert np.isfinite(np.array(made)).all()
    assert np.diff(made.s[made.ramp == 0])[1:-1].min() >= GAP / 2
    assert made.s[-1] == 1


def in_order(packed: PackedSet, pairs) -> list[list[tuple[float, ...]]]:
    """The packed keys of the pairs, whatever their row numbers."""
    found = []
    for first, second in pairs:
        row = packed.row_of[packed.number[first], packed.number[second]]
        for pose in range(len(packed.poses)):
            a = packed.start[pose, row]
            found.append([tuple(column[a : a + packed.count[pose, row]]) for column in packed.keys])
    return found


@given(curve_sets(nasty=True), st.sampled_from(PHONES), st.sampled_from(PHONES), st.sampled_from(POSES), curves())
def test_repacking_after_an_edit_equals_packing_from_scratch(before, first, second, pose, curve):
    assert before.packed is before.packed, "packed once per set"
    old = before.bigrams.get((first, second), Bigram())
    edited = before.with_bigram((first, second), old.with_curve(pose, curve))
    afresh = replace(
        edited,
        bigrams={
            pair: Bigram({p: Curve.of(c.keys()) for p, c in bigram.curves.items()})
            for pair, bigram in reversed(edited.bigrams.items())
        },
    )
    pairs = [(p, q) for p in (*PHONES, "sil") for q in (*PHONES, "sil")]
    assert in_order(edited.packed, pairs) == in_order(PackedSet.of(afresh), pairs)


def test_unknown_phones_are_not_taken_for_silence():
    hill = Bigram({"a": Curve.of([(0, 0), (0.5, 1), (1, 0)])})
    bigrams = {("sil", "x"): hill, ("x", "q"): hill}
    for phonemes in (("x",), ("x", "sil"), ("x", "x")):
        packed = CurveSet(phonemes=phonemes, poses=("a",), bigrams=bigrams).packed
        assert packed.numbers(("q", "sil"))[0] not in packed.number.values()
        for phones, size in ((("sil", "x"), 3), (("?", "x"), 0), (("x", "q"), 0)):
            assert timewarp(packed, phones, np.array([0.0, 1.0, 2.0])).x.size == size
