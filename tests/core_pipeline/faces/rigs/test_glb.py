"""Reading any .glb or .gltf: what is written comes back; what is broken is refused in one sentence."""

import base64
import json
import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.errors import UserError
from core_pipeline.faces.normals import VertexNormals
from core_pipeline.faces.rigs import glb, gltf_file
from core_pipeline.faces.rigs.glb import read_glb, read_rig
from core_pipeline.faces.rigs.glb_write import glb_bytes, write_glb
from core_pipeline.faces.rigs.scaffold import LEFT_OUT
from tests.helpers.ball import ball
from tests.helpers.gltf import Gltf, tetrahedron

BALL = ball()


def read(tmp_path, gltf, name="face.glb"):
    path = tmp_path / name
    path.write_bytes(gltf.glb() if isinstance(gltf, Gltf) else gltf)
    return read_glb(path)


def refuse(tmp_path, gltf, name="face.glb"):
    with pytest.raises(UserError) as caught:
        read(tmp_path, gltf, name)
    sentence = str(caught.value)
    assert sentence.startswith(name)
    assert "\n" not in sentence
    return sentence


def read_or_refuse(path):
    """The face, or None after a sentence about this file; anything else that is raised comes through."""
    try:
        return read_glb(path)
    except UserError as error:
        if not str(error).startswith(path.name):
            raise
        return None


# --- what is written comes back


def test_a_face_survives_writing_and_reading(tmp_path):
    write_glb(BALL, tmp_path / "ball.glb")
    back = read_glb(tmp_path / "ball.glb")
    assert back.shapes == BALL.shapes
    for name in ("positions", "triangles", "colours", "deltas"):
        np.testing.assert_array_equal(getattr(back, name), getattr(BALL, name), err_msg=name)
    np.testing.assert_allclose(back.normals, BALL.normals, atol=1e-6)
    assert back.positions.dtype == back.deltas.dtype == back.normal_deltas.dtype == np.float32
    assert back.triangles.dtype == np.uint32


def test_writing_is_deterministic_and_says_where_it_cannot(tmp_path):
    assert glb_bytes(BALL) == glb_bytes(BALL)
    with pytest.raises(UserError, match=r"nowhere.*cannot be written"):
        write_glb(BALL, tmp_path / "nowhere" / "ball.glb")


def test_normal_deltas_are_those_of_the_full_pose(tmp_path):
    back = read(tmp_path, tetrahedron())

    def exact(points):
        a, b, c = (points[back.triangles[:, i]].astype(float) for i in range(3))
        summed = np.zeros((len(points), 3))
        for corner in range(3):
            np.add.at(summed, back.triangles[:, corner], np.cross(b - a, c - a))
        return summed / np.linalg.norm(summed, axis=1, keepdims=True)

    expected = exact(back.positions + back.deltas[0]) - exact(back.positions)
    np.testing.assert_allclose(back.normal_deltas[0], expected, atol=1e-6)


# --- layouts


def test_the_plainest_file(tmp_path):
    face = read(tmp_path, tetrahedron())
    assert face.name == face.title == "face"
    assert face.shapes == ("up",)
    assert len(face.triangles) == 4
    np.testing.assert_allclose(np.linalg.norm(face.normals, axis=1), 1, atol=1e-6)
    np.testing.assert_allclose(face.deltas[0, :, 1], [0, 0, 0, 1])


def test_sparse_targets_equal_dense_ones(tmp_path):
    dense, sparse = tetrahedron(), tetrahedron()
    target = sparse.mesh()["primitives"][0]["targets"][0]
    target["POSITION"] = sparse.sparse(4, [3], np.array([[0, 1, 0]], np.float32))
    np.testing.assert_array_equal(read(tmp_path, sparse).deltas, read(tmp_path, dense).deltas)


