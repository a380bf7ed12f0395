"""What no camera sees is left out of our faces, what hides is drawn first, and hair is wound outwards."""

import numpy as np
import pytest

from core_pipeline.faces.face_folder import load
from core_pipeline.faces.sculpt import CHARACTERS, HUMANS
from core_pipeline.faces.sculpt.character import Sheet
from core_pipeline.faces.sculpt.hair_sheet import sheet
from core_pipeline.faces.sculpt.hidden import never_seen
from core_pipeline.faces.sculpt.raster import fragments, looking_along, nearest
from core_pipeline.faces.sculpt.sdf import Blob, Solid
from tests.helpers.zbuffer import deformed, seen, visible_triangles

BALL = Solid((Blob((0, 0, 0), (1, 1, 1), 0.1),))
CUBE = np.array([[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
SIDES = np.array(
    [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4),
     (1, 5, 7), (1, 7, 3)]
)  # fmt: skip


def _boxes(*sizes):
    points = np.concatenate([size * CUBE for size in sizes])
    return points, np.concatenate([SIDES + 8 * number for number in range(len(sizes))])


def test_a_box_in_a_box_is_never_seen():
    points, triangles = _boxes(1.0, 0.5)
    asked = np.ones(len(triangles), bool)
    np.testing.assert_array_equal(never_seen([points], triangles, asked), [False] * 12 + [True] * 12)
    # whoever is not asked about stays
    assert not never_seen([points], triangles, ~asked).any()


def test_what_one_pose_uncovers_stays():
    points, triangles = _boxes(1.0, 0.5)
    lid = np.isclose(points[:, 1], 1.0)
    opened = points + 1.5 * lid[:, None] * (0.0, 1.0, 0.0) + 3.0 * lid[:, None] * (1.0, 0.0, 0.0)
    hidden = never_seen([points, opened], triangles, np.ones(len(triangles), bool))
    assert not hidden[12:].all()


def test_fragments_cover_a_square_once_at_its_own_depth():
    square = np.array([[-1.0, -1.0, 0.3], [1.0, -1.0, 0.3], [1.0, 1.0, 0.3], [-1.0, 1.0, 0.3]])
    square += np.array([1e-4, 2e-4, 0.0])
    triangles = np.array([(0, 1, 2), (0, 2, 3)])
    size = 64
    points = looking_along(square, np.array([0.0, 0.0, 1.0]), size)
    which, pixel, near = fragments(points[triangles], size)
    # two by two of four by four head radii, each pixel once
    assert len(np.unique(pixel)) == pytest.approx(len(pixel), abs=size)
    assert len(np.unique(pixel)) == (size // 2) ** 2
    assert set(which.tolist()) == {0, 1}
    np.testing.assert_allclose(near, 0.3)
    buffer = nearest(pixel, near, size)
    assert (buffer > 0).sum() == (size // 2) ** 2


def test_a_sheet_of_hair_is_wound_outwards_on_both_sides_of_the_head():
    guides = tuple(
        ((0.1, 1.1, z), (1.1 - 0.2 * abs(z), 0.4, z), (1.1 - 0.2 * abs(z), -0.8, z)) for z in (0.5, 0.2, -0.2, -0.5)
    )
    layer = Sheet(guides=guides, thickness=0.06, columns=29, rows=14)
    for points, triangles, _ in sheet(layer, BALL):
        a, b, c = (points[triangles[:, i]] for i in range(3))
        sixfold = np.einsum("ij,ij->i", a, np.cross(b, c)).sum()
        assert sixfold > 0
        outer = (triangles % (2 * layer.columns) < layer.columns).all(axis=1)
        outwards = (np.cross(b - a, c - a) * (a + b + c) * (1, 0, 1)).sum(axis=1)
        area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
        assert area[outer & (outwards > 0)].sum() > 0.9 * area[outer].sum()


@pytest.mark.parametrize("character", CHARACTERS, ids=lambda character: character.name)
def test_nothing_that_faces_the_other_way_is_seen_from_in_front(character):
    face = load(f"assets/faces/{character.name}")
    corners = deformed(face, {})[face.triangles]
    towards = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    shown = visible_triangles(face, {}, (0.0, -0.1, 0.0), half=1.6)
    numbers, pixels = np.unique(shown[shown >= 0], return_counts=True)
    inner = pixels[towards[numbers, 2] < 0].sum()
    assert inner <= 0.002 * pixels.sum()


@pytest.mark.parametrize("character", HUMANS, ids=lambda character: character.name)
def test_from_behind_there_is_no_way_into_the_head(character):
    face = load(f"assets/faces/{character.name}")
    for yaw in (150, 180, -150):
        shown = visible_triangles(face, {}, (0.0, -0.35, -0.3), yaw, half=0.5)
        there = np.unique(shown[shown >= 0])
        parts = {
            name for name, (first, count) in face.parts.items() if ((there >= first) & (there < first + count)).any()
        }
        assert parts <= {"skin", "neck", "hair", "hair_back", "ear_right", "ear_left", "collar"}


@pytest.mark.parametrize("character", HUMANS, ids=lambda character: character.name)
def test_the_neck_does_not_stand_in_the_throat(character):
    face, height = load(f"assets/faces/{character.name}"), character.mouth.height
    for weights in ({"open": 1}, {"W": 0.7, "open": 0.5}, {"wide": 0.5, "open": 0.5}):
        for view in ((0, 0), (30, 0), (0, 15)):
            assert seen(face, weights, (0.0, height - 0.08, 0.75), *view, half=0.2)["neck"] == 0
