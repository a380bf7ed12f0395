"""One animator's first minutes: type, look, drag, undo, save, reload, export."""

import json
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QMimeData, QPoint, QPointF, Qt, QUrl
from PySide6.QtGui import QDragEnterEvent, QDropEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMessageBox
from pytestqt.qtbot import QtBot

from app import resources
from app.editor import Editor
from core_pipeline.curve_set import CurveSet
from core_pipeline.faces.render.renderer import Figure
from core_pipeline.files import curve_set_json
from core_pipeline.pipeline import Stages
from core_pipeline.settings import Settings
from tests.helpers import mouse


def speak(editor: Editor, qtbot: QtBot, text: str) -> Stages:
    """Type a sentence into the field, as a user would, and wait for its stages."""
    field = editor.window.sentence_bar.field
    field.setFocus()
    field.selectAll()
    with qtbot.waitSignal(editor.session.stages_changed, timeout=20_000, check_params_cb=lambda s: s is not None):
        if text.isascii() and text.isprintable():
            QTest.keyClicks(field, text)
        else:  # no keyboard has these keys: such text is pasted
            field.insert(text)
        QTest.keyClick(field, Qt.Key.Key_Return)
    assert editor.session.stages is not None
    return editor.session.stages


def knots(stages: Stages, colour: str, pose: str) -> tuple[np.ndarray, np.ndarray]:
    track = stages.stage(colour)[pose]
    return track.t, track.v


def drag_key(editor: Editor, pose: str, index: int, dt: float, dv: float) -> None:
    """Drag a key of the open bigram on the canvas, then let the event loop run."""
    canvas = editor.window.canvas
    canvas.set_active(pose)
    curve = canvas.curves[pose]
    t, v = float(curve.t[index]), float(curve.v[index])
    mouse.drag(canvas.viewport(), canvas.point_of(t, v), canvas.point_of(t + dt, v + dv))


def test_type_drag_undo_save_reload_export(editor: Editor, qtbot: QtBot, tmp_path: Path) -> None:
    stages = speak(editor, qtbot, "Fat cats often find fish.")
    assert stages.schedule.phones[1:4] == ("f", "ah", "d")
    editor.wiring.bigram.open(("f", "ah"))
    start = editor.document.curve_set
    before = start.bigrams["f", "ah"]
    top = int(before.curves["open"].v.argmax())

    with qtbot.waitSignal(editor.session.stages_changed):
        drag_key(editor, "open", top, 0.0, 0.4)
    dragged = editor.session.stages
    assert dragged is not None
    assert editor.document.undo_stack.count() == 1
    for colour in ("blue", "magenta"):
        t, v = knots(dragged, colour, "open")
        assert not np.allclose(v, stages.stage(colour)["open"].at(t), atol=0.05), colour
    after = editor.document.curve_set.bigrams["f", "ah"]
    assert after.curves["open"].v[top] == pytest.approx(before.curves["open"].v[top] + 0.4, abs=0.02)
    assert editor.window.isWindowModified()

    with qtbot.waitSignal(editor.session.stages_changed):
        editor.window.actions_.undo.trigger()
    assert editor.document.curve_set.bigrams["f", "ah"] is before
    undone = editor.session.stages
    assert undone is not None
    for colour in ("blue", "yellow", "cyan", "magenta"):
        for pose in stages.poses:
            np.testing.assert_array_equal(knots(undone, colour, pose), knots(stages, colour, pose))
    assert not editor.window.isWindowModified()

    editor.window.actions_.redo.trigger()
    assert editor.document.curve_set.bigrams["f", "ah"] is after
    saved, exported, weights = tmp_path / "mine.json", tmp_path / "engine.min.json", tmp_path / "weights.csv"
    editor.document.save(saved)
    assert not editor.window.isWindowModified()
    assert editor.wiring.exchange.export(exported)
    assert editor.wiring.exchange.export_weights(weights)
    text = saved.read_text("utf-8")

    editor.files.open(saved)
    again = editor.document.curve_set
    assert curve_set_json.dumps(again) == text
    assert again.bigrams["f", "ah"].curves["open"].v[top] == pytest.approx(after.curves["open"].v[top], abs=1e-4)
    compact = json.loads(exported.read_text("utf-8"))
    assert compact == json.loads(text)
    assert weights.read_text("utf-8").startswith("time,open,W,")


