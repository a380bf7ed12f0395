"""Avatars as exporters write them: pictures, see-through cards, names anywhere, and files spoiled on purpose."""

import base64
import io
import random
import sys
import time
import zlib

import numpy as np
import pytest
from PIL import Image

from core_pipeline.errors import UserError
from core_pipeline.faces import glb
from core_pipeline.faces.glb import read_glb, read_rig
from tests.helpers.gltf import Gltf, tetrahedron
from tests.helpers.meshopt_streams import packed_tetrahedron


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


# --- pictures


def png(pixels, kind="PNG"):
    out = io.BytesIO()
    Image.fromarray(np.array(pixels, np.uint8)).save(out, kind, **({"lossless": True} if kind == "WEBP" else {}))
    return out.getvalue()


#: red above green, blue beside: top left, top right, bottom left, bottom right
FOUR = png([[[255, 0, 0], [0, 0, 255]], [[0, 188, 0], [255, 255, 255]]])


def textured(picture=FOUR, places=((0.1, 0.1), (0.9, 0.1), (0.1, 0.9), (0.9, 0.9)), uri=None, **material):
    gltf = tetrahedron()
    coordinates = gltf.view(np.array(places, np.float32))
    gltf.json["accessors"].append({"bufferView": coordinates, "componentType": 5126, "count": 4, "type": "VEC2"})
    gltf.primitive()["attributes"]["TEXCOORD_0"] = len(gltf.json["accessors"]) - 1
    gltf.primitive()["material"] = 0
    image = {"uri": uri} if uri else {"bufferView": gltf.view(np.frombuffer(picture, np.uint8))}
    gltf.json["images"] = [image]
    gltf.json["textures"] = [{"source": 0}]
    surface = {"baseColorTexture": {"index": 0}, "roughnessFactor": 1} | material.pop("surface", {})
    gltf.json["materials"] = [{"pbrMetallicRoughness": surface} | material]
    return gltf


GREEN = 0.5028865
COLOURS = [[1, 0, 0], [0, 0, 1], [0, GREEN, 0], [1, 1, 1]]


@pytest.mark.parametrize("kind", ["PNG", "WEBP"])
def test_a_picture_becomes_linear_vertex_colours(tmp_path, kind):
    pixels = np.asarray(Image.open(io.BytesIO(FOUR)))
    colours = read(tmp_path, textured(png(pixels, kind))).colours
    np.testing.assert_allclose(colours[:, :3], COLOURS, atol=1e-4)
    np.testing.assert_array_equal(colours[:, 3], 0)


def test_the_materials_colour_tints_it(tmp_path):
    gltf = textured(surface={"baseColorFactor": [0.5, 1, 0.25, 1]})
    np.testing.assert_allclose(read(tmp_path, gltf).colours[:, :3], np.array(COLOURS) * [0.5, 1, 0.25], atol=1e-4)


def test_coordinates_wrap_as_the_sampler_says(tmp_path):
    places = ((-0.1, 0.1), (1.1, 0.1), (0.1, 1.1), (2.4, -0.9))
    repeated = [COLOURS[1], COLOURS[0], COLOURS[0], COLOURS[0]]
    clamped = [COLOURS[0], COLOURS[1], COLOURS[2], COLOURS[1]]
    mirrored = [COLOURS[0], COLOURS[1], COLOURS[2], COLOURS[2]]
    for mode, expected in ((10497, repeated), (33071, clamped), (33648, mirrored)):
        gltf = textured(places=places)
        gltf.json["samplers"] = [{"wrapS": mode, "wrapT": mode}]
        gltf.json["textures"][0]["sampler"] = 0
        np.testing.assert_allclose(read(tmp_path, gltf).colours[:, :3], expected, atol=1e-4, err_msg=str(mode))


def test_a_moved_texture(tmp_path):
    gltf = textured(places=[(0.1, 0.1)] * 4)
    move = {"KHR_texture_transform": {"offset": [0.4, 0], "scale": [2, 1]}}
    gltf.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = move
    gltf.json["extensionsRequired"] = ["KHR_texture_transform"]
    np.testing.assert_allclose(read(tmp_path, gltf).colours[:, :3], [COLOURS[1]] * 4, atol=1e-4)


def test_a_picture_beside_the_file_or_inside_its_text(tmp_path):
    (tmp_path / "skin.png").write_bytes(FOUR)
    for uri in ("skin.png", "data:image/png;base64," + base64.b64encode(FOUR).decode()):
        np.testing.assert_allclose(read(tmp_path, textured(uri=uri)).colours[:, :3], COLOURS, atol=1e-4)
    for uri in ("../skin.png", "/etc/hostname", "http://example.org/skin.png", "file:///skin.png"):
        assert "outside the file's folder" in refused(tmp_path, textured(uri=uri))


def test_a_link_does_not_lead_out_of_the_folder(tmp_path):
    inside = tmp_path / "inside"
    inside.mkdir()
    (tmp_path / "skin.png").write_bytes(FOUR)
    (inside / "skin.png").symlink_to(tmp_path / "skin.png")
    assert "outside the file's folder" in refused(inside, textured(uri="skin.png"))


def huge_png(side):
    """A picture of a few hundred bytes that announces side × side pixels."""
    whole = bytearray(png([[[1, 2, 3]]]))
    whole[16:24] = side.to_bytes(4, "big") * 2
    whole[29:33] = zlib.crc32(bytes(whole[12:29])).to_bytes(4, "big")
    return bytes(whole)


@pytest.mark.parametrize("side", [9_000, 20_000, 2**30])
def test_image_bombs_are_refused_unopened(tmp_path, side):
    assert "pixels" in refused(tmp_path, textured(huge_png(side)))


