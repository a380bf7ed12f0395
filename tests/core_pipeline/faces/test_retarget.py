"""A rig's names are recognised, and each pose becomes a mix of its shapes; the mix is kept as a file."""

import json
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.errors import UserError
from core_pipeline.faces.affixes import bare_names
from core_pipeline.faces.mapping_json import load_mapping, load_presets, mapping_path, save_mapping
from core_pipeline.faces.retarget import OWN_NAMES, Preset, apply, best, normalised
from core_pipeline.poses import FACEFX
from tests.helpers.rigs import NAMES, PRESETS

BY_NAME = {preset.name: preset for preset in PRESETS}
ARKIT = NAMES["arkit52"]


@pytest.mark.parametrize(
    "other",
    ["mouthSmileLeft", "mouthSmile_L", "mouth smile l", "MOUTH_SMILE_LEFT", "Head.mouthSmileLeft", "a.b.mouthSmile-L",
     "mouthSmileLeft.001", "Face:mouthSmileLeft", "Group|Head|mouthSmileLeft"],
)  # fmt: skip
def test_spellings_of_one_name(other):
    assert normalised(other) == "mouthsmilel"


@pytest.mark.parametrize("around", ["head__{}", "facs_bs_{}_div2", "{}_mesh", "A{n:02d}_{}", "{n}_BS-{}"])
@pytest.mark.parametrize("name", NAMES)
def test_what_all_names_have_around_them_is_no_name(name, around):
    shapes = {around.format(shape, n=number): shape for number, shape in enumerate(NAMES[name])}
    plain, found = best(NAMES[name], PRESETS), best(list(shapes), PRESETS)
    assert found.preset == name
    assert {pose: {shapes[shape]: amount for shape, amount in mix.items()} for pose, mix in found.poses.items()} == {
        pose: dict(mix) for pose, mix in plain.poses.items()
    }


@given(st.lists(st.text("aB1_-", max_size=8), unique=True))
def test_taking_off_what_is_around_leaves_something_of_every_name(names):
    for name, bare in bare_names(names).items():
        assert bare
        assert len(bare) < len(name)


def test_the_visemes_of_oculus_go_without_their_prefix_too():
    bare = [shape.removeprefix("viseme_") for shape in NAMES["oculus15"]]
    made = best(bare, PRESETS)
    assert made.preset == "oculus15"
    assert made.poses["PBM"] == {"PP": 1.0}


def test_japanese_vowels_are_vrms():
    made = best(["あ", "い", "う", "え", "お", "ん", "まばたき"], PRESETS)
    assert (made.preset, made.poses["open"], made.poses["PBM"]) == ("vrm", {"あ": 1.0}, {"ん": 1.0})


def test_sides_are_not_mixed_up_and_other_names_stay_apart():
    assert normalised("mouthSmile_R") == normalised("mouthSmileRight") != normalised("mouthSmile_L")
    assert normalised("mouthSmile") != normalised("mouthSmileLeft")
    assert normalised("CTRL_expressions_jawOpen") == "jawopen"


@pytest.mark.parametrize("name", NAMES)
def test_each_convention_is_recognised_by_its_own_names(name):
    assert best(NAMES[name], PRESETS).preset == name


@pytest.mark.parametrize("name", NAMES)
def test_a_preset_makes_the_lip_poses_from_shapes_it_names(name):
    made = best(NAMES[name], PRESETS)
    assert set(FACEFX[:6]) <= set(made.poses), made.missing
    assert set(made.missing) <= {"tBack", "tRoof", "tTeeth"}
    for mix in made.poses.values():
        assert all(0 < amount <= 1 for amount in mix.values())
    assert set(BY_NAME[name].poses) <= set(FACEFX)


