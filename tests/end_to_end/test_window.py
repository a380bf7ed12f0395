"""The window: palette, shortcuts, keymaps, layouts, sentences."""

from pathlib import Path

import pytest
from PySide6.QtCore import QByteArray, Qt
from PySide6.QtGui import QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDockWidget
from pytestqt.qtbot import QtBot

from app.editor import Editor
from core_pipeline.curve_set import CurveSet

CTRL, ALT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.AltModifier


def press(key: Qt.Key, held: Qt.KeyboardModifier = Qt.KeyboardModifier.NoModifier) -> None:
    """A key to whatever has the focus."""
    QTest.keyClick(QApplication.focusWidget(), key, held)


def type_text(text: str) -> None:
    QTest.keyClicks(QApplication.focusWidget(), text)


def test_the_palette_opens_bigrams_words_and_does_commands(editor: Editor, qtbot: QtBot) -> None:
    editor.wiring.sentence.pinned.set(["My mother bought five blue shoes."])
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
    type_text("open swapped")
    press(Qt.Key.Key_Return)
    assert editor.wiring.bigram.pair == ("ih", "f")

    press(Qt.Key.Key_K, CTRL)
    type_text("pbm")
    press(Qt.Key.Key_Return)
    assert editor.window.canvas.active == "PBM"
    assert editor.window.canvas.hasFocus()
    editor.wiring.bigram.activate_pose("open")

    press(Qt.Key.Key_K, CTRL)
    type_text("select all keys")
    press(Qt.Key.Key_Return)
    assert editor.window.canvas.selection

    press(Qt.Key.Key_K, CTRL)
    type_text("blue shoes")
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


def seen(editor: Editor) -> set[str]:
    """The docks that are really to be seen."""
    docks = editor.window.findChildren(QDockWidget)
    return {dock.objectName() for dock in docks if not dock.visibleRegion().isEmpty()}


@pytest.mark.parametrize("height", [1000, 720])
def test_layouts(editor: Editor, qtbot: QtBot, height: int) -> None:
    w = editor.window
    w.resize(1280, height)
    QApplication.processEvents()
    low = height < 860
    expected = {
        Qt.Key.Key_1: {"bigrams", "preview", "stages"} | (set() if low else {"weak", "weights"}),
        Qt.Key.Key_2: {"weak", "preview", "stages"},
        Qt.Key.Key_3: {"mapping", "preview"} | (set() if low else {"weights"}),
        Qt.Key.Key_4: set(),
    }
    for key, docks in expected.items():
        w.canvas.setFocus()
        press(key, CTRL | ALT)
        QApplication.processEvents()
        assert seen(editor) == docks
        assert w.canvas.width() > 150
        assert (w.width(), w.height()) == (1280, height)

    w.bigrams_dock.show()
    editor.wiring.layouts.save("Mine / \\ & yours")
    press(Qt.Key.Key_1, CTRL | ALT)
    qtbot.waitUntil(lambda: "preview" in seen(editor))
    own = w.actions_.registry["layout.own.Mine / \\ & yours"]
    assert own.title == "Mine / \\ & yours"
    own.action.trigger()
    qtbot.waitUntil(lambda: seen(editor) == {"bigrams"})
    assert editor.state.texts("layouts") == ["Mine / \\ & yours"]
    editor.wiring.layouts.remove("Mine / \\ & yours")
    assert "layout.own.Mine / \\ & yours" not in w.actions_.registry