def test_overlay_and_face_follow_while_the_key_is_still_held(editor: Editor, qtbot: QtBot) -> None:
    stages = speak(editor, qtbot, "Fat cats often find fish.")
    editor.preview.player.pause()
    editor.wiring.bigram.open(("f", "ah"))
    canvas = editor.window.canvas
    canvas.set_active("FV")
    curve = canvas.curves["FV"]
    top = int(curve.v.argmax())
    start = canvas.point_of(float(curve.t[top]), float(curve.v[top]))
    with qtbot.waitSignal(editor.preview.frame_ready, timeout=20_000):
        editor.preview.scrub(0.1)
    mouse.press(canvas.viewport(), start)
    with qtbot.waitSignals([editor.session.stages_changed, editor.preview.frame_ready], timeout=20_000):
        for i in range(1, 7):
            mouse.move(canvas.viewport(), start + QPointF(0, 20 * i))
    live = editor.session.stages
    assert live is not None
    assert live is not stages
    assert live.blue["FV"].v.max() <= stages.blue["FV"].v.max()
    assert not np.array_equal(live.blue["FV"].v, stages.blue["FV"].v)
    assert editor.document.undo_stack.count() == 0

    with qtbot.waitSignal(editor.session.stages_changed):
        QTest.keyClick(canvas.viewport(), Qt.Key.Key_Escape)
    mouse.release(canvas.viewport(), start)
    assert editor.document.undo_stack.count() == 0
    back = editor.session.stages
    assert back is not None
    np.testing.assert_array_equal(back.blue["FV"].v, stages.blue["FV"].v)


def test_a_preset_changes_the_curves_and_is_saved_with_the_set(editor: Editor, qtbot: QtBot, tmp_path: Path) -> None:
    stages = speak(editor, qtbot, "Pop music beams.")
    panel = editor.window.settings_panel
    with qtbot.waitSignal(editor.session.stages_changed):
        panel.preset.setCurrentIndex(panel.preset.findData("smartbody"))
        panel.preset.activated.emit(panel.preset.currentIndex())
    slow = editor.session.stages
    assert slow is not None
    steepest = max(np.abs(np.diff(slow.magenta[p].v) / np.diff(slow.magenta[p].t)).max() for p in slow.poses)
    assert steepest <= 6 + 1e-6
    assert editor.document.undo_stack.count() == 1
    editor.document.save(tmp_path / "slow.json")
    assert curve_set_json.load(tmp_path / "slow.json").effective_settings == Settings.smartbody()
    editor.document.undo_stack.undo()
    assert editor.document.curve_set.effective_settings == Settings.paper()
    editor.session.recompute()
    back = editor.session.stages
    assert back is not None
    np.testing.assert_array_equal(back.magenta["PBM"].v, stages.magenta["PBM"].v)


def test_a_click_in_the_overlay_opens_the_bigram_that_made_it(editor: Editor, qtbot: QtBot) -> None:
    stages = speak(editor, qtbot, "Fat cats often find fish.")
    t, v = knots(stages, "blue", "FV")
    moment = float(t[v.argmax()])
    editor.preview.player.pause()
    index = stages.winner("FV", moment)
    assert index is not None
    editor.window.stage_panel.bigram_picked.emit(index, moment, "FV")
    assert editor.wiring.bigram.pair == stages.schedule.pairs()[index]
    assert editor.window.canvas.active == "FV"
    assert editor.preview.player.time == pytest.approx(moment)


