"""glTF materials on our faces: the pictures that lie on parts, what multiplies them, and what cannot be seen."""

import base64
import cmath
import io
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from core_pipeline.errors import UserError
from core_pipeline.faces.rigs import album
from core_pipeline.faces.rigs.glb import read_glb, read_rig
from core_pipeline.faces.rigs.obj_colours import SKIN
from core_pipeline.faces.texture import Material
from tests.helpers.gltf import tetrahedron
from tests.helpers.pictures import COLOURS, FOUR, huge_png, png, seen_colours, textured


def read(tmp_path, gltf):
    (tmp_path / "face.glb").write_bytes(gltf.glb())
    return read_glb(tmp_path / "face.glb")


def notes(tmp_path, gltf):
    (tmp_path / "face.glb").write_bytes(gltf.glb())
    return read_rig(tmp_path / "face.glb")[2]


def refused(tmp_path, gltf):
    with pytest.raises(UserError, match=r"^face\.glb: ") as caught:
        read(tmp_path, gltf)
    assert "\n" not in str(caught.value)
    return str(caught.value)


@pytest.mark.parametrize("kind", ["PNG", "WEBP"])
def test_a_picture_is_kept_as_it_is_and_lies_where_the_file_says(tmp_path, kind):
    pixels = np.asarray(Image.open(io.BytesIO(FOUR)))
    face = read(tmp_path, textured(png(pixels, kind)))
    (texture,) = face.textures
    np.testing.assert_array_equal(texture.picture[..., :3], pixels)
    np.testing.assert_array_equal(texture.picture[..., 3], 255)
    assert dict(face.materials) == {"tetra": Material(0)}
    assert face.texcoords.dtype == np.float32
    np.testing.assert_allclose(seen_colours(face), COLOURS, atol=1e-4)
    np.testing.assert_array_equal(face.colours, [[1, 1, 1, 0]] * 4)


def test_a_face_without_pictures_has_no_texcoords(tmp_path):
    face = read(tmp_path, tetrahedron())
    assert (face.textures, dict(face.materials), face.texcoords) == ((), {}, None)


def test_the_materials_colour_tints_it(tmp_path):
    gltf = textured(surface={"baseColorFactor": [0.5, 1, 0.25, 1]})
    np.testing.assert_allclose(seen_colours(read(tmp_path, gltf)), np.array(COLOURS) * [0.5, 1, 0.25], atol=1e-4)


def test_coordinates_wrap_as_the_sampler_says(tmp_path):
    places = ((-0.1, 0.1), (1.1, 0.1), (0.1, 1.1), (2.4, -0.9))
    repeated = [COLOURS[1], COLOURS[0], COLOURS[0], COLOURS[0]]
    clamped = [COLOURS[0], COLOURS[1], COLOURS[2], COLOURS[1]]
    mirrored = [COLOURS[0], COLOURS[1], COLOURS[2], COLOURS[2]]
    for mode, expected in ((10497, repeated), (33071, clamped), (33648, mirrored)):
        gltf = textured(places=places)
        gltf.json["samplers"] = [{"wrapS": mode, "wrapT": mode}]
        gltf.json["textures"][0]["sampler"] = 0
        np.testing.assert_allclose(seen_colours(read(tmp_path, gltf)), expected, atol=1e-4, err_msg=str(mode))


def test_each_direction_wraps_in_its_own_way(tmp_path):
    gltf = textured(places=((-0.1, -0.1), (1.1, -0.1), (-0.1, 1.1), (1.1, 1.1)))
    gltf.json["samplers"] = [{"wrapS": 33071, "wrapT": "nonsense"}]
    gltf.json["textures"][0]["sampler"] = 0
    face = read(tmp_path, gltf)
    assert face.textures[0].wrap == ("clamp", "repeat")
    np.testing.assert_allclose(seen_colours(face), [COLOURS[2], COLOURS[3], COLOURS[0], COLOURS[1]], atol=1e-4)


def texture_of(gltf):
    return gltf.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]


