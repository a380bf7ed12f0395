"""Any face opened: put upright, framed on its head, its poses made, its oddities told; kept for the next time."""

import json
from dataclasses import replace

import numpy as np
import pytest

from core_pipeline.errors import UserError
from core_pipeline.faces.face import Camera
from core_pipeline.faces.face_folder import save
from core_pipeline.faces.framing import frame, head_camera, turned_upright
from core_pipeline.faces.mapping_json import mapping_path, save_mapping
from core_pipeline.faces.open_face import open_face
from core_pipeline.faces.retarget import OWN_NAMES
from core_pipeline.faces.rigs import rig_cache
from core_pipeline.faces.texture import Material, Texture
from core_pipeline.faces.view import View
from core_pipeline.poses import FACEFX
from tests.helpers.gltf import tetrahedron
from tests.helpers.pictures import png, textured
from tests.helpers.rigs import BACKWARDS, NAMES, PRESETS, Z_UP, as_glb, as_objs, head, moved

ARKIT = head(["jawOpen", *(name for name in NAMES["arkit52"] if name != "jawOpen")])
UPRIGHT = np.eye(3, dtype=np.float32)


def opened(path, **more):
    return open_face(path, PRESETS, **more)


def refused(path, **more):
    with pytest.raises(UserError) as caught:
        opened(path, **more)
    assert path.name in str(caught.value)
    return str(caught.value)


# --- what can be opened


def test_a_glb_gets_the_poses_of_its_convention(tmp_path):
    found = opened(as_glb(ARKIT, tmp_path / "head.glb"))
    assert found.retarget.preset == "arkit52"
    assert found.face.title == "head"
    assert found.face.mix("W") == {"mouthPucker": 1.0, "jawOpen": 0.1, "mouthFunnel": 0.15}
    assert found.retarget.missing == ("tBack", "tRoof")
    assert found.notes == ("Not available on this face: tBack, tRoof.",)
    amounts = np.eye(9, dtype=np.float32) @ found.face.retarget(FACEFX)
    assert amounts[FACEFX.index("open"), found.face.shapes.index("jawOpen")] == pytest.approx(0.9)
    assert not amounts[FACEFX.index("tBack")].any()


@pytest.mark.parametrize("suffix", [".glb", ".GLB", ".vrm"])
def test_endings_of_binary_gltf(tmp_path, suffix):
    path = as_glb(ARKIT, tmp_path / "head.glb").rename(tmp_path / f"avatar{suffix}")
    assert opened(path).face.title == "avatar"


def test_a_folder_of_objs_and_a_file_of_the_same_head_are_one_face(tmp_path):
    objs, glb = opened(as_objs(head(), tmp_path / "poses")), opened(as_glb(head(), tmp_path / "poses.glb"))
    np.testing.assert_allclose(objs.face.positions, glb.face.positions, atol=1e-5)
    assert objs.retarget.preset == glb.retarget.preset == "arkit52"
    assert objs.face.camera.distance == pytest.approx(glb.face.camera.distance, rel=1e-4)


def test_one_of_our_folders_keeps_its_own_camera_and_poses(tmp_path):
    face = replace(ARKIT, camera=Camera(distance=3.25), pose_map={"open": {"jawOpen": 0.5}}, title="Ours")
    save(face, tmp_path / "ours")
    found = opened(tmp_path / "ours")
    assert found.face.camera == Camera(distance=3.25)
    assert found.retarget.poses == {"open": {"jawOpen": 0.5}}
    assert found.retarget.preset == OWN_NAMES
    assert found.retarget.missing == FACEFX[1:]
    assert found.face.title == "Ours"


def test_a_pose_set_of_its_own(tmp_path):
    found = opened(as_glb(head(["mouth open", "bare teeth"]), tmp_path / "crab.glb"), poses=("mouth open", "smile"))
    assert found.retarget.preset == OWN_NAMES
    assert found.retarget.missing == ("smile",)
    assert found.face.mix("mouth open") == {"mouth open": 1.0}


def test_what_cannot_be_opened(tmp_path):
    (tmp_path / "empty").mkdir()
    assert "neither a face.glb nor any .obj" in refused(tmp_path / "empty")
    for name, why in (("head.fbx", "export it as .glb"), ("one.obj", "choose its folder"), ("bad.glb", "not a glTF")):
        (tmp_path / name).write_text("x")
        assert why in refused(tmp_path / name)
    assert "cannot be read" in refused(tmp_path / "nowhere.glb")


