"""A pose set of a rig's own: which shapes speak, and what their names say about who gives way to whom."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.errors import UserError
from core_pipeline.faces.face_folder import load
from core_pipeline.faces.pose_set import MAX_POSES, new_curve_set, poses_of, role_of, settings_for
from core_pipeline.files import curve_set_json
from core_pipeline.poses import FACEFX
from core_pipeline.settings import Constraint, Settings
from tests.helpers.rigs import NAMES, head


def test_the_crabs_shapes_give_the_crabs_poses():
    crab = load("assets/faces/crab")
    ours = curve_set_json.load("assets/curves/crab.json")
    made = new_curve_set(crab)
    assert set(made.poses) == set(ours.poses)
    assert made.name == "Crab"
    assert not made.bigrams
    assert made.settings.priorities[-1] == "lips shut"
    assert {(c.a, c.b) for c in made.settings.constraints} >= {("mouth open", "lips shut"), ("frown", "smile")}
    assert made.settings.window_of("lips shut") < made.settings.window_of("mouth open")


def test_the_set_is_a_file_that_can_be_read_again():
    made = new_curve_set(load("assets/faces/crab"))
    again = curve_set_json.parse(curve_set_json.dumps(made).encode(), "crab").curve_set
    assert again.poses == made.poses
    assert again.settings == made.settings


def test_the_papers_poses_get_the_papers_constraints():
    made, paper = settings_for(FACEFX), Settings.paper()
    assert {Constraint("open", "PBM", 0.5), Constraint("open", "FV", 0.5)} <= set(made.constraints)
    assert made.priorities[-1] == paper.priorities[-1] == "PBM"
    assert made.windows == paper.windows


def test_names_that_tell_nothing_are_never_constrained():
    made = settings_for(["target 0", "target 1", "xyz"])
    assert made.constraints == made.priorities == ()
    assert made.windows == {}


def test_lids_brows_and_shapes_that_move_nothing_are_no_poses():
    face = head([*NAMES["arkit52"], "still"])
    deltas = face.deltas.copy()
    deltas[-1] = 0
    poses = poses_of(replace(face, deltas=deltas))
    assert "jawOpen" in poses
    assert poses[-1] == "tongueOut"
    assert not [pose for pose in poses if "eye" in pose or "brow" in pose or pose == "still"]


def test_a_rig_that_cannot_speak_or_has_too_much_to_say():
    with pytest.raises(UserError, match="none of its 2 shapes moves the mouth"):
        new_curve_set(head(["blink", "browUp"]))
    with pytest.raises(UserError, match=f"{MAX_POSES + 1} shapes are more poses than a set may have"):
        new_curve_set(head([f"pose {number}" for number in range(MAX_POSES + 1)]))


@given(st.lists(st.text("abcdeopnshutlimwTongue _", min_size=1), min_size=1, max_size=12, unique=True))
def test_any_names_give_settings_that_hold(names):
    made = settings_for(names)
    ranked = {pose: rank for rank, pose in enumerate(made.priorities)}
    assert ranked.keys() <= set(names)
    for constraint in made.constraints:
        assert role_of(constraint.a) != role_of(constraint.b)
        assert {constraint.a, constraint.b} <= ranked.keys()


def test_still_shapes_stay_out_even_with_telling_names():
    face = head(["open", "shut"])
    assert poses_of(replace(face, deltas=np.stack([face.deltas[0], np.zeros_like(face.deltas[1])]))) == ("open",)
