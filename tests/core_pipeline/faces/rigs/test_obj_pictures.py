"""Pictures on .obj poses: the neutral's materials say where they are, and the poses still correspond by number."""

import random
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.errors import UserError
from core_pipeline.faces.open_face import open_face
from core_pipeline.faces.rigs import obj_folder
from core_pipeline.faces.rigs.obj_colours import SKIN
from core_pipeline.faces.rigs.obj_folder import read_obj_folder
from core_pipeline.faces.texture import Material
from tests.helpers.pictures import COLOURS, FOUR, huge_png, png, seen_colours

VERTICES = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
LIFTED = VERTICES.replace("v 1 1 0", "v 1 1 0.5") + "f 1 2 3 4\n"
#: bottom left, bottom right, top right, top left; v is up
PLACES = "vt .1 .1\nvt .9 .1\nvt .9 .9\nvt .1 .9\n"
NEUTRAL = "mtllib face.mtl\n" + VERTICES + PLACES + "usemtl skin\nf 1/1 2/2 3/3 4/4\n"
MTL = "newmtl skin\nKd .8 .8 .8\nmap_Kd skin.png\n"
#: seen at the four vertices
CORNERS = [COLOURS[2], COLOURS[3], COLOURS[1], COLOURS[0]]


def folder(tmp_path, neutral=NEUTRAL, mtl=MTL, up=LIFTED, **pictures):
    (tmp_path / "neutral.obj").write_text(neutral)
    (tmp_path / "up.obj").write_text(up)
    (tmp_path / "face.mtl").write_text(mtl)
    for name, raw in (pictures or {"skin": FOUR}).items():
        (tmp_path / f"{name}.png").write_bytes(raw)
    return tmp_path


def read(*arguments, **more):
    return read_obj_folder(folder(*arguments, **more))[0]


def test_a_picture_lies_where_the_neutral_says(tmp_path):
    face, notes = read_obj_folder(folder(tmp_path))
    assert notes == ()
    assert dict(face.parts) == {"skin": (0, 2)}
    assert dict(face.materials) == {"skin": Material(0)}
    assert face.textures[0].wrap == ("repeat", "repeat")
    np.testing.assert_allclose(face.colours, [[1, 1, 1, SKIN[3]]] * 4)
    np.testing.assert_allclose(seen_colours(face), CORNERS, atol=1e-4)
    np.testing.assert_array_equal(face.deltas[0], [[0, 0, 0], [0, 0, 0], [0, 0, 0.5], [0, 0, 0]])


@pytest.mark.parametrize(
    "change",
    [
        lambda text: text.replace("f 1/1 2/2 3/3 4/4", "vn 0 0 1\nf 1/1/1 2/2/1 3/3/1 4/4/1"),
        lambda text: text.replace("f 1/1 2/2 3/3 4/4", "f -4/-4 -3/-3 -2/-2 -1/-1"),
        lambda text: text.replace("f 1/1 2/2 3/3 4/4", "f 1/1/ 2/2/ 3/3/ 4/4/"),
        lambda text: text.replace("f 1/1 2/2 3/3 4/4", "f\t1/1\t2/2\t3/3\t4/4\t"),
        lambda text: text.replace("\n", "\r\n"),
        lambda text: text.replace(" .9\n", " .9 0\n").replace(" .1\n", " .1 0.0\n"),
        lambda text: text.replace("vt ", "vt   "),
        lambda text: text.replace("f 1/1 2/2", "f 1/1 \\\n 2/2"),
    ],
)
def test_every_dialect_lies_alike(tmp_path, change):
    face = read(tmp_path, change(NEUTRAL))
    np.testing.assert_allclose(seen_colours(face), CORNERS, atol=1e-4)