def test_the_mix_for_arkit_is_the_one_in_the_table():
    made = best(ARKIT, PRESETS).poses
    assert made["W"] == {"mouthPucker": 1.0, "jawOpen": 0.1, "mouthFunnel": 0.15}
    assert made["open"] == {
        "jawOpen": 0.9, "mouthLowerDownLeft": 0.25, "mouthLowerDownRight": 0.25,
        "mouthFrownLeft": 0.1, "mouthFrownRight": 0.1,
    }  # fmt: skip
    assert made["FV"]["mouthUpperUpLeft"] == made["FV"]["mouthUpperUpRight"] == 0.45
    assert made["tTeeth"] == {"tongueOut": 0.3}


def test_a_scanned_head_spelled_otherwise():
    """Sides as _L and _R, and brows in two halves, as ICT's heads have them."""
    names = [name.replace("Left", "_L").replace("Right", "_R") for name in ARKIT if name != "browInnerUp"]
    made = best([*names, "browInnerUp_L", "browInnerUp_R"], PRESETS)
    assert made.preset == "arkit52"
    assert made.poses["wide"]["mouthStretch_L"] == 0.45
    assert made.missing == ("tBack", "tRoof")


def test_an_avatar_with_two_conventions_takes_the_one_it_has_more_of():
    assert best([*NAMES["oculus15"], *ARKIT], PRESETS).preset == "arkit52"
    assert best([*NAMES["oculus15"], "jawOpen", "mouthSmile"], PRESETS).preset == "oculus15"


def test_a_rig_with_few_shapes_takes_the_convention_that_makes_most_of_them():
    found = best(("jawOpen", "mouthPucker", "mouthFunnel"), PRESETS)  # one shape for MetaHuman's four is one
    assert found.preset == "arkit52"
    assert {"open", "W", "ShCh"} <= set(found.poses)


def test_vroids_names_are_vrms():
    vowels = [f"Face.M_F00_000_00_Fcl_MTH_{vowel}" for vowel in "AIUEO"]
    names = ["Fcl_ALL_Neutral", "Fcl_ALL_Joy", "Fcl_EYE_Close", "Fcl_MTH_Close"]
    made = best([name.replace("Face.M_F00_000_00_", "Face.") for name in vowels] + names, PRESETS)
    assert made.preset == "vrm"
    assert made.poses["open"] == {"Face.Fcl_MTH_A": 1.0}
    assert made.poses["PBM"] == {"Fcl_MTH_Close": 1.0}


def test_both_sides_in_one_shape_count_once():
    merged = sorted({name.removesuffix("Left").removesuffix("Right") for name in ARKIT})
    made = best(merged, PRESETS)
    assert made.preset == "arkit52"
    assert made.poses["wide"]["mouthSmile"] == 0.35
    assert made.poses["wide"]["mouthStretch"] == 0.45
    assert not any("without" in note for note in made.notes)


def test_several_meshes_that_spell_a_name_differently_move_together():
    made = best(["Head.jawOpen", "Teeth.jawOpen", "mouthPucker"], PRESETS)
    assert made.poses["W"]["Head.jawOpen"] == made.poses["W"]["Teeth.jawOpen"] == 0.1


def test_what_is_lacking_is_said():
    made = best([name for name in ARKIT if name not in ("mouthFunnel", "mouthRollLower", "tongueOut")], PRESETS)
    assert "W is made without mouthFunnel: the rig has no such shape." in made.notes
    assert made.missing == ("ShCh", "tBack", "tRoof", "tTeeth"), "ShCh is nearly all funnel"
    assert made.notes[-1] == "Not available on this face: ShCh, tBack, tRoof, tTeeth."


def test_names_nobody_knows():
    made = best(["smirk", "wink", "Shape 3"], PRESETS)
    assert not made.poses
    assert made.missing == FACEFX
    assert "No naming convention fits these shapes (smirk, wink, Shape 3)" in made.notes[0]


def test_a_pose_set_of_ones_own_is_found_by_name():
    own = ("mouth open", "mouth OO", "bare teeth")
    made = best(["Mouth_Open", "crab.mouthOO", "claw"], PRESETS, own)
    assert made.preset == OWN_NAMES
    assert made.poses == {"mouth open": {"Mouth_Open": 1.0}, "mouth OO": {"crab.mouthOO": 1.0}}
    assert made.missing == ("bare teeth",)