@pytest.mark.parametrize(("dtype", "top"), [(np.int8, 127), (np.uint8, 255), (np.int16, 32767), (np.uint16, 65535)])
def test_normalised_integers_become_fractions(tmp_path, dtype, top):
    gltf = tetrahedron()
    values = np.array([[0, 0, 0], [top, 0, 0], [0, top, 0], [0, 0, top // 2]], dtype)
    gltf.primitive()["attributes"]["POSITION"] = gltf.accessor(values, normalized=True)
    positions = read(tmp_path, gltf).positions
    np.testing.assert_allclose(positions, values.astype(float) / top, atol=1e-6)


def test_the_lowest_normalised_integer_is_minus_one(tmp_path):
    gltf = tetrahedron()
    delta = np.array([[-128, 0, 127]] * 4, np.int8)
    gltf.primitive()["targets"][0]["POSITION"] = gltf.accessor(delta, normalized=True)
    np.testing.assert_allclose(read(tmp_path, gltf).deltas[0, 0], (-1, 0, 1))


def test_quantised_integers_are_put_in_place_by_their_node(tmp_path):
    gltf = tetrahedron()
    gltf.json["extensionsRequired"] = ["KHR_mesh_quantization"]
    gltf.primitive()["attributes"]["POSITION"] = gltf.accessor(
        np.array([[0, 0, 0], [8, 0, 0], [0, 8, 0], [0, 0, 8]], np.int16)
    )
    gltf.json["nodes"][0]["scale"] = [0.125, 0.125, 0.125]
    np.testing.assert_allclose(read(tmp_path, gltf).positions.max(0), 1)


def test_interleaved_vertices(tmp_path):
    gltf = tetrahedron()
    points = gltf.points()
    both = np.concatenate([points, np.tile(np.float32([0, 0, 1]), (4, 1))], axis=1)
    view = gltf.view(both, stride=24)
    accessors = gltf.json["accessors"]
    for name, offset in (("POSITION", 0), ("NORMAL", 12)):
        accessors.append({"bufferView": view, "byteOffset": offset, "componentType": 5126, "count": 4, "type": "VEC3"})
        gltf.primitive()["attributes"][name] = len(accessors) - 1
    face = read(tmp_path, gltf)
    np.testing.assert_array_equal(face.positions, points)
    np.testing.assert_array_equal(face.normals, np.tile(np.float32([0, 0, 1]), (4, 1)))


def test_nodes_move_turn_and_scale_positions_and_deltas(tmp_path):
    gltf = tetrahedron()
    half = np.sqrt(0.5)
    gltf.json["nodes"] = [
        {"children": [1], "translation": [10, 0, 0]},
        {"mesh": 0, "rotation": [0, 0, half, half], "scale": [2, 2, 2]},
    ]
    face = read(tmp_path, gltf)
    x, y, z = tetrahedron().points().T
    np.testing.assert_allclose(face.positions, np.stack([10 - 2 * y, 2 * x, 2 * z], -1), atol=1e-5)
    np.testing.assert_allclose(face.deltas[0, 3], (-2, 0, 0), atol=1e-6)


def test_a_mirroring_node_turns_the_triangles_round(tmp_path):
    gltf = tetrahedron()
    gltf.json["nodes"][0]["matrix"] = np.diag([-1.0, 1, 1, 1]).ravel().tolist()
    plain, mirrored = read(tmp_path, tetrahedron()), read(tmp_path, gltf)

    def volume(face):
        return np.einsum(
            "ij,ij->i",
            *np.split(
                np.concatenate(
                    [
                        face.positions[face.triangles[:, 0]],
                        np.cross(face.positions[face.triangles[:, 1]], face.positions[face.triangles[:, 2]]),
                    ]
                ),
                2,
            ),
        ).sum()

    assert volume(plain) == pytest.approx(volume(mirrored))
    assert volume(plain) > 0


def test_several_meshes_and_primitives_become_one_and_share_shapes(tmp_path):
    gltf = tetrahedron()
    gltf.mesh()["primitives"].append(json.loads(json.dumps(gltf.primitive())))
    gltf.json["meshes"].append(json.loads(json.dumps(gltf.mesh())))
    gltf.json["meshes"][1]["extras"] = {"targetNames": ["down"]}
    gltf.json["meshes"][1]["name"] = "jaw"
    gltf.json["meshes"][1]["primitives"].pop()
    gltf.json["nodes"].append({"mesh": 1, "translation": [0, 5, 0]})
    gltf.json["scenes"][0]["nodes"] = [0, 1]
    face = read(tmp_path, gltf)
    assert face.shapes == ("up", "down")
    assert len(face.positions) == 12
    np.testing.assert_array_equal(face.deltas[0].any(axis=1), [0, 0, 0, 1] * 2 + [0] * 4)
    np.testing.assert_array_equal(face.deltas[1].any(axis=1), [0] * 8 + [0, 0, 0, 1])
    assert face.parts == {"tetra": (0, 4), "tetra 2": (4, 4), "jaw": (8, 4)}
    assert face.triangles[8:].min() == 8


def test_vertex_colours_times_the_materials_colour(tmp_path):
    gltf = tetrahedron()
    gltf.primitive()["attributes"]["COLOR_0"] = gltf.accessor(
        np.array([[255, 0, 0, 255]] * 4, np.uint8), normalized=True
    )
    gltf.json["materials"] = [{"pbrMetallicRoughness": {"baseColorFactor": [0.5, 1, 1, 1], "roughnessFactor": 0.25}}]
    gltf.primitive()["material"] = 0
    np.testing.assert_allclose(read(tmp_path, gltf).colours, [[0.5, 0, 0, 0.75]] * 4)


def test_a_seam_with_equal_normals_stays_smooth(tmp_path):
    gltf = Gltf()
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 0, 0], [1, 1, 1], [0, 1, 0]], np.float32)
    gltf.add_mesh(points, [0, 1, 2, 3, 4, 5], {"bend": np.eye(6, 3, dtype=np.float32)})
    face = read(tmp_path, gltf)
    np.testing.assert_array_equal(face.normals[1], face.normals[3])
    np.testing.assert_allclose(face.normals[2] + face.normal_deltas[0, 2], face.normals[5] + face.normal_deltas[0, 5])


