"""How long a picture of faces takes at 512 × 512: moving at most 16 ms for one of ours, 33 for a large rig.

Run with: pytest tests/bench/test_bench_render.py --benchmark-only --benchmark-enable
"""

from dataclasses import replace
from itertools import count

import numpy as np
import pytest

from app import resources
from core_pipeline.faces import face_folder
from core_pipeline.faces.render.blend import Blend
from core_pipeline.faces.render.renderer import Figure, Renderer
from core_pipeline.faces.texture import Material, Texture
from core_pipeline.faces.view import View
from tests.helpers.ball import ball
from tests.helpers.budget import within
from tests.helpers.rigs import NAMES, head

SIZE = (512, 512)
MOVING, STILL = 1 / 60, 0.15


@pytest.fixture(scope="module")
def renderer():
    renderer = Renderer()
    yield renderer
    renderer.close()


def draw(benchmark, renderer, faces, full_quality=False):
    """One picture after another, each with another mouth."""
    views = [View.on(face) for face in faces]
    steps = count()

    def step():
        amount = 0.1 + 0.05 * (next(steps) % 10)
        figures = []
        for face, view in zip(faces, views, strict=True):
            amounts = np.zeros(len(face.shapes), np.float32)
            amounts[:2] = amount
            figures.append(Figure(face, amounts, view))
        return renderer.draw(figures, SIZE, full_quality)

    assert benchmark(step).shape == (512, 512, 4)


@pytest.mark.parametrize("name", ["toon", "ada", "man", "woman", "crab"])
def test_one_of_ours_moving(benchmark, renderer, name):
    draw(benchmark, renderer, [face_folder.load(resources.face_folder(name))])
    within(benchmark, MOVING)


def test_ada_at_rest_in_full_quality(benchmark, renderer):
    draw(benchmark, renderer, [face_folder.load(resources.face_folder("ada"))], full_quality=True)
    within(benchmark, STILL)


def test_three_of_ours_moving(benchmark, renderer):
    """Beyond the budget the editor draws them in a smaller picture while they move."""
    draw(benchmark, renderer, [face_folder.load(resources.face_folder(name)) for name in ("toon", "man", "woman")])
    within(benchmark, 2 * MOVING)


@pytest.mark.parametrize("pictured", [False, True])
def test_a_large_rig_moving(benchmark, renderer, pictured):
    """25,000 vertices, 50 shapes; bare, and under a picture of 2048 × 2048 pixels."""
    shapes = ["jawOpen", *(name for name in NAMES["arkit52"] if name != "jawOpen")][:50]
    face = head(shapes, rings=112)
    if pictured:
        picture = np.full((2048, 2048, 4), 255, np.uint8)
        picture[..., :3] = np.random.default_rng(1).integers(0, 256, (2048, 2048, 1))
        around = np.arctan2(face.positions[:, 0], face.positions[:, 2]) / (2 * np.pi) + 0.5
        face = replace(
            face,
            parts={"skin": (0, len(face.triangles))},
            textures=(Texture(picture),),
            materials={"skin": Material(0)},
            texcoords=np.stack([around, -0.5 * face.positions[:, 1]], -1).astype(np.float32),
        )
    draw(benchmark, renderer, [face])
    within(benchmark, 1 / 30)


@pytest.mark.parametrize("kind", ["mixed", "exact"])
def test_blend(benchmark, kind):
    face = ball(57)
    vertices = benchmark(getattr(Blend(face), kind), np.array([0.4, 0.2], np.float32))
    assert vertices.shape == (len(face.positions), 6)
