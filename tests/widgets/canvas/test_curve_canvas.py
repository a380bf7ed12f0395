"""The canvas under real mouse and key events: what it shows, and what it says is wanted."""

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QContextMenuEvent, QKeyEvent
from PySide6.QtWidgets import QApplication

from tests.helpers.curve_hand import ALT, CTRL, FV, LEFT, MIDDLE, NO_BUTTON, NONE, OPEN, SHIFT
from widgets import theme
from widgets.canvas.curve_axes import grid_values

Key = Qt.Key


def count(canvas, colour):
    """Pixels of exactly this colour."""
    image = canvas.grab().toImage().convertToFormat(canvas.grab().toImage().Format.Format_RGB32)
    pixels = np.frombuffer(image.constBits(), np.uint32).reshape(image.height(), -1)[:, : image.width()]
    return int(((pixels & 0xFFFFFF) == (colour.rgb() & 0xFFFFFF)).sum())


# One gesture, one edit


def test_a_drag_previews_all_the_way_and_edits_once(hand, canvas):
    hand.drag((0.26, 0.97), (0.3, 0.7), steps=8)
    assert len(hand.previews) == 8
    assert len(hand.edits) == 1
    changes, label = hand.edits[0]
    assert label == "Move keys"
    assert list(changes) == ["FV"]
    np.testing.assert_allclose(changes["FV"].keys()[2], (0.3, 0.7), atol=1e-3)
    assert hand.previews[-1]["FV"].same_as(changes["FV"])
    assert canvas.curves["FV"] is changes["FV"]


def test_undo_shows_the_very_object_again(hand, canvas):
    hand.drag((0.26, 0.97), (0.3, 0.7))
    canvas.set_curves(hand.history[0])
    assert canvas.curves["FV"] is FV


def test_escape_takes_a_drag_back_without_an_edit(hand, canvas):
    hand.press(0.26, 0.97)
    for step in range(1, 6):
        hand.move(0.26 + 0.01 * step, 0.97)
    hand.key(Key.Key_Escape)
    hand.move(0.5, 0.5)
    hand.release(0.5, 0.5)
    assert not hand.edits
    assert hand.cancelled == 1
    assert canvas.curves["FV"] is FV


def test_there_and_back_ends_the_preview_without_an_edit(hand, canvas):
    hand.press(0.26, 0.97)
    for t in (0.28, 0.3, 0.32, 0.29, 0.26):
        hand.move(t, 0.97)
    hand.release(0.26, 0.97)
    assert not hand.edits
    assert hand.cancelled == 1
    assert canvas.curves["FV"] is FV


def test_a_plain_click_edits_nothing(hand, canvas):
    hand.click(0.26, 0.97)
    hand.click(0.7, 0.3)
    assert not hand.edits
    assert not hand.previews
    assert not hand.cancelled


def test_values_from_outside_do_not_disturb_a_gesture(hand, canvas):
    hand.press(0.26, 0.97)
    hand.move(0.3, 0.7)
    held = canvas.curves["FV"]
    canvas.set_curves({"FV": OPEN})
    canvas.set_playhead(0.4)
    assert canvas.curves["FV"] is held
    hand.release(0.3, 0.7)
    assert len(hand.edits) == 1


def test_opening_another_bigram_ends_the_gesture_and_edits_neither(hand, canvas):
    hand.press(0.26, 0.97)
    hand.move(0.3, 0.7)
    canvas.set_bigram("d", "ih")
    assert not canvas.busy
    canvas.set_curves({"open": OPEN})
    hand.move(0.35, 0.5)
    hand.release(0.35, 0.5)
    assert not hand.edits
    assert hand.cancelled == 1
    assert canvas.curves == {"open": OPEN}


def test_a_release_that_went_elsewhere_ends_the_gesture_at_the_next_move(hand, canvas):
    hand.press(0.26, 0.97)
    hand.move(0.3, 0.7)
    hand.move(0.5, 0.5, button=NO_BUTTON)
    assert not canvas.busy
    assert len(hand.edits) == 1


def test_keys_pressed_during_a_drag_do_nothing_to_it(hand, canvas):
    hand.press(0.26, 0.97)
    hand.move(0.3, 0.7)
    for key in (Key.Key_Delete, Key.Key_Left, Key.Key_Comma, Key.Key_F):
        hand.key(key)
    assert canvas.busy
    assert not hand.edits
    hand.release(0.3, 0.7)
    assert [label for _, label in hand.edits] == ["Move keys"]
    assert not hand.cancelled


# Modifiers