def test_skinned_vertices_stand_where_their_joints_put_them(tmp_path):
    gltf = tetrahedron()
    gltf.primitive()["attributes"]["JOINTS_0"] = gltf.accessor(np.array([[0, 1, 0, 0]] * 4, np.uint8))
    gltf.primitive()["attributes"]["WEIGHTS_0"] = gltf.accessor(np.array([[0.5, 0.5, 0, 0]] * 4, np.float32))
    gltf.json["skins"] = [{"joints": [1, 2]}]
    gltf.json["nodes"] = [
        {"mesh": 0, "skin": 0, "translation": [99, 99, 99]},
        {"translation": [2, 0, 0]},
        {"translation": [0, 4, 0]},
    ]
    gltf.json["scenes"][0]["nodes"] = [0, 1, 2]
    np.testing.assert_allclose(read(tmp_path, gltf).positions, tetrahedron().points() + np.array([1, 2, 0]), atol=1e-6)


def test_a_vertex_may_hang_on_more_than_four_joints(tmp_path):
    gltf = tetrahedron()
    attributes = gltf.primitive()["attributes"]
    for number, joints in enumerate(([0, 1, 2, 3], [4, 0, 0, 0])):
        attributes[f"JOINTS_{number}"] = gltf.accessor(np.array([joints] * 4, np.uint8))
    attributes["WEIGHTS_0"] = gltf.accessor(np.array([[0.2, 0.2, 0.2, 0.2]] * 4, np.float32))
    attributes["WEIGHTS_1"] = gltf.accessor(np.array([[0.2, 0, 0, 0]] * 4, np.float32))
    gltf.json["skins"] = [{"joints": [1, 2, 3, 4, 5]}]
    gltf.json["nodes"] = [{"mesh": 0, "skin": 0}, *({"translation": [0, 0, far]} for far in (0, 0, 0, 0, 10))]
    gltf.json["scenes"][0]["nodes"] = list(range(6))
    np.testing.assert_allclose(read(tmp_path, gltf).positions, tetrahedron().points() + np.array([0, 0, 2]), atol=1e-6)


def test_a_mesh_without_a_name_is_called_as_what_it_hangs_on(tmp_path):
    gltf = tetrahedron()
    del gltf.mesh()["name"]
    gltf.json["nodes"] = [{"name": "Head", "children": [1]}, {"mesh": 0}]
    assert list(read(tmp_path, gltf).parts) == ["Head"]


