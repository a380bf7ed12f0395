"""Copying and pasting keys and curves across poses, bigrams and windows, and what the clipboard may hold."""

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication

from core_pipeline.curves import Curve
from core_pipeline.poses import FACEFX
from tests.helpers.curve_hand import CTRL, FV, OPEN, SHIFT, Hand
from widgets.canvas.curve_canvas import CurveCanvas
from widgets.canvas.curve_clipboard import LONGEST, Copied, NotCurvesError, from_text, to_text

Key = Qt.Key


def clipboard():
    return QGuiApplication.clipboard()


def test_a_curve_goes_to_another_pose(hand, canvas):
    hand.key(Key.Key_C, CTRL)
    canvas.set_active("PBM")
    hand.key(Key.Key_V, CTRL)
    ((changes, label),) = hand.edits
    assert label == "Paste keys"
    assert list(changes) == ["PBM"]
    assert changes["PBM"].same_as(FV)
    assert canvas.selection == {("PBM", i) for i in range(6)}
    hand.undo()
    assert "PBM" not in canvas.curves


def test_all_curves_go_to_another_bigram_in_another_window(hand, canvas, qtbot):
    hand.key(Key.Key_A, CTRL)
    hand.key(Key.Key_A, CTRL)
    hand.key(Key.Key_C, CTRL)
    assert not hand.edits
    other = CurveCanvas()
    qtbot.addWidget(other)
    other.set_poses(FACEFX)
    other.set_bigram("v", "ah")
    second = Hand(other)
    second.key(Key.Key_V, CTRL)
    ((changes, _),) = second.edits
    assert set(changes) == {"open", "FV"}
    assert changes["open"].same_as(OPEN)


def test_the_clipboard_is_json_with_a_version(hand, canvas):
    canvas.select([("FV", 1), ("FV", 2)])
    hand.key(Key.Key_C, CTRL)
    assert json.loads(clipboard().text()) == {
        "schema": "lipstitch.Curves.1",
        "bigram": ["f", "ah"],
        "whole": [],
        "curves": {"FV": [[0.12, 0.78], [0.26, 0.97]]},
    }


def test_pasted_keys_replace_what_lies_in_their_time(hand, canvas):
    canvas.select([("FV", 1), ("FV", 2), ("FV", 3)])  # t 0.12 to 0.42
    hand.key(Key.Key_C, CTRL)
    canvas.set_active("open")  # has keys at 0, 0.34, 0.55 …
    hand.key(Key.Key_V, CTRL)
    pasted = hand.edits[0][0]["open"]
    assert pasted.t.tolist() == [0, 0.12, 0.26, 0.42, 0.55, 0.72, 1]
    assert pasted.v.tolist() == [0, 0.78, 0.97, 0.55, 0.62, 0.8, 0.12]
    assert canvas.selection == {("open", 1), ("open", 2), ("open", 3)}


def test_keys_pasted_where_there_is_no_curve_rise_from_0_and_fall_to_0(hand, canvas):
    canvas.select([("FV", 1), ("FV", 2)])
    hand.key(Key.Key_C, CTRL)
    canvas.set_active("wide")
    hand.key(Key.Key_V, CTRL)
    assert hand.edits[0][0]["wide"].keys() == [(0, 0), (0.12, 0.78), (0.26, 0.97), (1, 0)]


def test_ctrl_shift_v_pastes_reversed_in_time(hand, canvas):
    hand.key(Key.Key_C, CTRL)
    canvas.set_active("PBM")
    hand.key(Key.Key_V, CTRL | SHIFT)
    pasted = hand.edits[0][0]["PBM"]
    np.testing.assert_allclose(pasted.t, 1 - FV.t[::-1], atol=1e-6)
    assert pasted.v.tolist() == FV.v[::-1].tolist()
    canvas.set_active("FV")
    canvas.select([("FV", 1), ("FV", 2), ("FV", 3)])
    hand.key(Key.Key_C, CTRL)
    hand.key(Key.Key_V, CTRL | SHIFT)
    np.testing.assert_allclose(hand.edits[1][0]["FV"].t[1:4], [0.12, 0.28, 0.42], atol=1e-6)


def test_cut_copies_and_deletes_as_one_edit(hand, canvas):
    canvas.select([("FV", 2)])
    hand.key(Key.Key_X, CTRL)
    ((changes, label),) = hand.edits
    assert label == "Cut keys"
    assert len(changes["FV"]) == 5
    hand.key(Key.Key_V, CTRL)
    assert canvas.curves["FV"].same_as(FV)


