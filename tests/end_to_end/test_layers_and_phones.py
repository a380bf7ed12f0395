"""A character's set over English, and b split from m: shown, undone, and nothing lost."""

from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtCore import Qt, QTimer
from PySide6.QtWidgets import QApplication, QDialogButtonBox, QInputDialog
from pytestqt.qtbot import QtBot

from app.editor import Editor
from core_pipeline.curves import Curve
from core_pipeline.files import curve_set_json
from core_pipeline.files.curve_set_merge import merge, open_conflicts
from widgets.window.phone_set_dialog import PhoneSetDialog

F_AH = ("f", "ah")
LEFT = Qt.MouseButton.LeftButton


def test_a_characters_own_curves_have_a_dot_and_a_way_back(editor: Editor, qtbot: QtBot, tmp_path: Path) -> None:
    window, document = editor.window, editor.document
    editor.wiring.exchange.new_on_base("english", "Hero")
    editor.wiring.bigram.open(F_AH)
    assert "from English" in window.header.text
    assert not window.header.revert.isVisible()
    assert not window.actions_.revert.isEnabled()
    base = document.curve_set.bigrams[F_AH]

    document.edit_curves(F_AH, {"open": Curve.of([(0, 0), (0.7, 0.9), (1, 0)])}, "Move key")
    assert window.picker.grid.pairs.overridden == {F_AH}
    assert "own curves of Hero" in window.header.text
    own = document.curve_set.bigrams[F_AH]
    qtbot.mouseClick(window.header.revert, LEFT)
    assert document.curve_set.bigrams[F_AH] is base
    assert window.picker.grid.pairs.overridden == set()
    document.undo_stack.undo()
    assert document.curve_set.bigrams[F_AH] is own

    document.save(tmp_path / "hero.json")
    assert set(curve_set_json.load(tmp_path / "hero.json").own) == {F_AH}


def test_b_is_split_from_m_in_the_dialog(editor: Editor, qtbot: QtBot) -> None:
    document = editor.document
    before = document.curve_set
    said: list[str] = []

    def fill() -> None:
        dialog = QApplication.activeModalWidget()
        if not isinstance(dialog, PhoneSetDialog):
            QTimer.singleShot(5, fill)
            return
        dialog.list.setCurrentRow([row.name for row in dialog._rows].index("bmp"))
        qtbot.keyClicks(dialog.name, "bmp")
        qtbot.mouseClick(dialog.add, LEFT)
        said.append(dialog.problem.text())
        dialog.name.setText("b")
        dialog.spoken.setText("b")
        qtbot.mouseClick(dialog.add, LEFT)
        said.append(dialog.problem.text())
        said.append(dialog.preview.text())
        qtbot.mouseClick(dialog.buttons.button(QDialogButtonBox.StandardButton.Ok), LEFT)

    QTimer.singleShot(0, fill)
    editor.window.actions_.phone_set.trigger()
    assert said[0] == "There is a phoneme bmp already: choose another name."
    assert said[1] == ""
    assert said[2].splitlines() == [
        "+ b: 21 phonemes become 22, 441 bigrams 484.",
        "43 + 2 bigrams are new and begin with the curves of others (b-ah, b-aa, b-ao, …).",
        "b plays b instead of bmp.",
    ]
    after = document.curve_set
    assert after.missing() == []
    assert after.bigrams["b", "ah"].curves["PBM"].same_as(before.bigrams["bmp", "ah"].curves["PBM"])
    assert editor.window.picker.grid.pairs.phonemes[-1] == "b" or "b" in editor.window.picker.grid.pairs.phonemes
    document.undo_stack.undo()
    assert document.curve_set is before
    assert "b" not in editor.window.picker.grid.pairs.phonemes
    assert [backup.kind for backup in editor.files.keeper.backups().all()] == ["before change the phone set"]


def test_after_a_merge_the_other_side_is_seen_and_one_is_approved(editor: Editor) -> None:
    """In the open bigram: ours, then theirs by the menu, and approving decides."""
    document, actions = editor.document, editor.window.actions_
    base = document.curve_set
    ours, theirs = (
        base.with_bigram(F_AH, base.bigrams[F_AH].with_curve("open", Curve.of([(0, height)]))) for height in (0.2, 0.8)
    )
    document.change_set(merge(base, ours, theirs).curve_set, "Merge")
    editor.wiring.bigram.open(F_AH)
    assert "undecided since a merge" in editor.window.header.text
    actions.theirs.trigger()
    assert document.curve_set.bigrams[F_AH].curves["open"].keys() == [(0, 0.8)]
    actions.theirs.trigger()
    actions.theirs.trigger()
    document.put_bigram(F_AH, replace(document.curve_set.bigrams[F_AH], status="approved"), "Approve")
    assert open_conflicts(document.curve_set) == []
    assert not actions.theirs.isEnabled()
    assert document.curve_set.bigrams[F_AH].curves["open"].keys() == [(0, 0.8)]


def test_a_note_stands_in_the_header_and_in_the_file(
    editor: Editor, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    editor.wiring.bigram.open(F_AH)
    monkeypatch.setattr(QInputDialog, "getMultiLineText", lambda *_: (" <b>lips</b>\nearlier ", True))
    editor.window.actions_.note.trigger()
    assert "“<b>lips</b> earlier”" in editor.window.header.text
    assert "&lt;b&gt;lips" in editor.window.header.toolTip()  # no markup
    editor.document.save(tmp_path / "mine.json")
    assert curve_set_json.load(tmp_path / "mine.json").bigrams[F_AH].note == "<b>lips</b>\nearlier"
    editor.document.undo_stack.undo()
    assert "lips" not in editor.window.header.text
