"""Differences of two sets: none of a set with itself, the same both ways, and as large as what changed."""

import numpy as np
import pytest
from hypothesis import given

from core_pipeline.compare import differences
from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from tests.helpers import stages as small
from tests.helpers import strategies as ours

FLAT = Bigram({"open": Curve.of([(0, 0.5), (1, 0.5)])})


@given(ours.curve_sets(nasty=True), ours.curve_sets())
def test_it_is_a_distance(one: CurveSet, other: CurveSet) -> None:
    assert differences(one, one) == {}
    there, back = differences(one, other), differences(other, one)
    assert there.keys() == back.keys() <= {*one.bigrams, *other.bigrams}
    assert np.allclose([there[p] for p in there], [back[p] for p in there])
    assert all(0 < amount <= 1 for amount in there.values())


def test_what_one_lacks_counts_as_rest() -> None:
    one = CurveSet(bigrams={("f", "ah"): FLAT}, poses=("open", "W"))
    other = CurveSet(bigrams={("d", "ah"): Bigram()}, poses=("open", "wide"))
    assert differences(one, other) == {("f", "ah"): pytest.approx(0.5 / np.sqrt(3))}


def test_only_what_was_edited_differs() -> None:
    curve_set = small.curve_set()
    assert differences(curve_set, curve_set.with_bigram(("f", "ah"), FLAT)).keys() == {("f", "ah")}