@pytest.mark.parametrize("holder", ["meshes", "nodes"])
def test_a_person_made_by_shapes_stands_so_and_an_expression_does_not(tmp_path, holder):
    gltf = tetrahedron()
    person = np.tile(np.float32([[0, 0, 2]]), (4, 1))
    gltf.primitive()["targets"].append({"POSITION": gltf.accessor(person)})
    gltf.mesh()["extras"]["targetNames"] = ["up", "$md-tall"]
    gltf.mesh()["weights"] = [0, 0]
    gltf.json[holder][0]["weights"] = [0.5, 0.25]
    path = tmp_path / "head.glb"
    path.write_bytes(gltf.glb())
    face, _, notes = read_rig(path, expressions_among=lambda shapes: {"up"} & set(shapes))
    np.testing.assert_allclose(face.positions, tetrahedron().points() + np.array([0, 0, 0.5]), atol=1e-6)
    assert [note.rpartition(": ")[2] for note in notes] == ["$md-tall.", "up."]
    np.testing.assert_allclose(read(tmp_path, gltf).positions, tetrahedron().points())


def test_normals_follow_the_person_and_keep_their_edges(tmp_path):
    gltf = tetrahedron()
    flat = tetrahedron().points() * np.float32([0, 0, -0.5])
    gltf.primitive()["targets"] = [{"POSITION": gltf.accessor(flat)}]
    gltf.mesh()["extras"]["targetNames"] = ["build"]
    plain = read(tmp_path, gltf)
    gltf.primitive()["attributes"]["NORMAL"] = gltf.accessor(plain.normals)
    gltf.mesh()["weights"] = [1]
    path = tmp_path / "head.glb"
    path.write_bytes(gltf.glb())
    found = read_rig(path, expressions_among=lambda _: ())[0]
    wanted = VertexNormals(plain.triangles, np.arange(4)).of(plain.positions + flat)
    np.testing.assert_allclose(found.normals, wanted, atol=1e-6)


@pytest.mark.parametrize("weights", [[1], "all", [float("1e99"), 0], {}])
def test_amounts_that_fit_nothing_are_no_person(tmp_path, weights):
    gltf = tetrahedron()
    gltf.mesh()["weights"] = weights
    if weights == [1]:
        gltf.mesh()["weights"] = [1, 1, 1]
    path = tmp_path / "head.glb"
    path.write_bytes(gltf.glb())
    np.testing.assert_allclose(read_rig(path, expressions_among=lambda _: ())[0].positions, tetrahedron().points())


@pytest.mark.parametrize(
    ("node", "material", "part"),
    [
        ("CC_Base_Tongue", "Std_Skin", "tongue (CC_Base_Tongue)"),
        ("Teeth", "Std_Tongue", "tongue (Teeth)"),
        ("tongue", "tongue", "tongue"),
        ("Head", "teeth_tongue", "Head"),
    ],
)
def test_a_tongue_is_called_so(tmp_path, node, material, part):
    gltf = tetrahedron()
    gltf.json["nodes"][0]["name"] = node
    gltf.json["materials"] = [{"name": material}]
    gltf.primitive()["material"] = 0
    assert list(read(tmp_path, gltf).parts) == [part]


@pytest.mark.parametrize("where", ["node", "mesh", "material"])
def test_what_only_tools_need_is_left_out(tmp_path, where):
    gltf = tetrahedron()
    points = tetrahedron().points()
    gltf.add_mesh(points + 5, [0, 2, 1], {"up": np.ones((4, 3), np.float32)}, "WGT-rig_jaw" if where == "mesh" else "x")
    gltf.json["materials"] = [{"name": "helper-tights" if where == "material" else "skin"}]
    gltf.json["meshes"][1]["primitives"][0]["material"] = 0
    if where == "node":
        gltf.json["nodes"][1]["name"] = "joint-l-eye"
    path = tmp_path / "head.glb"
    path.write_bytes(gltf.glb())
    face, _, notes = read_rig(path)
    assert list(face.parts) == ["tetra"]
    assert notes == (LEFT_OUT,)


def test_but_a_rig_of_nothing_else_is_shown(tmp_path):
    gltf = tetrahedron()
    gltf.json["nodes"][0]["name"] = "joint-venture"
    assert list(read(tmp_path, gltf).parts) == ["joint-venture"]


def test_strips_and_fans(tmp_path):
    for mode in (5, 6):
        gltf = Gltf()
        points = np.array(
            [[0, 0, 0], [1, 0, 0], [0, 1, 0] if mode == 5 else [1, 1, 0], [1, 1, 0] if mode == 5 else [0, 1, 0]]
        )
        gltf.add_mesh(points.astype(np.float32), [0, 1, 2, 3], {"x": np.eye(4, 3, dtype=np.float32)})
        gltf.primitive()["mode"] = mode
        face = read(tmp_path, gltf)
        assert len(face.triangles) == 2
        np.testing.assert_allclose(face.normals, [[0, 0, 1]] * 4)