def test_a_vertex_at_two_places_becomes_two_that_move_as_one(tmp_path):
    seam = NEUTRAL.replace("f 1/1 2/2 3/3 4/4", "f 1/1 2/2 3/3\nf 1/2 3/1 4/4")
    face = read(tmp_path, seam, up=LIFTED.replace("f 1 2 3 4", "f 1 2 3\nf 1 3 4"))
    assert len(face.positions) == 6
    np.testing.assert_array_equal(face.positions[:4], [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    np.testing.assert_array_equal(face.positions[4:], [[0, 0, 0], [1, 1, 0]])
    np.testing.assert_array_equal(face.deltas[0, [2, 5]], [[0, 0, 0.5]] * 2)
    np.testing.assert_array_equal(face.normal_deltas[0, 2], face.normal_deltas[0, 5])
    np.testing.assert_allclose(seen_colours(face)[face.triangles[1]], [CORNERS[1], CORNERS[0], CORNERS[3]], atol=1e-4)


corners = st.tuples(st.integers(1, 5), st.integers(0, 4))
faces = st.lists(st.tuples(st.lists(corners, min_size=3, max_size=5), st.sampled_from(["skin", "bare"])), min_size=1)


@given(faces, st.integers(0, 9))
def test_every_corner_has_the_place_position_and_motion_the_files_say(tmp_path_factory, polygons, seed):
    chance = np.random.default_rng(seed)
    points, moved = chance.integers(-9, 9, (2, 5, 3))
    places = chance.integers(0, 9, (4, 2)) / 8

    def text(vertices):
        lines = ["mtllib face.mtl", *("v {} {} {}".format(*v) for v in vertices.tolist())]
        lines += ["vt {} {}".format(*place) for place in places.tolist()]
        for polygon, material in polygons:
            lines += [f"usemtl {material}", "f " + " ".join(f"{v}/{vt}" if vt else f"{v}" for v, vt in polygon)]
        return "\n".join(lines) + "\n"

    face = read(tmp_path_factory.mktemp("rig"), text(points), up=text(moved))
    expected = {"skin": [], "bare": []}
    for polygon, material in polygons:
        fans = pairwise(polygon[1:])
        expected[material] += [corner for second, third in fans for corner in (polygon[0], second, third)]
    pictured = bool(expected["skin"])
    found = face.triangles.ravel()
    assert len(found) == len(expected["bare"] + expected["skin"])
    assert len(face.parts) == (bool(expected["bare"]) + 1 if pictured else 1)
    for number, (v, _) in zip(found, expected["bare"] + expected["skin"], strict=True):
        np.testing.assert_array_equal(face.positions[number], points[v - 1])
        np.testing.assert_array_equal(face.deltas[0, number], moved[v - 1] - points[v - 1])
    if pictured:
        first, count = face.parts["skin"]
        for number, (_, vt) in zip(face.triangles[first : first + count].ravel(), expected["skin"], strict=True):
            place = (places[vt - 1][0], 1 - places[vt - 1][1]) if vt else (0, 0)
            np.testing.assert_allclose(face.texcoords[number], place, atol=1e-6)
            np.testing.assert_array_equal(face.colours[number, :3], 1)
    else:
        assert face.texcoords is None


def test_parts_with_and_without_pictures(tmp_path):
    text = NEUTRAL.replace("f 1/1 2/2 3/3 4/4", "f 1/1 2/2 3/3\nusemtl teeth\nf 1/1 3/3 4/4")
    up = LIFTED.replace("f 1 2 3 4", "f 1 2 3\nf 1 3 4")
    face = read(tmp_path, text, up=up)
    assert dict(face.parts) == {"skin": (0, 1), "teeth": (1, 1)}
    assert list(face.materials) == ["skin"]
    skin, teeth = (face.colours[face.triangles[number]] for number in (0, 1))
    assert (teeth[:, :3] < 0.9).all(), "in a colour of their own, though they share vertices"
    assert (skin[:, :3] == 1).all()


def test_two_materials_of_one_picture_share_it(tmp_path):
    text = NEUTRAL.replace("f 1/1 2/2 3/3 4/4", "f 1/1 2/2 3/3\nusemtl lips\nf 1/1 3/3 4/4")
    up = LIFTED.replace("f 1 2 3 4", "f 1 2 3\nf 1 3 4")
    face = read(tmp_path, text, MTL + "newmtl lips\nmap_Kd skin.png\n", up=up)
    assert len(face.textures) == 1
    assert dict(face.materials) == {"lips": Material(0), "skin": Material(0)}


def test_shells_before_the_eyes_stay_left_out(tmp_path):
    text = NEUTRAL + "usemtl EyeOcclusion\nf 1/1 2/2 4/4\n"
    up = LIFTED + "f 1 2 4\n"
    face = read(tmp_path, text, MTL + "newmtl EyeOcclusion\nmap_Kd skin.png\n", up=up)
    assert len(face.triangles) == 2
    assert list(face.materials) == ["skin"]


# --- where pictures are


@pytest.mark.parametrize(
    "line",
    [
        "map_Kd C:\\Users\\me\\Art\\skin.png",
        "map_Kd /home/me/art/skin.png",
        "map_Kd ../art/skin.png",
        "map_kd skin.png",
        "map_Kd -blendu on -mm 0 1 -o 0 0 0 -s 1 1 -texres 512 skin.png",
        "\tmap_Kd   skin.png  ",
    ],
)
def test_however_a_picture_is_named_it_is_looked_for_in_the_folder(tmp_path, line):
    face = read(tmp_path, mtl=f"newmtl skin\n{line}\n")
    np.testing.assert_allclose(seen_colours(face), CORNERS, atol=1e-4)


def test_a_picture_in_a_folder_within_with_spaces_in_its_name(tmp_path):
    (tmp_path / "my art").mkdir()
    (tmp_path / "my art" / "the skin.png").write_bytes(FOUR)
    for name in ("my art/the skin.png", "my art\\the skin.png"):
        face = read(tmp_path, mtl=f"newmtl skin\nmap_Kd {name}\n")
        np.testing.assert_allclose(seen_colours(face), CORNERS, atol=1e-4)


@pytest.mark.parametrize("name", ["../skin.png", "none.png", "/etc/hostname", "x" * 5000, "a\0b", "link.png", ".", ""])
def test_pictures_elsewhere_are_not_read(tmp_path, name):
    (tmp_path / "skin.png").write_bytes(FOUR)
    inside = tmp_path / "inside"
    inside.mkdir()
    (inside / "link.png").symlink_to(tmp_path / "skin.png")
    face, notes = read_obj_folder(folder(inside, mtl=f"newmtl skin\nmap_Kd {name}\n", other=FOUR))
    assert (face.textures, face.texcoords) == ((), None)
    np.testing.assert_allclose(face.colours, [SKIN] * 4)
    assert len(notes) == bool(name)
    assert all("is not in the folder" in note and "\n" not in note for note in notes)


def test_a_picture_that_cannot_be_read_is_told(tmp_path):
    face, notes = read_obj_folder(folder(tmp_path, skin=FOUR[:40]))
    assert face.textures == ()
    assert notes == ("Picture skin.png cannot be read: what it covers shows a plain colour.",)


@pytest.mark.parametrize("side", [9_000, 20_000])
def test_image_bombs_are_refused(tmp_path, side):
    with pytest.raises(UserError, match="pixels") as caught:
        read(tmp_path, skin=huge_png(side))
    assert str(caught.value).startswith(f"{tmp_path}: ")
    assert "skin.png" in str(caught.value)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("vt .1 .9\n", ""),
        ("vt .1 .9", "vt .1"),
        ("vt .1 .9", "vt .1 x"),
        ("vt .1 .9", "vt .1 nan"),
        ("vt .1 .9", "vt .1 9e9"),
        ("1/1 2/2", "1/0.5x 2/2"),
        ("1/1 2/2", "1/ 2/2"),
        ("1/1 2/2", "1/99999999999999999999 2/2"),
        ("1/1 2/2", "1/-9 2/2"),
        (PLACES, ""),
    ],
)
def test_damaged_coordinates_leave_a_plain_face(tmp_path, old, new):
    assert old in NEUTRAL
    face = read(tmp_path, NEUTRAL.replace(old, new))
    assert face.texcoords is None
    np.testing.assert_allclose(face.colours, [SKIN] * 4)


