"""Every human face's poses mean what they should: teeth that show, lips that seal, nothing turned inside out."""

from collections import Counter
from functools import cache

import numpy as np
import pytest

from core_pipeline.faces.face_folder import load
from core_pipeline.faces.sculpt import HUMANS
from core_pipeline.poses import FACEFX
from tests.helpers.lip_sections import lip_gap_and_overlap, lip_sections
from tests.helpers.zbuffer import deformed, seen, visible_triangles

INSIDE = ("teeth_upper", "teeth_lower", "gums_upper", "gums_lower", "tongue", "mouth")
OUTSIDE = {"skin", "neck", "lips", "hair", "hair_back"}
VIEWS = ((0, 0), (35, 0), (-35, 0), (0, 15), (0, -15))
# one pixel in 220 × 220 may fall between two triangles
STRAY = 2


class Subject:
    """A shipped face, and windows on it in the measure of its own features: so pixels can be compared."""

    def __init__(self, character):
        self.character, self.face = character, load(f"assets/faces/{character.name}")
        mouth = character.mouth
        self.mouth = (0.0, mouth.height - 0.02, 0.75)
        self.half = 0.62 * mouth.half_width / 0.36
        self._counted = cache(self._count)

    def pixels(self, weights, view=(0, 0)) -> Counter[str]:
        return self._counted(tuple(weights.items()), view)

    def _count(self, weights, view):
        return seen(self.face, dict(weights), self.mouth, *view, half=self.half)

    def inside(self, weights, view=(0, 0)):
        counts = self.pixels(weights, view)
        return sum(counts[part] for part in INSIDE)

    def lips(self, weights):
        return lip_sections(self.face, weights)

    def numbers(self, part):
        first, count = self.face.parts[part]
        return np.unique(self.face.triangles[first : first + count])


@pytest.fixture(scope="module", params=HUMANS, ids=lambda character: character.name)
def human(request):
    return Subject(request.param)


def test_it_has_all_poses_blink_and_brow(human):
    face = human.face
    assert face.shapes == (*FACEFX, "blink", "browUp")
    assert face.title == human.character.title
    assert 10_000 <= len(face.triangles) <= (30_000 if face.name == "ada" else 15_000)
    assert sum(count for _, count in face.parts.values()) == len(face.triangles)


@pytest.mark.parametrize("view", VIEWS)
def test_at_rest_and_in_closed_poses_nothing_inside_is_seen(human, view):
    for weights in ({}, {"PBM": 1}, {"PBM": 0.65}, {"tBack": 1}, {"tRoof": 1}, {"tTeeth": 1}, {"blink": 1}):
        assert human.inside(weights, view) == 0, weights


@pytest.mark.parametrize("other", ["wide", "ShCh", "W"])
@pytest.mark.parametrize("press", [0.65, 0.8, 1.0])
def test_lips_stay_sealed_against_a_little_of_another_pose(human, press, other):
    for view in VIEWS:
        assert human.inside({"PBM": press, other: 0.3}, view) <= STRAY, view


def test_sealing_is_no_accident(human):
    assert human.inside({"wide": 0.5}) > 50
    assert human.inside({"ShCh": 0.3}) > 50
    assert human.inside({"W": 0.5}) > 50


@pytest.mark.parametrize("tuck", [0.65, 0.8, 1.0])
@pytest.mark.parametrize("wide", [0.0, 0.3])
def test_fv_shows_upper_teeth_and_no_lower_ones(human, tuck, wide):
    for view in ((0, 0), (35, 0), (-35, 0)):
        counts = human.pixels({"FV": tuck, "wide": wide}, view)
        assert counts["teeth_upper"] > 80
        assert counts["teeth_lower"] == counts["tongue"] == 0


def test_shch_shows_both_rows_nearly_shut(human):
    counts = human.pixels({"ShCh": 1})
    assert counts["teeth_upper"] > 300
    assert counts["teeth_lower"] > 100
    both = human.pixels({"ShCh": 0.75, "open": 0.15})
    assert both["teeth_upper"] > 300
    assert both["teeth_lower"] > 100


def test_open_shows_both_rows_and_the_tongue(human):
    counts = human.pixels({"open": 1})
    assert counts["teeth_upper"] > 200
    assert counts["teeth_lower"] > 200
    assert counts["tongue"] > 800
    assert human.pixels({"open": 0.5})["tongue"] > 200


def test_w_is_a_small_round_hole_without_teeth(human):
    where = visible_triangles(human.face, {"W": 1}, human.mouth, half=human.half)
    first, count = human.face.parts["mouth"]
    hole = (where >= first) & (where < first + count)
    rows, columns = np.nonzero(hole)
    height, width = np.ptp(rows) + 1, np.ptp(columns) + 1
    assert hole.sum() > 150
    assert 0.8 < width / height < 1.25
    assert hole.sum() / (width * height) > 0.7
    for view in ((0, 0), (35, 0), (-35, 0)):
        counts = human.pixels({"W": 1}, view)
        assert counts["teeth_upper"] + counts["teeth_lower"] + counts["tongue"] == 0


def test_w_is_pushed_out_and_narrow(human):
    lips = human.lips({"W": 1}) - human.lips({})
    assert lips[..., 2].max() > 0.25 * human.character.mouth.half_width
    assert np.ptp(human.lips({"W": 1})[..., 0]) < 0.5 * np.ptp(human.lips({})[..., 0])


