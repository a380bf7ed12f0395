"""A user's rig of 25,000 vertices and 50 shapes: opened within a second, from the cache in a fifth of one.

Run with: pytest tests/bench/test_bench_faces.py --benchmark-only --benchmark-enable
"""

from dataclasses import replace

import numpy as np
import pytest

from core_pipeline.faces.open_face import open_face
from core_pipeline.faces.render.blend import Blend
from core_pipeline.faces.rigs import rig_cache
from core_pipeline.faces.rigs.album import MAX_BYTES
from core_pipeline.faces.texture import Material, Texture
from core_pipeline.poses import FACEFX
from tests.helpers.budget import within
from tests.helpers.rigs import NAMES, PRESETS, as_glb, as_objs, head

SHAPES = ["jawOpen", *(name for name in NAMES["arkit52"] if name != "jawOpen")][:50]


@pytest.fixture(scope="module")
def rig():
    face = head(SHAPES, rings=112)
    assert len(face.positions) > 25_000
    wave = 0.01 * np.sin(7 * face.positions)
    return replace(face, deltas=(face.deltas + wave).astype(np.float32))  # every vertex moves in every shape


def test_open_a_glb(benchmark, rig, tmp_path):
    path = as_glb(rig, tmp_path / "head.glb")
    found = benchmark(open_face, path, PRESETS)
    assert len(found.face.shapes) == 50
    within(benchmark, 1.0)


def test_open_it_again(benchmark, rig, tmp_path):
    path = as_glb(rig, tmp_path / "head.glb")
    open_face(path, PRESETS, cache=tmp_path / "cache")
    found = benchmark(open_face, path, PRESETS, cache=tmp_path / "cache")
    assert len(found.face.shapes) == 50
    within(benchmark, 0.2)


def test_open_it_again_with_as_many_pictures_as_a_rig_may_have(benchmark, rig, tmp_path):
    path, cache = as_glb(rig, tmp_path / "head.glb"), tmp_path / "cache"
    face = open_face(path, PRESETS).face
    pictures = np.random.default_rng(1).integers(0, 256, (4, 2048, 2048, 4), np.uint8)
    assert pictures.nbytes == MAX_BYTES
    dressed = replace(
        face,
        textures=tuple(map(Texture, pictures)),
        materials=dict.fromkeys(face.parts, Material(3)),
        texcoords=face.positions[:, :2],
    )
    rig_cache.keep(path, [path], dressed, (), cache)
    found = benchmark(open_face, path, PRESETS, cache=cache)
    assert len(found.face.textures) == 4
    within(benchmark, 0.2)


def test_blend(benchmark, rig, tmp_path):
    """A frame of speech: one pose goes, another comes."""
    face = open_face(as_glb(rig, tmp_path / "head.glb"), PRESETS).face
    weights = np.array([0.3 if pose in ("PBM", "open") else 0 for pose in FACEFX], np.float32)
    amounts = weights @ face.retarget(FACEFX)
    assert np.count_nonzero(amounts) >= 9
    assert benchmark(Blend(face).mixed, amounts).shape == (len(rig.positions), 6)
    within(benchmark, 0.0003)


def test_blend_all_shapes_at_once(benchmark, rig):
    amounts = np.linspace(0.05, 0.15, 50, dtype=np.float32)  # no two alike: those would be mixed as one
    assert benchmark(Blend(rig).mixed, amounts).shape == (len(rig.positions), 6)
    within(benchmark, 0.002)


def test_open_a_folder_of_objs(benchmark, tmp_path):
    """Text is slower than binary, and a scanned head has twice as many numbers a file; seconds are the goal."""
    folder = as_objs(head(SHAPES[:5], rings=112), tmp_path / "poses")
    found = benchmark.pedantic(open_face, (folder, PRESETS), rounds=2)
    assert len(found.face.shapes) == 5
    within(benchmark, 0.5)