@pytest.mark.parametrize("kind", [as_glb, as_objs])
def test_opening_can_be_cancelled(tmp_path, kind):
    assert "cancelled" in refused(kind(head(), tmp_path / "head.glb"), cancelled=lambda: True)


# --- upright, from the front, framed on the head


def looks_alike(found, reference):
    """The same picture: the mesh seen from its camera, in units of the distance."""
    for face, other in ((found, reference),):
        a, b = (
            (View.of(f.camera).matrix() @ np.c_[f.positions, np.ones(len(f.positions))].T)[:3] / f.camera.distance
            for f in (face, other)
        )
        np.testing.assert_allclose(a, b, atol=2e-3)


@pytest.mark.parametrize(("scale", "shift"), [(100, (0, 0, 0)), (0.01, (0, 1.6, 0)), (1000, (-50, 70, 30))])
@pytest.mark.parametrize(
    ("turn", "told"),
    [(UPRIGHT, []), (Z_UP, ["z up"]), (BACKWARDS, ["backwards"]), (Z_UP @ BACKWARDS, ["z up", "backwards"])],
    ids=["upright", "z up", "backwards", "both"],
)
def test_any_unit_place_and_direction_gives_the_same_picture(tmp_path, scale, shift, turn, told):
    face = moved(ARKIT, turn, scale, shift)
    found = opened(as_glb(face, tmp_path / "head.glb"))
    said = [note for note in found.notes if "shown turned" in note]
    assert len(said) == len(told)
    assert all(word in note for word, note in zip(told, said, strict=True))
    looks_alike(found.face, opened(as_glb(ARKIT, tmp_path / "plain.glb")).face)


def test_an_avatars_head_fills_the_picture_not_its_body():
    body = np.float32([[x, y, z] for x in (-2, 2) for y in (-9, -1.5) for z in (-1, 1)])
    face = replace(
        ARKIT,
        positions=np.concatenate([ARKIT.positions, body]),
        deltas=np.concatenate([ARKIT.deltas, np.zeros((52, 8, 3), np.float32)], axis=1),
    )
    near, whole = head_camera(face), frame(face.positions)
    assert near.distance < whole.distance / 2
    assert abs(near.target[1]) < 1
    assert whole.target[1] < -3


def test_a_rig_at_rest_for_ever_is_left_alone():
    still = replace(ARKIT, deltas=np.zeros_like(ARKIT.deltas))
    assert turned_upright(still) == (still, ())
    assert head_camera(still) == frame(still.positions)


# --- warnings


def test_shapes_and_poses_that_move_nothing(tmp_path):
    deltas = ARKIT.deltas.copy()
    deltas[1:] = 0
    found = opened(as_glb(replace(ARKIT, deltas=deltas), tmp_path / "head.glb"))
    assert any(note.startswith("51 shapes move nothing: browDownLeft") for note in found.notes)
    assert "2 poses move nothing: wide, tTeeth." in found.notes


@pytest.mark.parametrize("name", ["viseme_sil", "vrc.v_sil", "sil", "Fcl_ALL_Neutral", "Basis", "head_neutral"])
def test_what_is_there_to_move_nothing_is_not_odd(tmp_path, name):
    face = replace(
        ARKIT,
        shapes=(*ARKIT.shapes, name),
        deltas=np.concatenate([ARKIT.deltas, np.zeros((1, len(ARKIT.positions), 3), np.float32)]),
        normal_deltas=np.concatenate([ARKIT.normal_deltas, np.zeros((1, len(ARKIT.positions), 3), np.float32)]),
    )
    assert not any("nothing" in note for note in opened(as_glb(face, tmp_path / "head.glb")).notes)


def test_shapes_no_convention_knows_are_of_the_person_when_the_file_sets_them(tmp_path):
    gltf = tetrahedron()
    gltf.primitive()["targets"] *= 2
    gltf.mesh()["extras"]["targetNames"] = ["jawOpen", "age"]
    gltf.mesh()["weights"] = [0.5, 1]
    (tmp_path / "head.glb").write_bytes(gltf.glb())
    found = opened(tmp_path / "head.glb")
    assert found.face.positions[:, 1].sum() == pytest.approx(2), "the lifted corner stays up"
    assert any(note.endswith("part of the neutral face: age.") for note in found.notes)
    assert any(note.endswith("left out of the neutral face: jawOpen.") for note in found.notes)


def test_motion_beyond_the_head(tmp_path):
    deltas = ARKIT.deltas.copy()
    deltas[ARKIT.shapes.index("mouthLeft"), 40] = (0, 0, 30)
    found = opened(as_glb(replace(ARKIT, deltas=deltas), tmp_path / "head.glb"))
    assert any(note.startswith("1 shape moves farther than the head is high: mouthLeft") for note in found.notes)


