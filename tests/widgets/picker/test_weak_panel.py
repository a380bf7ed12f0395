"""Where weak bigrams are looked for, and how far the reading of a text has come."""

import pytest
from PySide6.QtCore import Qt

from widgets.picker.weak_list import WeakRow
from widgets.picker.weak_panel import CORPUS, SENTENCE, WeakPanel

pytestmark = pytest.mark.qt_log_ignore("This plugin does not support")

ROWS = (
    WeakRow(("f", "ah"), "missing", 0.2, 2, sentence="Fat cats."),
    WeakRow(("f", "ah"), "jitter", 0.3, sentence="Fat cats."),
    WeakRow(("d", "z"), "hole", 0.4, 1),
)


@pytest.fixture
def panel(qtbot):
    panel = WeakPanel()
    qtbot.addWidget(panel)
    panel.resize(320, 200)
    with qtbot.waitExposed(panel):
        panel.show()
    return panel


def test_a_text_can_be_chosen_once_there_is_one(qtbot, panel):
    picked = []
    panel.source_picked.connect(picked.append)
    assert panel.source.count() == 1
    panel.set_corpus("script.txt")
    panel.set_source(CORPUS)
    assert panel.source.currentText() == "In script.txt"
    assert picked == []
    qtbot.keyClick(panel.source, Qt.Key.Key_Up)
    assert picked == [SENTENCE]
    panel.set_corpus("other.txt")
    assert [panel.source.itemText(i) for i in range(panel.source.count())] == ["In this sentence", "In other.txt"]
    panel.set_corpus("")
    assert panel.source.count() == 1


def test_while_a_text_is_read_there_is_a_bar_and_a_way_to_stop(qtbot, panel):
    wishes = []
    panel.load_wanted.connect(lambda: wishes.append("load"))
    panel.cancel_wanted.connect(lambda: wishes.append("cancel"))
    qtbot.mouseClick(panel.load, Qt.MouseButton.LeftButton)
    panel.set_progress((3, 20))
    assert panel.progress.isVisible()
    assert not panel.source.isVisible()
    assert panel.progress.text() == "3 of 20 sentences"
    qtbot.mouseClick(panel.cancel, Qt.MouseButton.LeftButton)
    panel.set_progress(None)
    assert not panel.progress.isVisible()
    assert panel.source.isVisible()
    assert wishes == ["load", "cancel"]


def test_a_row_of_a_text_names_its_sentence(qtbot, panel):
    here, there = [], []
    panel.list.picked.connect(lambda *what: here.append(what))
    panel.list.picked_in.connect(lambda *what: there.append(what))
    panel.list.set_rows(ROWS)
    for row in (0, 2):
        at = panel.list.list.visualItemRect(panel.list.list.topLevelItem(row)).center()
        qtbot.mouseClick(panel.list.list.viewport(), Qt.MouseButton.LeftButton, pos=at)
    assert there == [(("f", "ah"), "Fat cats.", 0.2)]
    assert here == [(("d", "z"), 0.4)]
    assert "“Fat cats.”" in panel.list.list.topLevelItem(0).toolTip(1)


def test_steps_go_from_bigram_to_bigram_round_the_end(panel):
    opened = []
    panel.list.picked.connect(lambda pair, _: opened.append(pair))
    panel.list.picked_in.connect(lambda pair, *_: opened.append(pair))
    panel.list.step(1)
    assert opened == []  # nothing is weak
    panel.list.set_rows(ROWS)
    for way in (1, 1, 1, -1):
        panel.list.step(way)
    assert opened == [("f", "ah"), ("d", "z"), ("f", "ah"), ("d", "z")]


@pytest.mark.parametrize("name", ["source", "load", "progress", "cancel"])
def test_names_for_screen_readers(panel, name):
    assert getattr(panel, name).accessibleName()