def test_pinned_sentences(editor: Editor, qtbot: QtBot, tmp_path: Path) -> None:
    w, pinned = editor.window, editor.wiring.sentence.pinned
    lines = tmp_path / "lines.txt"
    lines.write_text("Fat cats.\nBlue shoes.\n", "utf-8")
    pinned.set([])
    editor.wiring.sentences.import_from(lines)
    assert pinned.texts == ("Fat cats.", "Blue shoes.")
    w.sentence_bar.field.setFocus()
    for text in ("Fat cats.", "Blue shoes.", "Fat cats."):
        with qtbot.waitSignal(editor.session.stages_changed, timeout=20_000):
            press(Qt.Key.Key_Down, ALT)
        assert w.sentence_bar.sentence == text
    assert editor.session.utterance is not None
    assert editor.session.utterance.text == "Fat cats."
    w.sentence_bar.set_sentence("Go quickly.")
    press(Qt.Key.Key_P, CTRL | Qt.KeyboardModifier.ShiftModifier)
    assert pinned.texts[-1] == "Go quickly."
    assert w.sentence_list.texts == list(pinned.texts)
    w.sentence_list.pinned.setCurrentRow(2)
    w.sentence_list.up.click()
    assert pinned.texts == ("Fat cats.", "Go quickly.", "Blue shoes.")
    assert w.sentence_list.recent.item(0).text() == "Go quickly."
    editor.wiring.remember()
    assert editor.state.texts("sentences said")[-1] == "Go quickly."
    assert editor.document.undo_stack.count() == 0


def test_another_voice_says_the_same(editor: Editor, qtbot: QtBot) -> None:
    with qtbot.waitSignal(editor.session.stages_changed, timeout=20_000):
        editor.wiring.sentence.type("Fat cats ask for a bath.", play=False)
    american = editor.session.utterance
    box = editor.window.voice_bar.voice
    box.setFocus()
    with qtbot.waitSignal(editor.session.stages_changed, timeout=20_000):
        press(Qt.Key.Key_Down)
    british = editor.session.utterance
    assert american is not None
    assert british is not None
    assert british.text == american.text
    assert british.schedule.phones != american.schedule.phones
    editor.wiring.remember()
    assert editor.state.text("voice") == box.currentData() == editor.wiring.sentence.voice


def test_tabs_hold_several_bigrams_of_one_document(editor: Editor, qtbot: QtBot) -> None:
    w, tabs = editor.window, editor.wiring.tabs
    editor.wiring.bigram.open(("f", "ah"))
    w.canvas.setFocus()
    assert not w.bigram_tabs.isVisible()
    press(Qt.Key.Key_T, CTRL)
    assert w.bigram_tabs.titles == ["F – Ah", "Ah – F"]
    assert editor.wiring.bigram.pair == ("ah", "f")
    editor.wiring.bigram.open(("l", "ow"))
    assert w.bigram_tabs.titles == ["F – Ah", "L – Ow"]

    before = w.canvas.curves
    QTest.mouseClick(w.bigram_tabs, Qt.MouseButton.LeftButton, pos=w.bigram_tabs.tabRect(0).center())
    assert editor.wiring.bigram.pair == ("f", "ah")
    w.canvas.setFocus()
    press(Qt.Key.Key_A, CTRL)
    press(Qt.Key.Key_Up)
    assert editor.document.undo_stack.count() == 1
    press(Qt.Key.Key_Tab, CTRL)
    assert editor.wiring.bigram.pair == ("l", "ow")
    assert w.canvas.curves == before
    press(Qt.Key.Key_Z, CTRL)  # undo shows what it did, in the tab that has it
    assert w.bigram_tabs.titles == ["F – Ah", "L – Ow"]
    assert (editor.wiring.bigram.pair, w.bigram_tabs.currentIndex()) == (("f", "ah"), 0)

    tabs._reordered(0, 1)
    assert tabs.pairs == [("l", "ow"), ("f", "ah")]
    press(Qt.Key.Key_W, CTRL)
    assert tabs.pairs == [("l", "ow")]
    assert editor.wiring.bigram.pair == ("l", "ow")
    press(Qt.Key.Key_W, CTRL)
    assert tabs.pairs == [("l", "ow")]
    press(Qt.Key.Key_T, CTRL)
    assert tabs.pairs == [("l", "ow"), ("ow", "l")]
    editor.document.new(CurveSet(phonemes=("l", "ow", "x")))
    assert tabs.pairs == [("l", "ow"), ("ow", "l")]
    editor.document.new(CurveSet(phonemes=("f", "ah")))
    assert tabs.pairs == [("f", "ah")]


