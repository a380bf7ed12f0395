"""A folder of .obj poses: every vertex keeps its number, and files that do not correspond are refused."""

import numpy as np
import pytest

from core_pipeline.errors import UserError
from core_pipeline.faces.rigs import obj_file, obj_folder
from core_pipeline.faces.rigs.limits import MAX_TEXT
from core_pipeline.faces.rigs.obj_colours import SKIN, named_colour
from core_pipeline.faces.rigs.obj_folder import read_obj_folder
from core_pipeline.faces.rigs.scaffold import LEFT_OUT
from tests.helpers.rigs import as_objs, head

QUAD = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"
LIFTED = QUAD.replace("v 1 1 0", "v 1 1 0.5")


def folder(tmp_path, **files):
    for name, text in files.items():
        data = text if isinstance(text, bytes) else text.encode()
        (tmp_path / f"{name}.obj").write_bytes(data)
    return tmp_path


def read(tmp_path, **files):
    return read_obj_folder(folder(tmp_path, **files))[0]


def refused(tmp_path, **files):
    with pytest.raises(UserError) as caught:
        read_obj_folder(folder(tmp_path, **files))
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_what_is_written_comes_back(tmp_path):
    face = head()
    back, notes = read_obj_folder(as_objs(face, tmp_path / "poses"))
    assert notes == ()
    assert back.name == back.title == "poses"
    assert sorted(back.shapes) == sorted(face.shapes)
    np.testing.assert_array_equal(back.triangles, face.triangles)
    np.testing.assert_allclose(back.positions, face.positions, atol=1e-6)
    for shape in face.shapes:
        np.testing.assert_allclose(
            back.deltas[back.shapes.index(shape)], face.deltas[face.shapes.index(shape)], atol=2e-6
        )
    np.testing.assert_allclose(np.linalg.norm(back.normals, axis=1), 1, atol=1e-5)
    assert back.normal_deltas.any()


def test_polygons_become_fans(tmp_path):
    face = read(tmp_path, neutral=QUAD + "f 4 3 2\n", up=LIFTED + "f 4 3 2\n")
    assert face.triangles.tolist() == [[0, 1, 2], [0, 2, 3], [3, 2, 1]]
    np.testing.assert_array_equal(face.deltas[0], [[0, 0, 0], [0, 0, 0], [0, 0, 0.5], [0, 0, 0]])
    assert face.shapes == ("up",)


@pytest.mark.parametrize(
    "change",
    [
        lambda text: text.replace("\n", "\r\n"),
        lambda text: text.replace("\n", "\r"),
        lambda text: text.rstrip("\n"),
        lambda text: text.replace("f 1 2 3 4", "f 1 2 \\\n3 4"),
        lambda text: text.replace("f 1 2 3 4", "f -4 -3 -2 -1"),
        lambda text: text.replace("f 1 2 3 4", "vt 0 0\nvt 1 1\nvn 0 0 1\nf 1/1/1 2/2/1 3/1/1 4/2/1"),
        lambda text: text.replace("f 1 2 3 4", "f 1//1 2//1 3//1 4//1"),
        lambda text: text.replace(" 0\n", " 0 1.0\n").replace(" 0.5\n", " 0.5 1.0\n"),
        lambda text: text.replace(" 0\n", " 0 .2 .4 .6\n").replace(" 0.5\n", " 0.5 .2 .4 .6\n"),
        lambda text: "# a face\nmtllib f.mtl\no head\n" + text.replace("f 1", "g skin\nusemtl s\ns 1\nf 1"),
        lambda text: text.replace("v ", "v\t").replace("f ", "f\t"),
        lambda text: text.replace("v 1 1", "vn 0 0 1\nv 1.0e0 +1"),
    ],
)
def test_every_dialect_is_the_same_mesh(tmp_path, change):
    face = read(tmp_path, neutral=QUAD, up=change(LIFTED))
    np.testing.assert_array_equal(face.deltas[0], [[0, 0, 0], [0, 0, 0], [0, 0, 0.5], [0, 0, 0]])
    other = tmp_path / "other"
    other.mkdir()
    face = read(other, neutral=change(QUAD), up=LIFTED)
    assert face.triangles.tolist() == [[0, 1, 2], [0, 2, 3]]
    np.testing.assert_array_equal(face.deltas[0, 2], [0, 0, 0.5])


