"""Whole avatars: sixty-seven shapes over several skinned meshes, quantised, packed; and what their pictures show."""

import numpy as np
import pytest

from core_pipeline.faces.open_face import open_face
from tests.helpers.avatar import HEIGHT, MESHES, SCALE, avatar, packed, toon
from tests.helpers.pictures import sampled, seen_colours
from tests.helpers.rigs import NAMES, PRESETS

SHAPES = (*NAMES["arkit52"], *NAMES["oculus15"])
KINDS = {"plain": {}, "quantised": {"quantised": True}, "packed": {"quantised": True, "pack": packed}}


@pytest.fixture(scope="module")
def faces(tmp_path_factory):
    folder, opened = tmp_path_factory.mktemp("avatars"), {}
    for kind, how in KINDS.items():
        path = folder / f"{kind}.glb"
        path.write_bytes(avatar(SHAPES, **how).glb())
        opened[kind] = open_face(path, PRESETS)
    return opened


def corners(face, part):
    first, count = face.parts[part]
    return np.unique(face.triangles[first : first + count])


def test_its_convention_is_seen_among_all_its_shapes(faces):
    found = faces["plain"]
    assert len(found.face.shapes) == 67
    assert found.retarget.preset == "arkit52"
    assert found.retarget.missing == ("tBack", "tRoof")
    assert found.notes == ("Not available on this face: tBack, tRoof.",)


@pytest.mark.parametrize("kind", KINDS)
def test_the_head_is_looked_at_and_the_body_stands_below(faces, kind):
    face = faces[kind].face
    assert face.positions[:, 1].min() == pytest.approx(0, abs=1e-3)
    head = toon().positions[corners(toon(), "skin"), 1] * SCALE + HEIGHT
    assert face.camera.target[1] == pytest.approx((head.max() + head.min()) / 2, abs=0.25 * float(np.ptp(head)))
    seen = 2 * face.camera.distance * np.tan(np.radians(face.camera.fov / 2))
    assert np.ptp(head) < seen < 2 * np.ptp(head)


@pytest.mark.parametrize("kind", ["quantised", "packed"])
def test_packing_moves_nothing_by_more_than_its_steps(faces, kind):
    plain, other = faces["plain"].face, faces[kind].face
    assert other.shapes == plain.shapes
    for part in MESHES:
        mine, theirs = (face.positions[corners(face, part)] for face in (other, plain))
        np.testing.assert_allclose(mine.min(0), theirs.min(0), atol=1e-4)
        np.testing.assert_allclose(mine.max(0), theirs.max(0), atol=1e-4)
        mine, theirs = (face.deltas[:, corners(face, part)] for face in (other, plain))
        np.testing.assert_allclose(np.abs(mine).max((1, 2)), np.abs(theirs).max((1, 2)), atol=1e-4)


def test_packed_is_quantised(faces):
    for name in ("positions", "normals", "triangles", "colours", "deltas", "texcoords"):
        np.testing.assert_array_equal(getattr(faces["packed"].face, name), getattr(faces["quantised"].face, name))


def test_teeth_and_tongue_follow_the_jaw_and_hair_does_not(faces):
    face = faces["packed"].face
    opened = face.deltas[face.shapes.index("jawOpen")]
    teeth = corners(face, "Wolf3D_Teeth")
    down = opened[teeth, 1]
    assert down.min() < -0.1 * SCALE
    assert not down[face.positions[teeth, 1] > np.quantile(face.positions[teeth, 1], 0.9)].any()
    assert not opened[corners(face, "Wolf3D_Hair")].any()


@pytest.mark.parametrize("kind", KINDS)
def test_every_mesh_wears_its_own_picture(faces, kind):
    face = faces[kind].face
    assert set(face.materials) == {*MESHES, "Wolf3D_Body"}
    assert len({material.texture for material in face.materials.values()}) == len(face.textures) == 6
    assert all(not material.cutoff and not material.soft for material in face.materials.values())
    assert len(face.triangles) == sum(count for _, count in face.parts.values())


def test_quantised_coordinates_lie_where_plain_ones_do(faces):
    plain, other = (
        np.unique(face.texcoords[corners(face, "Wolf3D_Head")].round(3), axis=0)
        for face in (faces["plain"].face, faces["quantised"].face)
    )
    np.testing.assert_allclose(plain.min(0), other.min(0), atol=1e-3)
    np.testing.assert_allclose(plain.max(0), other.max(0), atol=1e-3)


@pytest.mark.parametrize("part", MESHES)
def test_what_is_seen_at_a_vertex_is_the_colour_it_was_painted_from(faces, part):
    """Toon's own vertex colours, by way of a picture of eight bits."""
    face, own = faces["plain"].face, toon()
    painted = own.colours[np.unique(np.concatenate([corners(own, name) for name in MESHES[part]])), :3]
    off = np.abs(seen_colours(face)[corners(face, part)] - painted).max(axis=1)
    assert np.median(off) < 0.02


def test_an_iris_painted_in_a_picture_can_be_seen(faces):
    """Toon's eye has few vertices where its pupil ends; between them the picture tells more."""
    face, own = faces["plain"].face, toon()
    eye = corners(face, "EyeRight")
    assert len(eye) == len(corners(own, "eye_right")), "no triangle was cut for it"
    first, count = face.parts["EyeRight"]
    triangles = face.triangles[first : first + count]
    inside = np.random.default_rng(0).dirichlet(np.ones(3), 40)
    places, points = (
        np.concatenate([inside @ values[triangle] for triangle in triangles])
        for values in (face.texcoords, face.positions)
    )
    dark = sampled(face.textures[face.materials["EyeRight"].texture], places)[:, :3].max(axis=1) < 0.05
    centre = face.positions[eye].mean(0)
    assert dark.sum() > 20
    assert (points[dark, 2] > centre[2]).all()


def test_pictures_are_the_right_way_up(faces):
    face = faces["plain"].face
    head = corners(face, "Wolf3D_Head")
    reference = toon()
    lips = reference.positions[corners(reference, "lips")] * SCALE + np.float32([0, HEIGHT, 0])
    at_lips = np.linalg.norm(face.positions[head] - lips.mean(0), axis=1).argmin()
    red, green, _ = seen_colours(face)[head[at_lips]]
    assert red > 2 * green


def test_normals_are_those_of_the_file(faces):
    face, own = faces["plain"].face, toon()
    np.testing.assert_allclose(np.linalg.norm(face.normals, axis=1), 1, atol=1e-5)
    np.testing.assert_allclose(face.normals[corners(face, "EyeLeft")], own.normals[corners(own, "eye_left")], atol=1e-5)
