"""The playing controls: wishes go up, values come down."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QToolButton

from widgets.transport import Transport

# the offscreen platform has no window manager to talk to
pytestmark = pytest.mark.qt_log_ignore("This plugin does not support")


@pytest.fixture
def transport(qtbot):
    transport = Transport()
    qtbot.addWidget(transport)
    with qtbot.waitExposed(transport):
        transport.show()
    return transport


@pytest.fixture
def wishes(transport):
    seen = []
    for name in ("play_toggled", "stopped", "to_start", "loop_toggled"):
        getattr(transport, name).connect(lambda *values, name=name: seen.append((name, *values)))
    return seen


def click(qtbot, button):
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)


def test_each_button_says_its_wish_once(qtbot, transport, wishes):
    for button in (transport.start_button, transport.play_button, transport.stop_button, transport.loop_button):
        click(qtbot, button)
    click(qtbot, transport.loop_button)
    assert wishes == [("to_start",), ("play_toggled",), ("stopped",), ("loop_toggled", True), ("loop_toggled", False)]


def test_the_keyboard_presses_them_too(qtbot, transport, wishes):
    for button in transport.findChildren(QToolButton):
        assert button.focusPolicy() == Qt.FocusPolicy.StrongFocus
    qtbot.keyClick(transport.play_button, Qt.Key.Key_Space)
    assert wishes == [("play_toggled",)]


def test_play_becomes_pause_only_when_told(qtbot, transport):
    before = transport.play_button.icon().cacheKey()
    click(qtbot, transport.play_button)
    assert transport.play_button.accessibleName() == "Play"
    transport.set_playing(True)
    assert transport.play_button.accessibleName() == "Pause"
    assert transport.play_button.icon().cacheKey() != before
    transport.set_playing(False)
    assert transport.play_button.accessibleName() == "Play"


def test_values_from_outside_emit_nothing(transport, wishes):
    transport.set_playing(True)
    transport.set_time(3.42, 10)
    transport.set_loop(True)
    assert wishes == []
    assert transport.loop_button.isChecked()


def test_the_time_does_not_dance(transport):
    transport.set_time(3.42, 10)
    assert transport.time.text() == "3.42 / 10.00 s"
    width = transport.time.sizeHint().width(), transport.time.minimumWidth()
    transport.set_time(3.11, 10)
    assert (transport.time.sizeHint().width(), transport.time.minimumWidth()) == width
    assert transport.time.sizeHint().width() <= transport.time.minimumWidth()


def test_everything_is_named(transport):
    for control in (*transport.findChildren(QToolButton), transport.time):
        assert control.accessibleName()
        assert control.toolTip()
