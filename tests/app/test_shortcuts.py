"""Keys of the window's actions: defaults of three keymaps, the user's changes, and what is kept of them."""

import pytest
from PySide6.QtGui import QKeySequence
from PySide6.QtWidgets import QMainWindow

from app.actions import Actions
from app.document import Document
from app.settings import ViewState
from app.shortcuts import KEYMAP_DEFAULTS, Shortcuts, is_key
from core_pipeline.curve_set import CurveSet
from widgets.canvas.keymaps import KEYMAPS


@pytest.fixture
def registry(qtbot):
    window = QMainWindow()
    qtbot.addWidget(window)
    registry = Actions(window, Document(CurveSet(), window).undo_stack).registry
    registry.window = window
    return registry


@pytest.fixture
def state(tmp_path):
    return ViewState(tmp_path)


@pytest.mark.parametrize("keymap", KEYMAPS)
def test_no_key_means_two_things_in_the_window_or_on_the_canvas(registry, state, keymap):
    shortcuts = Shortcuts(registry, state)
    shortcuts.set_keymap(keymap)
    keys = [key for entry in registry for key in shortcuts.keys(entry.id)]
    assert all(is_key(key) for key in keys)
    assert len(keys) == len(set(keys))
    assert not set(keys) & {key for keys in KEYMAPS[keymap].values() for key in keys}


def test_every_keymap_has_defaults_and_they_name_actions(registry):
    assert set(KEYMAP_DEFAULTS) == set(KEYMAPS)
    assert all(name in registry for own in KEYMAP_DEFAULTS.values() for name in own)


def test_a_changed_key_works_is_told_and_survives(registry, state, qtbot):
    shortcuts = Shortcuts(registry, state)
    with qtbot.waitSignal(shortcuts.changed):
        shortcuts.set_keys("file.export", ("F12", "\\"))
    action = registry["file.export"].action
    assert action.shortcuts() == [QKeySequence("F12"), QKeySequence("\\")]
    assert action.toolTip().endswith("(F12, \\)")
    again = Shortcuts(registry, ViewState(state.folder))
    assert again.keys("file.export") == ("F12", "\\")
    again.reset("file.export")
    assert again.keys("file.export") == ("Ctrl+E",)
    assert ViewState(state.folder).texts("shortcuts") == []


def test_who_gets_a_key_takes_it_from_the_other(registry, state):
    shortcuts = Shortcuts(registry, state)
    shortcuts.set_keys("file.export", ("Ctrl+S",))
    assert shortcuts.keys("file.save") == ()
    assert registry["file.save"].action.shortcuts() == []
    shortcuts.reset("file.save")
    assert shortcuts.keys("file.save") == ()  # still the other's
    shortcuts.reset("file.export")
    shortcuts.reset("file.save")
    assert shortcuts.keys("file.save") == ("Ctrl+S",)


def test_reset_all(registry, state):
    shortcuts = Shortcuts(registry, state)
    shortcuts.set_keys("file.export", ("Ctrl+S",))
    shortcuts.reset_all()
    assert {entry.id: shortcuts.keys(entry.id) for entry in registry} == {entry.id: entry.default for entry in registry}


def test_a_change_of_the_users_outlives_another_keymap(registry, state):
    shortcuts = Shortcuts(registry, state)
    shortcuts.set_keys("playback.play", ("F9",))
    shortcuts.set_keymap("Maya")
    assert shortcuts.keys("playback.play") == ("F9",)
    assert shortcuts.default("playback.play") == ("Alt+V", "F5")
    with pytest.raises(KeyError):
        shortcuts.set_keymap("Emacs")


@pytest.mark.parametrize(
    "line", ["\t\t", "file.export\tNonsense Key", "file.export\tCtrl+K, Ctrl+X", "gone.action\tF12"]
)
def test_a_damaged_state_harms_nothing(registry, state, line):
    state.put("shortcuts", [line])
    shortcuts = Shortcuts(registry, state)
    assert shortcuts.keys("file.save") == ("Ctrl+S",)
    assert all(is_key(key) for entry in registry for key in shortcuts.keys(entry.id))
