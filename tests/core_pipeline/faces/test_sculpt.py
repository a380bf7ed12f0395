"""The generator: the shipped faces are exactly what it makes, and clay, skin and fields keep their laws."""

import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.errors import UserError
from core_pipeline.faces.face_folder import load
from core_pipeline.faces.sculpt import CHARACTERS, build_all
from core_pipeline.faces.sculpt.__main__ import main
from core_pipeline.faces.sculpt.fields import SmoothField
from core_pipeline.faces.sculpt.layout import lay_out
from core_pipeline.faces.sculpt.lids import Lid
from core_pipeline.faces.sculpt.sdf import Blob, Solid


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """Every character's folder, made here and now; and what was told on the way."""
    folder, told = tmp_path_factory.mktemp("faces"), []
    return folder, build_all(folder, lambda *step: told.append(step)), told


@pytest.mark.parametrize("character", CHARACTERS, ids=lambda character: character.name)
def test_the_shipped_face_is_what_the_generator_makes(built, character):
    made, shipped = load(built[0] / character.name), load(f"assets/faces/{character.name}")
    assert (made.shapes, dict(made.parts), made.camera) == (shipped.shapes, dict(shipped.parts), shipped.camera)
    assert (made.title, dict(made.pose_map)) == (shipped.title, dict(shipped.pose_map))
    assert made.closed == shipped.closed
    np.testing.assert_array_equal(made.triangles, shipped.triangles)
    for name in ("positions", "normals", "colours", "deltas", "normal_deltas"):
        np.testing.assert_allclose(getattr(made, name), getattr(shipped, name), atol=1e-4, err_msg=name)


def test_building_all_writes_every_folder_and_tells_how_far_it_is(built):
    place, written, told = built
    assert told == [(n, len(CHARACTERS), c.title) for n, c in enumerate(CHARACTERS, 1)]
    assert written == [place / c.name for c in CHARACTERS]
    for folder in written:
        assert (folder / "face.glb").stat().st_size < 8_000_000
        assert load(folder).title


def test_twice_the_same_bytes(built, tmp_path):
    """In another process too: nothing hangs on hashes or on what ran before."""
    command = [sys.executable, "-m", "core_pipeline.faces.sculpt", str(tmp_path), "toon", "crab"]
    ran = subprocess.run(command, capture_output=True, text=True, check=True)
    assert ran.stdout.splitlines() == ["[1/2] Toon", "[2/2] Crab"]
    assert {place.name for place in tmp_path.iterdir()} == {"toon", "crab"}
    for character in ("toon", "crab"):
        for name in ("face.glb", "face.json"):
            assert (built[0] / character / name).read_bytes() == (tmp_path / character / name).read_bytes()


def test_a_name_that_is_none_of_ours_is_refused(tmp_path, capsys):
    assert main([str(tmp_path / "new"), "toon", "tune"]) == 2
    assert "“tune” is none of our characters; choose from toon" in capsys.readouterr().err
    assert not (tmp_path / "new").exists()


def test_a_folder_that_cannot_be_written(tmp_path, capsys):
    (tmp_path / "file").write_text("in the way", "utf-8")
    with pytest.raises(UserError, match="cannot be written"):
        build_all(tmp_path / "file", names=["toon"])
    assert main([str(tmp_path / "file"), "toon"]) == 2
    assert "cannot be written" in capsys.readouterr().err


@given(st.floats(0.2, 1.0), st.floats(-1.2, 1.2), st.floats(-1.2, 1.2))
def test_rays_end_on_the_clay(radius, yaw, pitch):
    ball = Solid((Blob((0, 0, 0), (radius, radius, radius), 0.1), Blob((0.1, 0, 0), (radius, radius, radius), 0.1)))
    ray = np.array([[np.sin(yaw) * np.cos(pitch), np.sin(pitch), np.cos(yaw) * np.cos(pitch)]])
    hit = ball.cast(np.zeros((1, 3)), ray)
    assert abs(ball.distance(hit)[0]) < 1e-3
    assert (ball.gradient(hit) * ray).sum() > 0


def test_carving_takes_away_and_mirroring_works_on_both_sides():
    ball = Blob((0, 0, 0), (1, 1, 1), 0.01)
    dented = Solid((ball, Blob((0.9, 0, 0), (0.3, 0.3, 0.3), 0.01, mirrored=True, carve=True)))
    points = np.array([[0.8, 0, 0], [-0.8, 0, 0], [0, 0.8, 0]])
    np.testing.assert_array_equal(dented.distance(points) > 0, [True, True, False])


