"""Typing sentences: one signal per sentence, whatever the fingers do."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QToolButton

from widgets.sentence_bar import HISTORY, SETTLE_MS, SentenceBar

# the offscreen platform has no window manager to talk to
pytestmark = pytest.mark.qt_log_ignore("This plugin does not support")


@pytest.fixture
def bar(qtbot):
    bar = SentenceBar()
    qtbot.addWidget(bar)
    bar.resize(700, 32)
    with qtbot.waitExposed(bar):
        bar.show()
    bar.field.setFocus()
    return bar


@pytest.fixture
def entered(bar):
    seen = []
    bar.sentence_entered.connect(seen.append)
    return seen


def settle(qtbot, bar):
    """Until the bar's own timer has run out."""
    if bar._settle.isActive():
        with qtbot.waitSignal(bar._settle.timeout, timeout=2000):
            pass


def test_typing_gives_one_signal_after_a_pause(qtbot, bar, entered):
    with qtbot.waitSignal(bar.sentence_entered, timeout=2000):
        qtbot.keyClicks(bar.field, "fat cats")
        assert entered == []
    assert entered == ["fat cats"]
    assert bar._settle.interval() == SETTLE_MS
    assert not bar._settle.isActive()


def test_enter_speaks_at_once_and_the_pause_adds_nothing(qtbot, bar, entered):
    qtbot.keyClicks(bar.field, "fat")
    qtbot.keyClick(bar.field, Qt.Key.Key_Return)
    assert entered == ["fat"]
    assert not bar._settle.isActive()


def test_the_same_sentence_comes_twice_only_by_enter(qtbot, bar, entered):
    qtbot.keyClicks(bar.field, "fat")
    settle(qtbot, bar)
    qtbot.keyClicks(bar.field, "s")
    qtbot.keyClick(bar.field, Qt.Key.Key_Backspace)
    settle(qtbot, bar)
    assert entered == ["fat"]
    qtbot.keyClick(bar.field, Qt.Key.Key_Return)
    assert entered == ["fat", "fat"]


def test_spaces_are_no_new_sentence(qtbot, bar, entered):
    qtbot.keyClicks(bar.field, "fat")
    settle(qtbot, bar)
    qtbot.keyClicks(bar.field, "  ")
    settle(qtbot, bar)
    assert entered == ["fat"]


def test_leaving_the_field_speaks_what_is_pending(qtbot, bar, entered):
    qtbot.keyClicks(bar.field, "fat")
    bar.field.clearFocus()
    assert entered == ["fat"]
    assert bar.history == ("fat",)


def test_the_clear_button_gives_the_empty_sentence(qtbot, bar, entered):
    bar.set_sentence("fat")
    clear = max(bar.field.findChildren(QToolButton), key=lambda button: button.x())
    qtbot.mouseClick(clear, Qt.MouseButton.LeftButton)
    settle(qtbot, bar)
    assert entered == [""]


def test_a_sentence_from_outside_emits_nothing(qtbot, bar, entered):
    bar.set_sentence("A dill-lover feared rye.")
    assert bar.sentence == "A dill-lover feared rye."
    assert not bar._settle.isActive()
    assert entered == []


def test_an_echo_leaves_what_is_being_typed(qtbot, bar, entered):
    qtbot.keyClicks(bar.field, "fat")
    settle(qtbot, bar)
    qtbot.keyClicks(bar.field, " c")
    bar.set_sentence("fat")
    assert bar.field.text() == "fat c"
    settle(qtbot, bar)
    qtbot.keyClicks(bar.field, " ")
    bar.set_sentence("fat c")
    assert bar.field.text() == "fat c "
    assert entered == ["fat", "fat c"]


def test_another_sentence_from_outside_wins_over_typing(qtbot, bar, entered):
    qtbot.keyClicks(bar.field, "fat")
    bar.set_sentence("opened file")
    assert bar.field.text() == "opened file"
    assert not bar._settle.isActive()
    assert entered == []


def test_up_and_down_walk_through_finished_sentences(qtbot, bar, entered):
    for text in ("one", "two", "three"):
        bar.field.selectAll()
        qtbot.keyClicks(bar.field, text)
        qtbot.keyClick(bar.field, Qt.Key.Key_Return)
    bar.field.selectAll()
    qtbot.keyClicks(bar.field, "draft")
    shown = []
    for key in (Qt.Key.Key_Up,) * 4 + (Qt.Key.Key_Down,) * 4:
        qtbot.keyClick(bar.field, key)
        shown.append(bar.field.text())
    assert shown == ["three", "two", "one", "one", "two", "three", "draft", "draft"]
    qtbot.keyClick(bar.field, Qt.Key.Key_Up)
    settle(qtbot, bar)
    assert entered == ["one", "two", "three"]  # "three" is what was spoken last
    qtbot.keyClick(bar.field, Qt.Key.Key_Up)
    settle(qtbot, bar)
    assert entered[-1] == "two"


def test_up_right_after_enter_shows_the_sentence_before(qtbot, bar):
    for text in ("one", "two"):
        bar.field.selectAll()
        qtbot.keyClicks(bar.field, text)
        qtbot.keyClick(bar.field, Qt.Key.Key_Return)
    qtbot.keyClick(bar.field, Qt.Key.Key_Up)
    assert bar.field.text() == "one"
    qtbot.keyClick(bar.field, Qt.Key.Key_Down)
    assert bar.field.text() == "two"


def test_the_history_keeps_the_last_50_each_once(qtbot, bar):
    for i in range(HISTORY + 5):
        bar.set_sentence(f"sentence {i}")
    bar.set_sentence("sentence 20")
    assert len(bar.history) == HISTORY == 50
    assert bar.history[0] == "sentence 5"
    assert bar.history[-1] == "sentence 20"
    assert bar.history.count("sentence 20") == 1


def test_half_typed_sentences_are_not_kept(qtbot, bar):
    for text in ("A", " fat"):
        qtbot.keyClicks(bar.field, text)
        settle(qtbot, bar)
    assert bar.history == ()


def test_a_message_is_seen_and_read_out(qtbot, bar):
    bar.set_sentence("A dill-lover feared rye.")
    plain = bar.field.grab().toImage()
    bar.set_message("The voice did not start: choose another one.")
    assert bar.message == "The voice did not start: choose another one."
    assert bar.field.accessibleDescription() == bar.message
    assert bar.field.grab().toImage() != plain
    assert bar.field.textMargins().right() > 0
    bar.set_message("")
    assert bar.field.textMargins().right() == 0
    assert bar.field.accessibleDescription() == ""


@pytest.mark.parametrize("width", [160, 300, 700, 1100])
def test_a_long_message_leaves_room_for_the_sentence(qtbot, bar, width):
    bar.set_sentence("A dill-lover feared rye. Fat cats often find fish.")
    bar.set_message("The voice espeak-ng did not start: choose another voice in the box on the right. " * 2, "hint")
    bar.resize(width, 32)
    message = bar._message.geometry()
    assert message.right() < width - 20
    sentence_ends = 30 + bar.field.fontMetrics().horizontalAdvance(bar.sentence)
    assert message.left() >= min(sentence_ends, width * 0.6 - 30)
    assert bar._message.toolTip() == bar.message


def test_the_field_is_named(bar):
    assert bar.field.accessibleName() == "Test sentence"
    assert bar.field.placeholderText()