def test_a_moved_texture(tmp_path):
    gltf = textured(places=[(0.1, 0.1)] * 4)
    texture_of(gltf)["extensions"] = {"KHR_texture_transform": {"offset": [0.4, 0], "scale": [2, 1]}}
    gltf.json["extensionsRequired"] = ["KHR_texture_transform"]
    face = read(tmp_path, gltf)
    np.testing.assert_allclose(face.texcoords, [[0.6, 0.1]] * 4, atol=1e-6)
    np.testing.assert_allclose(seen_colours(face), [COLOURS[1]] * 4, atol=1e-4)


numbers = st.floats(-3, 3, width=32)


@given(numbers, st.tuples(numbers, numbers), st.tuples(numbers, numbers))
def test_a_transform_scales_then_turns_anticlockwise_then_shifts(tmp_path_factory, angle, scale, offset):
    """As seen, with v down: a quarter turn takes what is right of the corner to what is above it."""
    places = np.float32([(0, 0), (1, 0), (0, 1), (0.25, 0.75)])
    gltf = textured(places=places)
    move = {"rotation": angle, "scale": scale, "offset": offset}
    texture_of(gltf)["extensions"] = {"KHR_texture_transform": move}
    found = read(tmp_path_factory.mktemp("moved"), gltf).texcoords
    for (u, v), place in zip(places.tolist(), found.tolist(), strict=True):
        upright = complex(u * scale[0], -v * scale[1]) * cmath.exp(1j * angle)
        assert place == pytest.approx((upright.real + offset[0], -upright.imag + offset[1]), abs=1e-5)


def test_the_second_set_of_coordinates(tmp_path):
    for where in ("texture", "transform"):
        gltf = textured(places=[(0.1, 0.1)] * 4)
        gltf.primitive()["attributes"]["TEXCOORD_1"] = gltf.accessor(np.float32([(0.9, 0.9)] * 4))
        if where == "texture":
            texture_of(gltf)["texCoord"] = 1
        else:
            texture_of(gltf)["extensions"] = {"KHR_texture_transform": {"texCoord": 1}}
        np.testing.assert_allclose(seen_colours(read(tmp_path, gltf)), 1)


def test_a_material_of_the_older_kind(tmp_path):
    gltf = textured()
    older = {"diffuseTexture": {"index": 0}, "diffuseFactor": [0.5, 0.5, 0.5, 1]}
    gltf.json["materials"] = [{"extensions": {"KHR_materials_pbrSpecularGlossiness": older}}]
    np.testing.assert_allclose(seen_colours(read(tmp_path, gltf)), np.array(COLOURS) / 2, atol=1e-4)


def two_parts(second, **changed):
    """One mesh of two primitives, the second with a material of its own."""
    gltf = textured()
    gltf.mesh()["primitives"].append({**gltf.primitive(), "material": 1})
    surface = {"baseColorTexture": {"index": second}} | changed.pop("surface", {})
    gltf.json["materials"].append({"pbrMetallicRoughness": surface} | changed)
    return gltf


def test_materials_of_one_picture_share_it(tmp_path):
    gltf = two_parts(0, surface={"baseColorFactor": [0.5, 0.5, 0.5, 1]})
    face = read(tmp_path, gltf)
    assert len(face.textures) == 1
    assert dict(face.materials) == dict.fromkeys(face.parts, Material(0))
    assert len(face.parts) == 2
    np.testing.assert_allclose(face.colours[:, 0], [1] * 4 + [0.5] * 4)


def test_a_picture_that_wraps_in_two_ways_is_unpacked_once(tmp_path):
    gltf = two_parts(1)
    gltf.json["samplers"] = [{"wrapS": 33071, "wrapT": 33071}]
    gltf.json["textures"].append({"source": 0, "sampler": 0})
    one, other = read(tmp_path, gltf).textures
    assert one.picture is other.picture
    assert (one.wrap, other.wrap) == (("repeat", "repeat"), ("clamp", "clamp"))


def test_each_part_has_the_picture_of_its_own_material(tmp_path):
    gltf = two_parts(1)
    gltf.json["images"].append({"bufferView": gltf.view(np.frombuffer(png([[[7, 8, 9]]]), np.uint8))})
    gltf.json["textures"].append({"source": 1})
    face = read(tmp_path, gltf)
    first, second = (face.textures[face.materials[name].texture] for name in face.parts)
    assert first.picture.shape == (2, 2, 4)
    assert second.picture.tolist() == [[[7, 8, 9, 255]]]