def test_text_files_with_data_inside_or_beside(tmp_path):
    gltf = tetrahedron()
    expected = read(tmp_path, gltf)
    (tmp_path / "data with space.bin").write_bytes(gltf.data)
    inside = "data:application/octet-stream;base64," + base64.b64encode(gltf.data).decode()
    for uri in (inside, "data%20with%20space.bin"):
        gltf.json["buffers"] = [{"byteLength": len(gltf.data), "uri": uri}]
        back = read(tmp_path, json.dumps(gltf.json).encode(), "face.gltf")
        np.testing.assert_array_equal(back.positions, expected.positions)


def test_targets_without_names_are_numbered(tmp_path):
    gltf = tetrahedron()
    del gltf.mesh()["extras"]
    assert read(tmp_path, gltf).shapes == ("target 0",)


# --- refusals


def test_a_missing_file(tmp_path):
    with pytest.raises(UserError, match=r"no\.glb.*cannot be read"):
        read_glb(tmp_path / "no.glb")


@pytest.mark.parametrize("raw", [b"", b"PNG", b"solid cube", b"\x00" * 200, b"[1, 2]"])
def test_not_a_gltf(tmp_path, raw):
    assert "not a glTF 2.0 file" in refuse(tmp_path, raw)


@pytest.mark.parametrize("raw", [b"{", b'{"asset": ', b"{" * 3 + b"[" * 200_000])
def test_damaged_description(tmp_path, raw):
    assert "description is damaged" in refuse(tmp_path, raw)


def test_another_version(tmp_path):
    assert "version 1" in refuse(tmp_path, struct.pack("<4sII", b"glTF", 1, 20) + b"\0" * 8)
    assert "version 1.0" in refuse(tmp_path, b'{"asset": {"version": "1.0"}}')


@given(st.integers(0, 3000))
def test_every_cut_is_noticed(tmp_path_factory, where):
    whole = tetrahedron().glb()
    refuse(tmp_path_factory.mktemp("cut"), whole[: min(where, len(whole) - 1)])


@given(st.data())
def test_no_damage_ends_in_anything_but_a_sentence(tmp_path_factory, data):
    raw = bytearray(tetrahedron().glb())
    for _ in range(data.draw(st.integers(1, 4))):
        raw[data.draw(st.integers(0, len(raw) - 1))] = data.draw(st.integers(0, 255))
    path = tmp_path_factory.mktemp("hit") / "face.glb"
    path.write_bytes(bytes(raw))
    face = read_or_refuse(path)
    assert face is None or face.triangles.max() < len(face.positions)


JUNK = st.recursive(
    st.none() | st.booleans() | st.integers(-3, 2**40) | st.floats(allow_nan=False) | st.text(max_size=4),
    lambda inner: (
        st.lists(inner, max_size=3) | st.dictionaries(st.sampled_from(["mesh", "count", "x"]), inner, max_size=3)
    ),
    max_leaves=5,
)


