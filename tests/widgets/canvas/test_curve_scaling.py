"""Scaling, grabbing and reversing with real events: by key about the middle, by handle about the opposite edge."""

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QContextMenuEvent
from PySide6.QtWidgets import QApplication

from core_pipeline.curves import Curve
from tests.helpers.curve_hand import CTRL, FV, LEFT, NO_BUTTON, NONE, OPEN, RIGHT, SHIFT
from widgets import theme
from widgets.canvas.curve_geometry import View
from widgets.canvas.transform_box import PADDING, Box

Key = Qt.Key
PEAK = [("FV", 1), ("FV", 2), ("FV", 3)]  # t 0.12 0.26 0.42, v 0.78 0.97 0.55


@pytest.fixture
def peak(canvas):
    canvas.select(PEAK)
    return canvas


def hover(hand, x, y):
    """The pointer goes to a place of the viewport with no button held."""
    hand.mouse(QEvent.Type.MouseMove, QPointF(x, y), NO_BUTTON, NO_BUTTON)


def handle(canvas, i, j):
    """Where a handle of the box around the peak lies on the viewport; −1, 0, 1 as in transform_box."""
    corner = {-1: canvas.point_of(0.12, 0.55), 1: canvas.point_of(0.42, 0.97)}
    middle = (corner[-1] + corner[1]) / 2
    x = corner[i].x() + i * PADDING if i else middle.x()
    y = corner[j].y() - j * PADDING if j else middle.y()
    return QPointF(x, y)


def drag(hand, start, by, held=NONE, steps=6):
    hand.mouse(QEvent.Type.MouseButtonPress, start, LEFT, LEFT, held)
    for step in range(1, steps + 1):
        hand.mouse(QEvent.Type.MouseMove, start + QPointF(*by) * (step / steps), NO_BUTTON, LEFT, held)
    hand.mouse(QEvent.Type.MouseButtonRelease, start + QPointF(*by), LEFT, NO_BUTTON, held)


def pixels(canvas, dt, dv):
    """A shift in data as one in pixels."""
    away = canvas.point_of(dt, dv) - canvas.point_of(0, 0)
    return away.x(), away.y()


# Handles


def test_a_side_handle_scales_time_about_the_other_side(hand, peak):
    drag(hand, handle(peak, 1, 0), pixels(peak, 0.06, 0))
    ((changes, label),) = hand.edits
    assert label == "Scale keys"
    np.testing.assert_allclose(changes["FV"].t[1:4], 0.12 + 1.2 * (FV.t[1:4] - 0.12), atol=2e-3)
    assert changes["FV"].v.tolist() == FV.v.tolist()
    assert changes["FV"].t[[0, 4, 5]].tolist() == FV.t[[0, 4, 5]].tolist()
    hand.undo()
    assert peak.curves["FV"] is FV


def test_the_bottom_handle_scales_weight_about_the_top(hand, peak):
    drag(hand, handle(peak, 0, -1), pixels(peak, 0, 0.21))
    ((changes, _),) = hand.edits
    np.testing.assert_allclose(changes["FV"].v[1:4], 0.97 + 0.5 * (FV.v[1:4] - 0.97), atol=3e-3)
    assert changes["FV"].t.tolist() == FV.t.tolist()


def test_a_corner_scales_both_and_shift_only_one(hand, peak):
    drag(hand, handle(peak, -1, -1), pixels(peak, 0.06, -0.1))
    both = hand.edits[-1][0]["FV"]
    assert (both.t[1:3] != FV.t[1:3]).all()
    assert (both.v[[1, 3]] != FV.v[[1, 3]]).all()
    assert (both.t[3], both.v[2]) == (FV.t[3], FV.v[2])
    hand.undo()
    peak.select(PEAK)
    drag(hand, handle(peak, -1, -1), pixels(peak, 0.06, -0.02), SHIFT)
    assert hand.edits[-1][0]["FV"].v.tolist() == FV.v.tolist()


def test_ctrl_brings_the_edge_to_the_grid(hand, peak):
    drag(hand, handle(peak, 1, 0), pixels(peak, 0.037, 0), CTRL)
    assert hand.edits[0][0]["FV"].t[3] == pytest.approx(0.45)


def test_scaling_stops_before_the_neighbours_and_never_turns_over(hand, peak):
    drag(hand, handle(peak, 1, 0), pixels(peak, 0.5, 0))
    assert hand.edits[-1][0]["FV"].t[3] == pytest.approx(0.559, abs=1e-5)
    hand.undo()
    peak.select(PEAK)
    drag(hand, handle(peak, 1, 0), pixels(peak, -0.8, 0))
    assert (np.diff(hand.edits[-1][0]["FV"].t) >= 1e-3 - 1.1e-6).all()


