"""Undo holds thousands of steps and leaks nothing."""

import gc
from pathlib import Path

from app import resources
from app.document import UNDO_STEPS, Document
from core_pipeline.curves import Curve
from core_pipeline.files import curve_set_json

PAIR = ("f", "ah")


def megabytes() -> float:
    """Of this process in memory now."""
    gc.collect()
    pages = int(Path("/proc/self/statm").read_text("ascii").split()[1])
    return pages * 4096 / 1e6


def edit(document: Document, count: int) -> None:
    for i in range(count):
        document.edit_curves(PAIR, {"FV": Curve.of([(0, 0), (0.5, (i % 100) / 100), (1, 0)])}, "Move key")


def test_ten_thousand_edits_and_undos_grow_by_less_than_twenty_megabytes() -> None:
    document = Document(curve_set_json.load(resources.english_curves()))
    stack = document.undo_stack
    edit(document, 100)
    before = megabytes()
    edit(document, 10_000)
    assert stack.count() == UNDO_STEPS >= 1000
    edited = document.curve_set.bigrams[PAIR]
    while stack.canUndo():
        stack.undo()
    while stack.canRedo():
        stack.redo()
    assert document.curve_set.bigrams[PAIR] is edited
    assert megabytes() - before < 20
    assert document.is_dirty


def test_a_thousand_steps_lead_back_to_the_very_same_objects() -> None:
    document = Document(curve_set_json.load(resources.english_curves()))
    start = dict(document.curve_set.bigrams)
    edit(document, 1000)
    for _ in range(1000):
        document.undo_stack.undo()
    assert all(document.curve_set.bigrams[pair] is bigram for pair, bigram in start.items())
    assert not document.is_dirty