def test_shift_constrains_while_it_is_held_even_when_pressed_late(hand, canvas):
    hand.press(0.26, 0.97)
    hand.move(0.36, 0.9)
    QApplication.sendEvent(canvas, QKeyEvent(QEvent.Type.KeyPress, Key.Key_Shift, NONE))
    assert canvas.curves["FV"].v[2] == 0.97
    QApplication.sendEvent(canvas, QKeyEvent(QEvent.Type.KeyRelease, Key.Key_Shift, SHIFT))
    assert canvas.curves["FV"].v[2] == pytest.approx(0.9, abs=1e-3)
    hand.release(0.36, 0.9)


def test_ctrl_drag_lands_on_the_grid(hand, canvas):
    hand.drag((0.26, 0.97), (0.312, 0.688), CTRL)
    assert hand.edits[0][0]["FV"].keys()[2] == (0.3, 0.7)


def test_the_snap_switch_does_the_same_without_ctrl(hand, canvas):
    canvas.set_snap(True)
    hand.drag((0.26, 0.97), (0.312, 0.688))
    assert hand.edits[0][0]["FV"].keys()[2] == (0.3, 0.7)


def test_alt_drag_is_ten_times_finer(hand, canvas):
    hand.drag((0.26, 0.97), (0.36, 0.97), ALT)
    assert hand.edits[0][0]["FV"].t[2] == pytest.approx(0.27, abs=2e-3)


# Adding and deleting


def test_a_double_click_on_the_curve_adds_a_key_and_only_that(hand, canvas):
    hand.double_click(0.19, 0.88)
    assert [label for _, label in hand.edits] == ["Add key"]
    assert len(canvas.curves["FV"]) == 7
    assert canvas.selection == {("FV", 2)}


def test_a_double_click_held_on_moves_the_new_key_as_a_second_edit(hand, canvas):
    hand.click(0.19, 0.88)
    hand.mouse(QEvent.Type.MouseButtonDblClick, canvas.point_of(0.19, 0.88), LEFT, LEFT)
    for step in range(1, 6):
        hand.move(0.19, 0.88 - 0.02 * step)
    hand.release(0.19, 0.78)
    assert [label for _, label in hand.edits] == ["Add key", "Move keys"]
    assert canvas.curves["FV"].v[2] == pytest.approx(0.78, abs=2e-3)


def test_a_double_click_in_the_open_says_where_to_click(hand, canvas):
    hand.double_click(0.8, 0.5)
    assert not hand.edits
    assert "Ctrl+click" in hand.hints[-1]


def test_a_double_click_starts_a_curve_for_a_pose_that_has_none(hand, canvas):
    canvas.set_active("PBM")
    hand.double_click(0.8, 0.4)
    (changes, label) = hand.edits[0]
    assert label == "Add key"
    np.testing.assert_allclose(changes["PBM"].keys(), [(0, 0), (0.8, 0.4), (1, 0)], atol=2e-3)


def test_ctrl_click_adds_anywhere(hand, canvas):
    hand.click(0.8, 0.5, CTRL)
    assert [label for _, label in hand.edits] == ["Add key"]
    assert canvas.selection == {("FV", 5)}


@pytest.mark.parametrize("key", [Key.Key_Delete, Key.Key_Backspace])
def test_delete_removes_the_selection_and_a_whole_curve_becomes_none(hand, canvas, key):
    hand.click(0.26, 0.97)
    hand.key(key)
    assert len(canvas.curves["FV"]) == 5
    hand.key(Key.Key_A, CTRL)
    hand.key(key)
    assert [label for _, label in hand.edits] == ["Delete keys", "Delete keys"]
    assert hand.edits[-1][0] == {"FV": None}
    assert "FV" not in canvas.curves


@pytest.mark.parametrize(
    ("key", "held", "shift"),
    [
        (Key.Key_Left, NONE, (-0.01, 0)),
        (Key.Key_Right, NONE, (0.01, 0)),
        (Key.Key_Up, SHIFT, (0, 0.001)),
        (Key.Key_Down, CTRL, (0, -0.05)),
    ],
)
def test_arrows_nudge(hand, canvas, key, held, shift):
    hand.click(0.26, 0.97)
    hand.key(key, held)
    (changes, label) = hand.edits[0]
    assert label == "Nudge keys"
    np.testing.assert_allclose(changes["FV"].keys()[2], (0.26 + shift[0], 0.97 + shift[1]), atol=1e-9)


def test_a_locked_pose_refuses_and_says_so(hand, canvas):
    canvas.set_locked({"FV"})
    hand.drag((0.26, 0.97), (0.3, 0.7))
    hand.double_click(0.19, 0.88)
    assert not hand.edits
    assert "FV is locked" in hand.hints[-1]


