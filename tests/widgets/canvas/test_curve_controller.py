"""The hand on the curves, without a window: what a gesture may do to keys and what it may never do."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core_pipeline.curves import MIN_GAP, Curve
from widgets.canvas.curve_clipboard import Copied
from widgets.canvas.curve_controller import ADD, DELETE, MOVE, NUDGE, PLAIN, SCALE, CurveController, Modifiers
from widgets.canvas.curve_edits import blended, reversed_keys, stretched
from widgets.canvas.curve_geometry import View, distance_to_line, feasible, feasible_scale, shifted
from widgets.canvas.curve_gestures import BLEND
from widgets.canvas.curve_scene import Refusal

POSES = ("open", "FV", "wide")
VIEW = View(left=50, width=800, bottom=450, height=400)
SHIFT, CTRL, ALT = Modifiers(shift=True), Modifiers(ctrl=True), Modifiers(alt=True)

HAT = Curve.of([(0, 0), (0.5, 0.8), (1, 0)])
RAMP = Curve.of([(0.1, 0.2), (0.3, 0.3), (0.7, 0.6), (0.9, 0.9)])


def controller(**curves: Curve) -> CurveController:
    control = CurveController()
    control.set_poses(POSES)
    control.set_view(VIEW)
    control.set_curves(curves)
    return control


def px(t: float, v: float) -> tuple[float, float]:
    return VIEW.x(t), VIEW.y(v)


def drag(control, start, end, held=PLAIN, steps=6):
    """Press at `start`, go to `end` (both data), release; the edit."""
    (x0, y0), (x1, y1) = px(*start), px(*end)
    control.press(x0, y0, held)
    for share in np.linspace(0, 1, steps + 1)[1:]:
        control.move(x0 + (x1 - x0) * share, y0 + (y1 - y0) * share, held)
    return control.release(x1, y1)


def click(control, t, v, held=PLAIN):
    x, y = px(t, v)
    control.press(x, y, held)
    return control.release(x, y)


# Moving


def test_a_drag_moves_the_key_under_the_pointer_and_no_other():
    control = controller(open=HAT)
    edit = drag(control, (0.5, 0.8), (0.6, 0.5))
    assert edit.label == MOVE
    assert list(edit.changes) == ["open"]
    np.testing.assert_allclose(edit.changes["open"].keys(), [(0, 0), (0.6, 0.5), (1, 0)], atol=1e-9)


def test_end_keys_may_leave_the_ends():
    control = controller(open=HAT)
    edit = drag(control, (0, 0), (0.2, 0.1))
    np.testing.assert_allclose(edit.changes["open"].keys()[0], (0.2, 0.1), atol=1e-9)


def test_less_than_three_pixels_is_a_click_and_moves_nothing():
    control = controller(open=HAT)
    x, y = px(0.5, 0.8)
    control.press(x, y)
    assert control.move(x + 2, y + 2) is None
    assert control.release(x + 2, y + 2) is None
    assert control.curves["open"] is HAT
    assert control.selection == {("open", 1)}


def test_the_selection_moves_as_one_body_and_stops_as_one_body():
    """Keys 1 and 2 of the ramp, dragged far to the right: key 2 stops before key 3, key 1 keeps its distance."""
    control = controller(open=RAMP)
    control.select({("open", 1), ("open", 2)})
    edit = drag(control, (0.3, 0.3), (1.5, 0.3))
    t = edit.changes["open"].t
    assert t[2] == pytest.approx(0.9 - MIN_GAP)
    assert t[2] - t[1] == pytest.approx(0.4)
    assert t[[0, 3]].tolist() == [0.1, 0.9]


def test_the_selection_is_clamped_in_weight_without_being_flattened():
    control = controller(open=RAMP)
    control.select({("open", 1), ("open", 2)})
    edit = drag(control, (0.3, 0.3), (0.3, 2.0))
    np.testing.assert_allclose(edit.changes["open"].v, [0.2, 0.7, 1.0, 0.9], atol=1e-9)


def test_one_drag_moves_keys_of_several_poses_in_one_edit():
    control = controller(open=HAT, FV=RAMP)
    control.select({("open", 1), ("FV", 2)})
    edit = drag(control, (0.5, 0.8), (0.55, 0.8))
    assert set(edit.changes) == {"open", "FV"}
    assert edit.changes["FV"].t[2] == pytest.approx(0.75)


def test_shift_keeps_to_the_axis_that_dominates():
    control = controller(open=HAT)
    edit = drag(control, (0.5, 0.8), (0.7, 0.75), SHIFT)
    assert edit.changes["open"].keys()[1] == (pytest.approx(0.7), 0.8)


def test_ctrl_snaps_to_the_grid_and_the_toggle_turns_that_round():
    end = (0.619, 0.437)
    assert drag(controller(open=HAT), (0.5, 0.8), end, CTRL).changes["open"].keys()[1] == (0.6, 0.45)
    control = controller(open=HAT)
    control.snap = True
    assert drag(control, (0.5, 0.8), end).changes["open"].keys()[1] == (0.6, 0.45)
    control = controller(open=HAT)
    control.snap = True
    np.testing.assert_allclose(drag(control, (0.5, 0.8), end, CTRL).changes["open"].keys()[1], end, atol=1e-6)


def test_the_phone_boundary_is_a_magnet_while_snapping():
    control = controller(open=HAT)
    control.boundary = 0.437
    assert drag(control, (0.5, 0.8), (0.432, 0.8), CTRL).changes["open"].keys()[1][0] == 0.437


def test_alt_is_ten_times_finer_and_ignores_the_grid():
    control = controller(open=HAT)
    control.snap = True
    edit = drag(control, (0.5, 0.8), (0.6, 0.8), ALT)
    assert edit.changes["open"].t[1] == pytest.approx(0.51)


def test_pressing_alt_in_the_middle_of_a_drag_makes_no_jump():
    control = controller(open=HAT)
    x, y = px(0.5, 0.8)
    control.press(x, y)
    control.move(x + 80, y)
    before = control.curves["open"].t[1]
    control.move(x + 80, y, ALT)
    assert control.curves["open"].t[1] == pytest.approx(before)
    control.move(x + 160, y, ALT)
    assert control.release(x + 160, y).changes["open"].t[1] == pytest.approx(0.61)


def test_cancel_leaves_the_very_objects_from_before():
    control = controller(open=HAT, FV=RAMP)
    x, y = px(0.5, 0.8)
    control.press(x, y)
    control.move(x + 30, y + 40)
    assert control.curves["open"] is not HAT
    assert control.cancel()
    assert control.curves["open"] is HAT
    assert control.curves["FV"] is RAMP
    assert control.release(x + 30, y + 40) is None


def test_a_pose_locked_in_the_middle_of_a_drag_stays_as_it_was():
    control = controller(open=HAT, FV=RAMP)
    control.select({("open", 1), ("FV", 2)})
    x, y = px(0.5, 0.8)
    control.press(x, y)
    control.move(x + 40, y)
    control.set_locked({"open"})
    assert list(control.release(x + 40, y).changes) == ["FV"]
    assert control.curves["open"] is HAT
    assert control.selection == {("FV", 2)}


def test_a_pose_locked_in_the_middle_of_a_click_is_not_selected():
    control = controller(open=HAT)
    control.press(*px(0.5, 0.8))
    control.set_locked({"open"})
    control.release(*px(0.5, 0.8))
    assert not control.selection


def test_there_and_back_is_no_edit_and_leaves_the_very_object():
    control = controller(open=HAT)
    x, y = px(0.5, 0.8)
    control.press(x, y)
    for dx in (10, 50, -70, 3, 0):
        control.move(x + dx, y + dx)
    assert control.release(x, y) is None
    assert control.curves["open"] is HAT


def test_curves_from_outside_wait_until_the_gesture_has_ended():
    """The drag goes on with its own copy; what came in for other poses is there afterwards."""
    control = controller(open=HAT)
    x, y = px(0.5, 0.8)
    control.press(x, y)
    control.move(x + 80, y)
    control.set_curves({"open": RAMP, "wide": RAMP})
    assert control.curves["open"].t[1] == pytest.approx(0.6)
    edit = control.release(x + 80, y)
    assert list(edit.changes) == ["open"]
    assert control.curves["open"] is edit.changes["open"]
    assert control.curves["wide"] is RAMP


def test_after_a_cancel_the_curves_that_came_in_meanwhile_are_shown():
    control = controller(open=HAT)
    x, y = px(0.5, 0.8)
    control.press(x, y)
    control.move(x + 80, y)
    control.set_curves({"open": RAMP})
    control.cancel()
    assert control.curves["open"] is RAMP


# Selecting


def test_the_active_curve_is_picked_before_a_nearer_one():
    control = controller(open=HAT, FV=Curve.of([(0, 0), (0.505, 0.8), (1, 0)]))
    control.set_active("open")
    click(control, 0.5045, 0.8)
    assert control.selection == {("open", 1)}


def test_shift_click_adds_to_the_selection_and_takes_out_again():
    control = controller(open=RAMP)
    click(control, 0.3, 0.3)
    click(control, 0.7, 0.6, SHIFT)
    assert control.selection == {("open", 1), ("open", 2)}
    click(control, 0.3, 0.3, SHIFT)
    assert control.selection == {("open", 2)}


def test_a_click_on_a_selected_key_leaves_only_that_one():
    control = controller(open=RAMP)
    control.select_all()
    click(control, 0.7, 0.6)
    assert control.selection == {("open", 2)}


def test_a_click_on_a_line_activates_its_pose_and_adds_nothing():
    control = controller(open=HAT, FV=Curve.of([(0, 0.5), (1, 0.5)]))
    assert click(control, 0.9, 0.5) is None
    assert control.active == "FV"
    assert len(control.curves["FV"]) == 2


def test_the_marquee_selects_and_shift_adds_and_ctrl_takes_away():
    control = controller(open=RAMP)
    drag(control, (0.2, 0.1), (0.8, 0.7))
    assert control.selection == {("open", 1), ("open", 2)}
    drag(control, (0.05, 0.0), (0.2, 0.25), SHIFT)
    assert control.selection == {("open", 0), ("open", 1), ("open", 2)}
    drag(control, (0.6, 0.4), (0.8, 0.7), CTRL)
    assert control.selection == {("open", 0), ("open", 1)}
    assert control.band is None


def test_cancelling_a_marquee_brings_the_selection_back():
    control = controller(open=RAMP)
    control.select({("open", 3)})
    control.press(*px(0.2, 0.1))
    control.move(*px(0.8, 0.7))
    control.cancel()
    assert control.selection == {("open", 3)}


def test_select_all_takes_the_active_curve_then_every_one_that_may_be_edited():
    control = controller(open=HAT, FV=RAMP, wide=HAT)
    control.set_locked({"wide"})
    control.select_all()
    assert {pose for pose, _ in control.selection} == {"open"}
    control.select_all()
    assert {pose for pose, _ in control.selection} == {"open", "FV"}


def test_select_next_goes_round_the_keys_of_the_active_curve():
    control = controller(open=HAT)
    seen = []
    for step in (1, 1, 1, 1, -1, -1):
        control.select_next(step)
        seen += [index for _, index in control.selection]
    assert seen == [0, 1, 2, 0, 2, 1]


def test_locked_poses_refuse_and_hidden_ones_are_not_there():
    control = controller(open=HAT)
    control.set_locked({"open"})
    assert drag(control, (0.5, 0.8), (0.6, 0.5)) is None
    assert control.refusal == (Refusal.LOCKED, "open")
    control.set_locked(())
    control.set_visible({"FV"})
    assert control.key_at(*px(0.5, 0.8)) is None
    assert control.add_at(0.2, 0.2) is None
    assert control.refusal == (Refusal.HIDDEN, "open")
    assert control.curves["open"] is HAT


def test_locking_or_hiding_takes_keys_out_of_the_selection():
    control = controller(open=HAT, FV=RAMP)
    control.select({("open", 1), ("FV", 1)})
    control.set_locked({"open"})
    assert control.selection == {("FV", 1)}
    control.set_visible({"open"})
    assert not control.selection


def test_the_selection_goes_when_a_curve_comes_back_with_another_number_of_keys():
    control = controller(open=HAT, FV=RAMP)
    control.select({("open", 1), ("FV", 1)})
    control.set_curves({"open": RAMP, "FV": Curve(RAMP.t, RAMP.v[::-1])})
    assert control.selection == {("FV", 1)}


# Adding, deleting, nudging


def test_ctrl_click_adds_a_key_where_it_falls_and_selects_it():
    control = controller(open=HAT)
    edit = click(control, 0.25, 0.7, CTRL)
    assert edit.label == ADD
    assert edit.changes["open"].keys() == [(0, 0), (0.25, 0.7), (0.5, 0.8), (1, 0)]
    assert control.selection == {("open", 1)}


def test_a_pose_without_a_curve_gets_one_that_rises_from_0_and_falls_to_0():
    control = controller()
    edit = control.add(*px(0.3, 0.6))
    assert edit.changes["open"].keys() == [(0, 0), (0.3, 0.6), (1, 0)]


@pytest.mark.parametrize(("t", "keys"), [(0.005, [(0, 0.6), (1, 0)]), (0.995, [(0, 0), (1, 0.6)])])
def test_a_first_key_at_an_end_is_the_end_key(t, keys):
    assert controller().add(*px(t, 0.6)).changes["open"].keys() == keys


def test_adding_away_from_the_curve_or_on_a_key_is_refused():
    control = controller(open=HAT)
    assert control.add(*px(0.5, 0.1)) is None
    assert control.refusal == (Refusal.OFF_CURVE, "open")
    assert control.add_at(0.5, 0.1) is None
    assert control.refusal == (Refusal.KEY_THERE, "open")


def test_deleting_the_last_key_removes_the_curve():
    control = controller(open=HAT, FV=RAMP)
    control.select({("open", 0), ("open", 1), ("open", 2), ("FV", 1)})
    edit = control.delete()
    assert edit.label == DELETE
    assert edit.changes["open"] is None
    assert len(edit.changes["FV"]) == 3
    assert "open" not in control.curves
    assert not control.selection


def test_a_nudge_goes_as_far_as_there_is_room_and_then_says_so():
    control = controller(open=HAT)
    control.select({("open", 1)})
    edit = control.nudge(0.01, 0.5)
    assert edit.label == NUDGE
    assert edit.changes["open"].keys()[1] == (0.51, 1.0)
    assert control.nudge(0, 0.1) is None
    assert control.refusal == (Refusal.NO_ROOM, "open")


def test_nothing_else_happens_while_a_gesture_runs():
    control = controller(open=HAT)
    x, y = px(0.5, 0.8)
    control.press(x, y)
    control.move(x + 20, y)
    assert control.delete() is None
    assert control.nudge(0.1, 0) is None
    assert control.add_at(0.2, 0.2) is None
    assert control.release(x + 20, y).label == MOVE


# Laws


@st.composite
def curves(draw):
    """Any curve, down to keys nearer than MIN_GAP as a file may bring them."""
    ticks = draw(st.lists(st.integers(0, 4000), min_size=1, max_size=8, unique=True))
    values = draw(st.lists(st.integers(0, 10000), min_size=len(ticks), max_size=len(ticks)))
    return Curve(np.sort(ticks) / 4000, np.array(values) / 10000)


points = st.tuples(st.floats(-50, 950), st.floats(-50, 550))
held = st.builds(Modifiers, st.booleans(), st.booleans(), st.booleans())
actions = st.one_of(
    st.tuples(st.just("press"), points, held),
    st.tuples(st.just("grab"), st.integers(0, 20), held),
    st.tuples(st.just("move"), points, held),
    st.tuples(st.just("release"), points),
    st.tuples(st.just("cancel")),
    st.tuples(st.just("add"), points, st.booleans()),
    st.tuples(st.just("delete")),
    st.tuples(st.just("nudge"), st.floats(-0.5, 0.5), st.floats(-0.5, 0.5)),
    st.tuples(st.just("all")),
    st.tuples(st.just("take"), points),
    st.tuples(st.just("scale"), st.none() | points),
    st.tuples(st.just("handle"), st.integers(0, 7), held),
    st.tuples(st.just("axis"), st.sampled_from("tv")),
    st.tuples(st.just("reverse")),
    st.tuples(
        st.just("type"), st.sampled_from("tv"), st.sampled_from(("*0.5", "/3", "+0.3", "-0.2", "=0.4", "9", "?"))
    ),
    st.tuples(st.just("paste"), curves(), st.booleans(), st.booleans()),
    st.tuples(st.just("swap"), curves()),
    st.tuples(st.just("slide"), curves(), st.floats(0, 1)),
    st.tuples(st.just("lock"), st.sampled_from(POSES)),
    st.tuples(st.just("hide"), st.sampled_from(POSES)),
    st.tuples(st.just("outside"), curves()),
)


def press_handle(control: CurveController, number: int, keys_held: Modifiers):
    box = control.box()
    if box is not None:
        places = list(box.handles(control.view).values())
        control.press(*places[number % len(places)], keys_held)


def take(control: CurveController, at: tuple[float, float]):
    control.begin_move(*at)


def scale(control: CurveController, at: tuple[float, float] | None):
    control.begin_scale(at)


def slide(control: CurveController, curve: Curve, share: float):
    if control.begin_blend({"open": curve}):
        control.blend(share)


#: Actions that need no pointer: what they call, and what of it is an edit.
KEYED = {
    "take": take,
    "scale": scale,
    "handle": press_handle,
    "axis": lambda control, axis: control.keep_axis(axis),
    "reverse": lambda control: control.reverse(),
    "type": lambda control, axis, text: control.type_value(axis, text),
    "paste": lambda control, curve, whole, backwards: control.paste(
        Copied({"x": curve}, frozenset({"x"} if whole else ())), backwards=backwards
    ),
    "swap": lambda control, curve: control.swap({"open": curve}),
    "slide": slide,
}


def perform(control: CurveController, action):
    name, *rest = action
    if name == "press":
        control.press(*rest[0], rest[1])
    elif name == "grab":
        keys = [key for pose in control.drawn() for key in control.keys_px(pose)]
        if keys:
            control.press(*keys[rest[0] % len(keys)], rest[1])
    elif name == "move":
        control.move(*rest[0], rest[1])
    elif name == "release":
        return control.release(*rest[0])
    elif name == "cancel":
        control.cancel()
    elif name == "add":
        return control.add(*rest[0], anywhere=rest[1])
    elif name == "delete":
        return control.delete()
    elif name == "nudge":
        return control.nudge(*rest)
    elif name == "all":
        control.select_all()
    elif name in KEYED:
        return KEYED[name](control, *rest)
    elif name == "lock":
        control.set_locked(control.locked ^ {rest[0]})
    elif name == "hide":
        control.set_visible(control.visible ^ {rest[0]})
    else:
        control.set_curves({**control.curves, "wide": rest[0]})
    return None


@given(curves(), curves(), st.lists(actions, max_size=40))
@settings(max_examples=300, deadline=None)
def test_whatever_the_hand_does_keys_stay_in_order_and_in_range(first, second, script):
    """Curve itself refuses disorder with ValueError, so an exception is a failure too; one edit names real changes."""
    control = controller(open=first, FV=second)
    control.boundary = 0.437
    for action in script:
        before = dict(control.curves)
        edit = perform(control, action)
        for curve in control.curves.values():
            assert (np.diff(curve.t) > 0).all()
            assert ((curve.t >= 0) & (curve.t <= 1) & (curve.v >= 0) & (curve.v <= 1)).all()
        if not control.busy:
            assert all(index < len(control.curves[pose]) for pose, index in control.selection)
            assert not {pose for pose, _ in control.selection} & (control.locked | (set(POSES) - control.visible))
        if edit is not None:
            assert edit.changes
            for pose, curve in edit.changes.items():
                assert control.curves.get(pose) is curve
                assert edit.label in {MOVE, SCALE, BLEND} or curve is None or not curve.same_as(before.get(pose))


@given(curves(), st.data(), st.floats(-400, 400), st.floats(-400, 400))
@settings(max_examples=100, deadline=None)
def test_the_clamp_never_makes_a_gap_smaller_than_it_must(curve, data, dx, dy):
    chosen = data.draw(st.sets(st.integers(0, len(curve) - 1), min_size=1))
    dt_lo, dt_hi, dv_lo, dv_hi = feasible({"open": curve}, {"open": sorted(chosen)})
    assert dt_lo <= 0 <= dt_hi
    assert dv_lo <= 0 <= dv_hi
    moved = shifted(curve, sorted(chosen), min(max(dx / 800, dt_lo), dt_hi), min(max(dy / 400, dv_lo), dv_hi))
    least = np.minimum(np.diff(curve.t), MIN_GAP)
    assert (np.diff(moved.t) >= least - 1.1e-6).all()
    stays = [i for i in range(len(curve)) if i not in chosen]
    assert moved.t[stays].tolist() == curve.t[stays].tolist()
    assert moved.v[stays].tolist() == curve.v[stays].tolist()


@given(curves(), st.data(), st.floats(0, 5), st.floats(0, 5), st.tuples(st.floats(0, 1), st.floats(0, 1)))
@settings(max_examples=100, deadline=None)
def test_scaling_never_makes_a_gap_smaller_than_it_must_nor_changes_the_order(curve, data, in_t, in_v, pivot):
    chosen = data.draw(st.sets(st.integers(0, len(curve) - 1), min_size=1).map(sorted))
    t_lo, t_hi, v_lo, v_hi = feasible_scale({"open": curve}, {"open": chosen}, pivot)
    assert 0 <= t_lo <= 1 <= t_hi
    assert 0 <= v_lo <= 1 <= v_hi
    new = stretched({"open": curve}, {"open": chosen}, pivot, (in_t, in_v)).get("open", curve)
    least = np.minimum(np.diff(curve.t), MIN_GAP)
    assert (np.diff(new.t) >= least - 1.1e-6).all()
    stays = [i for i in range(len(curve)) if i not in chosen]
    assert new.t[stays].tolist() == curve.t[stays].tolist()
    assert new.v[stays].tolist() == curve.v[stays].tolist()


@given(curves())
def test_reversing_a_curve_twice_gives_it_back(curve):
    everything = {"open": list(range(len(curve)))}
    once = reversed_keys({"open": curve}, everything)["open"][0]
    twice = reversed_keys({"open": once}, everything)["open"][0]
    np.testing.assert_allclose(twice.t, curve.t, atol=1e-6)
    np.testing.assert_allclose(twice.v, curve.v, atol=1e-6)
    np.testing.assert_allclose(once.at(0.3), curve.at(0.7), atol=1e-2)


@given(curves(), curves(), st.floats(0, 1))
def test_a_blend_lies_between_its_ends(one, other, share):
    at = np.linspace(0, 1, 41)
    low, high = min(one.v.min(), other.v.min()), max(one.v.max(), other.v.max())
    between = blended(one, other, share).at(at)
    assert (between >= low - 1e-6).all()
    assert (between <= high + 1e-6).all()


@given(curves(), st.data(), st.lists(points, max_size=6), held)
@settings(max_examples=60, deadline=None)
def test_cancel_undoes_any_drag_to_the_same_object(curve, data, way, keys_held):
    control = controller(open=curve)
    index = data.draw(st.integers(0, len(curve) - 1))
    control.press(*control.keys_px("open")[index], keys_held)
    for x, y in way:
        control.move(x, y, keys_held)
    control.cancel()
    assert control.curves == {"open": curve}


def test_distance_to_a_line_is_that_to_its_nearest_segment():
    line = np.array([(0.0, 0.0), (10.0, 0.0), (10.0, 10.0)])
    assert distance_to_line(line, 5, 3) == pytest.approx(3)
    assert distance_to_line(line, 13, 14) == pytest.approx(5)
    assert distance_to_line(line[:1], 3, 4) == pytest.approx(5)
    assert distance_to_line(line[:0], 3, 4) == np.inf