def test_pasting_the_same_again_is_no_edit(hand, canvas):
    hand.key(Key.Key_C, CTRL)
    hand.key(Key.Key_V, CTRL)
    assert not hand.edits


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "the clipboard holds no curves: copy keys with Ctrl+C first"),
        ("a sentence from a mail", "the clipboard holds no curves"),
        ("[" * 100_000, "the clipboard holds no curves"),
        ('{"schema": "other.Thing.1", "curves": {"FV": [[0, 0]]}}', "the clipboard holds no curves"),
        ('{"schema": "lipstitch.Curves.1", "curves": {}}', "the clipboard holds no curves"),
        ('{"schema": "lipstitch.Curves.2", "curves": {"FV": 3}}', "from a newer Lipstitch"),
        ('{"schema": "lipstitch.Curves.1", "curves": {"FV": [[0.5, 0], [0.4, 1]]}}', "are damaged"),
        ('{"schema": "lipstitch.Curves.1", "curves": {"FV": [[0.5, NaN]]}}', "are damaged"),
        ('{"schema": "lipstitch.Curves.1", "curves": {"FV": [[0.5, "x"]]}}', "are damaged"),
        ('{"schema": "lipstitch.Curves.1", "curves": {"FV": [[0.5]]}}', "are damaged"),
        ('{"schema": "lipstitch.Curves.1", "curves": [1]}', "are damaged"),
        ('{"schema": "lipstitch.Curves.1", "bigram": 3, "curves": {"FV": [[0, 0]]}}', "are damaged"),
        ('{"schema": "lipstitch.Curves.1", "curves": {"x": [[0, 0]], "y": [[0, 0]]}}', "has no pose x, y"),
    ],
)
def test_anything_else_on_the_clipboard_gives_one_sentence(hand, canvas, text, sentence):
    clipboard().setText(text)
    told = len(hand.hints)
    hand.key(Key.Key_V, CTRL)
    assert not hand.edits
    assert len(hand.hints) == told + 1
    assert sentence in hand.hints[-1]


def test_locked_poses_take_nothing_and_the_others_do(hand, canvas):
    canvas.select([("FV", 1), ("FV", 2), ("open", 1), ("open", 2)])
    hand.key(Key.Key_C, CTRL)
    hand.key(Key.Key_Delete)
    canvas.set_locked({"open"})
    hand.key(Key.Key_V, CTRL)
    assert list(hand.edits[-1][0]) == ["FV"]
    canvas.set_locked({"open", "FV"})
    hand.key(Key.Key_V, CTRL)
    assert len(hand.edits) == 2
    assert "is locked" in hand.hints[-1]


def test_nothing_is_copied_where_there_is_no_curve(hand, canvas):
    clipboard().setText("mine")
    canvas.set_active("tBack")
    hand.key(Key.Key_C, CTRL)
    assert clipboard().text() == "mine"
    assert "tBack has no curve" in hand.hints[-1]


ticks = st.lists(st.tuples(st.integers(0, 10**6), st.integers(0, 10**6)), min_size=1, unique_by=lambda key: key[0])
some_curves = ticks.map(lambda keys: Curve.of([(t / 10**6, v / 10**6) for t, v in sorted(keys)]))


@given(st.dictionaries(st.text(), some_curves, min_size=1), st.tuples(st.text(), st.text()), st.booleans())
def test_what_was_copied_comes_back_exactly(curves, bigram, whole):
    copied = from_text(to_text(Copied(curves, frozenset(curves if whole else ()), bigram)))
    assert copied.bigram == bigram
    assert copied.whole == (curves.keys() if whole else frozenset())
    assert copied.curves.keys() == curves.keys()
    assert all(copied.curves[pose].same_as(curve) for pose, curve in curves.items())


json_values = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(), inner, max_size=4),
)


@given(json_values, json_values, json_values)
def test_whatever_stands_on_the_clipboard_is_read_or_refused(curves, whole, bigram):
    data = {"schema": "lipstitch.Curves.1", "curves": curves, "whole": whole, "bigram": bigram}
    for text in (json.dumps(data), json.dumps(curves), str(data)):
        try:
            copied = from_text(text)
        except NotCurvesError:
            continue
        assert copied.curves


def test_a_text_that_is_too_long_is_not_read():
    with pytest.raises(NotCurvesError):
        from_text(to_text(Copied({"FV": FV}, frozenset())) + " " * LONGEST)