# Selection and words


def test_the_status_line_names_bigram_pose_keys_and_the_last_picked_one(hand, canvas):
    hand.click(0.42, 0.55)
    assert hand.selections[-1] == "F–Ah · FV · 1 key selected · t 0.42  v 0.55"
    hand.click(0.26, 0.97, SHIFT)
    assert hand.selections[-1] == "F–Ah · FV · 2 keys selected · t 0.26  v 0.97"
    assert canvas.accessibleDescription() == hand.selections[-1]
    hand.key(Key.Key_Escape)
    assert hand.selections[-1] == "F–Ah · FV"


def test_a_click_on_another_line_activates_its_pose_once(hand, canvas):
    hand.click(0.72, 0.8)
    assert hand.actives == ["open"]
    assert canvas.active == "open"


def test_a_value_from_outside_is_not_answered_with_a_wish(hand, canvas):
    canvas.set_active("open")
    canvas.set_poses(("open", "FV"))
    assert not hand.actives
    assert not hand.edits


def test_brackets_walk_the_keys(hand, canvas):
    hand.key(Key.Key_BracketRight)
    hand.key(Key.Key_BracketRight)
    assert canvas.selection == {("FV", 1)}
    hand.key(Key.Key_BracketLeft)
    assert canvas.selection == {("FV", 0)}


def test_a_marquee_selects_without_an_edit(hand, canvas):
    hand.drag((0.08, 0.6), (0.3, 1.02))
    assert canvas.selection == {("FV", 1), ("FV", 2)}
    assert not hand.edits


def test_space_asks_to_play(hand):
    hand.key(Key.Key_Space)
    assert hand.played == 1


def test_keys_that_mean_nothing_here_are_left_to_the_window(canvas):
    event = QKeyEvent(QEvent.Type.KeyPress, Key.Key_Q, NONE)
    event.accept()
    canvas.keyPressEvent(event)
    assert not event.isAccepted()


def test_own_keys_are_claimed_before_window_shortcuts(canvas):
    for key, claimed in ((Key.Key_Delete, True), (Key.Key_F6, False)):
        event = QKeyEvent(QEvent.Type.ShortcutOverride, key, NONE)
        event.ignore()
        QApplication.sendEvent(canvas, event)
        assert event.isAccepted() == claimed


@pytest.mark.qt_log_ignore("This plugin does not support")
def test_the_context_menu_offers_what_can_be_done_there(hand, canvas, qtbot):
    at = canvas.point_of(0.26, 0.97).toPoint()
    event = QContextMenuEvent(QContextMenuEvent.Reason.Mouse, at, canvas.viewport().mapToGlobal(at))
    QApplication.sendEvent(canvas.viewport(), event)
    menu = QApplication.activePopupWidget()
    able = {action.text().split("\t")[0]: action for action in menu.actions() if action.isEnabled()}
    assert canvas.selection == {("FV", 2)}
    assert "Add key to FV" not in able
    able["Delete keys"].trigger()
    menu.close()
    assert [label for _, label in hand.edits] == ["Delete keys"]


# The view


def test_the_wheel_zooms_about_the_pointer_and_home_brings_all_back(hand, canvas):
    home, before = canvas.shown, canvas.point_of(0.42, 0.55)
    hand.wheel(0.42, 0.55, 240)
    assert canvas.shown.width() < home.width()
    assert canvas.shown.height() < home.height()
    after = canvas.point_of(0.42, 0.55)
    assert (after - before).manhattanLength() < 1e-6
    hand.key(Key.Key_Home)
    assert canvas.shown == home


def test_ctrl_and_shift_wheel_zoom_one_axis(hand, canvas):
    home = canvas.shown
    hand.wheel(0.5, 0.5, 120, CTRL)
    assert canvas.shown.height() == pytest.approx(home.height())
    narrowed = canvas.shown.width()
    assert narrowed < home.width()
    hand.wheel(0.5, 0.5, 120, SHIFT)
    assert canvas.shown.width() == pytest.approx(narrowed)
    assert canvas.shown.height() < home.height()


def test_zooming_stops_at_both_ends(hand, canvas):
    for _ in range(60):
        hand.wheel(0.5, 0.5, 480)
    assert canvas.shown.width() == pytest.approx(0.02)
    for _ in range(60):
        hand.wheel(0.5, 0.5, -480)
    assert canvas.shown.width() == pytest.approx(1.5)


