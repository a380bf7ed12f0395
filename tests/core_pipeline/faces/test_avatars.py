"""Whole avatars: sixty-seven shapes over several skinned meshes, quantised, packed; and what their pictures show."""

import numpy as np
import pytest

from core_pipeline.faces.finer import MOST_TRIANGLES
from core_pipeline.faces.open_face import open_face
from tests.helpers.avatar import HEIGHT, MESHES, SCALE, avatar, packed, toon
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
    for name in ("positions", "normals", "triangles", "colours", "deltas"):
        np.testing.assert_array_equal(getattr(faces["packed"].face, name), getattr(faces["quantised"].face, name))


def test_teeth_and_tongue_follow_the_jaw_and_hair_does_not(faces):
    face = faces["packed"].face
    opened = face.deltas[face.shapes.index("jawOpen")]
    teeth = corners(face, "Wolf3D_Teeth")
    down = opened[teeth, 1]
    assert down.min() < -0.1 * SCALE
    assert not down[face.positions[teeth, 1] > np.quantile(face.positions[teeth, 1], 0.9)].any()
    assert not opened[corners(face, "Wolf3D_Hair")].any()


def test_an_iris_painted_in_a_picture_can_be_seen(faces):
    """Toon's eye has few vertices where its pupil ends; the picture tells more."""
    face, own = faces["plain"].face, toon()
    eye = corners(face, "EyeRight")
    assert len(eye) > len(corners(own, "eye_right"))
    dark = face.colours[eye, :3].max(axis=1) < 0.05
    front = face.positions[eye[dark]]
    centre = face.positions[eye].mean(0)
    assert dark.sum() > 20
    assert (front[:, 2] > centre[2]).all()
    assert len(face.triangles) <= MOST_TRIANGLES


def test_pictures_are_the_right_way_up(faces):
    face = faces["plain"].face
    head = corners(face, "Wolf3D_Head")
    reference = toon()
    lips = reference.positions[corners(reference, "lips")] * SCALE + np.float32([0, HEIGHT, 0])
    at_lips = np.linalg.norm(face.positions[head] - lips.mean(0), axis=1).argmin()
    red, green, _ = face.colours[head[at_lips], :3]
    assert red > 2 * green


def test_normals_stay_smooth_where_triangles_were_halved(faces):
    face = faces["plain"].face
    np.testing.assert_allclose(np.linalg.norm(face.normals, axis=1), 1, atol=1e-5)
    eye = corners(face, "EyeLeft")
    outward = face.positions[eye] - face.positions[eye].mean(0)
    outward /= np.linalg.norm(outward, axis=1, keepdims=True)
    assert np.median((outward * face.normals[eye]).sum(1)) > 0.9
