"""Real mouse events: QTest.mouseMove takes no modifiers and no buttons, so we send them ourselves."""

from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QApplication, QWidget

Left, No = Qt.MouseButton.LeftButton, Qt.MouseButton.NoButton


def send(widget: QWidget, kind: QEvent.Type, at: QPointF, button: Qt.MouseButton, held: Qt.MouseButton) -> None:
    event = QMouseEvent(kind, at, widget.mapToGlobal(at), button, held, Qt.KeyboardModifier.NoModifier)
    QApplication.sendEvent(widget, event)


def press(widget: QWidget, at: QPointF) -> None:
    send(widget, QEvent.Type.MouseButtonPress, at, Left, Left)


def move(widget: QWidget, at: QPointF) -> None:
    send(widget, QEvent.Type.MouseMove, at, No, Left)


def release(widget: QWidget, at: QPointF) -> None:
    send(widget, QEvent.Type.MouseButtonRelease, at, Left, No)


def drag(widget: QWidget, start: QPointF, end: QPointF, steps: int = 6) -> None:
    """Press, move in steps, release."""
    press(widget, start)
    for i in range(1, steps + 1):
        move(widget, start + (end - start) * (i / steps))
    release(widget, end)
