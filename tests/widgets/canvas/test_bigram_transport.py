"""Playing the open bigram alone: a button and a length, both within reach of the keyboard."""

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QApplication

from widgets.canvas.bigram_transport import BigramTransport


@pytest.fixture
def transport(qtbot):
    widget = BigramTransport()
    qtbot.addWidget(widget)
    widget.show()
    return widget


def test_the_button_wishes_and_shows_what_it_is_told(transport, qtbot):
    with qtbot.waitSignal(transport.play_toggled):
        qtbot.mouseClick(transport.button, Qt.MouseButton.LeftButton)
    before = transport.button.icon().cacheKey()
    transport.set_playing(True)
    assert transport.button.icon().cacheKey() != before
    assert transport.button.accessibleName() == "Stop the bigram (Space)"


def test_a_typed_length_is_wished_once_and_one_from_outside_is_not(transport, qtbot):
    said = []
    transport.length_changed.connect(said.append)
    transport.set_length(0.4)
    assert not said
    transport.length.setFocus()
    transport.length.selectAll()
    qtbot.keyClicks(transport.length, "1.25")
    qtbot.keyClick(transport.length, Qt.Key.Key_Return)
    assert said == [1.25]


def test_tab_reaches_both_and_the_wheel_changes_nothing_in_passing(transport):
    for control in (transport.button, transport.length):
        assert control.focusPolicy() & Qt.FocusPolicy.TabFocus
        assert control.accessibleName()
    transport.set_length(0.4)
    transport.button.setFocus()
    at = QPointF(transport.length.rect().center())
    event = QWheelEvent(
        at, QPointF(transport.length.mapToGlobal(at)), QPoint(), QPoint(0, 120), Qt.MouseButton.NoButton,
        Qt.KeyboardModifier.NoModifier, Qt.ScrollPhase.NoScrollPhase, False,
    )  # fmt: skip
    QApplication.sendEvent(transport.length, event)
    assert transport.length.value() == 0.4