def test_a_b_beside_b_a(editor: Editor, qtbot: QtBot) -> None:
    w, stack = editor.window, editor.document.undo_stack
    editor.wiring.bigram.open(("f", "ah"))
    w.canvas.setFocus()
    press(Qt.Key.Key_B, CTRL)
    QApplication.processEvents()
    beside = w.beside
    assert beside.title == "Ah – F"
    assert abs(beside.canvas.width() - w.canvas.width()) < 40
    before = editor.document.curve_set.bigrams["ah", "f"]
    beside.canvas.setFocus()
    press(Qt.Key.Key_A, CTRL)
    press(Qt.Key.Key_Up)
    assert stack.count() == 1
    assert editor.document.curve_set.bigrams["ah", "f"] is not before
    assert editor.wiring.bigram.pair == ("f", "ah")  # the other canvas stays with its own
    press(Qt.Key.Key_Z, CTRL)
    assert editor.document.curve_set.bigrams["ah", "f"] is before
    assert beside.canvas.curves == before.curves
    assert editor.wiring.bigram.pair == ("f", "ah")

    editor.wiring.bigram.open(("l", "ow"))
    assert beside.title == "Ow – L"  # follows
    QTest.mouseClick(beside.pin, Qt.MouseButton.LeftButton)
    editor.wiring.bigram.open(("f", "ah"))
    assert beside.title == "Ow – L"  # stays
    w.pose_list.visibility_changed.emit("open", False)
    beside.canvas.active_changed.emit("FV")
    assert w.canvas.active == "FV"
    QTest.mouseClick(beside.close_button, Qt.MouseButton.LeftButton)
    assert not beside.isVisible()
    assert not w.actions_.beside.isChecked()
    assert editor.wiring.beside.pair is None


def test_docks_share_a_place_in_a_low_window_and_part_when_it_is_high_again(editor: Editor) -> None:
    w = editor.window
    w.resize(1600, 1000)
    assert w.weak_dock not in w.tabifiedDockWidgets(w.bigrams_dock)
    w.resize(1600, 720)
    assert w.weak_dock in w.tabifiedDockWidgets(w.bigrams_dock)
    w.resize(1600, 1000)
    assert w.weak_dock not in w.tabifiedDockWidgets(w.bigrams_dock)


def test_the_first_window_is_no_higher_than_its_screen(editor: Editor) -> None:
    w = editor.window
    w.resize(1600, 10 * w.screen().availableSize().height())
    w.fit_screen()
    assert 640 <= w.height() < w.screen().availableSize().height()


def test_the_layout_of_a_high_window_is_not_put_upon_a_low_one(editor: Editor) -> None:
    w = editor.window
    w.resize(1600, 1000)
    high = w.docks_state()
    editor.wiring.layouts.save("High")
    w.resize(1600, 720)
    low = w.docks_state()
    editor.wiring.layouts.save("Low")
    editor.wiring.layouts.use("High")
    assert "for a higher window" in w.hint_label.text()
    assert w.weak_dock in w.tabifiedDockWidgets(w.bigrams_dock)
    w.resize(1600, 1000)
    editor.wiring.layouts.use("Low")  # fits, and may be wished for
    assert w.weak_dock in w.tabifiedDockWidgets(w.bigrams_dock)
    for height, last, tabs in ((720, high, True), (720, low, True), (1000, high, False), (1000, low, False)):
        w.resize(1600, height)
        w.restore_layout(QByteArray(), last)
        if not w._sized:  # what showing the window does then
            w.use_layout()
        assert (w.weak_dock in w.tabifiedDockWidgets(w.bigrams_dock)) == tabs