def _sheet(n=14):
    x, y = np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, n))
    points = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], -1)
    corner = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
    lower = np.stack([corner, corner + 1, corner + n + 1], -1)
    upper = np.stack([corner, corner + n + 1, corner + n], -1)
    return points, np.concatenate([lower, upper])


@given(st.tuples(*[st.floats(-2, 2)] * 3))
def test_smooth_fields_keep_what_is_held_and_reproduce_planes(plane):
    points, triangles = _sheet()
    held = np.abs(points[:, :2] - 0.5).max(axis=1) > 0.36
    values = (points @ np.array(plane))[:, None]
    spread = SmoothField(points, triangles, held).spread(np.where(held[:, None], values, 99.0))
    np.testing.assert_array_equal(spread[held], values[held])
    np.testing.assert_allclose(spread, values, atol=0.05 * (1 + np.abs(values).max()))


def _ring(radius, centre, count):
    turn = 2 * np.pi * np.arange(count) / count - np.pi / 2
    return np.stack([centre[0] + radius * np.cos(turn), centre[1] + radius * np.sin(turn)], -1)


def test_a_layout_is_mirrored_closed_and_keeps_its_loops():
    eyes = [_ring(0.16 * size, (0.5, 0.7), 20) for size in (1.0, 1.2, 1.5)]
    layout = lay_out(_ring(0.3, (0.0, 0.0), 40), eyes, lambda flat: np.full(len(flat), 0.14))
    there = {tuple(point) for point in layout.points.round(9) + 0.0}
    assert {(x * -1 + 0.0, y) for x, y in there} == there
    a, b, c = (layout.points[layout.triangles[:, i]] for i in range(3))
    u, v = b - a, c - a
    assert (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0] > 0).all()
    edges = np.concatenate([layout.triangles[:, [0, 1]], layout.triangles[:, [1, 2]], layout.triangles[:, [2, 0]]])
    _, times = np.unique(np.sort(edges, axis=1), axis=0, return_counts=True)
    assert set(times) == {1, 2}
    rim = (times == 1).sum() - len(layout.border) - sum(len(eye) for eye in layout.eyes)
    assert rim == 28
    np.testing.assert_allclose(layout.points[layout.eyes[1]], layout.points[layout.eyes[0]] * (-1, 1))


def test_rings_that_crowd_a_loop_give_way_to_it():
    eyes = [_ring(0.16, (0.5, 0.7), 4), _ring(0.115, (0.5, 0.7), 40)]
    layout = lay_out(_ring(0.3, (0.0, 0.0), 40), eyes, lambda flat: np.full(len(flat), 0.14))
    edges = np.sort(np.concatenate([layout.triangles[:, pair] for pair in ([0, 1], [1, 2], [2, 0])]), axis=1)
    steps = np.sort(np.stack([layout.eyes[0], np.roll(layout.eyes[0], -1)], -1), axis=1)
    assert {tuple(step) for step in steps} <= {tuple(edge) for edge in edges}


def test_a_loop_the_mesh_cannot_follow_is_refused():
    # the eye runs into the mouth
    eyes = [_ring(0.2, (0.4, 0.1), 20), _ring(0.24, (0.4, 0.1), 20)]
    with pytest.raises(ValueError, match="steps of a loop"):
        lay_out(_ring(0.3, (0.0, 0.0), 40), eyes, lambda flat: np.full(len(flat), 0.14))


def test_closed_lids_meet_and_the_way_there_leads_round_the_ball():
    for character in CHARACTERS:
        lid = Lid(character.eyes)
        angle = np.linspace(0.05, np.pi - 0.05, 30)
        upper, lower = lid.edge(angle), lid.edge(-angle)
        shut_upper, shut_lower = (lid.close(edge, np.ones(30)) for edge in (upper, lower))
        heights = shut_upper[:, 1] - shut_lower[:, 1]
        assert np.abs(heights).max() < 0.03
        for t in np.linspace(0, 1, 9):
            away = np.linalg.norm(upper + t * (shut_upper - upper) - lid.centre, axis=1)
            assert (away > character.eyes.radius).all()
