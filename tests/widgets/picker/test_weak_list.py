"""The list of bigrams that need work."""

import pytest
from PySide6.QtCore import Qt

from widgets.picker.weak_list import WeakList, WeakRow

# the offscreen platform has no window manager to talk to
pytestmark = pytest.mark.qt_log_ignore("This plugin does not support")

ROWS = (
    WeakRow(("er", "f"), "missing", 1.234, 1),
    WeakRow(("ay", "z"), "speed-limited 38 %", None, 2),
    WeakRow(("ih", "l"), "draft", 3.1, serious=False),
)


@pytest.fixture
def weak(qtbot):
    weak = WeakList()
    qtbot.addWidget(weak)
    weak.resize(300, 160)
    with qtbot.waitExposed(weak):
        weak.show()
    return weak


@pytest.fixture
def picks(weak):
    seen = []
    weak.picked.connect(lambda pair, time: seen.append((pair, time)))
    return seen


def click(qtbot, weak, row):
    at = weak.list.visualItemRect(weak.list.topLevelItem(row)).center()
    qtbot.mouseClick(weak.list.viewport(), Qt.MouseButton.LeftButton, pos=at)


def texts(weak, row):
    return [weak.list.topLevelItem(row).text(column) for column in range(3)]


def test_rows_say_bigram_reason_uses_and_time(weak):
    weak.set_rows(ROWS)
    assert texts(weak, 0) == ["er – f", "missing · 1×", "1.23 s"]
    assert texts(weak, 1) == ["ay – z", "speed-limited 38 % · 2×", ""]
    assert texts(weak, 2) == ["ih – l", "draft", "3.10 s"]
    assert weak.list.topLevelItem(0).toolTip(1) == "Er – F · missing · 1× · 1.23 s"


def test_a_click_opens_the_bigram_at_its_time(qtbot, weak, picks):
    weak.set_rows(ROWS)
    click(qtbot, weak, 2)
    click(qtbot, weak, 1)
    assert picks == [(("ih", "l"), 3.1), (("ay", "z"), None)]


def test_arrow_keys_and_enter_open(qtbot, weak, picks):
    weak.set_rows(ROWS)
    click(qtbot, weak, 0)
    for key in (Qt.Key.Key_Down, Qt.Key.Key_Return, Qt.Key.Key_Down, Qt.Key.Key_Down):
        qtbot.keyClick(weak.list, key)
    assert [pair for pair, _ in picks] == [("er", "f"), ("ay", "z"), ("ay", "z"), ("ih", "l")]


def test_new_rows_emit_nothing_and_keep_the_selected_bigram(qtbot, weak, picks):
    weak.set_rows(ROWS)
    click(qtbot, weak, 1)
    picks.clear()
    weak.set_rows((WeakRow(("ah", "d"), "missing"), *ROWS))
    assert picks == []
    assert weak.list.currentItem().text(0) == "ay – z"
    weak.set_rows(ROWS[:1])
    assert picks == []
    assert weak.rows == ROWS[:1]


def test_the_selection_survives_a_second_recompute_in_other_order(qtbot, weak, picks):
    weak.set_rows(ROWS)
    click(qtbot, weak, 0)
    weak.set_rows(ROWS[::-1])
    weak.set_rows(ROWS)
    qtbot.keyClick(weak.list, Qt.Key.Key_Down)
    assert [pair for pair, _ in picks] == [("er", "f"), ("ay", "z")]


def test_an_empty_list_says_so(weak):
    weak.set_rows(ROWS)
    full = weak.list.viewport().grab().toImage()
    weak.set_rows(())
    said = weak.list.viewport().grab().toImage()
    weak.list.empty_text = ""
    weak.list.viewport().update()
    blank = weak.list.viewport().grab().toImage()
    assert said not in (blank, full)


def test_names_for_screen_readers(weak):
    weak.set_rows(ROWS)
    assert weak.list.accessibleName() == "Weak bigrams in this sentence"
    index = weak.list.model().index(0, 0)
    assert index.data(Qt.ItemDataRole.AccessibleTextRole) == "Er – F · missing · 1× · 1.23 s"
