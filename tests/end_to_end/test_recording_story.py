"""A recording dropped on the window: its words typed and found, its phones edited and kept, replayed as if live."""

import json
from pathlib import Path

import pytest
from PySide6.QtCore import QMimeData, QPoint, QPointF, Qt, QUrl
from PySide6.QtGui import QDragEnterEvent, QDropEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QFileDialog, QMessageBox
from pytestqt.qtbot import QtBot

from app.editor import Editor
from core_pipeline.phonemes import SILENCE
from core_pipeline.speech.speaker import speak
from core_pipeline.speech.wav import write_wav
from tests.helpers import mouse
from widgets.overlay.stage_footer import ROW
from widgets.speech.assign_dialog import AssignDialog

TEXT = "Fat cats often find fish."


@pytest.fixture
def wav(tmp_path: Path) -> Path:
    path = tmp_path / "a.wav"
    audio = speak(TEXT).audio
    assert audio is not None
    write_wav(path, audio)
    return path


def drop(editor: Editor, path: Path) -> None:
    """A file let go over the window."""
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(path))])
    place, action, keys = QPoint(50, 50), Qt.DropAction.CopyAction, Qt.KeyboardModifier.NoModifier
    enter = QDragEnterEvent(place, action, data, Qt.MouseButton.LeftButton, keys)
    QApplication.sendEvent(editor.window, enter)
    event = QDropEvent(QPointF(place), action, data, Qt.MouseButton.LeftButton, keys)
    QApplication.sendEvent(editor.window, event)


def open_and_align(editor: Editor, qtbot: QtBot, wav: Path) -> None:
    hearing, panel = editor.wiring.speech_in.recording.hearing, editor.window.recording_panel
    with qtbot.waitSignal(hearing.opened, timeout=20_000):
        drop(editor, wav)
    assert editor.window.focusWidget() is panel.transcript
    QTest.keyClicks(panel.transcript, TEXT)
    with qtbot.waitSignal(hearing.aligned, timeout=60_000):
        QTest.mouseClick(panel.align, Qt.MouseButton.LeftButton)
    editor.preview.player.pause()
    editor.session.recompute()


