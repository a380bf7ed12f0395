"""The window by keyboard: palette, shortcuts, keymaps."""

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.editor import Editor

CTRL, ALT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.AltModifier


def press(key: Qt.Key, held: Qt.KeyboardModifier = Qt.KeyboardModifier.NoModifier) -> None:
    """A key to whatever has the focus."""
    QTest.keyClick(QApplication.focusWidget(), key, held)


def type_text(text: str) -> None:
    QTest.keyClicks(QApplication.focusWidget(), text)


def test_the_palette_opens_bigrams_words_and_does_commands(editor: Editor, qtbot: QtBot) -> None:
    editor.wiring.sentence.pinned.add(["My mother bought five blue shoes."])
    palette = editor.wiring.palette.view
    editor.window.canvas.setFocus()
    press(Qt.Key.Key_K, CTRL)
    assert palette.isVisible()
    type_text("l ow")
    press(Qt.Key.Key_Return)
    assert editor.wiring.bigram.pair == ("l", "ow")
    assert editor.window.canvas.hasFocus()

    press(Qt.Key.Key_K, CTRL)
    assert palette.titles[0] == "L – Ow"  # the recent one first
    type_text("fish")
    qtbot.waitUntil(lambda: "Ih – Sh" in palette.titles, timeout=20_000)
    assert palette.titles[0] == "F – Ih"
    press(Qt.Key.Key_Return)
    assert editor.wiring.bigram.pair == ("f", "ih")

    press(Qt.Key.Key_K, CTRL)
    type_text("swapped")
    press(Qt.Key.Key_Return)
    assert editor.wiring.bigram.pair == ("ih", "f")

    press(Qt.Key.Key_K, CTRL)
    type_text("select all keys")
    press(Qt.Key.Key_Return)
    assert editor.window.canvas.selection

    press(Qt.Key.Key_K, CTRL)
    type_text("mother")
    assert palette.titles[0] == "My mother bought five blue shoes."
    with qtbot.waitSignal(editor.session.stages_changed, timeout=20_000):
        press(Qt.Key.Key_Return)
    assert editor.window.sentence_bar.sentence == "My mother bought five blue shoes."
    assert editor.state.texts("recent commands")[0] == "sentence:My mother bought five blue shoes."
    assert editor.document.undo_stack.count() == 0


def test_keys_of_other_hands(editor: Editor, qtbot: QtBot) -> None:
    """Asked once, without being kept from anything; then the canvas and the window have that program's keys."""
    w = editor.window
    editor.wiring.restore()
    assert w.keymap_question.isVisible()
    w.canvas.setFocus()
    press(Qt.Key.Key_A, CTRL)
    assert w.canvas.selection  # nothing is blocked
    QTest.mouseClick(w.keymap_question.buttons["Maya"], Qt.MouseButton.LeftButton)
    assert not w.keymap_question.isVisible()
    assert w.actions_.keymap == "Maya"
    assert QKeySequence("Alt+V") in w.actions_.play.shortcuts()
    editor.wiring.restore()
    assert not w.keymap_question.isVisible()

    w.canvas.setFocus()
    press(Qt.Key.Key_K, CTRL | ALT)
    dialog = editor.wiring.keys._editor
    assert dialog is not None
    assert any(name.startswith("Maya:") for name in dialog.shown())
    dialog.select("bigram.swapped")
    QTest.mouseClick(dialog.record, Qt.MouseButton.LeftButton)
    QTest.keyClick(dialog.field, Qt.Key.Key_F9)
    dialog.close()
    w.activateWindow()
    w.canvas.setFocus()
    editor.wiring.bigram.open(("f", "ah"))
    press(Qt.Key.Key_F9)
    assert editor.wiring.bigram.pair == ("ah", "f")
