"""Everything can be reached by keyboard and is named for those who do not see it."""

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemView,
    QAbstractSlider,
    QAbstractSpinBox,
    QApplication,
    QComboBox,
    QDockWidget,
    QHeaderView,
    QLineEdit,
    QScrollBar,
    QTabBar,
    QWidget,
)

from app.editor import Editor

CONTROLS = (QAbstractButton, QLineEdit, QComboBox, QAbstractSpinBox, QAbstractItemView, QAbstractSlider)
#: What Qt puts into these is Qt's own to name.
OWNERS = (QAbstractSpinBox, QComboBox, QLineEdit, QTabBar)


def controls(editor: Editor) -> list[QWidget]:
    """All that a hand can use, of every dock, the palette and the dialog of shortcuts."""
    editor.wiring.keys.open()
    found = []
    for widget in editor.window.findChildren(QWidget):
        parents = [widget.parentWidget()]
        while parents[-1] is not None:
            parents.append(parents[-1].parentWidget())
        inner = isinstance(widget, (QHeaderView, QScrollBar)) or any(isinstance(p, OWNERS) for p in parents[:2])
        if isinstance(widget, CONTROLS) and not inner and not widget.objectName().startswith("qt_"):
            found.append(widget)
    editor.wiring.keys._editor.close()
    return found


def test_every_control_has_a_name_a_description_and_its_icon_a_text(editor: Editor) -> None:
    found = controls(editor)
    assert len(found) > 60
    nameless, undescribed, icons = [], [], []
    for widget in found:
        text = widget.text() if isinstance(widget, QAbstractButton) else ""
        where = f"{type(widget).__name__} {widget.accessibleName() or text!r} in {type(widget.parentWidget()).__name__}"
        if not (widget.accessibleName() or text):
            nameless.append(where)
        if not (widget.accessibleDescription() or widget.toolTip()):
            undescribed.append(where)
        if isinstance(widget, QAbstractButton) and not text:
            icons.append(where)
    assert (nameless, undescribed, icons) == ([], [], [])


def test_f6_goes_round_every_part_and_back(editor: Editor) -> None:
    w = editor.window
    w.canvas.setFocus()
    ring = w.focus_ring
    docks = {dock for dock in w.findChildren(QDockWidget) if not dock.isHidden()}
    docks.discard(w.weights_dock)  # figures only, nothing to do there
    seen: list[QWidget | None] = []
    for _ in range(len(docks) + 2):
        QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_F6)
        seen.append(ring._part_of(QApplication.focusWidget()))
    assert set(seen) >= docks
    assert seen[-1] is w.centralWidget()
    assert w.canvas.hasFocus()  # where it was before
    for expected in [*reversed(seen[:-1]), seen[-1]]:
        QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_F6, Qt.KeyboardModifier.ShiftModifier)
        assert ring._part_of(QApplication.focusWidget()) is expected
    w.picker.search.setFocus()
    assert w.bigrams_dock.property("here") is True
    w.canvas.setFocus()
    assert w.bigrams_dock.property("here") is False
