"""What is drawn once only: bodies that have no inside to show, seen from the front."""

from dataclasses import replace

import numpy as np
import pytest

from app import resources
from core_pipeline.faces import face_folder
from core_pipeline.faces.render.inner_sides import InnerSides
from core_pipeline.faces.render.renderer import FaceRenderer
from core_pipeline.faces.view import View
from tests.helpers.ball import ball

BALL = ball()


def test_a_closed_ball_shows_no_inner_side():
    assert not InnerSides(BALL).may_show.any()


@pytest.mark.parametrize(
    "open_ball",
    [
        replace(BALL, triangles=BALL.triangles[:-100]),
        replace(BALL, triangles=BALL.triangles[:, ::-1].copy()),
        replace(BALL, deltas=BALL.deltas + np.float32(0.1) * (np.arange(len(BALL.positions)) == 49)[:, None]),
    ],
    ids=["with a hole", "inside out", "a crack in one pose"],
)
def test_another_ball_may(open_ball):
    assert InnerSides(open_ball).may_show.all()


def test_one_body_of_two():
    both = replace(
        BALL,
        positions=np.concatenate([BALL.positions, BALL.positions + 3]),
        triangles=np.concatenate([BALL.triangles[:-100], BALL.triangles + len(BALL.positions)]),
        deltas=np.concatenate([BALL.deltas, BALL.deltas], axis=1),
    )
    may_show = InnerSides(both).may_show
    assert may_show[: len(BALL.triangles) - 100].all()
    assert not may_show[len(BALL.triangles) - 100 :].any()


def test_a_part_that_its_maker_calls_closed():
    parts = {"cap": (0, 300), "rest": (300, len(BALL.triangles) - 400)}
    face = replace(BALL, triangles=BALL.triangles[:-100], parts=parts, closed=frozenset({"cap"}))
    may_show = InnerSides(face).may_show
    assert not may_show[:300].any()
    assert may_show[300:].all()
    with pytest.raises(ValueError, match="no parts of this face: \\['hat'\\]"):
        replace(face, closed=frozenset({"hat"}))


@pytest.mark.parametrize(("yaw", "distance", "hidden"), [(0, 6, True), (50, 6, True), (180, 6, False), (0, 0.3, False)])
def test_only_from_the_front_and_from_outside(yaw, distance, hidden):
    assert InnerSides(BALL).hidden_from(View(yaw=yaw, distance=distance).matrix()) == hidden


@pytest.mark.parametrize("name", ["toon", "crab", "ada", "woman", "man"])
def test_what_is_left_out_of_our_faces_cannot_be_seen(name, monkeypatch):
    face = face_folder.load(resources.face_folder(name))
    amounts = np.zeros(len(face.shapes))
    amounts[face.shapes.index("open") if "open" in face.shapes else 0] = 0.8
    views = [replace(View.on(face), yaw=yaw, pitch=pitch) for yaw, pitch in ((0, 0), (55, -20), (-30, 40))]
    renderer = FaceRenderer(face)
    once = [renderer.frame(amounts, view, (200, 200), False).astype(int) for view in views]
    monkeypatch.setattr(InnerSides, "hidden_from", lambda self, from_mesh: False)  # all inner sides are drawn
    twice = [renderer.frame(amounts, view, (200, 200), False).astype(int) for view in views]
    renderer.close()
    for one, other in zip(once, twice, strict=True):
        assert np.count_nonzero(np.abs(one - other).max(axis=2) > 30) <= 12  # single pixels along outlines
