"""Actors side by side: whose weights each shows, from where each is seen, and that they do not live as one."""

from dataclasses import replace

import numpy as np
import pytest

from app.preview.cast import Actor, Cast
from core_pipeline.faces import idle
from core_pipeline.faces.looks import ANGLES
from tests.helpers.ball import ball

POSES = ("tall", "wide")


def cast_of(*faces):
    cast = Cast()
    cast.set_actors([Actor(face) for face in faces])
    return cast


def test_each_actor_shows_its_own_weights_in_its_own_poses():
    renamed = replace(ball(8), pose_map={"up": {"tall": 0.5}})
    cast = cast_of(ball(), renamed)
    one, other = cast.figures([(POSES, np.array([0.25, 1.0])), (("up",), np.array([1.0]))], None, talks=True)
    np.testing.assert_allclose(one.amounts, (0.25, 1.0))
    np.testing.assert_allclose(other.amounts, (0.5, 0.0))


def test_another_set_of_as_many_poses_is_not_mistaken_for_the_first():
    cast = cast_of(ball())
    for poses, shown in ((POSES, (1, 0)), (POSES[::-1], (0, 1))):
        (figure,) = cast.figures([(poses, np.array([1.0, 0.0]))], None, talks=False)
        np.testing.assert_array_equal(figure.amounts, shown)


def test_poses_made_anew_keep_mesh_and_view():
    face = ball()
    cast = cast_of(face, ball(8))
    cast.orbit(40, 10)
    views = cast.views
    taught = replace(face, pose_map={"tall": {"wide": 1.0}})
    cast.set_actors([Actor(taught), cast.actors[1]])
    assert cast.views == views
    figure, _ = cast.figures([(POSES, np.array([1.0, 0.0]))] * 2, None, talks=False)
    assert figure.face is face, "the renderer has this mesh already"
    np.testing.assert_array_equal(figure.amounts, (0, 1))


def test_one_face_with_two_sources_shares_a_mesh():
    face = ball()
    cast = cast_of(face, replace(face, pose_map={}))
    one, other = cast.figures([(POSES, np.array([1.0, 0.0])), (POSES, np.array([0.0, 1.0]))], None, talks=False)
    assert one.face is other.face
    assert not np.array_equal(one.amounts, other.amounts)


def test_a_face_that_stands_there_twice_is_seen_in_two_ways_whatever_else_changes():
    face = ball()
    cast = cast_of(face, face)
    cast.cut_away(1, True)
    cast.set_actors([*cast.actors, Actor(ball(8))])
    assert [view.cutaway for view in cast.views] == [False, True, False]
    cast.set_actors([Actor(face), Actor(ball(8)), Actor(face)])
    assert [view.cutaway for view in cast.views] == [False, False, True]


def test_cameras_turn_together_and_a_newcomer_joins_them():
    cast = cast_of(ball())
    cast.orbit(50, -20)
    cast.zoom(2)
    cast.set_actors([*cast.actors, Actor(ball(8))])
    one, other = cast.views
    assert (one.yaw, one.pitch) == (other.yaw, other.pitch)
    assert one.distance / one.home.distance == pytest.approx(other.distance / other.home.distance)
    cast.turn(30)
    assert cast.views[0].yaw == pytest.approx(cast.views[1].yaw)
    cast.set_angle(ANGLES["profile"])
    assert [view.yaw for view in cast.views] == [90, 90]


def test_one_head_is_cut_open_alone():
    cast = cast_of(ball(), ball(8))
    cast.cut_away(1, on=True)
    assert [view.cutaway for view in cast.views] == [False, True]
    cast.set_angle(ANGLES["front"])
    assert [view.cutaway for view in cast.views] == [False, True]
    cast.cut_away(1, on=False)
    assert [view.yaw for view in cast.views] == [0, 0]


def test_more_than_three_are_refused():
    with pytest.raises(ValueError, match="3 at most"):
        cast_of(*[ball(4)] * 4)


def test_faces_do_not_blink_as_one_and_the_next_blink_is_the_first_of_any():
    eyes = replace(ball(), shapes=("blink", "browUp"))
    cast = cast_of(eyes, replace(ball(8), shapes=("blink", "browUp")), replace(ball(6), shapes=("blink", "browUp")))
    times = np.arange(0, 60, 0.02)
    still = [(("nothing",), np.zeros(1))] * 3
    shut = np.array([[f.amounts[0] > 0.5 for f in cast.figures(still, t, talks=False)] for t in times])
    assert (shut.sum(axis=0) > 20).all(), "each of them blinks"
    assert shut.sum(axis=1).max() <= 2
    assert (shut.sum(axis=1) > 1).mean() < 0.02
    now = 5.0
    wait = cast.next_life(now, step=0.033)
    before, after = now + wait - 0.01, now + wait + idle.FALL
    assert not any(f.amounts[0] for f in cast.figures(still, before, talks=False))
    assert any(f.amounts[0] for f in cast.figures(still, after, talks=False))


def test_without_life_nothing_moves():
    eyes = replace(ball(), shapes=("blink", "browUp"))
    cast = cast_of(eyes)
    assert not cast.figures([(("nothing",), np.zeros(1))], None, talks=True)[0].amounts.any()