def test_corners_without_a_place_lie_at_the_pictures_corner(tmp_path):
    face = read(tmp_path, NEUTRAL.replace("f 1/1 2/2 3/3 4/4", "f 1 2/2 3//1 4/4"))
    np.testing.assert_allclose(face.texcoords, [[0, 0], [0.9, 0.9], [0, 0], [0.1, 0.1]], atol=1e-6)


# --- what is see-through


LASHES = np.zeros((16, 16, 4), np.uint8)
LASHES[7:9, 7:9] = 9, 9, 9, 255


def test_alpha_counts_where_the_material_says_so(tmp_path):
    plain = read(tmp_path, skin=png(LASHES))
    assert dict(plain.materials) == {"skin": Material(0)}
    assert (plain.textures[0].picture[..., 3] == 255).all()
    soft = read(tmp_path, mtl=MTL + "map_d skin.png\n", skin=png(LASHES))
    assert soft.materials["skin"].soft
    assert 0 < soft.materials["skin"].cutoff < 0.2
    np.testing.assert_array_equal(soft.textures[0].picture, LASHES)


def test_a_picture_of_its_own_for_what_is_see_through(tmp_path):
    mask = np.zeros((4, 4), np.uint8)
    mask[:2] = 200
    face = read(tmp_path, mtl=MTL + "map_d -imfchan l mask.png\n", skin=FOUR, mask=png(mask))
    assert face.materials["skin"].soft
    assert face.textures[0].picture[..., 3].tolist() == [[200, 200], [0, 0]]
    np.testing.assert_allclose(seen_colours(face), CORNERS, atol=1e-4)