# --- a mapping saved beside the rig


@pytest.mark.parametrize("kind", [as_glb, as_objs])
def test_a_saved_mapping_comes_first(tmp_path, kind):
    path = kind(head(), tmp_path / "head.glb")
    save_mapping(path, "arkit52", {"open": {"jawOpen": 0.4}})
    found = opened(path)
    assert found.face.pose_map == found.retarget.poses == {"open": {"jawOpen": 0.4}}
    assert found.retarget.preset == "arkit52"
    assert found.retarget.missing == FACEFX[1:]


def test_a_mapping_for_shapes_that_are_gone(tmp_path):
    path = as_glb(head(), tmp_path / "head.glb")
    save_mapping(path, "own", {"open": {"jawOpen": 1, "old": 1}, "W": {"old": 1}})
    found = opened(path)
    assert found.retarget.poses == {"open": {"jawOpen": 1.0}}
    assert "head.glb.lipstitch.json uses shapes this face does not have (old): they are left out." in found.notes


def test_a_mapping_made_for_another_pose_set_does_not_count(tmp_path):
    path = as_glb(head(["mouth open", "bare teeth"]), tmp_path / "crab.glb")
    save_mapping(path, "own names", {"open": {"mouth open": 1}})
    assert opened(path).retarget.poses == {"open": {"mouth open": 1.0}}
    assert opened(path, poses=("mouth open", "bare teeth")).retarget.missing == ()


def test_a_damaged_mapping_is_a_sentence(tmp_path):
    path = as_glb(head(), tmp_path / "head.glb")
    mapping_path(path).write_text("{")
    assert "damaged" in refused(path)


# --- the cache


def cached(tmp_path):
    return {"cache": tmp_path / "cache"}


@pytest.mark.parametrize("kind", [as_glb, as_objs])
def test_the_second_time_gives_the_same_face_without_reading_the_rig(tmp_path, kind, monkeypatch):
    path = kind(moved(ARKIT, Z_UP, 10), tmp_path / "head.glb")
    first = opened(path, **cached(tmp_path))
    monkeypatch.setattr("core_pipeline.faces.open_face._read", None)
    second = opened(path, **cached(tmp_path))
    for name in ("positions", "normals", "triangles", "colours", "deltas", "normal_deltas"):
        mine, theirs = getattr(second.face, name), getattr(first.face, name)
        np.testing.assert_array_equal(mine, theirs, err_msg=name)
        assert mine.dtype == theirs.dtype
    for name in ("name", "title", "shapes", "parts", "camera"):
        assert getattr(second.face, name) == getattr(first.face, name)
    assert second.notes == first.notes
    assert second.retarget == first.retarget


@pytest.mark.parametrize("wraps", [(10497,), (33071, 10497), (33648, 33071, 10497)])
def test_pictures_are_kept_bit_for_bit(tmp_path, monkeypatch, wraps):
    pixels = np.random.default_rng(1).integers(0, 256, (5, 7, 4))
    gltf = textured(png(pixels), alphaMode="BLEND")
    gltf.json["samplers"] = [{"wrapS": wrap} for wrap in wraps]
    gltf.json["textures"] = [{"source": 0, "sampler": number} for number in range(len(wraps))]
    surfaces = [{"baseColorTexture": {"index": number}} for number in range(len(wraps))]
    mask = {"alphaMode": "MASK", "alphaCutoff": 0.1}
    gltf.json["materials"] += [{"pbrMetallicRoughness": surface} | mask for surface in surfaces]
    gltf.mesh()["primitives"] = [
        {**gltf.primitive(), "material": number} for number in range(len(gltf.json["materials"]))
    ]
    path = tmp_path / "head.glb"
    path.write_bytes(gltf.glb())
    first = opened(path, **cached(tmp_path)).face
    monkeypatch.setattr("core_pipeline.faces.open_face._read", None)
    second = opened(path, **cached(tmp_path)).face
    assert second.materials == first.materials
    assert {material.soft for material in second.materials.values()} == {True, False}
    assert [texture.wrap for texture in second.textures] == [texture.wrap for texture in first.textures]
    assert len(second.textures) == len(wraps)
    assert len({id(texture.picture) for texture in second.textures}) == 1, "one picture stays one"
    np.testing.assert_array_equal(second.textures[0].picture, pixels)
    np.testing.assert_array_equal(second.texcoords, first.texcoords)
    assert second.texcoords.dtype == np.float32


