"""How long the stage overlay takes at 1600 × 330 with 40 phones and nine poses.

Goals: one pose edited and painted 4 ms, everything 12 ms, the playhead 0.3 ms.
Run with: pytest tests/bench/test_bench_overlay.py --benchmark-only -o addopts="--import-mode=importlib"
"""

from itertools import cycle

import pytest
from PySide6.QtWidgets import QApplication

from core_pipeline.curves import Curve
from tests.helpers.budget import within
from tests.helpers.stages import curve_set, sentence
from widgets.overlay.stage_panel import StagePanel

PHONES = " ".join(["sil ah f ah bmp d l ow sil w"] * 4)
ONE_POSE, EVERYTHING, PLAYHEAD = 4e-3, 12e-3, 0.3e-3  # seconds


@pytest.fixture
def overlay(qtbot):
    panel = StagePanel()
    panel.resize(1600, 330)
    qtbot.addWidget(panel)
    panel.set_stages(sentence(PHONES))
    with qtbot.waitExposed(panel):
        panel.show()
    QApplication.processEvents()
    return panel.overlay


def test_one_pose_edited(benchmark, overlay):
    curves = curve_set()
    f_ah = curves.bigrams["f", "ah"]
    edits = [
        curves.with_bigram(("f", "ah"), f_ah.with_curve("wide", Curve.of([(0, 0), (0.5, 0.3 + 0.05 * k), (1, 0)])))
        for k in range(10)
    ]
    results = cycle([sentence(PHONES, curves=edit) for edit in edits])

    def edit():
        overlay.set_stages(next(results))
        overlay.repaint()

    benchmark(edit)
    within(benchmark, ONE_POSE)


def test_everything_repainted(benchmark, overlay):
    safe = cycle([True, False])

    def repaint():
        overlay.set_palette_safe(next(safe))
        overlay.repaint()

    benchmark(repaint)
    within(benchmark, EVERYTHING)


def test_playhead_moved(benchmark, overlay):
    times = cycle([k * 0.02 for k in range(190)])

    def move():
        overlay.set_playhead(next(times))
        QApplication.processEvents()

    benchmark(move)
    within(benchmark, PLAYHEAD)
