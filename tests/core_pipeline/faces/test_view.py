"""The camera turns, nears and shifts as the hand does, and never gets lost."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app import resources
from core_pipeline.faces import face_folder
from core_pipeline.faces.face import Camera
from core_pipeline.faces.framing import head_camera
from core_pipeline.faces.looks import ANGLES
from core_pipeline.faces.view import View, places
from tests.helpers import rigs
from tests.helpers.ball import ball

HOME = Camera(target=(0.0, 0.2, 0.1), distance=7.0, yaw=10.0, pitch=-5.0, fov=22.0)
VIEW = View.of(HOME)
PIXELS = st.floats(-5000, 5000)
MOVES = st.lists(
    st.one_of(
        st.tuples(st.just("orbited"), st.tuples(PIXELS, PIXELS)),
        st.tuples(st.just("zoomed"), st.tuples(st.floats(-500, 500))),
        st.tuples(st.just("panned"), st.tuples(PIXELS, PIXELS, st.tuples(st.integers(0, 2000), st.integers(0, 2000)))),
    ),
    max_size=8,
)


def after(moves):
    view = VIEW
    for name, arguments in moves:
        view = getattr(view, name)(*arguments)
    return view


def on_screen(view, point, size=(400, 400)):
    """Pixel (x, y), +y down, where a point of the mesh is seen."""
    x, y, _, w = view.projection(size, 1.5) @ view.matrix() @ (*point, 1.0)
    return np.array([(x / w + 1) / 2 * size[0], (1 - y / w) / 2 * size[1]])


@given(MOVES)
def test_no_move_leads_astray(moves):
    view = after(moves)
    assert -180 < view.yaw <= 180
    assert -85 <= view.pitch <= 85
    assert 7.0 / 4 <= view.distance <= 7.0 * 4
    assert max(abs(a - b) for a, b in zip(view.target, HOME.target, strict=True)) <= 3.5 + 1e-9
    assert np.isfinite(view.matrix()).all()


@given(MOVES)
def test_reset_is_the_faces_own_view(moves):
    assert after(moves).reset() == VIEW


@given(MOVES)
def test_no_move_nor_reset_closes_the_cut_away(moves):
    view = VIEW
    for name, arguments in moves:
        view = getattr(replace(view, cutaway=True), name)(*arguments)
        assert view.cutaway
        assert view.reset() == replace(VIEW, cutaway=True)


@given(MOVES)
def test_the_matrix_neither_stretches_nor_mirrors(moves):
    turn = after(moves).matrix()[:3, :3]
    np.testing.assert_allclose(turn @ turn.T, np.eye(3), atol=1e-9)
    assert np.linalg.det(turn) == pytest.approx(1)


@given(MOVES)
def test_the_target_is_in_the_middle_at_its_distance(moves):
    view = after(moves)
    np.testing.assert_allclose(view.matrix() @ (*view.target, 1.0), (0, 0, -view.distance, 1), atol=1e-9)


def test_dragging_to_the_right_turns_the_face_to_the_right():
    nose = (0.0, 0.2, 1.1)
    assert on_screen(VIEW.orbited(40, 0), nose)[0] > on_screen(VIEW, nose)[0]


def test_dragging_down_turns_the_face_down():
    nose = (0.0, 0.2, 1.1)
    assert on_screen(VIEW.orbited(0, 40), nose)[1] > on_screen(VIEW, nose)[1]


def test_from_the_left_the_left_side_is_near():
    left = View(yaw=-90.0).matrix() @ (-1.0, 0.0, 0.0, 1.0)
    np.testing.assert_allclose(left, (0, 0, -4, 1), atol=1e-12)


def test_from_above_the_crown_is_near():
    crown = View(pitch=85.0).matrix() @ (0.0, 1.0, 0.0, 1.0)
    assert crown[2] > -4.1


@given(st.floats(-60, 60), st.floats(-60, 60))
def test_the_face_follows_a_shift_pixel_by_pixel(dx, dy):
    moved = on_screen(VIEW.panned(dx, dy, (400, 400)), HOME.target) - on_screen(VIEW, HOME.target)
    np.testing.assert_allclose(moved, (dx, dy), atol=1e-6)


@given(st.floats(0.1, 10))
def test_zooming_in_and_out_again_changes_nothing(steps):
    assert VIEW.zoomed(steps).zoomed(-steps).distance == pytest.approx(VIEW.distance)
    assert VIEW.zoomed(steps).distance < VIEW.distance


@pytest.mark.parametrize("size", [(400, 400), (300, 900), (900, 300)])
def test_the_angle_of_view_spans_the_shorter_side(size):
    view = View(fov=24.0, distance=5.0)
    x, y = on_screen(view, (5 * math.tan(math.radians(12)), 0.0, 0.0), size) - np.array(size) / 2
    assert x == pytest.approx(min(size) / 2)
    assert y == pytest.approx(0)


@given(MOVES)
def test_what_is_in_front_of_the_camera_is_between_near_and_far(moves):
    view = after(moves)
    for point in np.vstack([np.eye(3), -np.eye(3)]):
        _, _, z, w = view.projection((400, 400), 1.0) @ view.matrix() @ (*point, 1.0)
        if w > 0.02 * view.distance:
            assert -w <= z <= w


def bust(wide=1.0):
    """A ball of a head over a much wider shirt, as our characters name their parts."""
    head, shirt = ball(12), ball(12)
    n, m = len(head.positions), len(head.triangles)
    return replace(
        head,
        positions=np.vstack([head.positions * (wide, 1, 1), shirt.positions * (3, 0.5, 1) - (0, 2, 0)]).astype("f"),
        normals=np.vstack([head.normals, shirt.normals]),
        colours=np.vstack([head.colours, shirt.colours]),
        triangles=np.vstack([head.triangles, shirt.triangles + n]),
        deltas=np.concatenate([head.deltas, shirt.deltas], axis=1),
        normal_deltas=np.concatenate([head.normal_deltas, shirt.normal_deltas], axis=1),
        parts={"skin": (0, m), "shirt": (m, m)},
    )


BUSTS = {wide: bust(wide) for wide in (0.6, 1.0, 1.8)}


def reach(view, points, size):
    """How far the points go to each side, in half pictures: (left, right, up, down), all below 1 when seen."""
    corners = np.c_[points, np.ones(len(points))] @ (view.projection(size, 3.5) @ view.matrix()).T
    x, y = corners[:, 0] / corners[:, 3], corners[:, 1] / corners[:, 3]
    return -x.min(), x.max(), y.max(), -y.min()


SIZES = st.tuples(st.integers(80, 1200), st.integers(80, 1200))


@given(SIZES, st.floats(-180, 180), st.sampled_from(sorted(BUSTS)))
def test_the_whole_head_is_seen_with_a_little_air_in_a_picture_of_any_shape(size, yaw, wide):
    face = BUSTS[wide]
    head = face.positions[face.positions[:, 1] > -1]
    view = View.on(face).turned(yaw).fitted(size)
    assert max(reach(view, head, size)) < 0.98


@given(SIZES)
def test_and_it_is_as_large_as_it_can_be(size):
    face = BUSTS[1.0]
    view = View.on(face).fitted(size)
    assert max(reach(view, face.positions[face.positions[:, 1] > -1.5], size)) > 0.8


@pytest.mark.parametrize("size", [(300, 300), (120, 400), (500, 200)])
def test_the_crown_of_a_rig_is_seen_though_only_its_jaw_moves(size):
    face = rigs.head(("jawOpen", "mouthPucker"))
    face = replace(face, camera=head_camera(face))
    left, right, up, _ = reach(View.on(face).fitted(size), face.positions, size)
    assert max(left, right, up) < 0.98


def on_a_body(face):
    """The face on shoulders three times as wide, and down to its feet; the arms stretched out."""
    x, y, z = np.meshgrid([-3, -1.3, 0, 1.3, 3], [-1.6, -1.9, -4, -9], [-0.6, 0.6], indexing="ij")
    body = np.stack([x, y, z], -1).reshape(-1, 3).astype(np.float32)
    still = np.zeros((len(face.shapes), len(body), 3), np.float32)
    return replace(
        face, positions=np.vstack([face.positions, body]), deltas=np.concatenate([face.deltas, still], axis=1)
    )


@given(SIZES, st.sampled_from([-38, 0, 38]))
def test_of_a_whole_avatar_the_head_fills_the_picture(size, yaw):
    head = rigs.head(("jawOpen", "mouthPucker", "browInnerUp"))
    face = on_a_body(head)
    face = replace(face, camera=head_camera(face))
    left, right, up, down = reach(View.on(face).turned(yaw).fitted(size), head.positions, size)
    assert max(left, right, up) < 0.98
    assert max(left, right, up, down) > 0.7


def test_a_shape_of_the_whole_body_does_not_make_the_body_the_face():
    face = on_a_body(rigs.head(("jawOpen", "mouthPucker", "browInnerUp")))
    tall = 0.1 * face.positions[None] * np.float32([0, 1, 0])
    grown = replace(face, shapes=(*face.shapes, "tall"), deltas=np.concatenate([face.deltas, tall]))
    assert head_camera(grown) == head_camera(face)


def test_the_mouth_of_a_rig_that_names_no_lips_is_what_its_poses_move():
    face = rigs.head(("jawOpen", "mouthPucker", "browInnerUp"), rings=40)
    face = replace(face, camera=head_camera(face), pose_map={"open": {"jawOpen": 1}, "W": {"mouthPucker": 1}})
    near = View.on(face, ANGLES["mouth"]).fitted((300, 300))
    lips = face.positions[np.abs(face.deltas[1, :, 2]) > 0.8 * np.abs(face.deltas[1]).max()]
    assert 0.3 < reach(near, lips, (300, 300))[0] < 0.9
    assert near.distance < 0.6 * View.on(face).fitted((300, 300)).distance


@given(SIZES, st.floats(-5, 5))
def test_zoom_counts_from_where_the_head_fits(size, steps):
    view = View.on(BUSTS[1.0])
    assert view.zoomed(steps).fitted(size).distance == pytest.approx(
        view.fitted(size).distance * view.zoomed(steps).distance / view.distance
    )


def test_a_near_view_has_the_mouth_in_the_middle_and_is_nearer():
    face = face_folder.load(resources.face_folder("woman"))
    first, count = face.parts["lips"]
    lips = face.positions[face.triangles[first : first + count].ravel()]
    near = View.on(face, ANGLES["mouth"]).fitted((300, 300))
    left, right, up, down = reach(near, lips, (300, 300))
    assert 0.4 < left < 0.9
    assert left == pytest.approx(right, abs=0.02)
    assert up == pytest.approx(down, abs=0.2)
    assert near.distance < 0.6 * View.on(face).fitted((300, 300)).distance


@pytest.mark.parametrize(("name", "side"), [("left", -1), ("right", 1), ("profile", -1), ("front", 0)])
def test_an_angle_is_named_for_the_side_of_the_picture_the_face_looks_to(name, side):
    view = View.on(BUSTS[1.0], ANGLES[name])
    nose = on_screen(view, (0, 0, 1))[0] - on_screen(view, (0, 0, 0))[0]
    assert np.sign(round(float(nose))) == side


def test_another_face_is_seen_as_the_first_one_is_each_from_its_own_home():
    moved = VIEW.orbited(50, 10).zoomed(2)
    other = View.of(Camera(distance=3.0, pitch=4.0)).like(moved)
    assert other.yaw == pytest.approx(moved.yaw - HOME.yaw)
    assert other.pitch == pytest.approx(4.0 + moved.pitch - HOME.pitch)
    assert other.distance / 3.0 == pytest.approx(moved.distance / HOME.distance)


@given(SIZES, st.integers(1, 3))
def test_places_cover_the_picture_once_and_are_never_needlessly_narrow(size, count):
    found = places(size, count)
    covered = np.zeros(size, int)
    for x, y, w, h in found:
        covered[x : x + w, y : y + h] += 1
    assert (covered == 1).all()
    shorter = min(min(w, h) for *_, w, h in found)
    assert shorter >= max(min(size[0] // count, size[1]), min(size[0], size[1] // count))
