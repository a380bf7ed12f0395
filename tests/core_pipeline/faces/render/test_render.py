"""Pixels: the right way round, the same every time, from any thread; or one sentence why not."""

import os
import subprocess
import sys
import threading
from dataclasses import replace

import numpy as np
import pytest

from core_pipeline.errors import UserError
from core_pipeline.faces.face import Camera
from core_pipeline.faces.looks import Background, Look
from core_pipeline.faces.render.context import process_context
from core_pipeline.faces.render.renderer import FaceRenderer
from core_pipeline.faces.view import View
from tests.helpers.ball import ball

BALL = ball()
VIEW = View.of(BALL.camera)
REST = np.zeros(2, np.float32)
SIZE = (96, 96)
BLACK = Look(Background((0, 0, 0), (0, 0, 0), 0))


@pytest.fixture
def renderer():
    renderer = FaceRenderer(BALL)
    yield renderer
    renderer.close()


def covered(pixels):
    """(h, w) bool: where the face is, on a black background."""
    return pixels[..., :3].max(axis=2) > 8


def draw(renderer, amounts=REST, view=VIEW, size=SIZE, full_quality=False):
    return renderer.frame(amounts, view, size, full_quality, BLACK).copy()


@pytest.mark.parametrize("full_quality", [False, True])
def test_a_ball_is_a_disc_in_the_middle(renderer, full_quality):
    pixels = draw(renderer, full_quality=full_quality)
    assert pixels.shape == (96, 96, 4)
    assert pixels.dtype == np.uint8
    rows, columns = np.nonzero(covered(pixels))
    assert rows.mean() == pytest.approx(47.5, abs=0.5)
    assert columns.mean() == pytest.approx(47.5, abs=0.5)
    # Seen from 6 away a unit ball covers a circle of asin(1/6), in a picture of ±12 degrees.
    radius = 48 * np.tan(np.arcsin(1 / 6)) / np.tan(np.radians(12))
    assert len(rows) == pytest.approx(np.pi * radius**2, rel=0.03)


def test_the_first_row_is_the_top_and_the_first_column_the_left(renderer):
    above = VIEW.panned(0, -8, SIZE)
    rows, _ = np.nonzero(covered(draw(renderer, view=above)))
    assert rows.mean() == pytest.approx(39.5, abs=0.7)
    _, columns = np.nonzero(covered(draw(renderer, view=VIEW.panned(-8, 0, SIZE))))
    assert columns.mean() == pytest.approx(39.5, abs=0.7)


def test_bytes_are_blue_green_red_opaque():
    renderer = FaceRenderer(ball(colour=(0.9, 0.3, 0.05, 0.0)))
    blue, green, red, alpha = draw(renderer)[48, 48].astype(int)
    renderer.close()
    assert red > green > blue
    assert alpha == 255


def test_the_light_comes_from_the_upper_left(renderer):
    pixels = draw(renderer).astype(int).sum(axis=2)
    assert pixels[30, 30] > pixels[48, 48] > pixels[66, 66]


def test_the_other_side_of_the_surface_is_lit_too():
    """Inside out, the ball shows its far inner wall; its normals are turned to the eye."""
    renderer = FaceRenderer(BALL)
    near = View(distance=1.05, fov=20.0, home=Camera(distance=1.0))
    inside = renderer.frame(REST, View(distance=0.3, fov=20.0), SIZE, False, BLACK)
    assert covered(inside).all()
    assert covered(draw(renderer, view=near)).all()
    renderer.close()


def plates(*layers, parts=None):
    """Squares facing +z: each layer is (x, y, z of its middle, half its side, colour); shape `tall` lifts nothing."""
    corner = np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], np.float32)
    positions = np.concatenate([corner * half + (x, y, z) for x, y, z, half, _ in layers]).astype(np.float32)
    triangles = np.concatenate([np.array([(0, 1, 2), (0, 2, 3)]) + 4 * i for i in range(len(layers))])
    return replace(
        BALL,
        positions=positions,
        normals=np.tile(np.array([0, 0, 1], np.float32), (len(positions), 1)),
        triangles=triangles.astype(np.uint32),
        colours=np.repeat(np.array([layer[4] for layer in layers], np.float32), 4, axis=0),
        deltas=np.zeros((2, len(positions), 3), np.float32),
        normal_deltas=np.zeros((2, len(positions), 3), np.float32),
        parts=parts or {},
    )