def test_should_pictures_be_too_many_those_of_what_moves_stay_largest(tmp_path, monkeypatch):
    monkeypatch.setattr(album, "MAX_BYTES", 4 * (16 + 4))
    gltf = textured(png(np.zeros((4, 4, 3))))
    still = {name: value for name, value in gltf.primitive().items() if name != "targets"}
    gltf.json["meshes"].append({"name": "shirt", "primitives": [{**still, "material": 1}]})
    gltf.json["nodes"].insert(0, {"mesh": 1})
    gltf.json["scenes"][0]["nodes"] = [0, 1]
    gltf.json["images"] *= 2
    gltf.json["textures"].append({"source": 1})
    gltf.json["materials"].append({"pbrMetallicRoughness": {"baseColorTexture": {"index": 1}}})
    face = read(tmp_path, gltf)
    assert list(face.parts) == ["shirt", "tetra"]
    sizes = {name: face.textures[material.texture].picture.shape[0] for name, material in face.materials.items()}
    assert sizes == {"shirt": 2, "tetra": 4}


def test_a_part_without_a_picture_beside_one_that_has(tmp_path):
    gltf = two_parts(0)
    gltf.json["materials"][1] = {"pbrMetallicRoughness": {"baseColorFactor": [0, 1, 0, 1]}}
    face = read(tmp_path, gltf)
    assert list(face.materials) == [next(iter(face.parts))]
    assert face.texcoords.shape == (8, 2)
    np.testing.assert_allclose(seen_colours(face), [*COLOURS, *[[0, 1, 0]] * 4], atol=1e-4)


def test_a_picture_beside_the_file_or_inside_its_text(tmp_path):
    (tmp_path / "skin.png").write_bytes(FOUR)
    for uri in ("skin.png", "data:image/png;base64," + base64.b64encode(FOUR).decode()):
        np.testing.assert_allclose(seen_colours(read(tmp_path, textured(uri=uri))), COLOURS, atol=1e-4)
    for uri in ("../skin.png", "/etc/hostname", "http://example.org/skin.png", "file:///skin.png"):
        assert "outside the file's folder" in refused(tmp_path, textured(uri=uri))


def test_a_link_does_not_lead_out_of_the_folder(tmp_path):
    inside = tmp_path / "inside"
    inside.mkdir()
    (tmp_path / "skin.png").write_bytes(FOUR)
    (inside / "skin.png").symlink_to(tmp_path / "skin.png")
    assert "outside the file's folder" in refused(inside, textured(uri="skin.png"))


@pytest.mark.parametrize("side", [9_000, 20_000, 2**30])
def test_image_bombs_are_refused_unopened(tmp_path, side):
    assert "pixels" in refused(tmp_path, textured(huge_png(side)))


@pytest.mark.parametrize("raw", [b"", b"no picture at all", FOUR[:40], b"GIF89a" + bytes(50), huge_png(64)])
def test_pictures_that_cannot_be_read_leave_the_plain_colour(tmp_path, raw):
    gltf = textured(raw or b"\0", surface={"baseColorFactor": [0.5, 0.5, 0.5, 1]})
    assert any("Image 0 cannot be read" in note for note in notes(tmp_path, gltf))
    np.testing.assert_allclose(seen_colours(read(tmp_path, gltf)), 0.5)


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
    colours = seen_colours(read(tmp_path, in_ktx()))
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


def test_names_tell_of_shells_that_are_not_to_be_seen(tmp_path):
    """Where light goes through, that is: a head may be called anything."""
    gltf = two_parts(1)
    gltf.json["images"].append({"bufferView": gltf.view(np.zeros(9, np.uint8))})
    gltf.json["textures"].append({"source": 1})
    gltf.json["materials"][1]["name"] = "Std_Cornea_L"
    face = read(tmp_path, gltf)
    assert list(face.parts.values()) == [(0, 4), (4, 4)]
    np.testing.assert_allclose(face.colours[4:, :3], [SKIN[:3]] * 4)
    gltf.json["materials"][1]["alphaMode"] = "BLEND"
    assert list(read(tmp_path, gltf).parts.values()) == [(0, 4), (4, 0)]


# --- what light goes through

