"""Toon's poses mean what they should: who shows teeth, whose lips are sealed, and nothing turns inside out."""

import numpy as np
import pytest

from core_pipeline.faces.face_folder import load
from core_pipeline.poses import FACEFX
from tests.helpers.lip_sections import lip_gap_and_overlap, lip_sections
from tests.helpers.zbuffer import deformed, seen, visible_triangles

TOON = load("assets/faces/toon")
MOUTH = (0.0, -0.44, 0.75)
INSIDE = ("teeth_upper", "teeth_lower", "gums_upper", "gums_lower", "tongue", "mouth")
VIEWS = ((0, 0), (35, 0), (-35, 0), (0, 15), (0, -15))
# one pixel in 220 × 220 may fall between two triangles
STRAY = 2


def pixels(weights, view=(0, 0)):
    return seen(TOON, weights, MOUTH, *view)


def inside(weights, view=(0, 0)):
    counts = pixels(weights, view)
    return sum(counts[part] for part in INSIDE)


def test_it_has_all_poses_blink_and_brow():
    assert TOON.shapes == (*FACEFX, "blink", "browUp")
    assert TOON.title == "Toon"
    assert 10_000 <= len(TOON.triangles) <= 15_000
    assert sum(count for _, count in TOON.parts.values()) == len(TOON.triangles)


@pytest.mark.parametrize("view", VIEWS)
def test_at_rest_and_in_closed_poses_nothing_inside_is_seen(view):
    for weights in ({}, {"PBM": 1}, {"PBM": 0.65}, {"tBack": 1}, {"tRoof": 1}, {"tTeeth": 1}, {"blink": 1}):
        assert inside(weights, view) == 0, weights


@pytest.mark.parametrize("other", ["wide", "ShCh", "W"])
@pytest.mark.parametrize("press", [0.65, 0.8, 1.0])
def test_lips_stay_sealed_against_a_little_of_another_pose(press, other):
    for view in VIEWS:
        assert inside({"PBM": press, other: 0.3}, view) <= STRAY, view


def test_sealing_is_no_accident():
    assert inside({"wide": 0.5}) > 50
    assert inside({"ShCh": 0.3}) > 50
    assert inside({"W": 0.5}) > 50


@pytest.mark.parametrize("tuck", [0.65, 0.8, 1.0])
@pytest.mark.parametrize("wide", [0.0, 0.3])
def test_fv_shows_upper_teeth_and_no_lower_ones(tuck, wide):
    for view in ((0, 0), (35, 0), (-35, 0)):
        counts = pixels({"FV": tuck, "wide": wide}, view)
        assert counts["teeth_upper"] > 80
        assert counts["teeth_lower"] == counts["tongue"] == 0


def test_shch_shows_both_rows_nearly_shut():
    counts = pixels({"ShCh": 1})
    assert counts["teeth_upper"] > 300
    assert counts["teeth_lower"] > 100
    both = pixels({"ShCh": 0.75, "open": 0.15})
    assert both["teeth_upper"] > 300
    assert both["teeth_lower"] > 100


def test_open_shows_both_rows_and_the_tongue():
    counts = pixels({"open": 1})
    assert counts["teeth_upper"] > 200
    assert counts["teeth_lower"] > 200
    assert counts["tongue"] > 800
    assert pixels({"open": 0.5})["tongue"] > 200


def test_w_is_a_small_round_hole_without_teeth():
    where = visible_triangles(TOON, {"W": 1}, MOUTH)
    first, count = TOON.parts["mouth"]
    hole = (where >= first) & (where < first + count)
    rows, columns = np.nonzero(hole)
    height, width = np.ptp(rows) + 1, np.ptp(columns) + 1
    assert hole.sum() > 150
    assert 0.8 < width / height < 1.25
    assert hole.sum() / (width * height) > 0.7
    for view in ((0, 0), (35, 0), (-35, 0)):
        counts = pixels({"W": 1}, view)
        assert counts["teeth_upper"] + counts["teeth_lower"] + counts["tongue"] == 0


def test_w_is_pushed_out_and_narrow():
    lips = lip_sections(TOON, {"W": 1}) - lip_sections(TOON, {})
    assert lips[..., 2].max() > 0.10
    assert np.ptp(lip_sections(TOON, {"W": 1})[..., 0]) < 0.5 * np.ptp(lip_sections(TOON, {})[..., 0])


def test_oh_opens_a_round_mouth():
    assert inside({"W": 0.7, "open": 0.5}) > 1000
    assert inside({"W": 0.7, "open": 0.5}) < inside({"open": 0.7})