def test_a_word_in_the_search_finds_its_bigrams(editor: Editor, qtbot: QtBot) -> None:
    search = editor.window.picker.search
    search.setFocus()
    QTest.keyClicks(search, "f ah")
    QTest.keyClick(search, Qt.Key.Key_Return)
    assert editor.wiring.bigram.pair == ("f", "ah")
    search.clear()
    QTest.keyClicks(search, "low")
    QTest.keyClick(search, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: editor.wiring.bigram.pair == ("l", "ow"), timeout=20_000)


def test_space_in_the_canvas_plays_the_bigram_alone(editor: Editor, qtbot: QtBot) -> None:
    speak(editor, qtbot, "Fat cats.")
    editor.preview.player.pause()
    editor.wiring.bigram.open(("f", "ah"))
    seen: list[float] = []
    editor.preview.bigram_moment.connect(lambda s: seen.append(s) if s is not None else None)
    QTest.keyClick(editor.window.canvas.viewport(), Qt.Key.Key_Space)
    assert editor.preview.bigram_player.playing
    qtbot.waitUntil(lambda: any(b < a for a, b in pairwise(seen)), timeout=20_000)  # it looped
    assert all(0 <= s <= 1 for s in seen)
    QTest.keyClick(editor.window.canvas.viewport(), Qt.Key.Key_Space)
    assert not editor.preview.bigram_player.playing


def test_playing_without_a_device_moves_playhead_and_face(editor: Editor, qtbot: QtBot) -> None:
    times: list[float] = []
    speak(editor, qtbot, "Fat cats often find fish.")
    assert editor.preview.player.playing
    with qtbot.waitSignals([editor.preview.frame_ready] * 3, timeout=20_000):
        editor.preview.sentence_moment.connect(times.append)
    qtbot.waitUntil(lambda: len(times) > 3, timeout=20_000)
    assert times == sorted(times)


@pytest.mark.parametrize(
    ("text", "told"),
    [("?!…", "at least one word"), ("x" * 10_000, "characters")],
    ids=["only punctuation", "ten thousand characters"],
)
def test_what_cannot_be_said_is_told_and_the_last_sentence_stays(
    editor: Editor, qtbot: QtBot, text: str, told: str
) -> None:
    stages = speak(editor, qtbot, "Fat cats.")
    bar = editor.window.sentence_bar
    with qtbot.waitSignal(editor.speech.failed, timeout=20_000) as failed:
        bar.field.setText(text)
        QTest.keyClick(bar.field, Qt.Key.Key_Return)
    assert told in failed.args[0].lower()
    assert bar.message == failed.args[0]
    assert editor.session.stages is stages


def test_emoji_and_control_characters_are_said_without(editor: Editor, qtbot: QtBot) -> None:
    plain = speak(editor, qtbot, "Fat cats.").schedule.phones
    assert speak(editor, qtbot, "Fat \U0001f408 cats.\x07").schedule.phones == plain


def test_closing_with_unsaved_work_asks(
    editor: Editor, qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    answers = [QMessageBox.StandardButton.Cancel, QMessageBox.StandardButton.Save]
    asked: list[str] = []

    def question(*args: object, **_: object) -> QMessageBox.StandardButton:
        asked.append(str(args[2]))
        return answers.pop(0)

    monkeypatch.setattr(QMessageBox, "question", question)
    path = tmp_path / "mine.json"
    editor.document.save(path)
    editor.wiring.bigram.open(("f", "ah"))
    top = int(editor.window.canvas.curves["FV"].v.argmax())
    drag_key(editor, "FV", top, 0.0, -0.3)
    assert editor.document.is_dirty
    editor.window.close()
    assert editor.window.isVisible()
    assert "mine.json" in asked[0]
    editor.window.close()
    assert not editor.window.isVisible()
    assert not editor.document.is_dirty
    assert curve_set_json.load(path).bigrams["f", "ah"].curves["FV"].v[top] < 0.6


def test_undo_of_another_bigram_shows_that_bigram(editor: Editor, qtbot: QtBot) -> None:
    editor.wiring.bigram.open(("f", "ah"))
    top = int(editor.window.canvas.curves["FV"].v.argmax())
    drag_key(editor, "FV", top, 0.0, -0.3)
    editor.wiring.bigram.open(("l", "ow"))
    editor.window.actions_.undo.trigger()
    assert editor.wiring.bigram.pair == ("f", "ah")
    assert editor.window.picker.current == ("f", "ah")


def drop(editor: Editor, path: Path) -> None:
    """Drop a file on the window."""
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(path))])
    copy, left, no = Qt.DropAction.CopyAction, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
    enter = QDragEnterEvent(QPoint(300, 300), copy, data, left, no)
    QApplication.sendEvent(editor.window, enter)
    assert enter.isAccepted()
    QApplication.sendEvent(editor.window, QDropEvent(QPointF(300, 300), copy, data, left, no))


