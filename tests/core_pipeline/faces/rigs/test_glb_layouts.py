"""Avatars as exporters write them: names anywhere, instances without end, and files spoiled on purpose."""

import random
import time

import numpy as np
import pytest

from core_pipeline.errors import UserError
from core_pipeline.faces.rigs import glb
from core_pipeline.faces.rigs.glb import read_glb, read_rig
from tests.helpers.gltf import Gltf, tetrahedron
from tests.helpers.meshopt_streams import packed_tetrahedron
from tests.helpers.pictures import png, textured


def read(tmp_path, gltf, name="face.glb"):
    (tmp_path / name).write_bytes(gltf.glb() if isinstance(gltf, Gltf) else gltf)
    return read_glb(tmp_path / name)


def notes(tmp_path, gltf):
    (tmp_path / "face.glb").write_bytes(gltf.glb())
    return read_rig(tmp_path / "face.glb")[2]


def refused(tmp_path, gltf, name="face.glb"):
    with pytest.raises(UserError, match=rf"^{name}: ") as caught:
        read(tmp_path, gltf, name)
    assert "\n" not in str(caught.value)
    return str(caught.value)


# --- names


def test_names_on_the_primitive(tmp_path):
    gltf = tetrahedron()
    gltf.primitive()["extras"] = gltf.mesh().pop("extras")
    assert read(tmp_path, gltf).shapes == ("up",)


def test_primitives_that_share_all_vertices_keep_their_own(tmp_path, monkeypatch):
    gltf = tetrahedron()
    first = gltf.primitive()
    corners = ([0, 2, 1], [1, 2, 3])
    gltf.mesh()["primitives"] = [
        first | {"indices": gltf.accessor(np.array(own, np.uint16)[:, None])} for own in corners
    ]
    monkeypatch.setattr(glb, "MAX_VERTICES", 6)
    face = read(tmp_path, gltf)
    points = tetrahedron().points()
    for (start, count), own in zip(face.parts.values(), corners, strict=True):
        mine = face.triangles[start : start + count].ravel()
        np.testing.assert_allclose(face.positions[mine], points[own])
        np.testing.assert_allclose(face.deltas[0][mine, 1], [0, 0, float(own[2] == 3)])
    assert len(face.positions) == 6


@pytest.mark.parametrize("key", ["extra", "extras"])
def test_names_on_the_targets_themselves(tmp_path, key):
    gltf = tetrahedron()
    del gltf.mesh()["extras"]
    gltf.primitive()["targets"] = [gltf.primitive()["targets"][0] | {key: {"name": name}} for name in ("A", "O")]
    assert read(tmp_path, gltf).shapes == ("A", "O")
    assert notes(tmp_path, gltf) == ()
    del gltf.primitive()["targets"][1][key]["name"]
    assert read(tmp_path, gltf).shapes == ("target 0", "target 1")


def test_names_on_their_accessors(tmp_path):
    gltf = tetrahedron()
    del gltf.mesh()["extras"]
    gltf.json["accessors"][gltf.primitive()["targets"][0]["POSITION"]]["name"] = "jawOpen"
    assert read(tmp_path, gltf).shapes == ("jawOpen",)


def test_missing_and_doubled_names_are_told(tmp_path):
    gltf = tetrahedron()
    gltf.primitive()["targets"] *= 3
    gltf.mesh()["extras"]["targetNames"] = ["up", "up", "up (2)"]
    assert read(tmp_path, gltf).shapes == ("up", "up (2)", "up (2) (2)")
    assert any("several shapes named “up”" in note for note in notes(tmp_path, gltf))
    del gltf.mesh()["extras"]
    assert read(tmp_path, gltf).shapes == ("target 0", "target 1", "target 2")
    assert any("targetNames is missing" in note for note in notes(tmp_path, gltf))
    gltf.add_mesh(gltf.points(), [0, 1, 2], {"a": gltf.points(), "b": gltf.points(), "c": gltf.points()}, "other")
    del gltf.json["meshes"][1]["extras"]
    assert notes(tmp_path, gltf) == ("2 meshes do not name their shapes (targetNames is missing): they are numbered.",)
    assert notes(tmp_path, tetrahedron()) == ()


# --- sizes


def test_instances_of_one_mesh_are_counted_before_they_are_read(tmp_path, monkeypatch):
    gltf = tetrahedron()
    gltf.json["nodes"] = [{"mesh": 0} for _ in range(30)]
    gltf.json["scenes"][0]["nodes"] = list(range(30))
    assert len(read(tmp_path, gltf).positions) == 120
    monkeypatch.setattr(glb, "MAX_VERTICES", 119)
    assert "120 vertices, more than 119" in refused(tmp_path, gltf)
    monkeypatch.setattr(glb, "MAX_PARTS", 29)
    assert "more than 29 parts" in refused(tmp_path, gltf)


def test_a_description_of_millions_of_nothings_is_not_read(tmp_path):
    nothings = b'{"asset": {"version": "2.0"}, "nodes": [' + b"[]," * 2_000_000 + b"{}]}"
    assert "more than 1,000,000 entries" in refused(tmp_path, nothings)


def test_it_tells_how_far_it_is_and_can_be_ended_there(tmp_path):
    shares = []

    def told(share):
        shares.append(share)
        if len(shares) == end:
            raise UserError("cancelled")

    (tmp_path / "face.glb").write_bytes(everything().glb())
    end = 0
    read_rig(tmp_path / "face.glb", told)
    whole = shares.copy()
    assert whole == sorted(whole)
    assert (whole[0], len(whole)) == (0, 8)
    for end in range(1, 9):
        shares.clear()
        with pytest.raises(UserError, match="cancelled"):
            read_rig(tmp_path / "face.glb", told)
        assert len(shares) == end