def test_oh_opens_a_round_mouth(human):
    assert human.inside({"W": 0.7, "open": 0.5}) > 1000
    assert human.inside({"W": 0.7, "open": 0.5}) < human.inside({"open": 0.7})


def test_wide_shows_upper_teeth_with_the_jaw_shut(human):
    assert human.pixels({"wide": 1})["teeth_upper"] > 400
    assert human.pixels({"wide": 0.5, "open": 0.2})["teeth_upper"] > 400
    wide, rest = human.lips({"wide": 1}), human.lips({})
    assert np.ptp(wide[..., 0]) > 1.15 * np.ptp(rest[..., 0])


@pytest.mark.parametrize(("pose", "jaw"), [("tTeeth", 0.2), ("tRoof", 0.35), ("tBack", 0.4)])
def test_tongue_poses_show_the_tongue_once_the_mouth_opens(human, pose, jaw):
    assert human.pixels({pose: 1, "open": jaw})["tongue"] > 1.3 * human.pixels({"open": jaw})["tongue"] + 100


def test_tteeth_puts_the_tip_between_the_teeth(human):
    shown = deformed(human.face, {"tTeeth": 1, "open": 0.2})

    tongue, upper, lower = (shown[human.numbers(part)] for part in ("tongue", "teeth_upper", "teeth_lower"))
    tip = tongue[tongue[:, 2].argmax()]
    assert tip[2] > upper[:, 2].max()
    assert lower[np.abs(lower[:, 0]) < 0.1, 1].max() < tip[1] < upper[np.abs(upper[:, 0]) < 0.1, 1].max()


def test_lips_meet_without_running_into_each_other(human):
    gap, overlap = lip_gap_and_overlap(human.lips({}))
    assert gap <= 0.008
    assert overlap <= 0.01
    for press in (0.65, 0.8, 1.0):
        gap, overlap = lip_gap_and_overlap(human.lips({"PBM": press}))
        assert gap <= 0.008
        assert overlap <= 0.01
    assert lip_gap_and_overlap(human.lips({"open": 1}))[0] > 0.5 * human.character.mouth.half_width


COMBINED = (
    *({pose: 1.0} for pose in (*FACEFX, "blink", "browUp")),
    {"wide": 0.5, "open": 0.2},
    {"W": 0.7, "open": 0.5},
    {"PBM": 0.75, "open": 0.1},
    {"FV": 0.75, "wide": 0.3},
    {"ShCh": 0.75, "open": 0.15},
)


@pytest.mark.parametrize("weights", COMBINED, ids=" ".join)
def test_no_face_of_the_outer_skin_turns_inside_out(human, weights):
    def facing(points):
        first, count = human.face.parts["skin"]
        corners = points[human.face.triangles[first : first + count]]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        return normal / np.linalg.norm(normal, axis=1, keepdims=True)

    turned = (facing(human.face.positions) * facing(deformed(human.face, weights))).sum(1)
    assert (turned < np.cos(np.radians(100))).sum() == 0


@pytest.mark.parametrize("weights", COMBINED, ids=" ".join)
def test_nothing_inside_pokes_through_the_skin(human, weights):
    """Under the nose, on cheek and chin, seen from the front and from the side: skin and nothing but skin."""
    nose, mouth = human.character.nose, human.character.mouth
    cheek = (human.character.eyes.centre[0] + 0.12, nose[1] - 0.05, 0.5)
    windows = [((0.0, nose[1] - 0.08, 0.9), 0.05, (0, 0)), (cheek, 0.12, (0, 0)), (cheek, 0.12, (50, 0))]
    if "open" not in weights:
        chin = (0.0, mouth.height - 0.92 * mouth.half_width, 0.7)
        windows += [(chin, 0.39 * mouth.half_width, (0, 0)), (chin, 0.39 * mouth.half_width, (50, 0))]
    for centre, half, view in windows:
        counts = seen(human.face, weights, centre, *view, half=half)
        assert {part for part, number in counts.items() if number > STRAY} <= OUTSIDE, (centre, view)


def test_blink_shuts_the_eyes_and_never_uncovers_the_ball_in_front_of_the_lid(human):
    eyes = human.character.eyes

    def ball(weights):
        counts = seen(human.face, weights, eyes.centre, half=1.4 * eyes.radius)
        return counts["eye_right"] + counts["glint_right"]

    whole = ball({})
    assert whole > 3000
    assert ball({"blink": 1}) <= STRAY
    assert 0.25 * whole < ball({"blink": 0.5}) < 0.75 * whole


def test_brows_go_up_and_the_mouth_stays(human):
    delta = human.face.deltas[human.face.shapes.index("browUp")]
    assert delta[human.numbers("brow_left"), 1].min() > 0.6 * human.character.brows.lift
    assert np.abs(delta[human.numbers("lips")]).max() == 0


def test_left_and_right_are_alike(human):
    for pose in ("open", "W", "FV"):
        right, left = human.pixels({pose: 1}, (30, 0)), human.pixels({pose: 1}, (-30, 0))
        for part in INSIDE:
            assert right[part] == pytest.approx(left[part], abs=12 + 0.03 * right[part])
