"""A researcher compares methods on one face; an animator learns bigrams from takes. All parts are real."""

from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QMessageBox

from app import resources
from core_pipeline.files import curve_set_json, model_npz, schedule_json, weights_files
from core_pipeline.methods import visemes
from core_pipeline.methods.bigram import BigramMethod
from tests.helpers.corpora import baked, corpus

PATIENCE = 60_000


def said(editor, qtbot) -> None:
    editor.start("Fat cats.")
    qtbot.waitUntil(lambda: editor.session.stages is not None and editor.preview.face is not None, timeout=PATIENCE)


def test_a_model_beside_ours(editor, qtbot, tmp_path):
    """Its curves and differences are shown, a second face speaks it, and it goes when another set comes."""
    said(editor, qtbot)
    path = tmp_path / "visemes.npz"
    model_npz.save(visemes.fit(corpus(baked()[:8])), path)
    other, box = editor.wiring.other_method, editor.window.stage_panel.method_box
    other.open(path)
    qtbot.waitUntil(lambda: other.weights is not None, timeout=PATIENCE)
    assert box.details.text().startswith("RMSE 0.")
    assert box.table.rowCount() == 9
    qtbot.mouseClick(box.beside, Qt.MouseButton.LeftButton)
    assert [actor.name for actor in editor.preview.actors] == ["These curves", "Viseme interpolation"]
    editor.wiring.character.send_away(1)
    assert len(editor.preview.actors) == 1
    assert not box.beside.isChecked()
    qtbot.mouseClick(box.beside, Qt.MouseButton.LeftButton)
    source = editor.preview.actors[1].source
    middle = len(other.weights.frames) // 2
    assert source.weights_at(other.weights.start + middle / 60) == pytest.approx(other.weights.frames[middle], abs=1e-6)
    first = other.weights
    editor.wiring.sentence.type("Five fish.", play=False)
    qtbot.waitUntil(lambda: other.weights is not None and other.weights is not first, timeout=PATIENCE)
    other.choose("")
    assert other.weights is None
    assert len(editor.preview.actors) == 1
    assert not box.details.isVisible()


def test_what_is_no_model_is_said(editor, qtbot, tmp_path):
    said(editor, qtbot)
    path = tmp_path / "broken.npz"
    path.write_bytes(b"PK no")
    editor.wiring.other_method.open(path)
    qtbot.waitUntil(lambda: "no model of ours" in editor.window.hint_label.text(), timeout=PATIENCE)
    assert editor.window.stage_panel.method_box.box.currentIndex() == 0


def test_a_set_of_another_kind_of_face_is_not_compared(editor, qtbot):
    """The crab's set, compared with one whose poses it does not have, is said to be of no use."""
    said(editor, qtbot)
    other = editor.wiring.other_method
    crab = curve_set_json.load(resources.english_curves().with_name("crab.json"))
    foreign = replace(crab, poses=("claw",), bigrams={})
    other._made(BigramMethod(foreign))
    assert "none of this set's poses" in editor.window.hint_label.text()
    assert other.weights is None


@pytest.fixture
def takes(tmp_path) -> Path:
    folder = tmp_path / "takes"
    folder.mkdir()
    for i, clip in enumerate(baked()[:4]):
        weights_files.save(clip.weights, folder / f"{i}.csv")
        schedule_json.save(clip.schedule, folder / f"{i}.schedule.json")
    return folder


def test_bigrams_learned_and_accepted_one_by_one(editor, qtbot, takes, monkeypatch):
    """A drawn bigram is replaced only after a yes; undo brings the very same one back."""
    learning, document = editor.wiring.learning, editor.document
    learning.open()
    learning.learn(takes)
    qtbot.waitUntil(lambda: learning.lesson is not None, timeout=PATIENCE)
    view = learning.view
    assert "bigrams heard" in view.summary.text()
    pair = view.selected()[0]
    before = document.curve_set.bigrams[pair]
    asked = []

    def answer(*arguments):
        asked.append(arguments[2])
        return QMessageBox.StandardButton.No if len(asked) == 1 else QMessageBox.StandardButton.Yes

    monkeypatch.setattr(QMessageBox, "question", answer)
    qtbot.mouseClick(view.accept_one, Qt.MouseButton.LeftButton)
    assert document.curve_set.bigrams[pair] is before
    assert not document.is_dirty
    qtbot.mouseClick(view.accept_one, Qt.MouseButton.LeftButton)
    assert "already drawn" in asked[0]
    learned = document.curve_set.bigrams[pair]
    assert learned.source == "learned"
    assert learned.extra["learned"]["occurrences"] == learning.lesson.learned.found[pair].occurrences
    assert view.table.item(0, 3).text() == "learned, accepted"
    document.undo_stack.undo()
    assert document.curve_set.bigrams[pair] is before


def test_all_heard_fill_an_empty_set_in_one_step(editor, qtbot, takes):
    learning, document = editor.wiring.learning, editor.document
    document.new(replace(document.curve_set, bigrams={}))
    learning.open()
    learning.learn(takes)
    qtbot.waitUntil(lambda: learning.lesson is not None, timeout=PATIENCE)
    qtbot.mouseClick(learning.view.accept_empty, Qt.MouseButton.LeftButton)
    assert set(document.curve_set.bigrams) == set(learning.lesson.learned.found)
    document.undo_stack.undo()
    assert not document.curve_set.bigrams


def test_a_folder_without_animation_is_said_and_a_wish_can_be_taken_back(editor, qtbot, tmp_path, takes):
    learning = editor.wiring.learning
    learning.open()
    learning.learn(tmp_path / "nowhere")
    qtbot.waitUntil(lambda: "is not a folder" in learning.view.summary.text(), timeout=PATIENCE)
    learning.learn(takes)
    learning.cancel()
    assert not learning.view.progress.isVisible()
    assert learning.lesson is None