@given(st.data())
def test_no_nonsense_in_the_description_ends_in_anything_but_a_sentence(tmp_path_factory, data):
    gltf = tetrahedron()
    gltf.json["materials"] = [{"pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 1]}}]
    gltf.primitive()["material"] = 0
    at = gltf.json
    while True:
        keys = list(at) if isinstance(at, dict) else list(range(len(at)))
        key = data.draw(st.sampled_from(keys))
        if isinstance(at[key], dict | list) and at[key] and data.draw(st.booleans()):
            at = at[key]
            continue
        at[key] = data.draw(JUNK)
        break
    path = tmp_path_factory.mktemp("nonsense") / "face.glb"
    path.write_bytes(gltf.glb())
    read_or_refuse(path)


def test_accessor_past_its_buffer(tmp_path):
    gltf = tetrahedron()
    gltf.json["accessors"][0]["count"] = 5
    for target in ("POSITION",):
        gltf.json["accessors"][gltf.primitive()["targets"][0][target]]["count"] = 5
    assert "past the end" in refuse(tmp_path, gltf)
    gltf = tetrahedron()
    gltf.json["bufferViews"][0]["byteLength"] = 10_000
    assert "ends at byte" in refuse(tmp_path, gltf)
    gltf = tetrahedron()
    gltf.json["buffers"][0]["byteLength"] = 10_000
    assert "cut off" in refuse(tmp_path, gltf)


def test_index_past_the_vertices(tmp_path):
    gltf = tetrahedron()
    gltf.primitive()["indices"] = gltf.accessor(np.array([[0], [1], [4]], np.uint16))
    assert "uses vertex 4 but has 4" in refuse(tmp_path, gltf)


def test_indices_that_are_no_triangles(tmp_path):
    gltf = tetrahedron()
    gltf.primitive()["indices"] = gltf.accessor(np.array([[0], [1]], np.uint16))
    assert "not a multiple of 3" in refuse(tmp_path, gltf)


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_values_that_are_no_numbers(tmp_path, bad):
    for where in ("attributes", "targets"):
        gltf = tetrahedron()
        values = np.array([[0, 0, bad]] * 4, np.float32)
        holder = gltf.primitive()[where] if where == "attributes" else gltf.primitive()[where][0]
        holder["POSITION"] = gltf.accessor(values)
        assert "not numbers" in refuse(tmp_path, gltf)


def test_no_morph_targets(tmp_path):
    gltf = tetrahedron()
    del gltf.primitive()["targets"], gltf.mesh()["extras"]
    assert "no morph targets" in refuse(tmp_path, gltf)


def test_counts_that_do_not_agree(tmp_path):
    gltf = tetrahedron()
    gltf.primitive()["targets"][0]["POSITION"] = gltf.accessor(np.zeros((3, 3), np.float32))
    assert "4 vertices but 3 values of POSITION" in refuse(tmp_path, gltf)
    gltf = tetrahedron()
    gltf.mesh()["extras"]["targetNames"].append("more")
    assert "1 morph targets but names 2" in refuse(tmp_path, gltf)
    gltf = tetrahedron()
    other = json.loads(json.dumps(gltf.primitive()))
    other["targets"] = []
    gltf.mesh()["primitives"].append(other)
    assert "different numbers of morph targets" in refuse(tmp_path, gltf)


def test_unknown_required_extension(tmp_path):
    gltf = tetrahedron()
    gltf.json["extensionsRequired"] = ["KHR_no_such_thing"]
    assert "KHR_no_such_thing" in refuse(tmp_path, gltf)


@pytest.mark.parametrize("uri", ["../secret.bin", "/etc/hostname", "http://example.org/a.bin", "file:///etc/hostname"])
def test_buffers_outside_the_folder(tmp_path, uri):
    gltf = tetrahedron()
    gltf.json["buffers"] = [{"byteLength": len(gltf.data), "uri": uri}]
    assert "outside the file's folder" in refuse(tmp_path, json.dumps(gltf.json).encode(), "face.gltf")


def test_a_file_too_large_is_not_even_opened(tmp_path):
    path = tmp_path / "huge.glb"
    with path.open("wb") as file:
        file.truncate(gltf_file.MAX_FILE + 1)
    with pytest.raises(UserError, match=r"huge\.glb.*512 MB"):
        read_glb(path)


def test_sizes_are_checked_before_memory_is_taken(tmp_path):
    """A few hundred bytes that announce thousands of millions of vertices."""
    gltf = tetrahedron()
    for count in (2**31, glb.MAX_VERTICES + 1):
        for accessor in gltf.json["accessors"]:
            accessor.pop("bufferView", None)
            accessor["count"] = count
        assert "more than" in refuse(tmp_path, gltf)
    for accessor in gltf.json["accessors"]:
        accessor["count"] = 1_900_000
    gltf.primitive()["targets"] = gltf.primitive()["targets"] * 200
    gltf.mesh()["extras"]["targetNames"] = [f"shape {n}" for n in range(200)]
    assert "more than 512 MB" in refuse(tmp_path, gltf)


def test_nodes_that_go_round_in_circles(tmp_path):
    gltf = tetrahedron()
    gltf.json["nodes"] = [{"mesh": 0, "children": [1]}, {"children": [0]}]
    assert "twice" in refuse(tmp_path, gltf)