def test_escape_takes_a_scaling_back(hand, peak):
    start = handle(peak, 1, 0)
    hand.mouse(QEvent.Type.MouseButtonPress, start, LEFT, LEFT)
    for dx in range(5, 45, 8):
        hand.mouse(QEvent.Type.MouseMove, start + QPointF(dx, 0), NO_BUTTON, LEFT)
    assert peak.curves["FV"] is not FV
    hand.key(Key.Key_Escape)
    assert peak.curves["FV"] is FV
    assert hand.cancelled == 1
    assert not hand.edits


def test_a_click_on_a_handle_changes_neither_keys_nor_selection(hand, peak):
    drag(hand, handle(peak, 1, 1), (0, 0))
    assert not hand.edits
    assert peak.selection == set(PEAK)


def test_the_box_and_its_handles_are_painted_and_say_what_they_do(hand, peak):
    def handles():
        image = peak.grab().toImage()
        return sum(image.pixelColor(handle(peak, i, j).toPoint()) == theme.LINK for i in (-1, 1) for j in (-1, 0, 1))

    assert handles() == 6
    at = handle(peak, 1, 0)
    hover(hand, at.x(), at.y())
    assert peak.viewport().cursor().shape() == Qt.CursorShape.SizeHorCursor
    assert "opposite edge" in hand.hints[-1]
    peak.select([("FV", 1)])
    assert handles() == 0


def test_a_box_has_no_handle_that_could_do_nothing():
    level = Box.around({"FV": Curve.of([(0.2, 0.5), (0.4, 0.5)])}, {"FV": [0, 1]})
    assert set(level.handles(View(width=800, height=400, bottom=400))) == {(-1, 0), (1, 0)}
    assert Box.around({"FV": FV, "W": FV}, {"FV": [1], "W": [1]}) is None


# By key


def test_s_scales_about_the_middle_as_the_pointer_goes_away(hand, peak):
    centre = peak.point_of(0.27, 0.76)
    hover(hand, centre.x() + 100, centre.y())
    hand.key(Key.Key_S)
    assert peak.busy
    for dx in (101, 102, 103, 104):
        hover(hand, centre.x() + dx, centre.y())
    assert not hand.edits
    hand.mouse(QEvent.Type.MouseButtonPress, centre + QPointF(104, 0), LEFT, LEFT)
    hand.mouse(QEvent.Type.MouseButtonRelease, centre + QPointF(104, 0), LEFT, NO_BUTTON)
    ((changes, label),) = hand.edits
    assert label == "Scale keys"
    np.testing.assert_allclose(changes["FV"].t[1:4], 0.27 + 1.04 * (FV.t[1:4] - 0.27), atol=2e-3)
    np.testing.assert_allclose(changes["FV"].v[1:4], 0.76 + 1.04 * (FV.v[1:4] - 0.76), atol=2e-3)
    assert peak.selection == set(PEAK)
    hand.undo()
    assert peak.curves["FV"] is FV


@pytest.mark.parametrize(("axis", "kept"), [(Key.Key_X, "v"), (Key.Key_Y, "t")])
@pytest.mark.parametrize("start", [Key.Key_S, Key.Key_G])
def test_x_and_y_keep_scaling_and_grabbing_to_one_axis(hand, peak, start, axis, kept):
    at = peak.point_of(0.45, 0.7)
    hover(hand, at.x(), at.y())
    hand.key(start)
    for step in range(1, 6):
        hover(hand, at.x() + 3 * step, at.y() + 3 * step)
    hand.key(axis)
    hand.key(Key.Key_Return)
    ((changes, _),) = hand.edits
    assert getattr(changes["FV"], kept).tolist() == getattr(FV, kept).tolist()
    other = {"t": "v", "v": "t"}[kept]
    assert getattr(changes["FV"], other).tolist() != getattr(FV, other).tolist()


def test_x_holds_during_a_drag_with_the_button_too_and_once_more_lets_go(hand, canvas):
    hand.press(0.26, 0.97)
    hand.move(0.3, 0.8)
    hand.key(Key.Key_X)
    assert canvas.curves["FV"].v[2] == 0.97
    hand.key(Key.Key_X)
    assert canvas.curves["FV"].v[2] == pytest.approx(0.8, abs=2e-3)
    hand.release(0.3, 0.8)
    assert len(hand.edits) == 1


