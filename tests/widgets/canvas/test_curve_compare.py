"""Versions of a bigram: swapping with the one from before, and the slider towards it, with real events."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QImage

from core_pipeline.curves import Curve
from tests.helpers.curve_hand import ALT, CTRL, FV, LEFT, NO_BUTTON, OPEN, SHIFT
from widgets import theme
from widgets.canvas.curve_edits import blended
from widgets.canvas.curve_versions import CurveVersions

Key = Qt.Key
OLD = {"FV": Curve.of([(0, 0.1), (0.5, 0.9), (1, 0)]), "W": Curve.of([(0, 0), (0.4, 0.4), (1, 0)])}


@pytest.fixture
def ghosted(canvas):
    canvas.set_ghost(OLD)
    return canvas


def swap(hand):
    hand.key(Key.Key_Backslash, text="\\")


# Swapping


def test_backslash_swaps_in_one_edit_and_back_again(hand, ghosted):
    swap(hand)
    ((changes, label),) = hand.edits
    assert label == "Swap with previous version"
    assert changes == {"FV": OLD["FV"], "W": OLD["W"], "open": None}
    assert ghosted.curves == OLD
    swap(hand)
    assert ghosted.curves == {"open": OPEN, "FV": FV}
    swap(hand)
    assert ghosted.curves == OLD
    assert len(hand.edits) == 3


def test_undo_of_a_swap_loses_no_version(hand, ghosted):
    swap(hand)
    hand.undo()
    assert ghosted.curves == {"open": OPEN, "FV": FV}
    swap(hand)
    assert ghosted.curves == OLD


def test_the_grey_lines_are_always_the_other_version(hand, ghosted):
    before = ghosted.grab().toImage()
    swap(hand)
    assert ghosted.grab().toImage() != before
    swap(hand)
    assert ghosted.grab().toImage() == before


def test_locked_and_hidden_poses_are_not_swapped(hand, ghosted):
    ghosted.set_locked({"FV"})
    ghosted.set_visible_poses({"FV", "W"})
    swap(hand)
    assert hand.edits[0][0] == {"W": OLD["W"]}
    assert ghosted.curves["FV"] is FV
    assert ghosted.curves["open"] is OPEN
    swap(hand)
    assert hand.edits[1][0] == {"W": None}


def test_where_only_locked_poses_differ_the_swap_is_refused(hand, canvas):
    canvas.set_ghost({"FV": OPEN, "open": OPEN})
    canvas.set_locked({"FV"})
    swap(hand)
    assert not hand.edits
    assert "FV is locked" in hand.hints[-1]


def test_without_another_version_swapping_says_so(hand, canvas):
    canvas.set_ghost({"FV": FV, "open": OPEN})
    swap(hand)
    hand.key(Key.Key_D, ALT)
    assert not hand.edits
    assert not canvas.blend_bar.isVisible()
    assert "no other version" in hand.hints[-1]


def test_another_snapshot_forgets_the_one_left_by_a_swap():
    versions = CurveVersions()
    versions.set_snapshot(OLD)
    versions.keep({"FV": FV}, OLD)
    assert versions.other(OLD) == {"FV": FV}
    versions.set_snapshot({"open": OPEN})
    assert versions.other(OLD) == {"open": OPEN}


# Sliding


def slide_by_mouse(qtbot, bar, share):
    """Drags the slider's knob from its start, and lets go."""
    slider = bar.slider
    y, start = slider.height() // 2, 6
    end = start + round((slider.width() - 12) * share)
    qtbot.mousePress(slider, LEFT, pos=QPoint(start, y))
    for step in range(1, 7):
        qtbot.mouseMove(slider, QPoint(start + (end - start) * step // 6, y))
    qtbot.mouseRelease(slider, LEFT, pos=QPoint(end, y))


def test_the_slider_previews_live_and_edits_once_when_let_go(hand, ghosted, qtbot):
    hand.key(Key.Key_D, ALT)
    bar = ghosted.blend_bar
    assert bar.isVisible()
    slide_by_mouse(qtbot, bar, 0.5)
    assert not bar.isVisible()
    assert len(hand.previews) >= 3
    ((changes, label),) = hand.edits
    assert label == "Blend curves"
    assert set(changes) == {"FV", "W", "open"}
    assert 0.1 < changes["W"].v.max() < 0.3
    assert hand.previews[-1]["FV"].same_as(changes["FV"])
    hand.undo()
    assert ghosted.curves["FV"] is FV
    assert "W" not in ghosted.curves


def test_the_slider_by_keyboard_to_the_very_end_gives_the_very_version(hand, ghosted, qtbot):
    ghosted.slide()
    slider = ghosted.blend_bar.slider
    qtbot.keyClick(slider, Key.Key_Right)
    qtbot.keyClick(slider, Key.Key_End)
    assert not hand.edits
    qtbot.keyClick(slider, Key.Key_Return)
    ((changes, _),) = hand.edits
    assert changes == {"FV": OLD["FV"], "W": OLD["W"], "open": None}
    assert ghosted.curves == OLD


def test_escape_and_the_way_back_to_now_leave_everything_as_it_was(hand, ghosted, qtbot):
    ghosted.slide()
    qtbot.keyClick(ghosted.blend_bar.slider, Key.Key_PageUp)
    qtbot.keyClick(ghosted.blend_bar.slider, Key.Key_Escape)
    assert ghosted.curves == {"open": OPEN, "FV": FV}
    assert hand.cancelled == 1
    ghosted.slide()
    qtbot.keyClick(ghosted.blend_bar.slider, Key.Key_PageUp)
    qtbot.keyClick(ghosted.blend_bar.slider, Key.Key_Home)
    qtbot.keyClick(ghosted.blend_bar.slider, Key.Key_Return)
    assert ghosted.curves == {"open": OPEN, "FV": FV}
    assert not hand.edits
    assert hand.cancelled == 2


def test_alt_d_once_more_slides_to_the_next_version(hand, ghosted, qtbot):
    ghosted.set_blend_target("suggestion", {"FV": OPEN})
    ghosted.slide()
    bar = ghosted.blend_bar
    assert bar.targets.currentText() == "previous version"
    qtbot.keyClick(bar.slider, Key.Key_D, ALT)
    assert bar.targets.currentText() == "suggestion"
    qtbot.keyClick(bar.slider, Key.Key_End)
    qtbot.keyClick(bar.slider, Key.Key_Return)
    assert hand.edits[0][0] == {"FV": OPEN, "open": None}
    ghosted.set_blend_target("suggestion", None)
    ghosted.slide()
    assert bar.targets.count() == 1


def test_a_version_picked_in_the_bar_starts_from_the_curves_as_they_were(hand, ghosted, qtbot):
    ghosted.set_blend_target("suggestion", {"FV": OPEN, "open": OPEN})
    ghosted.slide()
    bar = ghosted.blend_bar
    qtbot.keyClick(bar.slider, Key.Key_PageUp)
    bar.targets.setCurrentText("suggestion")
    bar.targets.textActivated.emit("suggestion")
    assert bar.slider.value() == 10
    assert hand.cancelled == 1
    assert ghosted.curves.keys() == {"FV", "open"}
    assert ghosted.curves["FV"].same_as(blended(FV, OPEN, 0.1))
    qtbot.keyClick(bar.slider, Key.Key_Escape)
    assert not hand.edits
    assert ghosted.curves["FV"] is FV


def test_ctrl_d_takes_over_a_similar_bigram_and_up_and_down_choose_another(hand, ghosted, qtbot):
    ghosted.set_neighbours({"F – Aa": {"open": OPEN, "FV": FV}, "F – Ao": {"FV": OPEN}, "F – Eh": {"W": FV}})
    hand.key(Key.Key_D, CTRL)
    bar = ghosted.blend_bar
    # What is as the open bigram is already stands in no list.
    assert [bar.targets.itemText(i) for i in range(bar.targets.count())] == ["previous version", "F – Ao", "F – Eh"]
    assert bar.targets.currentText() == "F – Ao"
    assert bar.slider.value() == 100
    assert hand.previews[-1]["FV"] is OPEN
    for key, name in ((Key.Key_Down, "F – Eh"), (Key.Key_Up, "F – Ao"), (Key.Key_Down, "F – Eh")):
        qtbot.keyClick(bar.slider, key)
        assert (bar.targets.currentText(), bar.slider.value()) == (name, 100)
    assert not hand.edits
    qtbot.keyClick(bar.slider, Key.Key_Return)
    ((changes, _),) = hand.edits
    assert changes == {"W": FV, "open": None, "FV": None}
    hand.undo()
    assert ghosted.curves["FV"] is FV


def test_the_key_under_the_pointer_may_vanish_on_the_way(hand, canvas, qtbot):
    """Painting a key that is no more brought the program down."""
    canvas.set_neighbours({"F – Aa": {"FV": Curve.of([(0, 0), (1, 0)])}})
    hand.move(0.56, 0.06, button=NO_BUTTON)
    assert canvas._control.hover == ("FV", 4)
    hand.key(Key.Key_D, CTRL)
    assert len(canvas.curves["FV"]) == 2
    assert canvas._control.hover is None
    assert not canvas.grab().isNull()
    qtbot.keyClick(canvas.blend_bar.slider, Key.Key_Escape)
    assert canvas.curves["FV"] is FV


def test_where_no_bigram_is_similar_duplicating_says_so(hand, canvas):
    canvas.set_neighbours({"F – Aa": {"open": OPEN, "FV": FV}})
    hand.key(Key.Key_D, CTRL)
    assert not canvas.busy
    assert "nothing to duplicate" in hand.hints[-1]


def test_another_bigram_closes_the_slider_and_edits_neither(hand, ghosted, qtbot):
    ghosted.slide()
    qtbot.keyClick(ghosted.blend_bar.slider, Key.Key_PageUp)
    ghosted.set_bigram("d", "ih")
    assert not ghosted.blend_bar.isVisible()
    assert not ghosted.busy
    assert not hand.edits


def test_a_click_on_the_canvas_keeps_what_the_slider_shows(hand, ghosted, qtbot):
    ghosted.activateWindow()
    ghosted.setFocus()
    qtbot.waitUntil(ghosted.hasFocus)
    ghosted.slide()
    assert ghosted.blend_bar.slider.hasFocus()
    qtbot.keyClick(ghosted.blend_bar.slider, Key.Key_PageUp)
    hand.click(0.7, 0.3)
    assert len(hand.edits) == 1
    assert not ghosted.blend_bar.isVisible()
    assert not ghosted.busy
    qtbot.keyClick(ghosted, Key.Key_BracketRight)
    assert ghosted.selection == {("FV", 0)}


def test_blending_keeps_both_ends_and_as_many_keys_slide_key_by_key():
    assert blended(FV, OPEN, 0) is FV
    assert blended(FV, OPEN, 1) is OPEN
    other = Curve(FV.t * 0.5, FV.v[::-1])
    np.testing.assert_allclose(blended(FV, other, 0.5).t, FV.t * 0.75)
    half = blended(FV, OPEN, 0.5)
    at = np.linspace(0, 1, 101)
    np.testing.assert_allclose(half.at(at), (FV.at(at) + OPEN.at(at)) / 2, atol=1e-5)


def test_shift_does_not_hide_the_backslash_of_another_keyboard(hand, ghosted):
    hand.key(Key.Key_Backslash, SHIFT, "\\")
    assert len(hand.edits) == 1


def test_the_ghost_of_an_empty_bigram_has_its_poses_colours_whatever_set_it_is_from(qtbot, canvas):
    """Dashed where nothing is drawn; curves of a set with other poses are left out."""
    canvas.set_curves({})
    canvas.set_suggestion("suggested from 3 in its row, 2 in its column")
    canvas.set_ghost({"FV": FV, "beak": FV})
    with_ghost = canvas.viewport().grab().toImage()
    assert theme.pose_colour("FV").red() > theme.pose_colour("FV").green() + 50
    pixels = with_ghost.convertToFormat(QImage.Format.Format_RGB32)
    blue, green, red, _ = np.frombuffer(pixels.constBits(), np.uint8).reshape(-1, 4).T.astype(int)
    assert (red > np.maximum(green, blue) + 20).sum() > 50
    canvas.set_suggestion("")
    assert canvas.viewport().grab().toImage() != with_ghost
