"""Sky, hair, lashes and brow hairs: each keeps its law on shapes whose answer is known."""

import numpy as np
import pytest

from core_pipeline.faces.sculpt import HUMANS
from core_pipeline.faces.sculpt.ada import ADA
from core_pipeline.faces.sculpt.brow_hairs import brow_hairs
from core_pipeline.faces.sculpt.character import Sheet
from core_pipeline.faces.sculpt.hair_sheet import sheet
from core_pipeline.faces.sculpt.lashes import lashes
from core_pipeline.faces.sculpt.man import MAN
from core_pipeline.faces.sculpt.piece import grid
from core_pipeline.faces.sculpt.sdf import Blob, Solid
from core_pipeline.faces.sculpt.sky import sky
from core_pipeline.faces.sculpt.trimmings import ears

BALL = Solid((Blob((0, 0, 0), (1, 1, 1), 0.1),))


def _plate(height, half, n=21):
    x, z = np.meshgrid(np.linspace(-half, half, n), np.linspace(-half, half, n))
    return np.stack([x.ravel(), np.full(n * n, height), z.ravel()], -1), grid(n, n, closed=False)[:, ::-1]


def _up(points):
    return np.tile([0.0, 1.0, 0.0], (len(points), 1))


def test_a_free_plate_sees_all_of_the_sky_and_one_under_a_roof_little():
    floor, triangles = _plate(0.0, 1.0)
    # a grazing look into a buffer of pixels is not exact
    np.testing.assert_allclose(sky(floor, _up(floor), triangles), 1, atol=0.03)
    roof, roof_triangles = _plate(0.25, 1.0)
    both = np.concatenate([floor, roof])
    seen = sky(both, _up(both), np.concatenate([triangles, roof_triangles + len(floor)]))
    below, above = seen[: len(floor)].reshape(21, 21), seen[len(floor) :]
    assert below[10, 10] < 0.2
    assert below[10, 10] < below[10, 0]
    np.testing.assert_allclose(above, 1, atol=0.03)


def _cape(**changes):
    guides = (
        ((0.1, 1.0, 0.4), (0.9, 0.4, 0.5), (0.9, -0.8, 0.5)),
        ((0.1, 1.0, 0.0), (1.0, 0.4, 0.0), (1.0, -0.8, 0.0)),
        ((0.1, 1.0, -0.4), (0.9, 0.4, -0.5), (0.9, -0.8, -0.5)),
    )
    return Sheet(guides=guides, **changes)


def test_a_sheet_of_hair_lies_outside_the_head_and_its_mirror_image_on_the_other_side():
    right, left = sheet(_cape(height=0.05, thickness=0.06), BALL)
    assert BALL.distance(right[0]).min() > 0.0
    np.testing.assert_array_equal(left[0], right[0] * (-1, 1, 1))
    np.testing.assert_array_equal(left[1], right[1][:, ::-1])
    assert right[2].min() >= 0
    assert right[2].max() <= 1
    assert len(sheet(_cape(mirrored=False), BALL)) == 1


def test_hair_hangs_to_tips_of_uneven_length():
    (even, *_), _ = sheet(_cape(ragged=0.0), BALL)
    (ragged, *_), _ = sheet(_cape(ragged=0.3), BALL)
    rows = _cape().rows
    assert np.ptp(even.reshape(rows, -1, 3)[-1, :, 1]) < 0.01
    assert np.ptp(ragged.reshape(rows, -1, 3)[-1, :, 1]) > 0.2


@pytest.mark.parametrize("character", [c for c in HUMANS if c.eyes.lashes], ids=lambda character: character.name)
def test_lashes_stand_in_front_of_the_eye_and_go_down_with_the_lid(character):
    right, left = lashes(character)
    away = np.linalg.norm(right.positions - character.eyes.centre, axis=1) / character.eyes.radius
    assert away.min() > 1.05
    assert away.max() > 1.15
    shut = right.poses["blink"]
    assert (np.linalg.norm(shut - character.eyes.centre, axis=1) / character.eyes.radius).min() > 1.0
    assert shut[:, 1].mean() < right.positions[:, 1].mean() - 0.2 * character.eyes.radius
    np.testing.assert_array_equal(left.positions, right.positions * (-1, 1, 1))


def test_who_has_none_has_none():
    assert lashes(MAN) == []
    woman = next(character for character in HUMANS if character.name == "woman")
    assert ears(woman) == []


def test_brow_hairs_lie_on_the_skin_face_the_front_and_rise():
    clay = Solid(ADA.clay)
    right, _ = brow_hairs(ADA, clay)
    for points in (right.positions, right.poses["browUp"]):
        assert np.abs(clay.distance(points)).max() < 0.02
        a, b, c = (points[right.triangles[:, i]] for i in range(3))
        assert (np.cross(b - a, c - a)[:, 2] > 0).all()
    rise = right.poses["browUp"][:, 1] - right.positions[:, 1]
    np.testing.assert_allclose(rise, ADA.brows.lift)
