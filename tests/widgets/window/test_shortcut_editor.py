"""The list of shortcuts with real keys: find, change, conflict, put back."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from widgets.window.shortcut_editor import KeyRow, ShortcutEditor

ROWS = [
    KeyRow("save", "File", "Save", ("Ctrl+S",), ("Ctrl+S",)),
    KeyRow("export", "File", "Export", ("Ctrl+E",), ("Ctrl+E",)),
    KeyRow("play", "Playback", "Play", ("F9",), ("F5",)),
    KeyRow("neutral:frame", "Canvas", "Frame", ("F",), ("F",), fixed=True),
]


@pytest.fixture
def editor(qtbot):
    editor = ShortcutEditor()
    qtbot.addWidget(editor)
    editor.set_rows(ROWS)
    editor.show()
    qtbot.waitExposed(editor)
    editor.activateWindow()
    return editor


def record(editor, name, key, held=Qt.KeyboardModifier.NoModifier):
    editor.select(name)
    editor.tree.setFocus()
    QTest.mouseClick(editor.record, Qt.MouseButton.LeftButton)
    assert editor.field.hasFocus()
    QTest.keyClick(editor.field, key, held)


@pytest.mark.parametrize(
    ("typed", "shown"),
    [
        ("", ["save", "export", "play", "neutral:frame"]),
        ("exp", ["export"]),
        ("ctrl+s", ["save"]),
        ("file e", ["save", "export"]),
        ("none", []),
    ],
)
def test_search_by_name_group_and_key(editor, typed, shown):
    QTest.keyClicks(editor.search, typed)
    assert editor.shown() == shown


def test_a_key_nobody_has_is_given(editor, qtbot):
    with qtbot.waitSignal(editor.keys_wanted) as wanted:
        record(editor, "export", Qt.Key.Key_M, Qt.KeyboardModifier.ControlModifier)
    assert wanted.args == ["export", ("Ctrl+M",)]
    assert not editor.field.isVisible()


@pytest.mark.parametrize("key", [Qt.Key.Key_Tab, Qt.Key.Key_F12, Qt.Key.Key_Space])
def test_any_key_can_be_recorded(editor, qtbot, key):
    with qtbot.waitSignal(editor.keys_wanted):
        record(editor, "export", key)


def test_escape_and_modifiers_alone_are_no_keys(editor, qtbot):
    with qtbot.assertNotEmitted(editor.keys_wanted):
        record(editor, "export", Qt.Key.Key_Shift, Qt.KeyboardModifier.ShiftModifier)
        assert editor.field.isVisible()
        QTest.keyClick(editor.field, Qt.Key.Key_Escape)
    assert not editor.field.isVisible()
    assert editor.isVisible()
    assert editor.tree.hasFocus()


def test_a_conflict_names_the_other_command_and_waits(editor, qtbot):
    with qtbot.assertNotEmitted(editor.keys_wanted):
        record(editor, "export", Qt.Key.Key_S, Qt.KeyboardModifier.ControlModifier)
    assert "“Save” (File)" in editor.note.text()
    with qtbot.waitSignal(editor.keys_wanted) as wanted:
        QTest.mouseClick(editor.take, Qt.MouseButton.LeftButton)
    assert wanted.args == ["export", ("Ctrl+S",)]
    assert not editor.take.isVisible()


def test_looking_at_another_command_drops_the_conflict(editor, qtbot):
    record(editor, "export", Qt.Key.Key_S, Qt.KeyboardModifier.ControlModifier)
    editor.select("play")
    assert not editor.take.isVisible()
    assert editor.note.text() == ""


def test_a_key_of_the_canvas_is_a_hint_only(editor, qtbot):
    with qtbot.waitSignal(editor.keys_wanted) as wanted:
        record(editor, "export", Qt.Key.Key_F)
    assert wanted.args == ["export", ("F",)]
    assert "“Frame” (Canvas)" in editor.note.text()


def test_keys_of_the_canvas_are_listed_and_not_changed(editor):
    editor.select("neutral:frame")
    for button in (editor.record, editor.add, editor.remove, editor.reset):
        assert not button.isEnabled()
    assert "keymap" in editor.note.text()


def test_one_more_key_none_and_back_again(editor, qtbot):
    editor.select("play")
    with qtbot.waitSignal(editor.keys_wanted) as wanted:
        QTest.mouseClick(editor.add, Qt.MouseButton.LeftButton)
        QTest.keyClick(editor.field, Qt.Key.Key_F12)
    assert wanted.args == ["play", ("F9", "F12")]
    with qtbot.waitSignal(editor.keys_wanted) as wanted:
        QTest.mouseClick(editor.remove, Qt.MouseButton.LeftButton)
    assert wanted.args == ["play", ()]
    with qtbot.waitSignal(editor.reset_wanted) as reset:
        QTest.mouseClick(editor.reset, Qt.MouseButton.LeftButton)
    assert reset.args == ["play"]
    with qtbot.waitSignal(editor.reset_all_wanted):
        QTest.mouseClick(editor.reset_all, Qt.MouseButton.LeftButton)


def test_by_keyboard_alone(editor, qtbot):
    editor.search.setFocus()
    QTest.keyClicks(editor.search, "export")
    QTest.keyClick(editor.search, Qt.Key.Key_Return)
    QTest.keyClick(editor.tree, Qt.Key.Key_Return)
    with qtbot.waitSignal(editor.keys_wanted) as wanted:
        QTest.keyClick(editor.field, Qt.Key.Key_F11)
    assert wanted.args == ["export", ("F11",)]


def test_new_rows_keep_what_is_selected_and_typed(editor):
    QTest.keyClicks(editor.search, "exp")
    editor.select("export")
    editor.set_rows(ROWS[1:])
    assert editor.shown() == ["export"]
    assert editor.tree.currentItem().text(0) == "Export"