def test_g_grabs_the_selection_and_enter_keeps_it(hand, peak):
    at = peak.point_of(0.5, 0.5)
    hover(hand, at.x(), at.y())
    hand.key(Key.Key_G)
    dx, dy = pixels(peak, 0.05, -0.1)
    for share in (0.2, 0.4, 0.6, 0.8, 1.0):
        hover(hand, at.x() + dx * share, at.y() + dy * share)
    hand.key(Key.Key_Return)
    ((changes, label),) = hand.edits
    assert label == "Move keys"
    np.testing.assert_allclose(changes["FV"].t[1:4], FV.t[1:4] + 0.05, atol=1e-3)
    np.testing.assert_allclose(changes["FV"].v[1:4], FV.v[1:4] - 0.1, atol=1e-3)


@pytest.mark.parametrize("start", [Key.Key_S, Key.Key_G])
def test_escape_and_the_right_button_take_back_what_no_button_holds(hand, peak, start):
    at = peak.point_of(0.6, 0.4)
    for back in ("escape", "right"):
        hover(hand, at.x(), at.y())
        hand.key(start)
        hover(hand, at.x() + 30, at.y() + 10)
        assert peak.curves["FV"] is not FV
        if back == "escape":
            hand.key(Key.Key_Escape)
        else:
            hand.mouse(QEvent.Type.MouseButtonPress, at, RIGHT, RIGHT)
            wish = QContextMenuEvent(QContextMenuEvent.Reason.Mouse, at.toPoint(), at.toPoint())
            QApplication.sendEvent(peak.viewport(), wish)
            assert QApplication.activePopupWidget() is None
        assert peak.curves["FV"] is FV
        assert not peak.busy
        assert peak.selection == set(PEAK)
    assert not hand.edits
    assert hand.cancelled == 2


def test_arrows_steer_a_scaling_without_any_mouse(hand, peak):
    hand.key(Key.Key_S)
    for _ in range(3):
        hand.key(Key.Key_Right)
    hand.key(Key.Key_Return)
    ((changes, label),) = hand.edits
    assert label == "Scale keys"
    assert np.ptp(changes["FV"].t[1:4]) > np.ptp(FV.t[1:4])


def test_what_no_button_holds_is_kept_when_the_keyboard_goes_elsewhere(hand, peak, qtbot):
    peak.activateWindow()
    peak.setFocus()
    qtbot.waitUntil(peak.hasFocus)
    at = peak.point_of(0.6, 0.4)
    hover(hand, at.x(), at.y())
    hand.key(Key.Key_G)
    hover(hand, at.x() + 20, at.y())
    peak.clearFocus()
    assert not peak.busy
    assert [label for _, label in hand.edits] == ["Move keys"]


def test_scaling_one_key_or_none_says_what_it_needs(hand, canvas):
    hand.key(Key.Key_S)
    assert hand.hints[-1] == "select keys first"
    canvas.select([("FV", 1)])
    hand.key(Key.Key_S)
    assert hand.hints[-1] == "select two or more keys to scale them"
    assert not canvas.busy


# Reversing


def test_ctrl_m_reverses_the_active_curve_and_twice_is_as_before(hand, canvas):
    hand.key(Key.Key_M, CTRL)
    ((changes, label),) = hand.edits
    assert label == "Reverse keys"
    np.testing.assert_allclose(changes["FV"].t, 1 - FV.t[::-1], atol=1e-6)
    assert changes["FV"].v.tolist() == FV.v[::-1].tolist()
    hand.key(Key.Key_M, CTRL)
    assert hand.edits[-1][0]["FV"].same_as(FV)


def test_ctrl_m_reverses_some_keys_within_their_own_time(hand, peak):
    hand.key(Key.Key_M, CTRL)
    turned = hand.edits[0][0]["FV"]
    np.testing.assert_allclose(turned.t, [0, 0.12, 0.28, 0.42, 0.56, 1], atol=1e-6)
    assert turned.v.tolist() == [0.2, 0.55, 0.97, 0.78, 0.06, 0]
    assert peak.selection == set(PEAK)


def test_ctrl_m_without_room_is_refused(hand, canvas):
    canvas.set_curves({"FV": Curve.of([(0, 0), (0.2, 0.5), (0.72, 0.9), (1, 0)]), "open": OPEN})
    canvas.select([("FV", 1), ("open", 3)])  # about 0.46: 0.2 would come to 0.72, where a key of FV stays
    hand.key(Key.Key_M, CTRL)
    assert not hand.edits
    assert "another key is in the way" in hand.hints[-1]