@pytest.mark.parametrize(("button", "held"), [(MIDDLE, NONE), (LEFT, ALT)])
def test_middle_or_alt_drag_on_nothing_pans(hand, canvas, button, held):
    before, home = canvas.point_of(0.5, 0.5), canvas.shown
    at = [before + QPointF(8.0 * i, 0) for i in range(6)]
    hand.mouse(QEvent.Type.MouseButtonPress, at[0], button, button, held)
    for point in at[1:]:
        hand.mouse(QEvent.Type.MouseMove, point, NO_BUTTON, button, held)
    hand.mouse(QEvent.Type.MouseButtonRelease, at[-1], button, NO_BUTTON, held)
    assert canvas.point_of(0.5, 0.5).x() == pytest.approx(before.x() + 40)
    assert canvas.shown.width() == pytest.approx(home.width())
    assert not canvas.selection
    assert not hand.edits


def test_f_frames_the_selection_else_all(hand, canvas):
    home = canvas.shown
    hand.click(0.26, 0.97)
    hand.key(Key.Key_F)
    assert canvas.shown.width() < 0.3
    assert canvas.shown.contains(QPointF(0.26, 0.97))
    hand.key(Key.Key_Escape)
    hand.key(Key.Key_F)
    assert canvas.shown == home


def test_the_grid_keeps_its_distance_and_stays_within_0_and_1():
    for first, last, pixels in ((-0.05, 1.05, 300), (0.2, 0.4, 900), (-0.25, 1.25, 120), (0.41, 0.43, 800)):
        step, values = grid_values(first, last, pixels)
        assert step * pixels / (last - first) >= 48 or step == 0.5
        assert all(max(first, 0) <= value <= min(last, 1) for value in values)
        assert len(values) >= 2


# What is painted


def test_hidden_curves_are_not_painted_and_stay_data(canvas):
    blue = theme.pose_colour("FV")
    assert count(canvas, blue) > 200
    canvas.set_visible_poses({"open"})
    assert count(canvas, blue) == 0
    assert canvas.curves["FV"] is FV


def test_ghost_played_playhead_and_selection_are_painted(canvas):
    plain = canvas.grab().toImage()
    for show, hide in (
        (lambda: canvas.set_ghost({"FV": OPEN}), lambda: canvas.set_ghost(None)),
        (lambda: canvas.set_played({"FV": (OPEN.t, OPEN.v)}), lambda: canvas.set_played(None)),
        (lambda: canvas.set_playhead(0.3), lambda: canvas.set_playhead(None)),
        (lambda: canvas.select([("FV", 3)]), lambda: canvas.select([])),
        (lambda: canvas.set_spline("linear"), lambda: canvas.set_spline("pchip")),
        (lambda: canvas.set_boundary(0.7), lambda: canvas.set_boundary(0.5)),
    ):
        show()
        assert canvas.grab().toImage() != plain
        hide()
        assert canvas.grab().toImage() == plain


def test_the_playhead_leaves_the_curves_as_they_are(canvas):
    """With the cache that makes the playhead cheap, curves look the same, also after an edit and a zoom."""
    for change in (
        lambda: None,
        lambda: canvas.set_curves({"FV": OPEN}),
        canvas.frame_all,
        lambda: canvas.resize(700, 420),
    ):
        change()
        canvas.set_playhead(None)
        QApplication.processEvents()
        plain = count(canvas, theme.pose_colour("FV"))
        canvas.set_playhead(0.97)
        QApplication.processEvents()
        assert abs(count(canvas, theme.pose_colour("FV")) - plain) <= 8


def test_panning_under_the_playhead_shows_what_a_fresh_painting_shows(hand, canvas):
    canvas.set_playhead(0.5)
    canvas.grab()
    hand.wheel(0.5, 0.5, 240)
    hand.drag((0.4, 0.8), (0.5, 0.7), button=MIDDLE)
    panned = canvas.grab().toImage()
    canvas.set_playhead(None)
    canvas.set_playhead(0.5)
    assert canvas.grab().toImage() == panned


def test_the_focus_ring_shows_who_has_the_keyboard(canvas, qtbot):
    canvas.setFocus()
    canvas.activateWindow()
    qtbot.waitUntil(canvas.hasFocus)
    ring = count(canvas, theme.ACCENT)
    assert ring >= 2 * (canvas.viewport().width() + canvas.viewport().height()) - 8
    canvas.clearFocus()
    assert count(canvas, theme.ACCENT) < 50


def test_an_empty_bigram_says_how_to_begin(canvas):
    before = count(canvas, theme.MUTED)
    canvas.set_curves({})
    assert count(canvas, theme.MUTED) > before
