"""The phone set dialog: every wish goes up with names only; what is shown comes from outside."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDialogButtonBox
from pytestqt.qtbot import QtBot

from widgets.window.phone_set_dialog import PhoneRow, PhoneSetDialog

ROWS = [PhoneRow("ah", ("ae", "ah")), PhoneRow("bmp", ("p", "b", "m")), PhoneRow("w", ("w", "uw"))]
LEFT = Qt.MouseButton.LeftButton


@pytest.fixture
def dialog(qtbot: QtBot) -> PhoneSetDialog:
    dialog = PhoneSetDialog()
    qtbot.addWidget(dialog)
    dialog.set_rows(ROWS)
    dialog.set_preview([])
    with qtbot.waitExposed(dialog):
        dialog.show()
    return dialog


def test_a_phoneme_is_split_off(dialog: PhoneSetDialog, qtbot: QtBot) -> None:
    dialog.list.setCurrentRow(1)
    qtbot.keyClicks(dialog.name, " b ")
    qtbot.keyClicks(dialog.spoken, "b, bb")
    with qtbot.waitSignal(dialog.added) as wish:
        qtbot.mouseClick(dialog.add, LEFT)
    assert wish.args == ["b", "bmp", ("b", "bb")]
    dialog.like.setCurrentIndex(0)
    with qtbot.waitSignal(dialog.added) as wish:
        qtbot.mouseClick(dialog.add, LEFT)
    assert wish.args == ["b", "", ("b", "bb")]


def test_the_chosen_one_is_renamed_or_removed(dialog: PhoneSetDialog, qtbot: QtBot) -> None:
    dialog.list.setCurrentRow(1)
    assert dialog.new_name.text() == "bmp"
    assert [dialog.into.itemText(i) for i in range(dialog.into.count())] == ["ah", "w"]
    dialog.new_name.setText("lips")
    with qtbot.waitSignal(dialog.renamed) as wish:
        qtbot.mouseClick(dialog.rename, LEFT)
    assert wish.args == ["bmp", "lips"]
    dialog.into.setCurrentText("w")
    with qtbot.waitSignal(dialog.removed) as wish:
        qtbot.mouseClick(dialog.remove, LEFT)
    assert wish.args == ["bmp", "w"]


def test_ok_needs_a_change(dialog: PhoneSetDialog) -> None:
    ok = dialog.buttons.button(QDialogButtonBox.StandardButton.Ok)
    assert not ok.isEnabled()
    dialog.set_preview(["+ b: 21 phonemes become 22."])
    assert ok.isEnabled()
    assert dialog.preview.text() == "+ b: 21 phonemes become 22."
    dialog.set_problem("There is a phoneme ah already.")
    assert dialog.problem.text() == "There is a phoneme ah already."


def test_the_choice_stays_and_the_last_one_cannot_go(dialog: PhoneSetDialog) -> None:
    dialog.set_rows([*ROWS, PhoneRow("b", ("b",))], "b")
    assert dialog.current == "b"
    dialog.set_rows(ROWS[:2])
    assert dialog.current == "ah"
    dialog.set_rows(ROWS[:1])
    assert not dialog.remove.isEnabled()
    assert dialog.rename.isEnabled()