@given(
    st.dictionaries(st.sampled_from(["jawOpen", "mouthClose", "mouthPucker"]), st.floats(0, 1)),
    st.sets(st.sampled_from(["jawOpen", "mouthClose", "mouthPucker"])),
)
def test_the_mouth_is_never_closed_more_than_opened(wanted, shapes):
    made = apply(Preset("p", "p", {"PBM": wanted}), sorted(shapes), ("PBM",))
    mix = made.poses.get("PBM", {})
    assert mix.get("mouthClose", 0) <= mix.get("jawOpen", 0)
    assert mix.get("mouthPucker", 0) in (0, wanted.get("mouthPucker", 0))


def test_the_presets_law_holds_on_arkit():
    mix = best(ARKIT, PRESETS).poses["PBM"]
    assert mix["mouthClose"] == mix["jawOpen"] == 0.08


# --- files


NAME = st.text(min_size=1, max_size=8)


@given(st.dictionaries(NAME, st.dictionaries(NAME, st.floats(-4, 4), max_size=4), max_size=4))
def test_a_mapping_comes_back_as_it_was_saved(tmp_path_factory, poses):
    rig = tmp_path_factory.mktemp("rig") / "head.glb"
    try:
        json.dumps(poses, ensure_ascii=False).encode()
    except UnicodeEncodeError:
        return
    path = save_mapping(rig, "arkit52", poses)
    assert path == rig.with_name("head.glb.lipstitch.json") == mapping_path(rig)
    assert load_mapping(rig) == ("arkit52", poses)


def test_nothing_saved_is_no_mapping(tmp_path):
    assert load_mapping(tmp_path / "head.glb") is None


def test_amounts_out_of_reach_are_not_saved(tmp_path):
    for amount in (5.0, float("nan")):
        with pytest.raises(ValueError, match="jawOpen"):
            save_mapping(tmp_path / "head.glb", "x", {"open": {"jawOpen": amount}})
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    "text",
    ["", "{", "[]", '{"format": "lipstitch-face.1"}', '{"format": "lipstitch-mapping.1"}',
     '{"format": "lipstitch-mapping.1", "poses": []}', '{"format": "lipstitch-mapping.1", "poses": {"open": 1}}',
     '{"format": "lipstitch-mapping.1", "poses": {"open": {"a": "b"}}}',
     '{"format": "lipstitch-mapping.1", "poses": {"open": {"a": 1e9}}}',
     '{"format": "lipstitch-mapping.1", "poses": {"open": {"a": NaN}}}',
     '{"format": "lipstitch-mapping.1", "poses": {"open": {"a": true}}}',
     '{"format": "lipstitch-mapping.1", "preset": 3, "poses": {}}', "\udcff"],
)  # fmt: skip
def test_a_damaged_mapping_is_refused_by_name(tmp_path, text):
    rig = tmp_path / "head.glb"
    mapping_path(rig).write_bytes(text.encode(errors="surrogateescape"))
    with pytest.raises(UserError, match=r"head\.glb\.lipstitch\.json"):
        load_mapping(rig)


def test_damaged_presets_are_refused(tmp_path):
    with pytest.raises(UserError, match="no retarget presets"):
        load_presets(tmp_path)
    for spoiled in ('"title": 1', '"names": "jawOpen"', '"aliases": {"a": 1}'):
        rest = {"title": '"title": "T"', "names": '"names": []', "aliases": '"aliases": {}'}
        rest[spoiled.split('"')[1]] = spoiled
        text = f'{{"format": "lipstitch-retarget.1", "poses": {{}}, {", ".join(rest.values())}}}'
        Path(tmp_path / "p.json").write_text(text)
        with pytest.raises(UserError, match=r"p\.json: its title, names or aliases"):
            load_presets(tmp_path)
