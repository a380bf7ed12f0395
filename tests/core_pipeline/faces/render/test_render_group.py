"""Several faces in one picture, and the looks they are seen in."""

import numpy as np
import pytest

from core_pipeline.faces.looks import BACKGROUNDS, LIGHTS, Background, Look
from core_pipeline.faces.render import passes
from core_pipeline.faces.render.renderer import FaceRenderer, Figure, Renderer
from core_pipeline.faces.view import View
from tests.helpers.ball import ball

BALL, BLUE = ball(), ball(12, colour=(0.0, 0.0, 0.9, 0.0))
VIEW = View.of(BALL.camera)
REST, TALL = np.zeros(2, np.float32), np.array([1, 0], np.float32)
BLACK = Look(Background((0, 0, 0), (0, 0, 0), 0))


@pytest.fixture
def renderer():
    renderer = Renderer()
    yield renderer
    renderer.close()


def draw(renderer, *figures, size=(192, 96), full_quality=False, look=BLACK):
    return renderer.draw(figures, size, full_quality, look)[..., :3].astype(int)


def covered(pixels):
    return pixels.max(axis=2) > 8


@pytest.mark.parametrize("full_quality", [False, True])
def test_each_face_is_drawn_in_its_half_as_if_it_were_alone(renderer, full_quality):
    both = draw(renderer, Figure(BALL, TALL, VIEW), Figure(BLUE, REST, VIEW), full_quality=full_quality)
    for half, (face, amounts) in zip((both[:, :96], both[:, 96:]), ((BALL, TALL), (BLUE, REST)), strict=True):
        alone = FaceRenderer(face)
        picture = alone.frame(amounts, VIEW, (96, 96), full_quality, BLACK)[..., :3].astype(int)
        alone.close()
        np.testing.assert_allclose(half, picture, atol=2)


def test_the_same_face_may_stand_twice_and_show_two_things(renderer):
    both = covered(draw(renderer, Figure(BALL, REST, VIEW), Figure(BALL, TALL, VIEW)))
    assert both[:, 96:].any(axis=1).sum() > 1.15 * both[:, :96].any(axis=1).sum()


def test_a_face_that_comes_near_stays_in_its_own_place(renderer):
    near = VIEW.zoomed(12)
    both = covered(draw(renderer, Figure(BALL, REST, near), Figure(BLUE, REST, View(target=(99.0, 0.0, 0.0)))))
    assert both[:, :96].mean() > 0.9
    assert not both[:, 96:].any()


def test_faces_come_and_go(renderer):
    figures = [Figure(face, REST, VIEW) for face in (BALL, BLUE, ball(8))]
    first = draw(renderer, figures[0])
    for some in (figures, figures[1:], figures[:2], []):
        picture = draw(renderer, *some)
        assert covered(picture).any() == bool(some)
    np.testing.assert_array_equal(draw(renderer, figures[0]), first)


def test_what_a_figure_shows_does_not_change_after_it_was_made():
    amounts = REST.copy()
    figure = Figure(BALL, amounts, VIEW)
    amounts[:] = 1
    assert not figure.amounts.any()


@pytest.mark.parametrize(("light", "across"), [("left", -1), ("right", 1), ("top", 0)])
def test_the_key_light_comes_from_where_it_is_said_to_come_from(renderer, light, across):
    background = Background((0, 0, 0), (0, 0, 0), 0, rim=(0, 0, 0))
    picture = draw(renderer, Figure(BALL, REST, VIEW), size=(96, 96), look=Look(background, LIGHTS[light])).sum(axis=2)
    left, right, top, bottom = (part.sum() for part in (picture[:, :48], picture[:, 48:], picture[:48], picture[48:]))
    assert top > 1.15 * bottom
    assert np.sign(round((right - left) / (right + left), 2)) == across


@pytest.mark.parametrize("name", BACKGROUNDS)
def test_each_background_is_seen_behind_the_face_and_lights_it(renderer, name):
    picture = draw(renderer, Figure(BALL, REST, VIEW), size=(96, 96), look=Look(BACKGROUNDS[name]))
    top = np.array(BACKGROUNDS[name].top[::-1]) * 255
    corners = picture[[0, 0], [0, -1]]
    assert np.abs(corners - top).max(axis=1).min() < 40
    assert picture[40, 40].max() > 60, "the face is to be seen in any of them"


def test_a_colour_for_keying_is_the_same_in_every_pixel(renderer):
    picture = draw(renderer, Figure(BALL, REST, VIEW), size=(96, 96), look=Look(BACKGROUNDS["green"]))
    face = covered(draw(renderer, Figure(BALL, REST, VIEW), size=(96, 96)))
    assert len(np.unique(picture[~face], axis=0)) == 1
    blue, green, red = picture[0, 0]
    assert green > 150 > blue > red


def test_a_checkered_ground_has_two_colours_in_squares(renderer):
    picture = draw(renderer, size=(96, 96), look=Look(BACKGROUNDS["checker"]))
    assert len(np.unique(picture.reshape(-1, 3), axis=0)) == 2
    side = round(96 * BACKGROUNDS["checker"].checker)
    np.testing.assert_array_equal(picture[:-side, :-side], picture[side:, side:])
    assert (picture[:, :-side] != picture[:, side:]).any(axis=2).all()


@pytest.mark.parametrize("full_quality", [False, True])
@pytest.mark.parametrize("background", ["studio", "checker"])
def test_a_picture_drawn_in_bands_is_the_same_as_in_one_go(renderer, monkeypatch, full_quality, background):
    figures = [Figure(BALL, TALL, VIEW.zoomed(2)), Figure(BLUE, REST, VIEW)]
    look, size = Look(BACKGROUNDS[background]), (130, 901)
    whole = renderer.draw(figures, size, full_quality, look).copy()
    monkeypatch.setattr(passes, "_MOST_SAMPLES", 130 * 300 * (4 if full_quality else 1))
    for _ in range(2):
        off = np.abs(renderer.draw(figures, size, full_quality, look).astype(int) - whole).max(axis=2)
        assert off.max() <= 1