GREY, RED, GREEN = (0.3, 0.3, 0.3, 0), (0.5, 0.02, 0.02, 0), (0.02, 0.5, 0.02, 0)


def drawn(face, view=VIEW):
    renderer = FaceRenderer(face)
    pixels = draw(renderer, view=view).astype(int)
    renderer.close()
    return pixels


def test_what_is_nearer_hides_what_is_farther_in_whatever_order():
    for layers in ([(0, 0, 0, 0.9, GREEN), (0, 0, 0.3, 0.3, RED)], [(0, 0, 0.3, 0.3, RED), (0, 0, 0, 0.9, GREEN)]):
        pixels = drawn(plates(*layers))
        assert pixels[48, 48, 2] > pixels[48, 48, 1]
        assert pixels[48, 75, 1] > pixels[48, 75, 2]


def test_what_is_in_the_way_of_the_key_light_casts_a_shadow_to_the_lower_right():
    wall = (0, 0, 0, 0.95, GREY)
    bare, shaded = drawn(plates(wall)), drawn(plates(wall, (-0.3, 0.4, 0.4, 0.2, GREY)))
    darker = shaded[..., 1] < bare[..., 1] - 15
    rows, columns = np.nonzero(darker)
    # 0.4 before the wall the light from (-.46, .64, .62) throws it .30 to the right and .41 down: to the middle.
    assert rows.mean() == pytest.approx(48, abs=3)
    assert columns.mean() == pytest.approx(48, abs=3)
    assert darker.sum() > 80


def test_the_light_from_behind_does_not_pass_behind_what_is_seen():
    """A wall just beyond the right edge of the ball, nearer to us, keeps the light behind it from that edge."""
    count = len(BALL.positions)
    corner = np.array([(0.93, -1, 0.6), (2, -1, 0.6), (2, 1, 0.6), (0.93, 1, 0.6)], np.float32)
    walled = replace(
        BALL,
        positions=np.concatenate([BALL.positions, corner]),
        normals=np.concatenate([BALL.normals, np.tile(np.float32([0, 0, 1]), (4, 1))]),
        triangles=np.concatenate([BALL.triangles, np.uint32([(0, 1, 2), (0, 2, 3)]) + np.uint32(count)]),
        colours=np.concatenate([BALL.colours, np.tile(np.float32(GREY), (4, 1))]),
        deltas=np.concatenate([BALL.deltas, np.zeros((2, 4, 3), np.float32)], axis=1),
        normal_deltas=np.concatenate([BALL.normal_deltas, np.zeros((2, 4, 3), np.float32)], axis=1),
    )
    free, kept = drawn(BALL), drawn(walled)
    edge = np.s_[38:50, 83:86]  # the ball ends at column 86
    assert kept[edge].sum() < 0.75 * free[edge].sum()
    np.testing.assert_array_equal(kept[30:66, 30:66], free[30:66, 30:66])


def test_in_motion_a_shadow_may_be_two_pictures_old_but_never_in_full_quality_or_another_view():
    face = plates((0, 0, 0, 0.95, GREY), (-0.3, 0.4, 0.4, 0.2, GREY))
    face.deltas[0, 4:, 0] = 9.0  # shape `tall` takes away what casts the shadow
    renderer = FaceRenderer(face)
    gone, there = np.array([1, 0], np.float32), REST

    def shaded(amounts, view=VIEW, full_quality=False):
        return draw(renderer, amounts, view, full_quality=full_quality)[48, 48, 1] < 0.8 * lit

    lit = int(draw(renderer, gone, full_quality=True)[48, 48, 1])
    assert shaded(there, full_quality=True)
    assert [shaded(gone) for _ in range(4)] == [True, True, False, False]
    assert shaded(there, full_quality=True)
    assert not shaded(gone, VIEW.turned(1))
    assert shaded(there, full_quality=True)
    assert not shaded(gone, full_quality=True)
    renderer.close()


