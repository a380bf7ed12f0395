"""Phones that look alike, orders of phones, and bigrams that are similar."""

from itertools import product

import pytest

from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.phone_classes import CLASSES, by_class, by_frequency, distance, similar_bigrams
from core_pipeline.phonemes import COMMON, TABLE_1

DRAWN = Bigram({"open": Curve.of([(0, 0), (0.5, 1), (1, 0)])})


SHARES = {("d", "ah"): 0.5, ("ah", "f"): 0.3, ("d", "oy"): 0.2}


def frequent(phones):
    return by_frequency(phones, SHARES)


def test_every_common_phone_is_in_one_class():
    assert sorted(phone for group in CLASSES for phone in group) == sorted(COMMON)


@pytest.mark.parametrize("order", [by_class, frequent])
@pytest.mark.parametrize("phones", [COMMON, tuple(TABLE_1), (), ("ü", "ah", "xx", "d")])
def test_an_order_keeps_every_phone_once(order, phones):
    assert sorted(order(phones)) == sorted(phones)
    assert order(order(phones)) == order(phones)


def test_phones_of_no_class_come_last():
    assert by_class(("ü", "bmp", "ah")) == ("ah", "bmp", "ü")
    assert frequent(("ü", "oy", "d", "f", "ah")) == ("ah", "d", "f", "oy", "ü")
    assert by_frequency(COMMON, {}) == COMMON


def test_distance_is_a_distance():
    for a, b in product((*COMMON, "ü"), repeat=2):
        assert distance(a, b) == distance(b, a)
        assert (distance(a, b) == 0) == (a == b)
    assert distance("aa", "ah") < distance("aa", "ih") < distance("aa", "bmp")


def test_similar_bigrams_share_a_phone_first_and_are_never_empty_or_the_same():
    pairs = [("f", "aa"), ("f", "ih"), ("f", "bmp"), ("bmp", "d"), ("f", "ah"), ("f", "eh")]
    curve_set = CurveSet(bigrams=dict.fromkeys(reversed(pairs), DRAWN) | {("f", "ao"): Bigram()})
    found = similar_bigrams(curve_set, ("f", "ah"))
    assert found[0] == ("f", "aa")
    assert found[-1] == ("bmp", "d")
    assert set(found) == set(pairs) - {("f", "ah")}
    assert similar_bigrams(curve_set, ("f", "ah"), most=2) == found[:2]
    assert similar_bigrams(CurveSet(), ("f", "ah")) == []