def test_triangles_of_nothing_are_left_out(tmp_path):
    text = NEUTRAL.replace("f 1/1 2/2 3/3 4/4", "f 1/1 2/2 3/3 4/4\nf 1/1 2/1 3/1")
    up = LIFTED + "f 1 2 3\n"
    assert len(read(tmp_path, text, up=up, skin=png(LASHES)).triangles) == 3
    assert len(read(tmp_path, text, MTL + "map_d skin.png\n", up=up, skin=png(LASHES)).triangles) == 2


def test_a_picture_that_does_not_go_on(tmp_path):
    assert read(tmp_path, mtl="newmtl skin\nmap_Kd -clamp on skin.png\n").textures[0].wrap == ("clamp", "clamp")
    assert read(tmp_path, mtl="newmtl skin\nmap_Kd -clamp off skin.png\n").textures[0].wrap == ("repeat", "repeat")


# --- sizes, and the cache


def test_split_vertices_count(tmp_path, monkeypatch):
    seam = NEUTRAL.replace("f 1/1 2/2 3/3 4/4", "f 1/1 2/2 3/3\nf 1/2 3/1 4/4")
    up = LIFTED.replace("f 1 2 3 4", "f 1 2 3\nf 1 3 4")
    monkeypatch.setattr(obj_folder, "MAX_MORPH_BYTES", 6 * 24)
    assert len(read(tmp_path, seam, up=up).positions) == 6
    monkeypatch.setattr(obj_folder, "MAX_MORPH_BYTES", 6 * 24 - 1)
    with pytest.raises(UserError, match="6 vertices × 1 poses"):
        read(tmp_path, seam, up=up)


@pytest.mark.parametrize("name", ["face.mtl", "skin.png"])
def test_a_changed_material_or_picture_is_read_again(tmp_path, name):
    rig = tmp_path / "rig"
    rig.mkdir()
    folder(rig)
    first = open_face(rig, (), cache=tmp_path / "cache").face
    assert len(first.textures) == 1
    again = open_face(rig, (), cache=tmp_path / "cache").face
    np.testing.assert_array_equal(again.textures[0].picture, first.textures[0].picture)
    np.testing.assert_array_equal(again.texcoords, first.texcoords)
    (rig / name).write_bytes(b"# nothing")
    assert open_face(rig, (), cache=tmp_path / "cache").face.textures == ()


# --- spoiled files


@pytest.mark.parametrize("name", ["neutral.obj", "face.mtl", "skin.png"])
def test_a_spoiled_file_is_a_face_or_a_sentence(tmp_path, name):
    chance = random.Random(2013)
    rig = folder(tmp_path, mtl=MTL + "map_d -clamp on skin.png\n", skin=png(np.full((3, 3, 4), 200)))
    whole = (rig / name).read_bytes()
    pictured, sentences = 0, []
    for _ in range(150):
        raw = bytearray(whole)
        for _ in range(chance.randint(1, 3)):
            raw[chance.randrange(len(raw))] = chance.choice(b" \n/-.0159vtfmd#" + bytes([chance.randrange(256)]))
        (rig / name).write_bytes(raw)
        try:
            face, notes = read_obj_folder(rig)
        except UserError as error:
            sentences.append(str(error))
            continue
        sentences += notes
        assert face.triangles.max() < len(face.positions)
        pictured += bool(face.textures)
        if face.textures:
            assert np.isfinite(face.texcoords).all()
            assert face.texcoords.shape == (len(face.positions), 2)
    assert all(sentence.isprintable() for sentence in sentences)
    assert 0 < pictured < 150, "some damage does not matter, and some does"
