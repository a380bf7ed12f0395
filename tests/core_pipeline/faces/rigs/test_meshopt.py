"""Compressed buffer views: streams from the reference encoder come back as what they were made from."""

import random
import struct

import numpy as np
import pytest

from core_pipeline.errors import UserError
from core_pipeline.faces.rigs.glb import read_glb
from core_pipeline.faces.rigs.meshopt import decode
from tests.helpers.gltf import tetrahedron
from tests.helpers.meshopt_streams import CORNERS, STREAMS, packed_tetrahedron

SEQUENCE = [0, 1, 2, 2, 1, 3, 500, 4, 501, 5, 70000, 6]


def rows(name, count, stride, kind="NONE", dtype="<i2", mode="ATTRIBUTES"):
    return np.frombuffer(decode(STREAMS[name], count, stride, mode, kind), dtype).reshape(count, -1)


def test_attributes():
    i = np.arange(300)
    expected = np.stack([i // 3, i * i % 4001, np.where(i % 40 == 0, (i * 7919) % 30000, 0), 5 - i], 1)
    np.testing.assert_array_equal(rows("attributes", 300, 8), expected.astype(np.int16))


@pytest.mark.parametrize(("stride", "dtype"), [(2, "<u2"), (4, "<u4")])
def test_triangles_keep_their_corners_and_direction(stride, dtype):
    found = rows("triangles", 3 * len(CORNERS), stride, dtype=dtype, mode="TRIANGLES").reshape(-1, 3)

    def from_the_least(triangles):
        return [tuple(np.roll(t, -int(np.argmin(t)))) for t in triangles]

    assert from_the_least(found) == from_the_least(CORNERS)


def test_index_sequences():
    assert rows("indices", len(SEQUENCE), 4, dtype="<u4", mode="INDICES")[:, 0].tolist() == SEQUENCE


@pytest.mark.parametrize(
    ("name", "stride", "dtype", "top"), [("octahedral16", 8, "<i2", 32767), ("octahedral8", 4, "i1", 127)]
)
def test_directions(name, stride, dtype, top):
    directions = np.array([[1, 0, 0], [0, -1, 0], [0.6, -0.48, -0.64], [-0.2, 0.3, -0.93]])
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    found = rows(name, 4, stride, "OCTAHEDRAL", dtype) / top
    np.testing.assert_allclose(found[:, :3], directions, atol=2e-3 if top > 127 else 2e-2)
    np.testing.assert_allclose(found[:, 3], [0, 1, 0, 0], atol=1e-3)


def test_rotations():
    expected = np.array([[0, 0, 0, 1], [0.5, 0.5, 0.5, 0.5], [0.8, 0, -0.6, 0], [0, -0.28, 0, 0.96]])
    found = rows("quaternion", 4, 8, "QUATERNION") / 32767
    np.testing.assert_allclose(np.abs((found * expected).sum(1)), 1, atol=1e-3)


def test_floats():
    expected = [[0, 1.5, -2.25], [1000, 0.001, -0.5], [3, 4, 5], [1e-6, 0, 1]]
    np.testing.assert_allclose(rows("exponential", 4, 12, "EXPONENTIAL", "<f4"), expected, rtol=1e-5)


def test_a_packed_file_is_the_same_face(tmp_path):
    (tmp_path / "packed.glb").write_bytes(packed_tetrahedron().glb())
    (tmp_path / "plain.glb").write_bytes(tetrahedron().glb())
    packed, plain = read_glb(tmp_path / "packed.glb"), read_glb(tmp_path / "plain.glb")
    np.testing.assert_array_equal(packed.positions, plain.positions)
    np.testing.assert_allclose(packed.deltas, plain.deltas, atol=1e-6)
    assert {frozenset(t) for t in packed.triangles.tolist()} == {frozenset(t) for t in plain.triangles.tolist()}
    np.testing.assert_allclose(packed.normals, plain.normals, atol=1e-6)


@pytest.mark.parametrize(
    ("change", "why"),
    [
        ({"mode": "CUBES"}, "packed as 'CUBES'"),
        ({"filter": "BLUR"}, "filter 'BLUR'"),
        ({"byteStride": 7}, "announced"),
        ({"count": 2**38}, "announced"),
        ({"byteLength": 5}, "cut off"),
        ({"byteOffset": 10**6}, "ends at byte"),
        ({"buffer": 7}, "refers to buffers 7"),
    ],
)
def test_damage_is_a_sentence(tmp_path, change, why):
    gltf = packed_tetrahedron()
    view = gltf.json["accessors"][gltf.primitive()["attributes"]["POSITION"]]["bufferView"]
    gltf.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"] |= change
    (tmp_path / "face.glb").write_bytes(gltf.glb())
    with pytest.raises(UserError, match=rf"face\.glb: .*{why}"):
        read_glb(tmp_path / "face.glb")


MODES = {"triangles": ("TRIANGLES", 3 * len(CORNERS), 4), "indices": ("INDICES", len(SEQUENCE), 4)}


@pytest.mark.parametrize("name", ["attributes", "triangles", "indices", "exponential"])
def test_no_damage_ends_in_anything_but_a_value_error(name):
    mode, count, stride = MODES.get(name, ("ATTRIBUTES", 300, 8) if name == "attributes" else ("ATTRIBUTES", 4, 12))
    chance = random.Random(name)
    outcomes = set()
    for _ in range(300):
        data = bytearray(STREAMS[name])
        for _ in range(chance.randint(1, 3)):
            data[chance.randrange(len(data))] = chance.randrange(256)
        del data[len(data) - chance.choice([0, 0, 0, 1, 17, len(data) - 1]) :]
        try:
            outcomes.add(len(decode(bytes(data), count, stride, mode)))
        except ValueError:
            outcomes.add(None)
    assert outcomes == {None, count * stride}


def test_a_few_bytes_cannot_ask_for_much_memory():
    for mode, head in (("ATTRIBUTES", 0xA0), ("TRIANGLES", 0xE1), ("INDICES", 0xD1)):
        with pytest.raises(ValueError, match=r"cut off|cannot hold"):
            decode(struct.pack("<B", head) + bytes(40), 3 * 10**7, 4, mode)