def test_drop_align_edit_undo_save_and_open_again(
    editor: Editor, qtbot: QtBot, wav: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    open_and_align(editor, qtbot, wav)
    utterance = editor.session.utterance
    assert utterance is not None
    assert utterance.audio is editor.wiring.speech_in.recording.audio
    assert [w.text for w in utterance.words] == ["Fat", "cats", "often", "find", "fish"]
    assert editor.window.recording_dock.isVisible()
    spoken = sum(phone != SILENCE for phone in utterance.schedule.phones)  # "often" may be said in two ways
    assert f"5 words, {spoken} phones" in editor.window.recording_panel.message.text()

    overlay = editor.window.stage_panel.overlay
    x = overlay.axis.px(float(utterance.schedule.times[2]))
    at = QPointF(round(x), overlay.rows_height + ROW + ROW // 2)
    mouse.drag(overlay, at, at + QPointF(12, 0))
    editor.session.recompute()
    moved = editor.session.utterance
    assert moved is not None
    assert moved.schedule.times[2] > utterance.schedule.times[2]
    assert editor.document.undo_stack.count() == 1
    assert not editor.document.is_dirty  # the curve set is as it was
    assert not editor.window.isWindowModified()

    where = QPoint(round(overlay.axis.px(float(sum(moved.schedule.times[1:3]) / 2))), round(at.y()))
    QTest.mouseDClick(overlay, Qt.MouseButton.LeftButton, pos=where)
    overlay.field.selectAll()
    QTest.keyClicks(overlay.field, "v")
    QTest.keyClick(overlay.field, Qt.Key.Key_Return)
    editor.session.recompute()
    assert editor.session.utterance is not None
    assert editor.session.utterance.schedule.phones[1] == "v"
    editor.window.actions_.undo.trigger()
    assert editor.session.utterance is moved  # the very same object
    editor.window.actions_.undo.trigger()
    assert editor.session.utterance is utterance
    editor.window.actions_.redo.trigger()
    assert editor.session.utterance is moved

    asked: list[str] = []
    monkeypatch.setattr(QMessageBox, "question", lambda *a: asked.append(a[2]) or QMessageBox.StandardButton.Cancel)
    assert not editor.window.may_close()
    assert "edited by hand" in asked[0]
    kept = wav.with_name("a.utterance.json")
    assert not kept.exists()
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *a: (a[2], ""))
    assert editor.wiring.speech_in.recording.ask_save()
    assert json.loads(kept.read_text())["recording"] == "a.wav"
    assert editor.window.may_close()

    hearing = editor.wiring.speech_in.recording.hearing
    with qtbot.waitSignal(hearing.labelled, timeout=20_000):  # what was kept comes back with the recording
        drop(editor, wav)
    assert editor.session.utterance is not None
    assert editor.session.utterance.schedule.times[2] == pytest.approx(moved.schedule.times[2], abs=1e-6)


def test_a_sentence_is_kept_with_its_sound_and_comes_back(editor: Editor, qtbot: QtBot, tmp_path: Path) -> None:
    recording = editor.wiring.speech_in.recording
    with qtbot.waitSignal(editor.speech.spoken, timeout=20_000):
        editor.wiring.sentence.type("Hello there.", play=False)
    said = editor.session.utterance
    assert said is not None
    kept = tmp_path / "mine.utterance.json"
    (tmp_path / "mine.wav").write_bytes(b"somebody else's")
    assert recording.save(kept, said)
    assert recording.save(kept, said)  # again: no third sound
    assert sorted(path.name for path in tmp_path.glob("*.wav")) == ["mine-2.wav", "mine.wav"]
    with qtbot.waitSignal(recording.hearing.labelled, timeout=20_000):
        drop(editor, kept)
    again = editor.session.utterance
    assert again is not None
    assert again.schedule.phones == said.schedule.phones
    assert again.audio is not None
    assert recording.path == tmp_path / "mine-2.wav"


def test_label_files_ask_for_unknown_names_once(
    editor: Editor, qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    lab = tmp_path / "a.lab"
    lab.write_text("0 1000000 pau\n1000000 2000000 QX\n2000000 3000000 aa1\n")
    shown: list[list[str]] = []

    def answer(dialog: AssignDialog) -> bool:
        shown.append(list(dialog.boxes))
        dialog.boxes["QX"].setCurrentIndex(dialog.boxes["QX"].findData("b"))
        return True

    monkeypatch.setattr(AssignDialog, "exec", answer)
    hearing = editor.wiring.speech_in.recording.hearing
    with qtbot.waitSignals([hearing.labelled, hearing.labelled], timeout=20_000):
        drop(editor, lab)
    assert editor.session.utterance is not None
    assert editor.session.utterance.schedule.phones == (SILENCE, "b", "aa")
    with qtbot.waitSignal(hearing.labelled, timeout=20_000):
        drop(editor, lab)
    assert shown == [["QX"]]


@pytest.mark.parametrize(("name", "data"), [("a.wav", b"no sound"), ("a.TextGrid", b"nothing"), ("a.mp3", b"")])
def test_what_cannot_be_read_is_one_sentence_in_the_panel(
    editor: Editor, qtbot: QtBot, tmp_path: Path, name: str, data: bytes
) -> None:
    (tmp_path / name).write_bytes(data)
    with qtbot.waitSignal(editor.wiring.speech_in.recording.hearing.failed, timeout=20_000):
        drop(editor, tmp_path / name)
    assert name in editor.window.recording_panel.message.text()


def test_cancel_gives_an_alignment_up(editor: Editor, qtbot: QtBot, wav: Path) -> None:
    open_and_align(editor, qtbot, wav)
    before = editor.session.utterance
    panel = editor.window.recording_panel
    QTest.mouseClick(panel.align, Qt.MouseButton.LeftButton)
    assert panel.cancel.isVisible()
    QTest.mouseClick(panel.cancel, Qt.MouseButton.LeftButton)
    assert not panel.cancel.isVisible()
    assert panel.message.text() == "Given up."
    assert editor.session.utterance is before
    with qtbot.waitSignal(editor.wiring.speech_in.recording.hearing.aligned, timeout=60_000):  # and once more
        QTest.mouseClick(panel.align, Qt.MouseButton.LeftButton)


def test_a_recording_replayed_as_if_live_moves_the_face_and_becomes_an_utterance(
    editor: Editor, qtbot: QtBot, wav: Path
) -> None:
    with qtbot.waitSignal(editor.wiring.speech_in.recording.hearing.opened, timeout=20_000):
        drop(editor, wav)
    panel, live = editor.window.live_panel, editor.wiring.speech_in.microphone.worker
    editor.window.actions_.live.trigger()
    assert panel.devices.count() > 0  # the microphones, or that there is none
    shown: list[float] = []
    editor.preview.weights_changed.connect(lambda weights: shown.append(float(weights.max())))
    with qtbot.waitSignal(live.ended, timeout=60_000) as over:
        QTest.mouseClick(panel.replay, Qt.MouseButton.LeftButton)
    assert over.args == [""]
    assert max(shown) > 0.3
    assert "ms behind the sound" in panel.latency.text()
    QTest.mouseClick(panel.record, Qt.MouseButton.LeftButton)
    said = editor.session.utterance
    assert said is not None
    assert said.audio is not None
    assert said.audio.duration == pytest.approx(2.05, abs=0.1)
    assert sum(phone != SILENCE for phone in said.schedule.phones) > 8


def test_a_phoneme_map_is_one_undo_step(editor: Editor, qtbot: QtBot) -> None:
    panel, document = editor.window.voice_panel, editor.document
    before = document.curve_set
    assert panel.maps.currentText() == "Table 1"
    panel.maps.setCurrentIndex(panel.maps.findData("sapi"))
    panel.maps.activated.emit(panel.maps.currentIndex())
    assert document.curve_set.phoneme_map["ng"] == "kg"
    assert document.curve_set.bigrams == before.bigrams
    editor.window.actions_.undo.trigger()
    assert document.curve_set.phoneme_map["ng"] == "d"
    assert panel.maps.currentText() == "Table 1"


def test_rate_and_pitch_speak_the_sentence_anew(editor: Editor, qtbot: QtBot) -> None:
    with qtbot.waitSignal(editor.speech.spoken, timeout=20_000) as usual:
        editor.wiring.sentence.type("Hello there.", play=False)
    with qtbot.waitSignal(editor.speech.spoken, timeout=20_000) as fast:
        editor.window.voice_panel.rate.setValue(300)
    assert fast.args[0].audio.duration < usual.args[0].audio.duration


def test_a_dropped_text_is_a_sentence_to_say_or_the_words_of_the_open_recording(
    editor: Editor, qtbot: QtBot, wav: Path, tmp_path: Path
) -> None:
    w, text, long = editor.window, tmp_path / "words.txt", tmp_path / "long.txt"
    text.write_text("Five big\nmoths.\n")
    long.write_text("moth " * 200)
    with qtbot.waitSignal(editor.session.stages_changed, timeout=20_000):
        drop(editor, text)
    assert w.sentence_bar.sentence == "Five big moths."
    drop(editor, long)
    assert "long.txt is too long" in w.hint_label.text()
    assert w.sentence_bar.sentence == "Five big moths."

    with qtbot.waitSignal(editor.wiring.speech_in.recording.hearing.opened, timeout=20_000):
        drop(editor, wav)
    w.sentences_dock.raise_()
    drop(editor, text)
    assert w.recording_panel.transcript.toPlainText().split() == ["Five", "big", "moths."]
    assert "Press Align" in w.recording_panel.message.text()
    qtbot.waitUntil(lambda: not w.recording_panel.visibleRegion().isEmpty())
