"""Magnets: 0, 1 and the phone boundary hold dragged keys and scaled edges that come near, but not under Alt."""

import pytest
from PySide6.QtCore import QEvent, QPointF, Qt

from tests.helpers.curve_hand import ALT, CTRL, FV, NO_BUTTON, NONE, OPEN
from widgets import theme
from widgets.canvas.curve_geometry import View
from widgets.canvas.curve_magnets import PULL, Landing

BOUNDARY = 0.4337  # on no grid line


@pytest.fixture
def canvas(canvas):
    canvas.set_boundary(BOUNDARY)
    return canvas


def beside(canvas, t, v, dx=0.0, dy=0.0):
    """The place (t, v) a few pixels away, as time and weight."""
    view = canvas._control.view
    return t + dx / view.width, v - dy / view.height


@pytest.mark.parametrize("snap", [False, True])
def test_a_key_dragged_near_the_boundary_lands_on_it(hand, canvas, snap):
    canvas.set_snap(snap)
    hand.drag((0.42, 0.55), beside(canvas, BOUNDARY, 0.7, dx=PULL - 1.5))
    assert hand.edits[-1][0]["FV"].t[3] == BOUNDARY


def test_farther_away_or_under_alt_it_lies_where_the_hand_is(hand, canvas):
    end = beside(canvas, BOUNDARY, 0.7, dx=PULL + 2)
    hand.drag((0.42, 0.55), end)
    assert hand.edits[-1][0]["FV"].t[3] == pytest.approx(end[0], abs=1e-3)
    hand.undo()
    wide = canvas._control.view.width
    hand.drag((0.42, 0.55), (0.42 + 10 * (BOUNDARY - 0.42) - 20 / wide, 0.55), ALT)  # ends 2 pixels before it
    assert hand.edits[-1][0]["FV"].t[3] == pytest.approx(BOUNDARY - 2 / wide, abs=5e-4)


def test_end_keys_stay_at_the_ends_while_they_are_dragged_up_and_down(hand, canvas):
    hand.drag((0, 0.2), beside(canvas, 0, 0.5, dx=3))
    hand.drag((1, 0), beside(canvas, 1, 0.3, dx=-3))
    assert hand.curves["FV"].t[[0, -1]].tolist() == [0, 1]


def test_weights_near_0_and_1_lie_on_them(hand, canvas):
    hand.drag((0.56, 0.06), beside(canvas, 0.6, 0.0, dy=-3))
    hand.drag((0.26, 0.97), beside(canvas, 0.26, 1.0, dy=3))
    assert hand.curves["FV"].v[[4, 2]].tolist() == [0, 1]


@pytest.mark.parametrize(
    ("handle", "end", "reached"),
    [
        ((1, 0), (BOUNDARY, 0.5), lambda curve: curve.t[3] == BOUNDARY),
        ((-1, 0), (0.0, 0.5), lambda curve: curve.t[0] == 0),
        ((0, 1), (0.2, 1.0), lambda curve: curve.v[2] == 1),
        ((0, -1), (0.2, 0.0), lambda curve: curve.v[3] == 0),
    ],
)
def test_the_edge_under_a_handle_meets_the_magnets(hand, canvas, handle, end, reached):
    keys = [0, 1, 2, 3] if handle == (-1, 0) else [1, 2, 3]
    canvas.select([("FV", i) for i in keys])
    control = canvas._control
    x, y = control.box().handles(control.view)[handle]
    t, v = control.box().edge(handle)
    start = control.view.t(x), control.view.v(y)
    # The handle stands off the edge it moves: go as far as the edge must go, and 3 pixels less.
    way = (end[0] - t) * bool(handle[0]), (end[1] - v) * bool(handle[1])
    goal = beside(canvas, start[0] + way[0], start[1] + way[1], dx=-3 * handle[0], dy=3 * handle[1])
    hand.drag(start, goal)
    if handle == (-1, 0):
        assert not hand.edits  # it is at 0 already, and 3 pixels do not take it away
    else:
        assert reached(hand.edits[-1][0]["FV"])