@pytest.mark.parametrize("name", ["neutral", "Neutral", "basis", "generic_neutral_mesh", "head.rest"])
def test_names_of_the_neutral(tmp_path, name):
    assert read(tmp_path, **{name: QUAD, "up": LIFTED}).shapes == ("up",)


def test_no_neutral_or_two(tmp_path):
    assert "none of its 2 .obj files is the neutral face" in refused(tmp_path, a=QUAD, b=LIFTED)
    assert "both basis.obj and neutral.obj" in refused(tmp_path, neutral=QUAD, basis=QUAD)


def test_other_heads_are_no_expressions(tmp_path):
    found, notes = read_obj_folder(
        folder(tmp_path, generic_neutral_mesh=QUAD, jawOpen=LIFTED, identity000=LIFTED, identity_12=LIFTED)
    )
    assert found.shapes == ("jawOpen",)
    assert notes == ("2 identity files make other heads, not expressions: they are left out.",)


def test_no_poses(tmp_path):
    assert "no poses beside neutral.obj" in refused(tmp_path, neutral=QUAD)


def test_another_vertex_count(tmp_path):
    sentence = refused(tmp_path, neutral=QUAD, up="v 2 2 2\n" + LIFTED)
    assert "up.obj: it has 5 vertices, neutral.obj has 4" in sentence


def test_another_face_list(tmp_path):
    sentence = refused(tmp_path, neutral=QUAD, up=LIFTED.replace("f 1 2 3 4", "f 1 2 3\nf 1 3 2"))
    assert "up.obj: its faces are not those of neutral.obj" in sentence


@pytest.mark.parametrize(
    ("bad", "why"),
    [
        (QUAD.replace("v 1 1 0", "v 1 nan 0"), "not a number"),
        (QUAD.replace("v 1 1 0", "v 1 inf 0"), "not a number"),
        (QUAD.replace("v 1 1 0", "v 1 9e9 0"), "above 1,000,000"),
        (QUAD.replace("v 1 1 0", "v 1 one 0"), "no number"),
        (QUAD.replace("v 1 1 0", "v 1 1"), "not three numbers"),
        (QUAD.replace("f 1 2 3 4", "f 1 2 3 9"), "not among its 4"),
        (QUAD.replace("f 1 2 3 4", "f 0 1 2"), "not among its 4"),
        (QUAD.replace("f 1 2 3 4", "f 1 2"), "fewer than three"),
        (QUAD.replace("f 1 2 3 4", "f 1 2 x"), "no number"),
        (QUAD.replace("f 1 2 3 4\n", ""), "no faces"),
        ("f 1 2 3\n", "not three numbers"),
        ("", "not three numbers"),
        ("\0\1\2" * 50, "not three numbers"),
    ],
)
def test_damage_is_named_by_file(tmp_path, bad, why):
    sentence = refused(tmp_path, neutral=bad, up=LIFTED)
    assert "neutral.obj" in sentence
    assert why in sentence


def test_sizes_are_checked_before_memory_is_taken(tmp_path, monkeypatch):
    huge = folder(tmp_path, up=LIFTED) / "neutral.obj"
    with huge.open("wb") as file:
        file.truncate(MAX_TEXT + 1)
    assert "larger than 128 MB" in refused(tmp_path)
    huge.write_text(QUAD)
    for room, limit, value, why in (
        (obj_file, "MAX_LINES", 4, "more than 4 lines"),
        (obj_file, "MAX_VERTICES", 3, "4 vertices, more than 3"),
        (obj_folder, "MAX_POSES", 0, "more than 0"),
        (obj_folder, "MAX_MORPH_BYTES", 95, "4 vertices × 1 poses"),
    ):
        with monkeypatch.context() as patch:
            patch.setattr(room, limit, value)
            assert why in refused(tmp_path)


def test_it_tells_how_far_it_is_and_can_be_ended_there(tmp_path):
    shares = []

    def told(share):
        shares.append(share)
        if len(shares) == end:
            raise UserError("cancelled")

    end = 0
    read_obj_folder(folder(tmp_path, neutral=QUAD, a=LIFTED, b=LIFTED), told)
    assert shares == [0, 0.25, 0.5, 0.75, 1]
    for end in (1, 2, 4):
        shares.clear()
        with pytest.raises(UserError, match="cancelled"):
            read_obj_folder(tmp_path, told)
        assert len(shares) == end