def test_a_dropped_curve_set_is_opened_and_a_dropped_face_is_shown(
    editor: Editor, qtbot: QtBot, tmp_path: Path
) -> None:
    mine = tmp_path / "mine.json"
    curve_set_json.save(CurveSet(name="Mine"), mine)
    drop(editor, mine)
    assert editor.document.curve_set.name == "Mine"
    assert editor.document.path == mine
    rig = tmp_path / "rig.glb"
    rig.write_bytes((resources.face_folder() / "face.glb").read_bytes())
    with qtbot.waitSignal(editor.faces.opened, timeout=20_000):
        drop(editor, rig)
    assert editor.preview.face is not None
    assert editor.preview.face.mix("PBM")


def test_a_file_that_is_no_face_is_told_and_the_face_stays(editor: Editor, qtbot: QtBot, tmp_path: Path) -> None:
    qtbot.waitUntil(lambda: editor.preview.face is not None, timeout=20_000)
    before = editor.preview.face
    wrong = tmp_path / "wrong.glb"
    wrong.write_bytes(b"not a face")
    with qtbot.waitSignal(editor.faces.failed, timeout=20_000) as failed:
        drop(editor, wrong)
    assert "wrong.glb" in failed.args[0]
    assert editor.window.hint_label.text() == failed.args[0]
    assert editor.preview.face is before


def test_a_set_with_other_poses_brings_the_character_that_can_make_them(editor: Editor, qtbot: QtBot) -> None:
    qtbot.waitUntil(lambda: editor.preview.face is not None, timeout=20_000)
    editor.files.open(resources.assets() / "curves" / "crab.json")
    qtbot.waitUntil(lambda: editor.preview.face is not None and editor.preview.face.name == "crab", timeout=20_000)
    assert editor.preview.face is not None
    assert all(editor.preview.face.mix(pose) for pose in editor.document.curve_set.poses)
    speak(editor, qtbot, "Fat cats.")
    assert editor.window.canvas.curves
    editor.document.new(curve_set_json.load(resources.english_curves()))
    qtbot.waitUntil(lambda: editor.preview.face is not None and editor.preview.face.name == "toon", timeout=20_000)


def test_a_new_set_never_plays_through_the_poses_of_the_old_one(editor: Editor, qtbot: QtBot) -> None:
    """English and the crab have nine poses each: as many, but not the same."""
    qtbot.waitUntil(lambda: editor.preview.face is not None, timeout=20_000)
    speak(editor, qtbot, "Fat cats.")
    editor.preview.player.pause()
    editor.preview.set_lively(False)
    asked: list[float] = []
    request = editor.preview.worker.request

    def watched(figures: list[Figure], *rest: object) -> None:
        asked.append(float(figures[0].amounts.max()))
        request(figures, *rest)

    editor.preview.worker.request = watched
    editor.preview.scrub(0.5)
    qtbot.waitUntil(lambda: bool(asked) and asked[-1] > 0, timeout=20_000)
    toon = editor.preview.face
    editor.document.new(curve_set_json.load(resources.assets() / "curves" / "crab.json"))
    editor.session.recompute()
    editor.preview.scrub(0.51)
    assert editor.preview.face is toon  # the crab is still being read
    assert asked[-1] == 0.0