def test_wide_shows_upper_teeth_with_the_jaw_shut():
    assert pixels({"wide": 1})["teeth_upper"] > 400
    assert pixels({"wide": 0.5, "open": 0.2})["teeth_upper"] > 400
    wide, rest = lip_sections(TOON, {"wide": 1}), lip_sections(TOON, {})
    assert np.ptp(wide[..., 0]) > 1.15 * np.ptp(rest[..., 0])


@pytest.mark.parametrize(("pose", "jaw"), [("tTeeth", 0.2), ("tRoof", 0.35), ("tBack", 0.4)])
def test_tongue_poses_show_the_tongue_once_the_mouth_opens(pose, jaw):
    assert pixels({pose: 1, "open": jaw})["tongue"] > 1.3 * pixels({"open": jaw})["tongue"] + 100


def test_tteeth_puts_the_tip_between_the_teeth():
    shown = deformed(TOON, {"tTeeth": 1, "open": 0.2})

    def part(name):
        first, count = TOON.parts[name]
        return shown[np.unique(TOON.triangles[first : first + count])]

    tongue, upper, lower = part("tongue"), part("teeth_upper"), part("teeth_lower")
    tip = tongue[tongue[:, 2].argmax()]
    assert tip[2] > upper[:, 2].max()
    assert lower[np.abs(lower[:, 0]) < 0.1, 1].max() < tip[1] < upper[np.abs(upper[:, 0]) < 0.1, 1].max()


def test_lips_meet_without_running_into_each_other():
    gap, overlap = lip_gap_and_overlap(lip_sections(TOON, {}))
    assert gap <= 0.008
    assert overlap <= 0.01
    for press in (0.65, 0.8, 1.0):
        gap, overlap = lip_gap_and_overlap(lip_sections(TOON, {"PBM": press}))
        assert gap <= 0.008
        assert overlap <= 0.01
    assert lip_gap_and_overlap(lip_sections(TOON, {"open": 1}))[0] > 0.2


COMBINED = (
    *({pose: 1.0} for pose in TOON.shapes),
    {"wide": 0.5, "open": 0.2},
    {"W": 0.7, "open": 0.5},
    {"PBM": 0.75, "open": 0.1},
    {"FV": 0.75, "wide": 0.3},
    {"ShCh": 0.75, "open": 0.15},
)


@pytest.mark.parametrize("weights", COMBINED, ids=" ".join)
def test_no_face_of_the_outer_skin_turns_inside_out(weights):
    def facing(points):
        first, count = TOON.parts["skin"]
        corners = points[TOON.triangles[first : first + count]]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        return normal / np.linalg.norm(normal, axis=1, keepdims=True)

    turned = (facing(TOON.positions) * facing(deformed(TOON, weights))).sum(1)
    assert (turned < np.cos(np.radians(100))).sum() == 0


@pytest.mark.parametrize("weights", COMBINED, ids=" ".join)
def test_nothing_inside_pokes_through_the_skin(weights):
    """Under the nose, on cheek and chin, seen from the front and from the side: skin and nothing but skin."""
    windows = [((0.0, -0.20, 0.9), 0.05, (0, 0)), ((0.6, -0.1, 0.5), 0.1, (0, 0)), ((0.6, -0.2, 0.5), 0.1, (50, 0))]
    if "open" not in weights:
        windows += [((0.0, -0.75, 0.7), 0.14, (0, 0)), ((0.0, -0.75, 0.7), 0.14, (50, 0))]
    for centre, half, view in windows:
        counts = seen(TOON, weights, centre, *view, half=half)
        assert {part for part, number in counts.items() if number > STRAY} <= {"skin", "neck", "lips"}, (centre, view)


def test_blink_shuts_the_eyes_and_never_uncovers_the_ball_in_front_of_the_lid():
    centre = (0.325, 0.17, 0.62)
    eye = ("eye_right", "glint_right")
    open_eye, shut = (sum(seen(TOON, w, centre, half=0.4)[part] for part in eye) for w in ({}, {"blink": 1}))
    half = sum(seen(TOON, {"blink": 0.5}, centre, half=0.4)[part] for part in eye)
    assert open_eye > 5000
    assert shut <= STRAY
    assert 0.25 * open_eye < half < 0.75 * open_eye


def test_brows_go_up_and_the_mouth_stays():
    first, count = TOON.parts["brow_left"]
    brow = np.unique(TOON.triangles[first : first + count])
    delta = TOON.deltas[TOON.shapes.index("browUp")]
    assert delta[brow, 1].min() > 0.05
    first, count = TOON.parts["lips"]
    assert np.abs(delta[TOON.triangles[first : first + count]]).max() == 0


def test_left_and_right_are_alike():
    for pose in ("open", "W", "FV"):
        right, left = pixels({pose: 1}, (30, 0)), pixels({pose: 1}, (-30, 0))
        for part in INSIDE:
            assert right[part] == pytest.approx(left[part], abs=12 + 0.03 * right[part])
