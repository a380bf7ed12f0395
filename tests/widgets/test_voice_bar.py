"""Voice, speed and sound: wishes go up, values come down."""

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QApplication, QLabel

from widgets.voice_bar import VoiceBar

VOICES = {"en-us": "American English", "gmw/en": "British English"}


@pytest.fixture
def bar(qtbot):
    bar = VoiceBar()
    bar.set_voices(VOICES)
    qtbot.addWidget(bar)
    bar.show()
    qtbot.waitExposed(bar)
    return bar


@pytest.fixture
def wishes(bar):
    seen = []
    for name in ("voice_chosen", "speed_changed"):
        getattr(bar, name).connect(lambda *values, name=name: seen.append((name, *values)))
    return seen


def test_a_voice_is_chosen_by_key(qtbot, bar, wishes):
    bar.voice.setFocus()
    qtbot.keyClick(bar.voice, Qt.Key.Key_Down)
    assert wishes == [("voice_chosen", "gmw/en")]


def test_values_from_outside_emit_nothing(bar, wishes):
    bar.set_voice("gmw/en")
    bar.set_speed(0.5)
    bar.set_sound("no audio device: playing silently")
    bar.set_voices({"new": "New", **VOICES})
    assert bar.voice.currentData() == "gmw/en"
    assert bar.speed.value() == 0.5
    bar.set_voice("gone")
    assert bar.voice.currentData() == "new"
    assert wishes == []


def test_the_speed_box_steps_and_takes_typed_values(qtbot, bar, wishes):
    qtbot.keyClick(bar.speed, Qt.Key.Key_Down)
    assert wishes == [("speed_changed", 0.75)]
    bar.speed.selectAll()
    qtbot.keyClicks(bar.speed, "0.4")
    assert len(wishes) == 1
    qtbot.keyClick(bar.speed, Qt.Key.Key_Return)
    assert wishes[1:] == [("speed_changed", 0.4)]
    bar.speed.setValue(7)
    assert bar.speed.value() == 1.0


def test_the_wheel_over_an_unfocused_box_changes_nothing(qtbot, bar, wishes):
    bar.voice.setFocus()
    turn(bar.speed)
    assert bar.speed.value() == 1.0
    bar.speed.setFocus()
    turn(bar.speed)
    assert wishes == [("speed_changed", 0.75)]


def turn(box):
    """One notch towards the user."""
    at = QPointF(box.rect().center())
    event = QWheelEvent(
        at,
        QPointF(box.mapToGlobal(at.toPoint())),
        QPoint(),
        QPoint(0, -120),
        Qt.MouseButton.NoButton,
        Qt.KeyboardModifier.NoModifier,
        Qt.ScrollPhase.NoScrollPhase,
        False,
    )
    QApplication.sendEvent(box, event)


def test_what_is_wrong_with_the_sound_is_a_word_with_a_reason(bar):
    def shown():
        return [label for label in bar.findChildren(QLabel) if label.isVisible()]

    assert shown() == []
    reason = "PortAudio is missing (on Debian: libportaudio2): playing silently"
    narrow = bar.sizeHint().width()
    bar.set_sound(reason)
    assert bar.sound == reason
    assert [label.toolTip() for label in shown()] == [reason, reason]
    assert bar.sizeHint().width() < narrow + 80  # the sentence needs the room
    bar.set_sound("")
    assert shown() == []


def test_everything_is_named(bar):
    for control in (bar.voice, bar.speed):
        assert control.accessibleName()
        assert control.toolTip()
