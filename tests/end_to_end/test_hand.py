"""The hand in the whole window: what an edit did, similar bigrams, letters, orders, buttons, scrubbing."""

import numpy as np
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from app.editor import Editor
from core_pipeline.curves import Curve
from core_pipeline.phone_classes import by_class
from tests.end_to_end.test_first_story import drag_key, speak

Key = Qt.Key


def test_the_overlay_shows_what_the_last_edit_did(editor: Editor, qtbot: QtBot) -> None:
    speak(editor, qtbot, "Fat cats often find fish.")
    overlay, session = editor.window.stage_panel.overlay, editor.session
    editor.wiring.bigram.open(("f", "ah"))

    def ghost_top() -> float | None:
        lines = overlay._ghost.get("open")
        return None if lines is None else float(lines.stage["magenta"].v.max())

    assert session.stages is not None
    first = float(session.stages.magenta["open"].v.max())
    assert ghost_top() is None
    top = int(editor.window.canvas.curves["open"].v.argmax())
    with qtbot.waitSignal(session.stages_changed):
        drag_key(editor, "open", top, 0.0, 0.4)
    assert ghost_top() == first
    before = session.stages
    editor.window.canvas.setFocus()
    for _ in range(3):  # presses of an arrow are one step, and so is what they did
        with qtbot.waitSignal(session.stages_changed):
            QTest.keyClick(editor.window.canvas, Key.Key_Up)
        assert (
            overlay._ghost["open"]
            .stage["magenta"]
            .same_as(type(overlay._ghost["open"].stage["magenta"])(before.magenta["open"].t, before.magenta["open"].v))
        )
    assert editor.document.undo_stack.count() == 2
    with qtbot.waitSignal(session.stages_changed):
        editor.window.actions_.undo.trigger()
    assert ghost_top() is not None
    editor.wiring.bigram.open(("d", "ah"))
    assert ghost_top() is None


def test_a_cancelled_drag_leaves_the_version_from_before_as_it_was(editor: Editor, qtbot: QtBot) -> None:
    speak(editor, qtbot, "Fat cats.")
    overlay, canvas = editor.window.stage_panel.overlay, editor.window.canvas
    editor.wiring.bigram.open(("f", "ah"))
    canvas.setFocus()
    canvas.select_all()
    with qtbot.waitSignal(editor.session.stages_changed):
        canvas.begin_move()
        QTest.keyClick(canvas, Key.Key_Up)
    assert overlay._ghost
    with qtbot.waitSignal(editor.session.stages_changed):
        QTest.keyClick(canvas, Key.Key_Escape)
    assert not overlay._ghost
    assert editor.document.undo_stack.count() == 0


def test_an_empty_bigram_is_begun_from_a_similar_one_and_found_in_its_word(editor: Editor, qtbot: QtBot) -> None:
    w, pair = editor.window, ("f", "ah")
    editor.document.edit_curves(pair, dict.fromkeys(editor.document.curve_set.bigrams[pair].curves), "Empty")
    speak(editor, qtbot, "Fat cats.")
    editor.wiring.bigram.open(pair)
    assert ">Fa</b>t" in w.header.detail
    assert not w.canvas.curves
    QTest.keyClick(w.canvas, Key.Key_D, Qt.KeyboardModifier.ControlModifier)
    bar = w.canvas.blend_bar
    taken = bar.targets.currentText()
    assert taken == "F – Aa"
    QTest.keyClick(bar.slider, Key.Key_Return)
    source = editor.document.curve_set.bigrams["f", "aa"].curves
    made = editor.document.curve_set.bigrams[pair]
    assert made.status == "draft"
    assert made.curves == source
    assert w.picker.grid.pairs.statuses[pair] == "draft"


def test_the_order_of_phones_is_chosen_and_remembered(editor: Editor) -> None:
    picker, phones = editor.window.picker, editor.document.curve_set.phonemes
    assert picker.grid.pairs.phonemes == phones
    picker.order.menu().actions()[1].trigger()
    assert picker.grid.pairs.phonemes == by_class(phones)
    editor.wiring.remember()
    picker.set_order("As in the set")
    editor.wiring.restore()
    assert picker.grid.pairs.phonemes == by_class(phones)


def test_a_drag_in_the_time_row_moves_face_and_sound(editor: Editor, qtbot: QtBot) -> None:
    speak(editor, qtbot, "Fat cats.")
    player, overlay = editor.preview.player, editor.window.stage_panel.overlay
    player.pause()
    y = overlay.rows_height + 8
    QTest.mousePress(overlay, Qt.MouseButton.LeftButton, pos=QPoint(round(overlay.axis.px(0.2)), y))
    assert player._output is not None
    assert player._output._playback is not None  # what sounds there is on its way out
    shown = []
    editor.preview.weights_changed.connect(lambda weights: shown.append(np.array(weights)))
    for t in (0.3, 0.4, 0.5):
        QTest.mouseMove(overlay, QPoint(round(overlay.axis.px(t)), y))
    QTest.mouseRelease(overlay, Qt.MouseButton.LeftButton, pos=QPoint(round(overlay.axis.px(0.5)), y))
    assert abs(player.time - 0.5) < 0.01
    qtbot.waitUntil(lambda: bool(shown) and np.allclose(shown[-1], editor.session.weights_at(player.time), atol=1e-6))
    qtbot.waitUntil(lambda: player._output._playback is None)


def test_the_headers_buttons_reach_the_canvas(editor: Editor, qtbot: QtBot) -> None:
    header, canvas = editor.window.header, editor.window.canvas
    editor.wiring.bigram.open(("f", "ah"))
    canvas.set_active("FV")
    before = canvas.curves["FV"]
    QTest.mouseClick(header.button_of("reverse"), Qt.MouseButton.LeftButton)
    assert canvas.curves["FV"].same_as(Curve(np.round(1 - before.t[::-1], 6), before.v[::-1]))
    QTest.mouseClick(header.buttons[0], Qt.MouseButton.LeftButton)
    assert canvas._control.snap