def test_a_cut_away_hides_the_near_half_but_not_the_tongue():
    face = plates((0, 0, -0.3, 0.9, GREEN), (0, 0, 0.3, 0.3, RED), parts={"skin": (0, 2), "tongue": (2, 2)})
    for yaw, hidden, shown in ((20, slice(62, 76), slice(24, 30)), (-20, slice(20, 34), slice(66, 72))):
        whole, cut = (drawn(face, replace(VIEW, yaw=yaw, cutaway=cutaway)) for cutaway in (False, True))
        assert whole[48, hidden, 1].min() > 60
        assert cut[48, hidden, 1].max() < 8
        assert cut[48, shown, 1].min() > 60
        np.testing.assert_array_equal(cut[40:56, 44:52, 2] > 60, True)


def test_shapes_move_the_outline(renderer):
    tall = covered(draw(renderer, np.array([1, 0], np.float32)))
    wide = covered(draw(renderer, np.array([0, 1], np.float32)))
    assert tall.any(axis=1).sum() > wide.any(axis=1).sum() + 15
    assert wide.any(axis=0).sum() > tall.any(axis=0).sum() + 15


def test_full_quality_shows_the_same_face(renderer):
    fast, full = draw(renderer).astype(int), draw(renderer, full_quality=True).astype(int)
    inner = np.hypot(*(np.mgrid[:96, :96] - 47.5)) < 33
    assert np.abs(fast - full)[inner].max() <= 6


def test_only_full_quality_has_pixels_between_face_and_background():
    renderer = FaceRenderer(ball(colour=(0.02, 0.02, 0.02, 0.0)))
    white = Look(Background((1, 1, 1), (1, 1, 1), 0))
    between = []
    for full_quality in (False, True):
        grey = renderer.frame(REST, VIEW, SIZE, full_quality, white)[..., 1]
        between.append(np.count_nonzero((grey > 150) & (grey < 250)))
    renderer.close()
    assert between[0] == 0
    assert between[1] > 50


@pytest.mark.parametrize("full_quality", [False, True])
def test_the_same_wish_gives_the_same_pixels(renderer, full_quality):
    first = draw(renderer, full_quality=full_quality)
    draw(renderer, np.ones(2, np.float32), VIEW.orbited(50, 20), (64, 80), not full_quality)
    np.testing.assert_array_equal(draw(renderer, full_quality=full_quality), first)


def test_the_array_is_used_again_until_the_size_changes(renderer):
    one = renderer.frame(REST, VIEW, SIZE, False)
    assert renderer.frame(REST, VIEW, SIZE, True) is one
    assert renderer.frame(REST, VIEW, (40, 30), False).shape == (30, 40, 4)


def test_the_background_falls_from_top_to_bottom(renderer):
    away = View(distance=6.0, target=(50.0, 0.0, 0.0))
    pixels = renderer.frame(REST, away, SIZE, False, Look(Background((1, 0.5, 0), (0, 0.5, 1), 0))).astype(int)
    assert abs(pixels[0, 48, :3] - (0, 128, 255)).max() <= 3
    assert abs(pixels[-1, 48, :3] - (255, 128, 0)).max() <= 3
    assert (np.diff(pixels[:, 48, 0]) >= -1).all()


def test_another_face_is_drawn_when_it_is_put_in(renderer):
    draw(renderer)
    renderer.face = ball(12, colour=(0.0, 0.0, 0.9, 0.0))
    blue, _, red, _ = draw(renderer)[48, 48].astype(int)
    assert blue > red


