"""Pinned and recent sentences with real mouse and keys."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from widgets.window.sentence_list import SentenceList

PINNED = ["One fish.", "Two fish.", "Red fish."]
CTRL = Qt.KeyboardModifier.ControlModifier


@pytest.fixture
def view(qtbot):
    view = SentenceList()
    qtbot.addWidget(view)
    view.resize(320, 500)
    view.set_pinned(PINNED)
    view.set_recent(["Blue fish.", "One fish."])
    view.order_wanted.connect(view.set_pinned)  # as the program answers
    view.show()
    qtbot.waitExposed(view)
    return view


def click(box, row):
    QTest.mouseClick(box.viewport(), Qt.MouseButton.LeftButton, pos=box.visualItemRect(box.item(row)).center())


def test_a_click_or_enter_says_a_sentence(view, qtbot):
    said = []
    view.picked.connect(said.append)
    click(view.pinned, 1)
    QTest.keyClick(view.pinned, Qt.Key.Key_Down)
    QTest.keyClick(view.pinned, Qt.Key.Key_Return)
    click(view.recent, 0)
    assert said == ["Two fish.", "Red fish.", "Blue fish."]


def test_keys_and_buttons_reorder(view, qtbot):
    view.pinned.setCurrentRow(0)
    with qtbot.waitSignal(view.order_wanted) as wanted:
        QTest.keyClick(view.pinned, Qt.Key.Key_Down, CTRL)
    assert wanted.args == [["Two fish.", "One fish.", "Red fish."]]
    assert view.pinned.currentItem().text() == "One fish."
    QTest.mouseClick(view.down, Qt.MouseButton.LeftButton)
    assert view.texts == ["Two fish.", "Red fish.", "One fish."]
    assert not view.down.isEnabled()
    QTest.mouseClick(view.up, Qt.MouseButton.LeftButton)
    assert view.texts == ["Two fish.", "One fish.", "Red fish."]


def test_a_row_that_is_dropped_elsewhere_says_the_new_order(view, qtbot):
    model = view.pinned.model()
    with qtbot.waitSignal(view.order_wanted) as wanted:
        assert model.moveRow(model.index(-1, -1), 2, model.index(-1, -1), 0)
    assert wanted.args == [["Red fish.", "One fish.", "Two fish."]]


def test_pin_and_unpin(view, qtbot):
    with qtbot.waitSignal(view.pin_wanted) as wanted:
        QTest.mouseClick(view.pin, Qt.MouseButton.LeftButton)
    assert wanted.args == [""]
    view.recent.setCurrentRow(0)
    with qtbot.waitSignal(view.pin_wanted) as wanted:
        QTest.keyClick(view.recent, Qt.Key.Key_P)
    assert wanted.args == ["Blue fish."]
    view.pinned.setCurrentRow(1)
    with qtbot.waitSignal(view.unpin_wanted) as wanted:
        QTest.keyClick(view.pinned, Qt.Key.Key_Delete)
    assert wanted.args == ["Two fish."]
    with qtbot.waitSignal(view.import_wanted):
        QTest.mouseClick(view.load, Qt.MouseButton.LeftButton)


def test_values_from_outside_emit_nothing_and_the_place_stays(view, qtbot):
    view.pinned.setCurrentRow(1)
    with qtbot.assertNotEmitted(view.picked), qtbot.assertNotEmitted(view.order_wanted):
        view.set_pinned(["One fish.", "Red fish."])
        assert view.pinned.currentItem().text() == "Red fish."
        view.set_pinned(["Red fish.", "One fish."])
        assert view.pinned.currentItem().text() == "Red fish."
        view.set_current("One fish.")
    assert view.pinned.item(1).font().bold()
    assert view.pinned.currentItem().text() == "One fish."
    view.set_pinned([])
    assert not view.unpin.isEnabled()


def test_a_low_dock_has_room_for_the_pinned_ones(view):
    assert view.recent.isVisible()
    view.resize(320, 150)
    QApplication.processEvents()
    assert not view.recent.isVisible()
    assert view.pinned.height() > 80
