"""The palette with real keys: opens empty, walks, does, closes, and gives the focus back."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit, QVBoxLayout, QWidget

from widgets.window.command_palette import CommandPalette
from widgets.window.palette_choices import Choice

CHOICES = [
    Choice("open", "Open", "File", "Ctrl+O"),
    Choice("weights", "Export Weights", "File", "Ctrl+Shift+E"),
    Choice("redo", "Redo", "Edit", enabled=False),
    Choice("loop", "Loop", "Playback", on=True),
    Choice("f-ah", "F – Ah", "Bigram · draft", name="f ah"),
]


@pytest.fixture
def window(qtbot):
    window = QWidget()
    window.resize(900, 600)
    window.editor = QLineEdit(window)
    QVBoxLayout(window).addWidget(window.editor)
    window.palette = CommandPalette(window)
    qtbot.addWidget(window)
    window.show()
    qtbot.waitExposed(window)
    window.activateWindow()
    window.editor.setFocus()
    return window


def test_typed_letters_and_enter_choose_and_give_the_focus_back(window, qtbot):
    palette = window.palette
    palette.open(CHOICES)
    assert palette.field.hasFocus()
    assert palette.titles == ["Open", "Export Weights", "Redo", "Loop"]
    QTest.keyClicks(palette.field, "exw")
    assert palette.titles == ["Export Weights"]
    with qtbot.waitSignal(palette.chosen) as chosen:
        QTest.keyClick(palette.field, Qt.Key.Key_Return)
    assert chosen.args == ["weights"]
    assert not palette.isVisible()
    assert window.editor.hasFocus()


def test_arrows_go_round(window, qtbot):
    palette = window.palette
    palette.open(CHOICES, ["loop"])
    QTest.keyClick(palette.field, Qt.Key.Key_Up)
    assert palette.list.currentIndex().row() == 3
    QTest.keyClick(palette.field, Qt.Key.Key_Down)
    QTest.keyClick(palette.field, Qt.Key.Key_Tab)  # goes nowhere
    with qtbot.waitSignal(palette.chosen) as chosen:
        QTest.keyClick(palette.field, Qt.Key.Key_Enter)
    assert chosen.args == ["loop"]


def test_escape_closes_and_nothing_happens(window, qtbot):
    palette = window.palette
    palette.open(CHOICES)
    with qtbot.assertNotEmitted(palette.chosen):
        QTest.keyClick(palette.field, Qt.Key.Key_Escape)
    assert not palette.isVisible()
    assert window.editor.hasFocus()


def test_a_click_elsewhere_closes_and_the_focus_stays_there(window):
    window.palette.open(CHOICES)
    window.editor.setFocus(Qt.FocusReason.MouseFocusReason)
    assert not window.palette.isVisible()
    assert window.editor.hasFocus()


def test_a_click_on_a_row_chooses_it(window, qtbot):
    palette = window.palette
    palette.open(CHOICES)
    at = palette.list.visualRect(palette.list.model().index(3, 0)).center()
    with qtbot.waitSignal(palette.chosen) as chosen:
        QTest.mouseClick(palette.list.viewport(), Qt.MouseButton.LeftButton, pos=at)
    assert chosen.args == ["loop"]


def test_what_cannot_be_done_now_is_said(window, qtbot):
    palette = window.palette
    palette.open(CHOICES)
    QTest.keyClicks(palette.field, "redo")
    with qtbot.assertNotEmitted(palette.chosen):
        QTest.keyClick(palette.field, Qt.Key.Key_Return)
    assert palette.isVisible()
    assert "Redo" in palette.note.text()


def test_an_answer_for_an_older_query_is_passed_over(window):
    palette = window.palette
    palette.open(CHOICES)
    QTest.keyClicks(palette.field, "zz")
    palette.set_found("z", [Choice("z", "Zed")])
    assert palette.titles == []
    assert "f ah" in palette.note.text()
    palette.set_found("zz", [Choice("zz", "Zed Zed")])
    assert palette.titles == ["Zed Zed"]


def test_it_stays_inside_a_small_window(window):
    window.resize(420, 320)
    window.palette.open(CHOICES * 20)
    assert window.rect().contains(window.palette.geometry())


def test_a_row_is_read_out_whole(window):
    window.palette.open(CHOICES)
    index = window.palette.list.model().index(1, 0)
    assert index.data(Qt.ItemDataRole.AccessibleTextRole) == "Export Weights, File, Ctrl+Shift+E"
