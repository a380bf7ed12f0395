"""How long the square of 441 bigrams takes to repaint. The goal is 1 ms.

Run with: pytest tests/bench/test_bench_picker.py --benchmark-only -o addopts="--import-mode=importlib"
"""

from itertools import product

import pytest
from PySide6.QtWidgets import QApplication

from core_pipeline.phonemes import COMMON
from tests.helpers.budget import within
from widgets import theme
from widgets.picker.bigram_picker import BigramPicker

# the offscreen platform has no window manager to talk to
pytestmark = pytest.mark.qt_log_ignore("This plugin does not support")

BUDGET = 1e-3  # seconds


@pytest.fixture
def picker(qtbot):
    picker = BigramPicker()
    qtbot.addWidget(picker)
    picker.set_phonemes(COMMON)
    pairs = list(product(COMMON, COMMON))
    statuses = list(theme.STATUS_COLOURS)
    picker.set_statuses({pair: statuses[i % len(statuses)] for i, pair in enumerate(pairs)})
    picker.set_weak(dict.fromkeys(pairs[::40], "missing"))
    picker.set_used(dict.fromkeys(pairs[::15], 1))
    picker.set_current(("f", "ah"))
    picker.resize(408, 620)
    with qtbot.waitExposed(picker):
        picker.show()
    QApplication.processEvents()
    return picker


def test_repaint(benchmark, picker):
    benchmark(picker.grid.viewport().repaint)
    within(benchmark, BUDGET)


def test_repaint_with_new_statuses(benchmark, picker):
    def change():
        picker.grid.pairs.refresh()
        picker.grid.viewport().repaint()

    benchmark(change)
    within(benchmark, BUDGET)