def test_a_rig_without_pictures_is_kept_without(tmp_path, monkeypatch):
    path = as_glb(head(), tmp_path / "head.glb")
    opened(path, **cached(tmp_path))
    monkeypatch.setattr("core_pipeline.faces.open_face._read", None)
    face = opened(path, **cached(tmp_path)).face
    assert (face.textures, face.materials, face.texcoords) == ((), {}, None)


def test_a_rig_whose_pictures_are_too_large_is_not_kept(tmp_path, monkeypatch):
    path = tmp_path / "head.glb"
    path.write_bytes(textured(png(np.zeros((64, 64, 3)))).glb())
    monkeypatch.setattr(rig_cache, "MAX_FILE", 64 * 64 * 4)
    opened(path, **cached(tmp_path))
    assert rig_cache.recall(path, tmp_path / "cache") is None
    monkeypatch.setattr(rig_cache, "MAX_FILE", 64 * 64 * 5)
    opened(path, **cached(tmp_path))
    assert rig_cache.recall(path, tmp_path / "cache") is not None


def test_turned_upright_a_rig_keeps_its_pictures():
    lying = {
        "textures": (Texture(np.zeros((1, 1, 4), np.uint8)),),
        "parts": {"head": (0, 20)},
        "materials": {"head": Material(0, 0.5)},
        "texcoords": ARKIT.positions[:, :2],
    }
    face, told = turned_upright(replace(moved(ARKIT, BACKWARDS), **lying))
    assert told
    for name, value in lying.items():
        assert getattr(face, name) is value, name


def test_a_changed_rig_is_read_again(tmp_path):
    path = as_glb(head(), tmp_path / "head.glb")
    opened(path, **cached(tmp_path))
    as_glb(head(["jawOpen", "smirk", "blink"]), path)
    assert opened(path, **cached(tmp_path)).face.shapes == ("jawOpen", "smirk", "blink")
    folder = as_objs(head(), tmp_path / "poses")
    opened(folder, **cached(tmp_path))
    (folder / "smirk.obj").write_text((folder / "neutral.obj").read_text())
    assert "smirk" in opened(folder, **cached(tmp_path)).face.shapes


def test_a_file_beside_a_gltf_counts_too(tmp_path):
    glb = as_glb(head(), tmp_path / "head.glb").read_bytes()
    size = int.from_bytes(glb[12:16], "little")
    document = json.loads(glb[20 : 20 + size])
    document["buffers"][0]["uri"] = "head.bin"
    (tmp_path / "head.gltf").write_text(json.dumps(document))
    data = bytearray(glb[28 + size :])
    (tmp_path / "head.bin").write_bytes(data)
    first = opened(tmp_path / "head.gltf", **cached(tmp_path)).face
    data[:4] = np.float32(0.25).tobytes()
    (tmp_path / "head.bin").write_bytes(bytes(data) + b"\0")
    assert opened(tmp_path / "head.gltf", **cached(tmp_path)).face.positions[0, 0] == 0.25 != first.positions[0, 0]


def test_a_spoiled_cache_is_made_again(tmp_path):
    path = as_glb(head(), tmp_path / "head.glb")
    first = opened(path, **cached(tmp_path))
    (kept,) = (tmp_path / "cache").iterdir()
    whole = kept.read_bytes()
    for spoiled in (b"", b"PK", whole[: len(whole) // 2], whole[:200] + b"\xff" * 40 + whole[240:]):
        kept.write_bytes(spoiled)
        again = opened(path, **cached(tmp_path))
        np.testing.assert_array_equal(again.face.deltas, first.face.deltas)


def test_a_cache_that_cannot_be_written_is_no_hindrance(tmp_path):
    (tmp_path / "cache").write_text("a file, not a folder")
    assert opened(as_glb(head(), tmp_path / "head.glb"), **cached(tmp_path)).face.shapes == head().shapes


def test_the_cache_does_not_grow_for_ever(tmp_path, monkeypatch):
    rigs = [as_glb(head(), tmp_path / f"{name}.glb") for name in "abc"]
    opened(rigs[0], **cached(tmp_path))
    (one,) = (tmp_path / "cache").iterdir()
    monkeypatch.setattr(rig_cache, "MAX_KEPT", int(2.5 * one.stat().st_size))
    for rig in rigs[1:]:
        opened(rig, **cached(tmp_path))
    assert len(list((tmp_path / "cache").iterdir())) == 2
    assert rig_cache.recall(rigs[2], tmp_path / "cache") is not None
    assert rig_cache.recall(rigs[0], tmp_path / "cache") is None