#: nothing but a dot in the middle
CARD = np.zeros((16, 16, 4), np.uint8)
CARD[7:9, 7:9] = 9, 9, 9, 255
#: Two triangles that hold the middle, and two of no width at the card's edge.
ON_CARD = ((0.1, 0.1), (0.9, 0.1), (0.5, 0.9), (0.5, 0.9))


def test_what_cannot_be_seen_is_left_out(tmp_path):
    for mode, count in (("OPAQUE", 4), ("MASK", 2), ("BLEND", 2)):
        face = read(tmp_path, textured(png(CARD), ON_CARD, alphaMode=mode))
        assert len(face.triangles) == count, mode
        assert all(3 not in corners or 2 not in corners for corners in face.triangles.tolist()) == (count == 2)
    cornea = textured(surface={"baseColorFactor": [1, 1, 1, 0.1]}, alphaMode="BLEND")
    assert "no triangles" in refused(tmp_path, cornea)


def test_a_shell_painted_thinly_is_left_out_and_thin_edges_of_hair_are_not(tmp_path):
    """A whole part below four tenths is a cornea or a tear line; a strand may end as thin as that."""
    thin = np.full((4, 4, 4), 80, np.uint8)
    assert "no triangles" in refused(tmp_path, textured(png(thin), alphaMode="BLEND"))
    strand = thin.copy()
    strand[0, 0, 3] = 255
    places = ((0.05, 0.05), (0.1, 0.05), (0.05, 0.1), (0.9, 0.9))
    assert len(read(tmp_path, textured(png(strand), places, alphaMode="BLEND")).triangles) == 4
    strand[1:, 1:, 3] = 3
    places = ((0.6, 0.6), (0.7, 0.6), (0.6, 0.7), (0.05, 0.05))
    assert len(read(tmp_path, textured(png(strand), places, alphaMode="BLEND")).triangles) == 3


@pytest.mark.parametrize(
    ("described", "cutoff", "soft"),
    [
        ({}, 0, False),
        ({"alphaMode": "OPAQUE", "alphaCutoff": 0.7}, 0, False),
        ({"alphaMode": "MASK"}, 0.5, False),
        ({"alphaMode": "MASK", "alphaCutoff": 0.2}, 0.2, False),
        ({"alphaMode": "MASK", "alphaCutoff": 0.2, "surface": {"baseColorFactor": [1, 1, 1, 0.8]}}, 0.25, False),
        ({"alphaMode": "MASK", "alphaCutoff": 0}, 0, False),
        ({"alphaMode": "BLEND"}, 0.05, True),
        ({"alphaMode": "BLEND", "surface": {"baseColorFactor": [1, 1, 1, 0.5]}}, 0.1, True),
    ],
)
def test_how_the_alpha_of_a_picture_counts(tmp_path, described, cutoff, soft):
    (material,) = read(tmp_path, textured(png(CARD), ON_CARD, **described)).materials.values()
    assert material.cutoff == pytest.approx(cutoff)
    assert material.soft == soft


@pytest.mark.parametrize("mode", ["MASK", "BLEND"])
def test_a_picture_without_holes_needs_no_looking_through(tmp_path, mode):
    """Many exporters call every material blended; drawn as solid, skin hides what is behind it."""
    face = read(tmp_path, textured(alphaMode=mode))
    assert dict(face.materials) == {"tetra": Material(0)}
    assert len(face.triangles) == 4


def test_a_cutoff_that_nothing_reaches(tmp_path):
    gltf = textured(png(CARD), ON_CARD, alphaMode="MASK", alphaCutoff=0.9, surface={"baseColorFactor": [1, 1, 1, 0.8]})
    assert "no triangles" in refused(tmp_path, gltf)


def test_a_part_of_which_nothing_is_left_keeps_no_picture(tmp_path):
    gltf = two_parts(1, alphaMode="MASK")
    gltf.json["images"].append({"bufferView": gltf.view(np.frombuffer(png(np.zeros((2, 2, 4))), np.uint8))})
    gltf.json["textures"].append({"source": 1})
    face = read(tmp_path, gltf)
    assert list(face.parts.values()) == [(0, 4), (4, 0)]
    assert len(face.textures) == len(face.materials) == 1