@pytest.mark.parametrize("raw", [b"", b"no picture at all", FOUR[:40], b"GIF89a" + bytes(50), huge_png(64)])
def test_pictures_that_cannot_be_read_leave_the_plain_colour(tmp_path, raw):
    gltf = textured(raw or b"\0", surface={"baseColorFactor": [0.5, 0.5, 0.5, 1]})
    assert any("Image 0 cannot be read" in note for note in notes(tmp_path, gltf))
    np.testing.assert_allclose(read(tmp_path, gltf).colours[:, :3], 0.5)


def test_pictures_of_a_foreign_kind_are_told(tmp_path):
    gltf = textured()
    gltf.json["textures"] = [{"extensions": {"MSFT_texture_dds": {"source": 0}}}]
    assert any("format that cannot be read" in note for note in notes(tmp_path, gltf))


#: FOUR as 16 × 16 pixels of Basis Universal (ETC1S), by the reference encoder
FOUR_KTX = base64.b64decode(
    "q0tUWCAyMLsNChoKAAAAAAEAAAAQAAAAEAAAAAAAAAAAAAAAAQAAAAEAAAABAAAAaAAAACwAAACUAAAAJAAAALgAAAAAAAAAjgAA"
    "AAAAAABGAQAAAAAAAAQAAAAAAAAAAAAAAAAAAAAsAAAAAAAAAAIAKACjAQIAAwMAAAgAAAAAAAAAAAA/AAAAAAAAAAAA/////x8A"
    "AABLVFh3cml0ZXIAQmFzaXMgVW5pdmVyc2FsIDIuMTAAAAQAAgAuAAAACQAAAC8AAAAAAAAAAAAAAAAAAAAEAAAAAAAAAAAAAAAg"
    "wJQAAAAAABDkCyMRwEQAAAAAAACSQAIwBUAAAAAAgOQJACYAAAAAAAAQmGgErKqqqlJVVVUFFMBEAAAAAAAAEkEAmAAAAAAAAEAY"
    "AqIEDAAAAMLGJZIIRDkCMAMAAAAAAIAkIABIzWEF"
)


def in_ktx(raw=FOUR_KTX, places=((0.2, 0.2), (0.8, 0.2), (0.2, 0.8), (0.8, 0.8)), **material):
    gltf = textured(raw, places, **material)
    gltf.json["textures"] = [{"extensions": {"KHR_texture_basisu": {"source": 0}}}]
    gltf.json["extensionsRequired"] = ["KHR_texture_basisu"]
    return gltf


def test_a_ktx_picture(tmp_path):
    pytest.importorskip("opengl_basisu", reason="it has no wheel for this platform")
    colours = read(tmp_path, in_ktx()).colours[:4, :3]
    np.testing.assert_allclose(colours, COLOURS, atol=0.04)


def test_ktx_bombs_and_damage(tmp_path):
    pytest.importorskip("opengl_basisu", reason="it has no wheel for this platform")
    bomb = FOUR_KTX[:20] + (2**31).to_bytes(4, "little") + FOUR_KTX[24:]
    assert "more than we take" in refused(tmp_path, in_ktx(bomb))
    for raw in (FOUR_KTX[:12], FOUR_KTX[:60], FOUR_KTX[:200], FOUR_KTX[:80] + b"\xff" * (len(FOUR_KTX) - 80)):
        assert "Image 0 cannot be read: what it covers shows a plain colour." in notes(tmp_path, in_ktx(raw))


def test_without_its_package_a_ktx_picture_is_told_and_names_give_the_colours(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "opengl_basisu", None)
    gltf = in_ktx()
    found = {}
    for name in ("head", "eyeLeft", "teeth"):
        gltf.json["nodes"][0]["name"] = name
        found[name] = read(tmp_path, gltf).colours[0, :3]
    assert found["head"][0] > 1.3 * found["head"][2], "skin is redder than blue"
    assert np.ptp(found["eyeLeft"]) < 0.1
    assert found["teeth"].min() > found["head"].max()
    assert any("lipstitch[ktx]" in note for note in notes(tmp_path, gltf))


def test_what_cannot_be_seen_is_left_out(tmp_path):
    """A lash card: transparent but for its lower right."""
    card = png([[[0, 0, 0, 0], [0, 0, 0, 0]], [[0, 0, 0, 0], [9, 9, 9, 255]]])
    places = ((0.9, 0.9), (0.9, 0.8), (0.8, 0.9), (-0.9, -0.9))
    for mode, count in (("OPAQUE", 4), ("MASK", 1), ("BLEND", 1)):
        assert len(read(tmp_path, textured(card, places, alphaMode=mode)).triangles) == count, mode
    cornea = textured(surface={"baseColorFactor": [1, 1, 1, 0.1]}, alphaMode="BLEND")
    assert "no triangles" in refused(tmp_path, cornea)


# --- names


def test_names_on_the_primitive(tmp_path):
    gltf = tetrahedron()
    gltf.primitive()["extras"] = gltf.mesh().pop("extras")
    assert read(tmp_path, gltf).shapes == ("up",)


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
    assert (whole[0], len(whole)) == (0, 6)
    for end in range(1, 7):
        shares.clear()
        with pytest.raises(UserError, match="cancelled"):
            read_rig(tmp_path / "face.glb", told)
        assert len(shares) == end


# --- spoiled files


def everything():
    """One file with a skin, a picture, a sparse and a packed shape, two meshes and vertex colours."""
    gltf = packed_tetrahedron()
    dressed = textured()
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
    for part in ("textures", "materials"):
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
        assert time.monotonic() - begun < 2, f"file {number}"
    assert faces > 10, "some damage does not matter"
    assert len(sentences) > 20, "and much of it does"
    assert all(sentence.startswith("face.glb: ") and sentence.isprintable() for sentence in sentences)