# --- colours

TWO = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 3 0 0\nv 2 1 0\n"


def parts(tmp_path, first, second):
    text = TWO + f"{first}\nf 1 2 3\n{second}\nf 4 5 6\n"
    return read(tmp_path, neutral=text, up=text.replace("v 0 1 0", "v 0 1 1"))


def test_parts_take_the_colour_their_names_suggest(tmp_path):
    face = parts(tmp_path, "g head\nusemtl M_Face", "g mouth\nusemtl M_Teeth")
    np.testing.assert_allclose(face.colours[:3], [SKIN] * 3)
    assert (face.colours[3:, :3].min(axis=1) > 0.6).all(), "teeth are light"


@pytest.mark.parametrize("name", ["helper-l-eye", "CC_Base_Eye", "Eyes", "Eye_L", "Eye.001", "eye_right", "EyeLeft"])
def test_an_eye_is_white(name):
    colour = named_colour(f"{name} Material")
    assert colour is not None
    assert min(colour[:3]) > 0.6


@pytest.mark.parametrize("name", ["Eye_Lid_L", "eyeSocket", "keyes", "Eye_Shadow", "Eyelids", "body"])
def test_what_is_round_an_eye_is_not(name):
    assert named_colour(name) is None


def test_clear_shells_before_the_eyes_are_left_out(tmp_path):
    face = parts(tmp_path, "o Face", "o EyeOcclusion_L")
    assert face.triangles.tolist() == [[0, 1, 2]]
    assert len(face.positions) == 6, "and the vertices keep their numbers"
    (tmp_path / "all").mkdir()
    assert len(parts(tmp_path / "all", "g lens", "g tear").triangles) == 2, "but something is always shown"


def test_the_proxies_of_makehuman_are_left_out(tmp_path):
    face = parts(tmp_path, "g body", "g helper-hair")
    assert face.triangles.tolist() == [[0, 1, 2]]
    assert LEFT_OUT in read_obj_folder(tmp_path)[1]
    for number, group in enumerate(("joint-l-eye", "helper-l-eye", "helper-upper-teeth", "helper-l-eyelashes-1")):
        (tmp_path / group).mkdir()
        assert len(parts(tmp_path / group, "g body", f"g {group}").triangles) == (1 if not number else 2)


def test_colours_of_the_material_file(tmp_path):
    (tmp_path / "face.mtl").write_text("newmtl red\nKd 1 0 0\nnewmtl grey\nKd .8 .8 .8\nnewmtl off\nKd 0 1 0\nd 0.0\n")
    face = parts(tmp_path, "mtllib face.mtl\nusemtl red", "usemtl grey")
    np.testing.assert_allclose(face.colours[:3, :3], [[1, 0, 0]] * 3)
    np.testing.assert_allclose(face.colours[3:], [SKIN] * 3, err_msg="grey is what exporters write for nothing")
    assert len(parts(tmp_path, "mtllib face.mtl\nusemtl red", "usemtl off").triangles) == 1


@pytest.mark.parametrize("library", ["../face.mtl", "/etc/hostname", "none.mtl", "\udc80", "x" * 5000, "a\0b"])
def test_material_files_elsewhere_are_not_read(tmp_path, library):
    (tmp_path / "face.mtl").write_text("newmtl red\nKd 1 0 0\n")
    inside = tmp_path / "inside"
    inside.mkdir()
    text = (f"mtllib {library}\nusemtl red\n" + QUAD).encode(errors="surrogateescape")
    np.testing.assert_allclose(read(inside, neutral=text, up=LIFTED).colours, [SKIN] * 4)


def test_colours_of_the_vertices(tmp_path):
    for top in ("1", "255"):
        face = read(tmp_path, neutral=QUAD.replace(" 0\n", f" 0 {top} 0 0\n"), up=LIFTED)
        np.testing.assert_allclose(face.colours[:, :3], [[1, 0, 0]] * 4)


@pytest.mark.parametrize("number", ["1e300", "nan", "99999999999999999999", "-1e19"])
def test_a_corner_far_beyond_all_vertices_is_refused(tmp_path, number):
    sentence = refused(tmp_path, neutral=QUAD.replace("f 1 2", f"f {number} 2"), up=LIFTED)
    assert "a face uses a vertex" in sentence
