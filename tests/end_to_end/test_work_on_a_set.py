"""Through the 441: what is weak, what is suggested, what is next, and how two sets differ; in the real window."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app import resources
from app.editor import Editor
from app.settings import ViewState
from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.files import curve_set_json
from core_pipeline.phonemes import Pair
from widgets.picker.weak_panel import CORPUS, SENTENCE

F_AH, AH_D, D_Z = ("f", "ah"), ("ah", "d"), ("d", "z")


def partial() -> CurveSet:
    """English without a third of its bigrams, f-ah and ah-d among them."""
    full = curve_set_json.load(resources.english_curves())
    gone = {pair for i, pair in enumerate(full.bigrams) if i % 3 == 1 and "sil" not in pair} | {F_AH, AH_D}
    return replace(full, bigrams={p: b for p, b in full.bigrams.items() if p not in gone})


@pytest.fixture
def editor(qtbot: QtBot, qapp: QApplication, tmp_path: Path) -> Iterator[Editor]:
    editor = Editor(partial(), ViewState(tmp_path / "state"))
    editor.window.resize(1600, 1000)
    with qtbot.waitExposed(editor.window):
        editor.window.show()
    yield editor
    editor.close()
    editor.window.may_close = lambda: True
    editor.window.close()
    editor.window.deleteLater()
    qapp.processEvents()


def say(editor: Editor, qtbot: QtBot, text: str) -> None:
    """A sentence, and what is found in it."""
    with qtbot.waitSignal(editor.wiring.weak.diagnosed, timeout=20_000, check_params_cb=lambda d: d.stages is not None):
        editor.wiring.sentence.type(text, play=False)


def after_diagnosis(editor: Editor, qtbot: QtBot) -> None:
    """Wait until the newest curves have been looked at."""
    qtbot.waitUntil(
        lambda: (
            editor.wiring.weak.diagnosis is not None
            and editor.wiring.weak.diagnosis.curve_set.bigrams is editor.document.curve_set.bigrams
        ),
        timeout=20_000,
    )


def pairs_in_list(editor: Editor) -> list[Pair]:
    return [row.pair for row in editor.window.weak_list.rows]


def click_row(editor: Editor, row: int) -> None:
    rows = editor.window.weak_list.list
    item = rows.topLevelItem(row)
    rows.scrollToItem(item)
    at = rows.visualItemRect(item).center()
    QTest.mouseClick(rows.viewport(), Qt.MouseButton.LeftButton, pos=at)


def test_a_weak_row_opens_its_bigram_at_its_place_and_a_mark_does_the_same(editor: Editor, qtbot: QtBot) -> None:
    say(editor, qtbot, "Fat cats often find fish.")
    window, stages = editor.window, editor.session.stages
    assert stages is not None
    assert set(stages.missing) <= set(pairs_in_list(editor))
    assert window.picker.grid.pairs.weak[F_AH].startswith("missing")
    row = pairs_in_list(editor).index(AH_D)
    click_row(editor, row)
    time = window.weak_list.rows[row].time
    assert editor.wiring.bigram.pair == AH_D
    assert editor.preview.player.time == pytest.approx(time)

    overlay = window.stage_panel.overlay
    mark = next(m for m in overlay._marks if m.pair == F_AH)
    at = QPoint(round(overlay.axis.px(mark.time)), 5)
    QTest.mouseClick(overlay, Qt.MouseButton.LeftButton, pos=at)
    assert editor.wiring.bigram.pair == F_AH
    assert "F" in window.header.text


def test_comma_and_point_step_through_weak_bigrams_even_from_the_canvas(editor: Editor, qtbot: QtBot) -> None:
    say(editor, qtbot, "Fat cats often find fish.")
    order = list(dict.fromkeys(pairs_in_list(editor)))
    editor.window.canvas.setFocus()
    seen = []
    for key in (Qt.Key.Key_Period, Qt.Key.Key_Period, Qt.Key.Key_Comma):
        QTest.keyClick(editor.window.canvas, key)
        seen.append(editor.wiring.bigram.pair)
    assert seen == [order[0], order[1], order[0]]


def test_tab_accepts_what_is_suggested_for_an_empty_bigram_in_one_step(editor: Editor, qtbot: QtBot) -> None:
    say(editor, qtbot, "Fat.")
    editor.wiring.bigram.open(F_AH)
    canvas = editor.window.canvas
    canvas.setFocus()
    assert editor.wiring.suggesting.accept_action.isEnabled()
    QTest.keyClick(canvas, Qt.Key.Key_Tab)
    accepted = editor.document.curve_set.bigrams[F_AH]
    assert accepted.status == "draft"
    assert accepted.curves["FV"].v.max() > 0.6
    assert "in its row" in accepted.source
    assert editor.document.undo_stack.count() == 1
    assert canvas.hasFocus()
    after_diagnosis(editor, qtbot)
    assert not editor.wiring.suggesting.accept_action.isEnabled()
    editor.window.actions_.undo.trigger()
    assert F_AH not in editor.document.curve_set.bigrams


def test_a_drawn_bigram_keeps_its_curves_when_tab_is_pressed(editor: Editor, qtbot: QtBot) -> None:
    say(editor, qtbot, "Fat.")
    drawn = next(iter(editor.document.curve_set.bigrams))
    editor.wiring.bigram.open(drawn)
    editor.window.canvas.setFocus()
    QTest.keyClick(editor.window.canvas, Qt.Key.Key_Tab)
    assert editor.document.undo_stack.count() == 0
    assert not editor.window.canvas.hasFocus()  # Tab goes to the next field, as everywhere


def test_fill_all_is_one_step_marked_until_reviewed(editor: Editor) -> None:
    before = editor.document.curve_set
    missing = before.missing()
    editor.wiring.suggesting.fill_action.trigger()
    after = editor.document.curve_set
    assert after.missing() == []
    assert {after.status_of(pair) for pair in missing} == {"suggestion"}
    assert all(after.bigrams[pair] is bigram for pair, bigram in before.bigrams.items())
    assert editor.window.picker.grid.pairs.statuses[F_AH] == "suggestion"
    assert editor.document.undo_stack.count() == 1
    editor.window.actions_.undo.trigger()
    assert dict(editor.document.curve_set.bigrams) == dict(before.bigrams)


def test_approve_goes_on_in_the_queue_with_a_word_in_a_loop(editor: Editor, qtbot: QtBot) -> None:
    say(editor, qtbot, "Oh.")
    queue, bar = editor.wiring.queue, editor.window.picker.coverage
    assert " % of running speech" in bar.text
    drawn = next(pair for pair in queue.order if pair in editor.document.curve_set.bigrams)
    editor.wiring.bigram.open(drawn)
    at = queue.order.index(drawn)
    following = next(pair for pair in queue.order[at + 1 :])
    with qtbot.waitSignal(
        editor.session.stages_changed, timeout=30_000, check_params_cb=lambda s: following in s.schedule.pairs()
    ):
        QTest.keyClick(editor.window, Qt.Key.Key_Return, Qt.KeyboardModifier.ControlModifier)
    assert editor.document.curve_set.status_of(drawn) == "approved"
    assert editor.wiring.bigram.pair == following
    assert bar.text.endswith("1 approved")
    assert editor.preview.player.looping
    assert editor.document.undo_stack.count() == 1


def test_nothing_drawn_is_not_approved(editor: Editor) -> None:
    editor.wiring.bigram.open(F_AH)
    editor.wiring.queue.approve_action.trigger()
    assert editor.document.undo_stack.count() == 0
    assert editor.wiring.bigram.pair == F_AH
    assert "Tab" in editor.window.hint_label.text()


def test_a_pinned_sentence_that_has_the_bigram_is_said_after_the_word(editor: Editor, qtbot: QtBot) -> None:
    say(editor, qtbot, "Oh.")
    editor.wiring.sentence.pinned.set(["Fifty ships.", "The fat cat."])
    with qtbot.waitSignal(
        editor.session.stages_changed, timeout=30_000, check_params_cb=lambda s: F_AH in s.schedule.pairs()
    ):
        grid = editor.window.picker.grid
        QTest.mouseClick(grid.viewport(), Qt.MouseButton.LeftButton, pos=grid.rect_of(F_AH).center())
    said = editor.window.sentence_bar.sentence
    assert said.endswith(" The fat cat.")
    assert "Fifty" not in said
    editor.wiring.carrier.action.setChecked(False)
    QTest.mouseClick(grid.viewport(), Qt.MouseButton.LeftButton, pos=grid.rect_of(("oy", "oy")).center())
    assert editor.window.sentence_bar.sentence == said


def test_a_word_that_is_found_late_leaves_alone_what_is_typed_meanwhile(editor: Editor, qtbot: QtBot) -> None:
    say(editor, qtbot, "Oh.")
    carrier, bar = editor.wiring.carrier, editor.window.sentence_bar
    grid = editor.window.picker.grid
    with qtbot.waitSignal(carrier.known, timeout=30_000):
        QTest.mouseClick(grid.viewport(), Qt.MouseButton.LeftButton, pos=grid.rect_of(("ah", "r")).center())
        bar.field.selectAll()
        QTest.keyClicks(bar.field, "Find fish.")
    assert bar.sentence == "Find fish."


def test_a_whole_text_is_read_ranked_and_opened_at_the_sentence(editor: Editor, qtbot: QtBot, tmp_path: Path) -> None:
    say(editor, qtbot, "Oh.")
    script = tmp_path / "script.txt"
    script.write_text("Fat cats.\nThe cat sat on the mat. Find it!\n", "utf-8")
    weak, panel = editor.wiring.weak, editor.window.weak_panel
    with qtbot.waitSignal(weak.reported, timeout=20_000) as reported:
        weak.read(script)
    report = reported.args[0]
    assert report.sentences == ("Fat cats.", "The cat sat on the mat.", "Find it!")
    assert panel.source.currentIndex() == CORPUS
    assert pairs_in_list(editor)[0] == AH_D
    assert editor.window.weak_list.rows[0].uses == 5
    assert editor.wiring.queue.frequencies is report.frequencies
    row = pairs_in_list(editor).index(F_AH)
    with qtbot.waitSignal(editor.session.stages_changed, timeout=20_000, check_params_cb=lambda s: len(s.schedule) > 3):
        click_row(editor, row)
    assert editor.window.sentence_bar.sentence == "Fat cats."
    qtbot.waitUntil(lambda: editor.wiring.bigram.pair == F_AH)
    panel.source.setCurrentIndex(SENTENCE)
    assert all(row.sentence == "" for row in editor.window.weak_list.rows)


def test_a_text_that_is_none_is_refused_and_a_long_one_can_be_stopped(
    editor: Editor, qtbot: QtBot, tmp_path: Path
) -> None:
    weak, panel = editor.wiring.weak, editor.window.weak_panel
    (tmp_path / "blob.txt").write_bytes(bytes(range(256)))
    weak.read(tmp_path / "blob.txt")
    qtbot.waitUntil(lambda: "is not text" in editor.window.hint_label.text(), timeout=20_000)
    assert not panel.progress.isVisible()
    (tmp_path / "long.txt").write_text("This is one more sentence.\n" * 20_000, "utf-8")
    weak.read(tmp_path / "long.txt")
    qtbot.waitUntil(lambda: panel.progress.maximum() == 20_000, timeout=20_000)
    panel.cancel.click()
    assert not panel.progress.isVisible()
    assert panel.source.isVisible()
    say(editor, qtbot, "Fat.")  # and all goes on
    assert pairs_in_list(editor)


def test_statistics_stand_beside_the_papers_tables(editor: Editor) -> None:
    editor.window.actions_.registry["tools.statistics"].action.trigger()
    view = editor.wiring.statistics.view
    assert view is not None
    assert "122 of 441 pairs never appear" in view.summary.text()
    assert view.table.item(0, 0).text() == "ah – d"
    assert (view.table_2.item(0, 0).text(), view.table_2.item(0, 1).text()) == ("ah – d", "4.62 %")
    assert view.table_2.rowCount() == 21
    image = view.curve.grab().toImage()
    at = view.curve.point(441, 1.0)
    around = {image.pixelColor(round(at.x()) - 5, round(at.y()) + dy).name() for dy in (-1, 0, 1)}
    assert len(around) > 1  # the curve ends at the top right
    editor.wiring.suggesting.fill_action.trigger()
    editor.wiring.bigram.open(F_AH)
    editor.wiring.queue.approve_action.trigger()
    assert "approved: 1" in view.summary.text()
    view.close()


def test_holding_a_key_shows_the_other_set_and_letting_go_this_one(editor: Editor, qtbot: QtBot) -> None:
    say(editor, qtbot, "Fat.")
    start = editor.session.stages
    editor.wiring.suggesting.fill_action.trigger()
    qtbot.waitUntil(lambda: editor.session.stages is not start)
    now = editor.session.stages
    assert start is not None
    assert now is not None
    canvas = editor.window.canvas
    canvas.setFocus()
    QTest.keyPress(canvas, Qt.Key.Key_B)
    qtbot.waitUntil(lambda: editor.session.stages is not now)
    held = editor.session.stages
    assert held is not None
    np.testing.assert_array_equal(held.magenta["FV"].v, start.magenta["FV"].v)
    QTest.keyRelease(canvas, Qt.Key.Key_B)
    qtbot.waitUntil(lambda: editor.session.stages is not held)
    again = editor.session.stages
    assert again is not None
    np.testing.assert_array_equal(again.magenta["FV"].v, now.magenta["FV"].v)
    assert editor.document.undo_stack.count() == 1


def test_comparing_tints_what_differs_and_draws_both(editor: Editor, qtbot: QtBot, tmp_path: Path) -> None:
    say(editor, qtbot, "Fat.")
    other = editor.document.curve_set.with_bigram(D_Z, Bigram())
    other = other.with_bigram(F_AH, curve_set_json.load(resources.english_curves()).bigrams[F_AH])
    curve_set_json.save(other, tmp_path / "other.json")
    compare, pairs = editor.wiring.compare, editor.window.picker.grid.pairs
    compare.open_file(tmp_path / "other.json")
    assert pairs.differences is not None
    assert pairs.differences[F_AH] > 0.5
    assert pairs.differences["oy", "oy"] == 0
    legend = editor.window.picker.legend
    assert legend.names[0] == "like other.json"
    assert "hold B" in editor.window.hint_label.text()
    assert compare.file.isChecked()
    assert editor.window.stage_panel.overlay._other["FV"].peak > 0.5
    compare.nothing.trigger()
    assert pairs.differences is None
    assert legend.names[0] == "empty"
    assert not editor.window.stage_panel.overlay._other
    crab = resources.english_curves().with_name("crab.json")
    compare.open_file(crab)
    assert compare.other is None
    assert "other poses" in editor.window.hint_label.text()


def test_time_is_counted_while_there_is_work(editor: Editor) -> None:
    spent = editor.wiring.time_spent
    editor.wiring.bigram.open(F_AH)
    editor.window.activateWindow()
    for _ in range(75):
        spent.tick()
        if _ % 20 == 0:
            editor.window.canvas.selection_changed.emit("")
    counted = spent.seconds[F_AH]
    assert counted > 60
    for _ in range(90):
        spent.tick()
    assert spent.seconds[F_AH] < counted + 40  # nothing was done
    assert editor.window.header._spent == f"{spent.seconds[F_AH] // 60}:{spent.seconds[F_AH] % 60:02}"


def test_no_two_commands_of_the_whole_window_share_a_key(editor: Editor) -> None:
    keys = [key for entry in editor.window.actions_.registry for key in entry.default]
    assert {key for key in keys if keys.count(key) > 1} == set()
    actions = editor.window.actions_
    for menu in (actions.bigram_menu, actions.work_menu, actions.tools_menu):
        texts = [action.text().casefold() for action in menu.menu.actions() if "&" in action.text()]
        letters = [text[text.index("&") + 1] for text in texts]
        assert len(letters) == len(set(letters)), texts


def test_nothing_is_suggested_from_the_set_that_was_open_before(editor: Editor, qtbot: QtBot) -> None:
    say(editor, qtbot, "Fat.")
    editor.wiring.bigram.open(F_AH)
    assert editor.wiring.suggesting.accept_action.isEnabled()
    crab = curve_set_json.load(resources.english_curves().with_name("crab.json"))
    editor.document.new(crab.with_bigram(F_AH, None))
    assert editor.wiring.bigram.pair == F_AH
    assert not editor.wiring.suggesting.accept_action.isEnabled()
    after_diagnosis(editor, qtbot)
    editor.wiring.suggesting.accept()
    assert set(editor.document.curve_set.bigrams[F_AH].curves) <= set(crab.poses)
    assert editor.document.curve_set.bigrams[F_AH].curves["mouth open"].v.max() > 0.2


def test_the_version_at_opening_outlives_a_great_change(editor: Editor, qtbot: QtBot) -> None:
    compare, opened = editor.wiring.compare, editor.document.curve_set
    compare.opening.trigger()
    assert compare.other is opened
    editor.document.change_set(replace(opened, name="Renamed"), "Rename")
    qtbot.waitUntil(lambda: editor.session.curve_set.name == "Renamed")
    assert compare.other is opened
    editor.document.new(opened)
    qtbot.waitUntil(lambda: compare.other is None)
