"""The bar over the face: each button is one wish, and fits into a narrow dock."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QToolButton

from widgets.preview.face_view import FaceView
from widgets.preview.preview_panel import PreviewPanel


@pytest.fixture
def panel(qtbot):
    panel = PreviewPanel(FaceView())
    panel.resize(280, 300)
    qtbot.addWidget(panel)
    with qtbot.waitExposed(panel):
        panel.show()
    return panel


def test_buttons_tell_their_wishes(qtbot, panel):
    for button, signal in ((panel.add, panel.add_wanted), (panel.reset, panel.view.reset_wanted)):
        with qtbot.waitSignal(signal):
            qtbot.mouseClick(button, Qt.MouseButton.LeftButton)


def test_in_a_narrow_dock_the_caption_gives_way_and_nothing_overlaps(panel):
    panel.set_caption("1600 × 1600 · 1000 ms and more than fits")
    panel.resize(160, 200)
    buttons = panel.findChildren(QToolButton)
    assert len(buttons) >= 4
    boxes = [panel.caption.geometry(), *(button.geometry() for button in buttons if button.isVisible())]
    assert not any(a.intersects(b) for i, a in enumerate(boxes) for b in boxes[:i])
    assert all(panel.rect().contains(box) for box in boxes)
    assert panel.view.geometry().top() >= panel.caption.geometry().bottom()


def test_the_turntable_button_and_its_action_are_one(qtbot, panel):
    action = QAction("Turntable", panel, checkable=True)
    panel.set_turntable(action)
    qtbot.mouseClick(panel.turntable, Qt.MouseButton.LeftButton)
    assert action.isChecked()
    action.setChecked(False)
    assert not panel.turntable.isChecked()


def test_the_menu_of_looks_has_each_group_under_its_title(panel):
    night, left = QAction("Night", panel), QAction("Left", panel)
    panel.set_looks([("Background", [night]), ("Light", [left])])
    texts = [action.text() for action in panel.look.menu().actions() if not action.isSeparator()]
    assert texts == ["Background", "Night", "Light", "Left"]


def test_when_three_faces_are_there_no_other_can_be_added(panel):
    panel.set_full(True)
    assert not panel.add.isEnabled()
    panel.set_full(False)
    assert panel.add.isEnabled()
    assert all(button.accessibleName() for button in (panel.add, panel.look, panel.turntable, panel.reset))
