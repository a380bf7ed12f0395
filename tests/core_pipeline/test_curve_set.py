"""Curve sets: edits return new sets, what is missing is known, and sil never counts."""

import pytest

from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.settings import Settings

HILL = Curve.of([(0, 0), (0.5, 1), (1, 0)])
SMALL = CurveSet(phonemes=("x", "y"), poses=("a",), bigrams={("x", "y"): Bigram({"a": HILL})})


def test_the_usual_set_has_441_pairs():
    assert len(CurveSet().missing()) == 441


def test_a_set_of_one_phoneme_has_one_pair():
    assert CurveSet(phonemes=("x",)).missing() == [("x", "x")]


def test_missing_pairs_come_in_order_and_silence_never_counts():
    assert SMALL.missing() == [("x", "x"), ("y", "x"), ("y", "y")]


def test_pairs_with_silence_can_be_held_but_unknown_phones_cannot():
    assert SMALL.has_pair(("x", "y"))
    assert SMALL.has_pair(("sil", "x"))
    assert not SMALL.has_pair(("x", "q"))


def test_edits_leave_the_old_set_as_it_was():
    more = SMALL.with_bigram(("y", "y"), Bigram({"a": HILL}))
    less = more.with_bigram(("x", "y"), None)
    assert list(SMALL.bigrams) == [("x", "y")]
    assert list(more.bigrams) == [("x", "y"), ("y", "y")]
    assert list(less.bigrams) == [("y", "y")]
    assert less.with_bigram(("x", "x"), None).bigrams == less.bigrams
    with pytest.raises(TypeError):
        SMALL.bigrams["x", "x"] = Bigram()
    with pytest.raises(TypeError):
        SMALL.bigrams["x", "y"].curves["a"] = HILL


def test_a_curve_is_added_replaced_and_removed():
    bigram = Bigram({"a": HILL}, status="review", note="lips")
    flat = Curve.of([(0, 0)])
    assert bigram.with_curve("a", flat).curves == {"a": flat}
    assert bigram.with_curve("b", flat).curves == {"a": HILL, "b": flat}
    assert bigram.with_curve("a", None).curves == {}
    assert bigram.with_curve("b", flat).note == "lips"


def test_a_bigram_that_never_leaves_zero_is_empty():
    still = Bigram({"a": Curve.of([(0, 0), (1, 0)])}, status="approved")
    assert still.is_empty
    assert Bigram().is_empty
    assert not Bigram({"a": HILL}).is_empty
    edited = SMALL.with_bigram(("y", "y"), still)
    assert edited.status_of(("y", "y")) == "empty"
    assert edited.status_of(("y", "x")) == "empty"
    assert edited.status_of(("x", "y")) == "draft"


def test_a_set_without_settings_uses_the_preset_of_the_paper():
    assert SMALL.effective_settings == Settings.paper()
    assert SMALL.with_settings(Settings.smartbody()).effective_settings == Settings.smartbody()
