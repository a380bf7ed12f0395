"""Draco: unpacked when it fits the shapes, refused when its vertices were put in another order."""

import DracoPy
import numpy as np
import pytest

from core_pipeline.errors import UserError
from core_pipeline.faces.rigs.glb import read_glb
from tests.helpers.gltf import tetrahedron


def packed(points, corners, **changes):
    gltf = tetrahedron()
    data = DracoPy.encode(
        points, np.array(corners, np.uint32).reshape(-1, 3), quantization_bits=16, preserve_order=True
    )
    primitive = gltf.primitive()
    for index in (primitive["attributes"]["POSITION"], primitive["indices"]):
        del gltf.json["accessors"][index]["bufferView"]
    extension = {"bufferView": gltf.view(np.frombuffer(data, np.uint8)), "attributes": {"POSITION": 0}} | changes
    primitive["extensions"] = {"KHR_draco_mesh_compression": extension}
    gltf.json["extensionsRequired"] = ["KHR_draco_mesh_compression"]
    return gltf


CORNERS = [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]
POINTS = tetrahedron().points()


def test_a_packed_file_is_the_same_face(tmp_path):
    (tmp_path / "packed.glb").write_bytes(packed(POINTS, CORNERS).glb())
    (tmp_path / "plain.glb").write_bytes(tetrahedron().glb())
    back, plain = read_glb(tmp_path / "packed.glb"), read_glb(tmp_path / "plain.glb")
    np.testing.assert_allclose(back.positions, plain.positions, atol=1e-4)
    np.testing.assert_array_equal(back.triangles, plain.triangles)
    np.testing.assert_array_equal(back.deltas, plain.deltas)


def refused(tmp_path, gltf):
    (tmp_path / "face.glb").write_bytes(gltf.glb())
    with pytest.raises(UserError, match=r"^face\.glb: ") as caught:
        read_glb(tmp_path / "face.glb")
    return str(caught.value)


def test_another_count_means_another_order(tmp_path):
    more = np.concatenate([POINTS, [[2, 2, 2]]]).astype(np.float32)
    assert "holds 5 POSITION where 4 are announced" in refused(tmp_path, packed(more, [*CORNERS[:9], 1, 2, 4]))


def test_damage_is_a_sentence(tmp_path):
    assert "has no POSITION" in refused(tmp_path, packed(POINTS, CORNERS, attributes={"POSITION": 9}))
    assert "cannot be unpacked" in refused(tmp_path, packed(POINTS, CORNERS, bufferView=0))
    assert "refers to bufferViews 99" in refused(tmp_path, packed(POINTS, CORNERS, bufferView=99))


def test_without_the_package_the_extra_is_named(tmp_path, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "DracoPy", None)
    assert "lipstitch[draco]" in refused(tmp_path, packed(POINTS, CORNERS))