def test_renderers_live_side_by_side_and_outlive_each_other():
    one, other = FaceRenderer(BALL), FaceRenderer(ball(12))
    first = draw(one)
    draw(other)
    other.close()
    np.testing.assert_array_equal(draw(one), first)
    one.close()
    np.testing.assert_array_equal(draw(one), first)
    one.close()
    one.close()


def test_threads_take_turns(renderer):
    first = draw(renderer)
    same = []

    def elsewhere():
        own = FaceRenderer(BALL)
        same.extend(np.array_equal(draw(own), first) for _ in range(20))
        own.close()

    thread = threading.Thread(target=elsewhere)
    thread.start()
    here = [np.array_equal(draw(renderer), first) for _ in range(20)]
    thread.join()
    assert here == same == [True] * 20


@pytest.mark.parametrize("amounts", [np.zeros(3), np.array([0, np.nan]), np.array([np.inf, 0])])
def test_amounts_that_are_not_for_this_face_are_refused(renderer, amounts):
    with pytest.raises(ValueError, match="2 finite numbers"):
        renderer.frame(amounts, VIEW, SIZE)


@pytest.mark.parametrize("size", [(1, 1), (0, 5), (3, 500)])
def test_any_size_is_drawn(renderer, size):
    assert renderer.frame(REST, VIEW, size, True).shape == (max(size[1], 1), max(size[0], 1), 4)


class Broken:
    """A platform on a machine whose driver gives no context."""

    def init_context(self):
        raise OSError("libEGL:\n  no such driver")

    def make_current(self):
        raise AssertionError("there is no context")

    make_uncurrent = delete_context = make_current


def test_without_opengl_one_sentence_says_so():
    renderer = FaceRenderer(BALL, Broken())
    for _ in range(2):
        with pytest.raises(UserError) as caught:
            renderer.frame(REST, VIEW, SIZE)
        assert "The face cannot be drawn: no OpenGL on this machine (libEGL: no such driver). Install" in str(
            caught.value
        )
        assert "\n" not in str(caught.value)
    renderer.close()


class Fickle:
    """A platform whose context is lost at the second frame, as after a driver's reset."""

    def __init__(self):
        self.frames = 0

    def init_context(self):
        pass

    def make_current(self):
        self.frames += 1
        if self.frames == 2:
            raise OSError("context lost")
        process_context().__enter__()

    def make_uncurrent(self):
        process_context().__exit__()

    def delete_context(self):
        pass


def test_after_a_lost_context_the_next_frame_is_drawn_again():
    renderer = FaceRenderer(BALL, Fickle())
    first = draw(renderer)
    with pytest.raises(UserError, match=r"OpenGL stopped working \(context lost\)\. Try again"):
        draw(renderer)
    np.testing.assert_array_equal(draw(renderer), first)
    renderer.close()


ALONE = """
import sys
from core_pipeline.errors import UserError
from core_pipeline.faces.render.renderer import FaceRenderer
from core_pipeline.faces.render.context import process_context
from core_pipeline.faces.looks import Background, Look
from core_pipeline.faces.view import View
from tests.helpers.ball import ball
try:
    print(FaceRenderer(ball(6)).frame([0, 0], View(), (32, 32)).shape)
except UserError as error:
    print(error)
print(sorted({name.split(".")[0] for name in sys.modules} & {"PySide6", "pyglet", "tkinter"}))
"""


def alone(**environment):
    """What a process of its own prints that draws one frame."""
    result = subprocess.run(
        [sys.executable, "-W", "error", "-c", ALONE],
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    assert result.stderr == ""
    return result.stdout.splitlines()


def test_drawing_needs_no_qt_and_no_window():
    assert alone() == ["(32, 32, 4)", "[]"]


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="EGL is Linux's way")
def test_a_machine_without_a_driver_is_told_what_to_install():
    sentence, modules = alone(__EGL_VENDOR_LIBRARY_FILENAMES="/nowhere.json")
    assert sentence.startswith("The face cannot be drawn: no OpenGL on this machine (")
    assert sentence.endswith("Install the packages libegl1 and libgl1-mesa-dri, or the driver of your graphics card.")
    assert modules == "[]"
