"""VRM avatars speak whatever their morph targets are called: the file says which make aa, ih, ou, ee and oh."""

import numpy as np
import pytest

from core_pipeline.errors import UserError
from core_pipeline.faces.open_face import open_face
from core_pipeline.faces.retarget import best
from core_pipeline.faces.rigs.glb import read_glb
from tests.helpers.gltf import tetrahedron
from tests.helpers.rigs import PRESETS

ODD = ("ブレンド", "k017", "lower", "k017.001")


def avatar():
    """Four oddly named shapes on one mesh, and a mesh without any before it in the list of nodes."""
    gltf = tetrahedron()
    primitive = gltf.primitive()
    deltas = [np.eye(4, 3, -row).astype(np.float32) * (1 + row) for row in range(4)]
    primitive["targets"] = [{"POSITION": gltf.accessor(delta)} for delta in deltas]
    gltf.mesh()["extras"]["targetNames"] = list(ODD)
    gltf.json["nodes"].insert(0, {"name": "root", "children": [1]})
    gltf.json["scenes"][0]["nodes"] = [0]
    return gltf


def vrm0(groups):
    gltf = avatar()
    gltf.json["extensions"] = {"VRM": {"blendShapeMaster": {"blendShapeGroups": groups}}}
    return gltf


def vrm1(preset, custom=None):
    gltf = avatar()
    gltf.json["extensions"] = {"VRMC_vrm": {"expressions": {"preset": preset, "custom": custom or {}}}}
    return gltf


OLD = [
    {"name": "A", "presetName": "a", "binds": [{"mesh": 0, "index": 0, "weight": 100}]},
    {"name": "U", "presetName": "u", "binds": [{"mesh": 0, "index": 1, "weight": 50}, {"mesh": 0, "index": 2}]},
    {"name": "Close", "presetName": "unknown", "binds": [{"mesh": 0, "index": 3, "weight": 100}]},
    {"name": "Blink", "presetName": "blink", "binds": []},
]
NEW = {
    "aa": {"morphTargetBinds": [{"node": 1, "index": 0, "weight": 1}]},
    "ou": {"morphTargetBinds": [{"node": 1, "index": 1, "weight": 0.5}, {"node": 1, "index": 2, "weight": 1}]},
    "blink": {"isBinary": True},
}
CUSTOM = {"close": {"morphTargetBinds": [{"node": 1, "index": 3, "weight": 1.0}]}}


@pytest.mark.parametrize("gltf", [vrm0(OLD), vrm1(NEW, CUSTOM)], ids=["VRM 0", "VRM 1"])
def test_its_binds_make_the_poses(tmp_path, gltf):
    (tmp_path / "avatar.vrm").write_bytes(gltf.glb())
    found = open_face(tmp_path / "avatar.vrm", PRESETS, cache=tmp_path / "cache")
    assert found.retarget.preset == "vrm"
    assert found.face.mix("open") == {ODD[0]: 1.0}
    assert found.face.mix("W") == {ODD[1]: 0.5, ODD[2]: 1.0}
    assert found.face.mix("PBM") == {ODD[3]: 1.0}
    assert found.retarget.missing == ("FV", "wide", "tBack", "tRoof", "tTeeth")
    again = open_face(tmp_path / "avatar.vrm", PRESETS, cache=tmp_path / "cache")
    assert again.face.expressions == found.face.expressions
    assert again.retarget == found.retarget


def test_shapes_named_as_arkit_names_them_come_before_five_vowels():
    arkit = next(preset for preset in PRESETS if preset.name == "arkit52")
    made = best(sorted(arkit.names), PRESETS, expressions={"aa": {"jawOpen": 0.7}, "ou": {"mouthPucker": 1}})
    assert made.preset == "arkit52"


@pytest.mark.parametrize("prefix", ["", "Face.M_F00_000_00_", "Face.", "F00_000_"])
def test_vroids_names(prefix):
    shapes = [f"{prefix}{name}" for name in ("Fcl_MTH_A", "Fcl_MTH_I", "Fcl_MTH_U", "Fcl_MTH_E", "Fcl_MTH_Close")]
    made = best(shapes, PRESETS)
    assert made.preset == "vrm"
    assert made.poses["open"] == {f"{prefix}Fcl_MTH_A": 1.0}
    assert made.poses["ShCh"] == {f"{prefix}Fcl_MTH_U": 0.5, f"{prefix}Fcl_MTH_E": 0.4}


@pytest.mark.parametrize(
    "gltf",
    [
        vrm0([{"presetName": "a", "binds": [{"mesh": 0, "index": 99, "weight": 100}]}]),
        vrm0([{"presetName": "a", "binds": [{"mesh": 7, "index": 0, "weight": 100}]}]),
        vrm1({"aa": {"morphTargetBinds": [{"node": 0, "index": 0, "weight": 1}]}}),
        vrm1({}),
    ],
)
def test_binds_to_nothing_are_no_expression(tmp_path, gltf):
    (tmp_path / "avatar.vrm").write_bytes(gltf.glb())
    assert read_glb(tmp_path / "avatar.vrm").expressions == {}


@pytest.mark.parametrize(
    "gltf",
    [
        vrm0([{"presetName": "a", "binds": [{"mesh": "x", "index": 0}]}]),
        vrm0([{"presetName": "a", "binds": [{"mesh": 0, "index": -1}]}]),
        vrm0([{"presetName": "a", "binds": 3}]),
        vrm0({}),
        vrm1({"aa": []}),
        vrm1({"aa": {"morphTargetBinds": [{"node": 99, "index": 0}]}}),
        vrm1({"aa": {"morphTargetBinds": [{"node": 1, "index": 0, "weight": "much"}]}}),
        vrm1(None),
    ],
)
def test_damage_is_a_sentence(tmp_path, gltf):
    (tmp_path / "avatar.vrm").write_bytes(gltf.glb())
    with pytest.raises(UserError, match=r"^avatar\.vrm: .*export the file again\.$"):
        read_glb(tmp_path / "avatar.vrm")