# --- spoiled files


def everything():
    """One file with a skin, a see-through picture, a sparse and a packed shape, two meshes and vertex colours."""
    gltf = packed_tetrahedron()
    dressed = textured(png(np.full((2, 2, 4), 200)), alphaMode="MASK", alphaCutoff=0.3)
    texture = dressed.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]
    texture["extensions"] = {"KHR_texture_transform": {"offset": [0, 1], "rotation": 1.5, "scale": [2, 0.5]}}
    dressed.json["samplers"] = [{"wrapS": 33071, "wrapT": 33648}]
    dressed.json["textures"][0]["sampler"] = 0
    base = len(gltf.data)
    first_view, first_accessor = len(gltf.json["bufferViews"]), len(gltf.json["accessors"])
    gltf.data += dressed.data
    for view in dressed.json["bufferViews"]:
        gltf.json["bufferViews"].append({**view, "byteOffset": view["byteOffset"] + base})
    for accessor in dressed.json["accessors"]:
        gltf.json["accessors"].append({**accessor, "bufferView": accessor["bufferView"] + first_view})
    mesh = dressed.json["meshes"][0]
    primitive = mesh["primitives"][0]
    primitive["attributes"] = {name: index + first_accessor for name, index in primitive["attributes"].items()}
    primitive["indices"] += first_accessor
    primitive["targets"] = [{"POSITION": gltf.sparse(4, [3], np.array([[0, 1, 0]], np.float32))}]
    primitive["attributes"]["JOINTS_0"] = gltf.accessor(np.array([[0, 1, 0, 0]] * 4, np.uint8))
    primitive["attributes"]["WEIGHTS_0"] = gltf.accessor(np.array([[0.5, 0.5, 0, 0]] * 4, np.float32))
    primitive["attributes"]["COLOR_0"] = gltf.accessor(np.full((4, 4), 200, np.uint8), normalized=True)
    gltf.json["meshes"].append(mesh)
    gltf.json["images"] = [{"bufferView": dressed.json["images"][0]["bufferView"] + first_view}]
    for part in ("textures", "samplers", "materials"):
        gltf.json[part] = dressed.json[part]
    gltf.json["skins"] = [
        {"joints": [2, 3], "inverseBindMatrices": gltf.accessor(np.tile(np.eye(4, dtype=np.float32).ravel(), (2, 1)))}
    ]
    gltf.json["nodes"] += [{"mesh": 1, "skin": 0}, {"translation": [0, 2, 0], "children": [3]}, {"scale": [2, 1, 1]}]
    gltf.json["scenes"][0]["nodes"] = [0, 1, 2]
    gltf.json["buffers"][0]["byteLength"] = len(gltf.data)
    return gltf


def test_everything_at_once(tmp_path):
    face = read(tmp_path, everything())
    assert face.shapes == ("up",)
    assert [texture.wrap for texture in face.textures] == [("clamp", "mirror")]
    assert [material.cutoff for material in face.materials.values()] == [0.3]
    corners = {tuple(corner) for corner in face.positions.tolist()}
    assert {(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)} <= corners
    assert {tuple(delta) for delta in face.deltas[0].tolist()} >= {(0, 0, 0), (0, 1, 0)}


def spoil_bytes(chance):
    raw = bytearray(everything().glb())
    for _ in range(chance.randint(1, 3)):
        raw[chance.randrange(len(raw))] = chance.randrange(256)
    if chance.random() < 0.2:
        del raw[chance.randrange(len(raw)) :]
    return bytes(raw)


def spoil_values(chance):
    """One to three values somewhere in the description become something else."""
    gltf = everything()
    for _ in range(chance.randint(1, 3)):
        at = gltf.json
        while True:
            key = chance.choice(list(at) if isinstance(at, dict) else range(len(at)))
            if isinstance(at[key], dict | list) and at[key] and chance.random() < 0.85:
                at = at[key]
                continue
            junk = [None, True, -1, 0, 1, 3, 7, 2**31, 2**63, 1e300, 0.5, "", "x", [], {}, [0], [[1]], {"mesh": 0}]
            if chance.random() < 0.2 and isinstance(at, dict):
                del at[key]
            else:
                at[key] = chance.choice(junk)
            break
        if not gltf.json:
            break
    return gltf.glb()


@pytest.mark.parametrize("spoil", [spoil_bytes, spoil_values])
def test_a_spoiled_file_is_a_face_or_a_sentence_and_soon(tmp_path, spoil):
    chance = random.Random(2013)
    path = tmp_path / "face.glb"
    sentences, faces = set(), 0
    for number in range(150):
        path.write_bytes(spoil(chance))
        begun = time.monotonic()
        try:
            face = read_glb(path)
        except UserError as error:
            sentences.add(str(error))
        else:
            faces += 1
            assert np.isfinite(face.positions).all()
            assert np.isfinite(face.normals).all()
            assert np.isfinite(face.deltas).all()
            assert face.triangles.max() < len(face.positions)
            assert face.texcoords is None or np.isfinite(face.texcoords).all()
        assert time.monotonic() - begun < 2, f"file {number}"
    assert faces > 10, "some damage does not matter"
    assert len(sentences) > 20, "and much of it does"
    assert all(sentence.startswith("face.glb: ") and sentence.isprintable() for sentence in sentences)
