"""A character's folder: what is saved is loaded; what is damaged is refused by name."""

import json
from dataclasses import replace

import numpy as np
import pytest

from core_pipeline.errors import UserError
from core_pipeline.faces.face import Camera
from core_pipeline.faces.face_folder import load, save
from core_pipeline.faces.texture import Material
from tests.helpers.ball import ball
from tests.helpers.pictures import png, textured

BALL = replace(
    ball(),
    title="The Ball",
    pose_map={"open": {ball().shapes[0]: 0.75}},
    parts={"top": (0, 10), "rest": (10, len(ball().triangles) - 10)},
    closed=frozenset({"rest"}),
    camera=Camera(target=(0.0, 0.25, -1.0), distance=3.5, yaw=15.0, pitch=-4.0, fov=30.0),
)


@pytest.fixture
def folder(tmp_path):
    save(BALL, tmp_path / "ball")
    return tmp_path / "ball"


def change(folder, **fields):
    path = folder / "face.json"
    about = json.loads(path.read_text("utf-8"))
    path.write_text(json.dumps(about | fields), "utf-8")


def test_title_camera_parts_and_mixes_come_back(folder):
    back = load(folder)
    assert (back.name, back.title) == ("ball", "The Ball")
    assert (back.camera, back.parts, back.pose_map) == (BALL.camera, BALL.parts, BALL.pose_map)
    assert back.closed == {"rest"}
    assert back.mix("open") == {BALL.shapes[0]: 0.75}


def test_loading_and_saving_again_changes_nothing(folder, tmp_path):
    first, second = tmp_path / "first" / "ball", tmp_path / "second" / "ball"
    save(load(folder), first)
    save(load(first), second)
    for name in ("face.glb", "face.json"):
        assert first.joinpath(name).read_bytes() == second.joinpath(name).read_bytes()
    assert (first / "face.json").read_bytes() == (folder / "face.json").read_bytes()


def test_a_bare_glb_will_do(folder):
    (folder / "face.json").unlink()
    assert load(folder).title == "ball"


def test_no_face_at_all(tmp_path):
    with pytest.raises(UserError, match=r"no face\.glb"):
        load(tmp_path)


@pytest.mark.parametrize("text", ["", "{", "[]", "{}", '{"format": "other.1"}', "[" * 100_000])
def test_a_damaged_description(folder, text):
    (folder / "face.json").write_text(text, "utf-8")
    with pytest.raises(UserError, match=r"face\.json: is not"):
        load(folder)


def test_bytes_that_are_no_text(folder):
    (folder / "face.json").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(UserError, match=r"face\.json: is not readable"):
        load(folder)


@pytest.mark.parametrize(
    "fields",
    [
        {"camera": {"distance": "far"}},
        {"camera": {"distance": 1e999}},
        {"camera": {"target": [0, 1]}},
        {"camera": {"zoom": 1}},
        {"camera": 3},
        {"pose_map": {"open": ["x"]}},
        {"pose_map": {"open": {"x": None}}},
        {"parts": {"top": [0]}},
        {"parts": {"top": None}},
        {"parts": []},
        {"closed": 3},
    ],
)
def test_fields_that_are_not_as_they_should_be(folder, fields):
    change(folder, **fields)
    with pytest.raises(UserError, match=r"face\.json: its camera, pose_map, parts or closed"):
        load(folder)


def test_a_mix_of_unknown_shapes_and_a_part_outside_the_mesh(folder):
    change(folder, pose_map={"open": {"jawOpen": 1.0}})
    with pytest.raises(UserError, match="jawOpen"):
        load(folder)
    change(folder, pose_map={}, parts={"top": [0, 10**6]}, closed=[])
    with pytest.raises(UserError, match=r"part “top” lies outside"):
        load(folder)


def test_a_closed_part_that_is_none(folder):
    change(folder, closed=["rest", "hat"])
    with pytest.raises(UserError, match=r"no parts to be closed named hat"):
        load(folder)


def test_saving_where_one_cannot(tmp_path):
    (tmp_path / "file").write_text("in the way", "utf-8")
    with pytest.raises(UserError, match="cannot be written"):
        save(BALL, tmp_path / "file")


# --- a file with pictures, put into such a folder


@pytest.fixture
def pictured(tmp_path):
    """Two parts of four triangles, each with a picture of its own."""
    gltf = textured()
    gltf.mesh()["primitives"].append({**gltf.primitive(), "material": 1})
    gltf.json["images"].append({"bufferView": gltf.view(np.frombuffer(png([[[7, 8, 9]]]), np.uint8))})
    gltf.json["textures"].append({"source": 1})
    gltf.json["materials"].append({"pbrMetallicRoughness": {"baseColorTexture": {"index": 1}}})
    (tmp_path / "face.glb").write_bytes(gltf.glb())
    (tmp_path / "face.json").write_text(json.dumps({"format": "lipstitch-face.1"}), "utf-8")
    return tmp_path


def test_pictures_stay_on_their_triangles_whatever_the_parts_are_called(pictured):
    assert dict(load(pictured).materials) == {"tetra": Material(0), "tetra 2": Material(1)}
    change(pictured, parts={"nose": [1, 2], "ear": [4, 4], "nothing": [0, 0]})
    face = load(pictured)
    assert dict(face.materials) == {"nose": Material(0), "ear": Material(1)}
    assert len(face.textures) == 2


def test_a_part_with_two_pictures(pictured):
    change(pictured, parts={"both": [2, 4]})
    with pytest.raises(UserError, match=r"face\.json: part “both” has several pictures"):
        load(pictured)


def test_pictures_cannot_be_saved(pictured, tmp_path):
    with pytest.raises(ValueError, match="a face with pictures cannot be written"):
        save(load(pictured), tmp_path / "copy")