def test_scaling_about_the_middle_meets_the_boundary_with_either_edge(hand, canvas):
    canvas.select([("FV", 1), ("FV", 2), ("FV", 3)])
    centre = canvas.point_of(0.27, 0.76)
    arm = QPointF(100, 0)
    hand.mouse(QEvent.Type.MouseMove, centre + arm, NO_BUTTON, NO_BUTTON)
    hand.key(Qt.Key.Key_S)
    hand.key(Qt.Key.Key_X)
    wanted = 100 * (BOUNDARY - 0.27) / 0.15
    for dx in (102, 106, 108, round(wanted)):
        hand.mouse(QEvent.Type.MouseMove, centre + QPointF(dx, 0), NO_BUTTON, NO_BUTTON)
    hand.key(Qt.Key.Key_Return)
    curve = hand.edits[-1][0]["FV"]
    assert curve.t[3] == pytest.approx(BOUNDARY, abs=1e-6)
    assert curve.v.tolist() == FV.v.tolist()


def test_the_magnet_that_holds_a_key_lights_up(hand, canvas):
    lit = theme.mix(theme.HIGHLIGHT, theme.BACKGROUND, 0.5).rgb()

    def count():
        image = canvas.grab().toImage()
        return sum(image.pixel(x, y) == lit for x in range(image.width()) for y in range(100, 104))

    hand.press(0.42, 0.55)
    hand.move(0.39, 0.6)
    assert count() == 0
    hand.move(BOUNDARY, 0.6)
    assert count() >= 3
    hand.release(BOUNDARY, 0.6)
    assert count() == 0


def test_a_scale_factor_meets_the_grid_or_a_magnet_whichever_is_nearer():
    snapping, free = Landing(View(0, 100, 100, 100), 0.5, snap=True), Landing(View(0, 100, 100, 100), 0.5)
    arms = [(0.3, 0.15, True), (0.3, -0.15, True)]
    assert snapping.factor(1.32, arms) == pytest.approx(0.2 / 0.15)
    assert snapping.factor(1.22, arms) == pytest.approx(1.2)
    assert free.factor(1.22, arms) == pytest.approx(0.2 / 0.15)
    assert free.factor(0.8, arms) == 0.8
    assert free._replace(fine=True).factor(1.32, arms) == 1.32


# Mirror


def test_ctrl_shift_m_turns_the_selection_upside_down_in_one_edit(hand, canvas):
    canvas.select([("FV", 1), ("FV", 2), ("FV", 3)])
    hand.key(Qt.Key.Key_M, CTRL | Qt.KeyboardModifier.ShiftModifier)
    ((changes, label),) = hand.edits
    assert label == "Mirror values"
    assert changes["FV"].v.tolist() == pytest.approx([0.2, 0.74, 0.55, 0.97, 0.06, 0])
    assert changes["FV"].t.tolist() == FV.t.tolist()
    assert canvas.selection == {("FV", 1), ("FV", 2), ("FV", 3)}
    hand.key(Qt.Key.Key_M, CTRL | Qt.KeyboardModifier.ShiftModifier)
    assert hand.curves["FV"].same_as(FV)


def test_without_a_selection_the_active_curve_is_mirrored_within_its_own_range(hand, canvas):
    canvas.set_active("open")
    canvas.mirror()
    assert hand.curves["open"].v.tolist() == pytest.approx([0.8, 0.78, 0.18, 0, 0.68])
    assert hand.curves["FV"] is FV
    assert hand.history[0]["open"] is OPEN


def test_equal_weights_cannot_be_mirrored(hand, canvas):
    canvas.select([("FV", 5)])
    canvas.mirror()
    assert not hand.edits
    assert "nothing to mirror" in hand.hints[-1]


def test_a_grab_by_key_meets_magnets_too(hand, canvas):
    canvas.select([("FV", 3)])
    at = canvas.point_of(0.42, 0.55)
    hand.mouse(QEvent.Type.MouseMove, at, NO_BUTTON, NO_BUTTON)
    hand.key(Qt.Key.Key_G)
    end = canvas.point_of(*beside(canvas, BOUNDARY, 0.55, dx=2))
    hand.mouse(QEvent.Type.MouseMove, (at + end) / 2, NO_BUTTON, NO_BUTTON)
    hand.mouse(QEvent.Type.MouseMove, end, NO_BUTTON, NO_BUTTON, NONE)
    hand.key(Qt.Key.Key_Return)
    assert hand.edits[-1][0]["FV"].t[3] == BOUNDARY
