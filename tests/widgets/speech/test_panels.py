"""The panels of speech: what can be pressed when, and what they say."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from widgets.speech.assign_dialog import AssignDialog
from widgets.speech.live_panel import LivePanel
from widgets.speech.recording_panel import RecordingPanel
from widgets.speech.voice_panel import VoicePanel


@pytest.fixture
def recording(qtbot):
    panel = RecordingPanel()
    qtbot.addWidget(panel)
    with qtbot.waitExposed(panel):
        panel.show()
    return panel


def test_nothing_can_be_aligned_before_there_is_a_recording_and_a_text(recording, qtbot):
    assert not recording.align.isEnabled()
    assert "Drop a recording" in recording.name.text
    recording.set_recording("a.wav", 63.2)
    assert "a.wav · 1:03.2" in recording.name.text
    assert recording.recognise.isEnabled()
    assert not recording.align.isEnabled()
    QTest.keyClicks(recording.transcript, "Hello")
    with qtbot.waitSignal(recording.align_wanted) as wish:
        QTest.mouseClick(recording.align, Qt.MouseButton.LeftButton)
    assert wish.args == ["Hello"]
    with qtbot.waitSignal(recording.align_wanted):
        QTest.keyClick(recording.transcript, Qt.Key.Key_Return, Qt.KeyboardModifier.ControlModifier)


def test_while_busy_only_cancel_remains(recording, qtbot):
    recording.set_recording("a.wav", 3)
    recording.set_transcript("Hello")
    recording.set_busy(True)
    recording.set_progress(0.5)
    assert recording.bar.value() == 500
    assert not recording.align.isEnabled()
    assert not recording.phones.isEnabled()
    with qtbot.waitSignal(recording.cancelled):
        QTest.mouseClick(recording.cancel, Qt.MouseButton.LeftButton)
    recording.set_busy(False)
    assert not recording.cancel.isVisible()
    assert recording.align.isEnabled()


def test_values_from_outside_emit_nothing(recording, qtbot):
    with qtbot.assertNotEmitted(recording.transcript_changed):
        recording.set_transcript("Hello")
    recording.set_message("<b>no markup</b>", "error")
    assert recording.message.text() == "<b>no markup</b>"


def test_the_live_panel_says_why_there_is_no_microphone(qtbot):
    panel = LivePanel()
    qtbot.addWidget(panel)
    panel.set_devices([], "No microphone was found")
    assert "No microphone was found. A recording can still be replayed." in panel.message.text()
    assert not panel.start.isEnabled()
    assert not panel.replay.isEnabled()
    panel.set_can_replay(True)
    assert panel.replay.isEnabled()
    panel.set_running(True)
    panel.set_moment("ah", 0.321, 0.3, 0.5)
    assert "321 ms behind the sound" in panel.latency.text()
    assert "30 % of real time" in panel.latency.text()
    assert panel.stop.isEnabled()
    assert panel.record.isEnabled()
    panel.set_message("")
    assert "No microphone" in panel.message.text()


def test_a_microphone_can_be_chosen(qtbot):
    panel = LivePanel()
    qtbot.addWidget(panel)
    panel.set_devices([(3, "Desk"), (5, "Head")])
    panel.devices.setCurrentIndex(1)
    with qtbot.waitSignal(panel.start_wanted) as wish:
        QTest.mouseClick(panel.start, Qt.MouseButton.LeftButton)
    assert wish.args == [5]


def test_voice_and_map_tell_only_the_users_choices(qtbot):
    panel = VoicePanel(80, 450)
    qtbot.addWidget(panel)
    with qtbot.assertNotEmitted(panel.rate_changed):
        panel.set_voice(140, 60)
        panel.set_maps([("table-1", "Table 1", "note"), ("sapi", "SAPI", "")], "sapi")
    assert panel.maps.currentText() == "SAPI"
    panel.set_maps([("table-1", "Table 1", "note")], "")
    assert panel.maps.currentText() == "(the set's own)"
    with qtbot.waitSignal(panel.rate_changed) as wish:
        panel.rate.setValue(200)
    assert wish.args == [200]


def test_names_are_assigned(qtbot):
    dialog = AssignDialog("t", "s", ("Name", "Phone"), {"QX": "", "ZZ": "b"}, [("sil", "silence"), ("b", "b")])
    qtbot.addWidget(dialog)
    assert dialog.answers == {"QX": "sil", "ZZ": "b"}
    dialog.boxes["QX"].setCurrentIndex(1)
    assert dialog.answers == {"QX": "b", "ZZ": "b"}
