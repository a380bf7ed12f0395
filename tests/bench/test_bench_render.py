"""How long a frame takes: 12,800 triangles at 512 × 512. The goal is 16 ms while moving, 33 at most.

Run with: pytest tests/bench/test_bench_render.py --benchmark-only -o addopts=""
"""

import numpy as np
import pytest

from core_pipeline.faces.blend import Blend
from core_pipeline.faces.render import FaceRenderer
from core_pipeline.faces.view import View
from tests.helpers.ball import ball

FACE = ball(57)
AMOUNTS = np.array([0.4, 0.2], np.float32)


@pytest.mark.parametrize("full_quality", [False, True], ids=["moving", "full quality"])
def test_frame(benchmark, full_quality):
    renderer = FaceRenderer(FACE)
    pixels = benchmark(renderer.frame, AMOUNTS, View.of(FACE.camera), (512, 512), full_quality)
    assert pixels.shape == (512, 512, 4)
    renderer.close()


@pytest.mark.parametrize("kind", ["mixed", "exact"])
def test_blend(benchmark, kind):
    vertices = benchmark(getattr(Blend(FACE), kind), AMOUNTS)
    assert vertices.shape == (len(FACE.positions), 6)
