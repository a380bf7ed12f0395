"""Menus that know their actions."""

import pytest
from PySide6.QtGui import QKeySequence
from PySide6.QtWidgets import QMainWindow, QMenu

from app.actions import Actions
from app.document import Document
from app.menus import Registry, plain
from core_pipeline.curve_set import CurveSet
from core_pipeline.curves import Curve


@pytest.fixture
def window(qtbot):
    window = QMainWindow()
    qtbot.addWidget(window)
    return window


@pytest.mark.parametrize(
    ("text", "read"), [("&Open…", "Open"), ("Save &As…", "Save As"), ("Black && &White", "Black & White"), ("", "")]
)
def test_a_menu_text_as_it_is_read(text, read):
    assert plain(text) == read


def test_what_a_menu_adds_is_in_menu_and_registry(window):
    registry = Registry(window.menuBar())
    menu = registry.menu("&Tools")
    count = menu.add("tools.count", "&Count…", "Ctrl+Shift+C", "How many")
    inner = menu.submenu("&More")
    switch = inner.add("tools.switch", "S&witch", checked=True)
    assert [entry.id for entry in registry] == ["tools.count", "tools.switch"]
    entry = registry["tools.count"]
    assert (entry.title, entry.group, entry.default) == ("Count", "Tools", ("Ctrl+Shift+C",))
    assert count.shortcut() == QKeySequence("Ctrl+Shift+C")
    assert (count.toolTip(), count.statusTip()) == ("How many", "How many")
    assert registry["tools.switch"].group == "Tools → More"
    assert switch.isChecked()
    assert menu.menu.actions()[0] is count
    assert window.menuBar().actions()[0].text() == "&Tools"


def test_an_id_is_given_once(window):
    menu = Registry(window.menuBar()).menu("&Tools")
    menu.add("tools.count", "&Count")
    with pytest.raises(ValueError, match=r"tools\.count"):
        menu.add("tools.count", "&Count again")


def test_no_two_actions_of_the_window_share_a_key_or_a_mnemonic(window):
    document = Document(CurveSet())
    registry = Actions(window, document.undo_stack).registry
    keys = [key for entry in registry for key in entry.default]
    assert len(keys) == len(set(keys))
    for menu in window.findChildren(QMenu):
        texts = [action.text().casefold() for action in menu.actions() if "&" in action.text()]
        mnemonics = [text[text.index("&") + 1] for text in texts]
        assert len(mnemonics) == len(set(mnemonics)), texts
    titles = [menu.text() for menu in window.menuBar().actions()]
    assert [plain(t) for t in titles] == ["File", "Edit", "View", "Bigram", "Sentence", "Playback", "Tools", "Help"]


def test_undo_and_redo_keep_their_names_in_lists_whatever_they_would_do(window):
    document = Document(CurveSet())
    actions = Actions(window, document.undo_stack)
    document.edit_curves(("f", "ah"), {"open": Curve.of([(0, 0), (0.5, 1), (1, 0)])}, "Move keys")
    document.undo_stack.undo()
    assert actions.redo.text() == "&Redo Move keys"
    assert actions.registry["edit.redo"].title == "Redo"
