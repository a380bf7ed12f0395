"""The time axis: what is seen, and where."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from widgets.overlay.time_axis import CLOSEST, TimeAxis, clock

seconds = st.floats(-100, 1000)
spans = st.floats(1e-3, 2000)


def axis_of(start, span):
    return TimeAxis().with_pixels(90, 1590).with_content(start, start + span)


axes = st.builds(axis_of, seconds, spans)
moves = st.lists(
    st.one_of(
        st.tuples(st.just("zoomed"), st.floats(0.05, 20), st.floats(0, 1)),
        st.tuples(st.just("panned"), st.floats(-3000, 3000), st.floats(0, 1)),
    ),
    max_size=12,
)


def moved(axis, steps):
    for kind, amount, where in steps:
        if kind == "zoomed":
            axis = axis.zoomed(amount, axis.left + where * axis.span)
        else:
            axis = axis.panned(amount)
    return axis


@given(axes, moves)
def test_nothing_outside_the_utterance_is_ever_seen(axis, steps):
    axis = moved(axis, steps)
    assert axis.start <= axis.left < axis.right <= axis.end
    assert axis.span >= min(CLOSEST, axis.end - axis.start) * (1 - 1e-6)


@given(axes, moves, st.floats(0, 1))
def test_a_pixel_and_its_time_lead_to_each_other(axis, steps, where):
    axis = moved(axis, steps)
    px = axis.x0 + where * (axis.x1 - axis.x0)
    assert axis.px(axis.time(px)) == pytest.approx(px, abs=1e-3)


@given(axes, moves)
def test_fitting_shows_everything_and_is_recognised(axis, steps):
    assert moved(axis, steps).fitted().is_fitted
    assert moved(axis, steps).zoomed(1e-9, axis.left).is_fitted


def test_zooming_keeps_the_time_under_the_mouse_where_it_is():
    axis = axis_of(0, 10)
    near = axis.zoomed(4, 3.0)
    assert near.span == pytest.approx(2.5)
    assert near.px(3.0) == pytest.approx(axis.px(3.0))


def test_panning_moves_the_content_with_the_mouse():
    axis = axis_of(0, 10).zoomed(4, 5.0)
    assert axis.panned(100).px(5.0) == pytest.approx(axis.px(5.0) + 100)


def test_times_outside_are_held_at_the_ends():
    axis = axis_of(2, 3)
    assert (axis.time(-500), axis.time(99999)) == (2, 5)


def test_px_takes_arrays():
    axis = axis_of(0, 10)
    assert np.allclose(axis.px(np.array([0.0, 10.0])), [90, 1590])


def test_another_utterance_is_fitted_if_the_old_one_was():
    axis = axis_of(0, 10)
    assert axis.with_content(0, 4).is_fitted
    near = axis.zoomed(5, 9.0)
    assert near.with_content(0, 12).left == near.left
    assert near.with_content(0, 3).is_fitted is False
    assert near.with_content(0, 3).right == 3


def test_content_without_duration_has_an_axis():
    axis = TimeAxis().with_content(0, 0)
    assert axis.span > 0


def test_revealing_moves_only_when_it_must():
    axis = axis_of(0, 10).at(4, 2)
    assert axis.revealing(4.5, 5) is axis
    assert axis.revealing(6.5, 6.7).sees(6.7)
    assert axis.revealing(1, 1.2).sees(1)
    assert axis.revealing(6, 9).sees(6)


def test_following_turns_the_page_near_the_right_edge_and_not_before():
    axis = axis_of(0, 10).at(2, 2)
    assert axis.following(3.5) is axis
    turned = axis.following(3.9)
    assert turned.left == pytest.approx(3.74)
    assert axis.following(0.5).sees(0.5)
    last = axis_of(0, 10).at(8, 2)
    assert last.following(9.9) is last
    assert axis_of(0, 10).following(9.9).is_fitted


@given(axes, moves)
def test_labels_keep_their_distance(axis, steps):
    axis = moved(axis, steps)
    step = axis.step(64)
    ticks = axis.ticks(step)
    assert step * axis.scale >= 64 * (1 - 1e-6)
    assert np.diff(ticks) == pytest.approx(step)
    assert all(axis.left - 1e-5 * step <= t <= axis.right + 1e-5 * step for t in ticks)
    assert len(ticks) <= (axis.x1 - axis.x0) / 60 + 1


@pytest.mark.parametrize(
    ("t", "step", "text"),
    [
        (0.25, 0.05, "0.25"),
        (3.42, 0.1, "3.4"),
        (12, 1, "12"),
        (65, 5, "1:05"),
        (65.5, 0.5, "1:05.5"),
        (62.084, 0.01, "1:02.08"),
        (-75, 1, "-1:15"),
        (119.999, 0.1, "2:00.0"),
    ],
)
def test_times_as_written(t, step, text):
    assert clock(t, step) == text
