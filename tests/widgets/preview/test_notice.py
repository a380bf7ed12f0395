"""The notice over the picture: a sentence, a way out of it, and never wider or higher than the picture."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel

from widgets.preview.face_view import FaceView

LONG = "head.glb: " + "its third target has another number of vertices than its mesh; " * 4 + "export it again."


@pytest.fixture
def view(qtbot):
    view = FaceView()
    qtbot.addWidget(view)
    view.resize(400, 300)
    with qtbot.waitExposed(view):
        view.show()
    return view


@pytest.mark.parametrize("width", [160, 300, 900])
def test_the_whole_sentence_has_room_in_any_picture(view, width):
    view.resize(width, 700)
    view.notice.tell("head.glb: 40 % read", "Cancel")
    view.notice.warn(LONG, "Mend")
    notice = view.notice
    assert view.rect().contains(notice.geometry())
    words = notice.findChildren(QLabel)[-1]
    notice.layout().activate()
    assert words.text() == LONG
    assert words.height() >= words.heightForWidth(words.width())


def test_a_warning_is_put_away_by_its_cross_or_escape(qtbot, view):
    for put_away in (
        lambda: QTest.mouseClick(view.notice.cross, Qt.MouseButton.LeftButton),
        lambda: QTest.keyClick(view, Qt.Key.Key_Escape),
    ):
        view.notice.warn(LONG)
        assert view.notice.text == LONG
        assert view.notice.button.isHidden()
        with qtbot.waitSignal(view.notice.dismissed):
            put_away()
        assert view.notice.text == ""


def test_what_goes_on_is_ended_by_its_button_or_escape_and_has_no_cross(qtbot, view):
    for end in (
        lambda: QTest.mouseClick(view.notice.button, Qt.MouseButton.LeftButton),
        lambda: QTest.keyClick(view, Qt.Key.Key_Escape),
    ):
        view.notice.tell("head.glb: 40 % read", "Cancel")
        assert view.notice.cross.isHidden()
        with qtbot.waitSignal(view.notice.wanted):
            end()


def test_names_are_no_markup(view):
    view.notice.warn("<b>head</b>.glb: it is cut off.")
    assert view.notice.text == "<b>head</b>.glb: it is cut off."
    assert view.notice.findChildren(QLabel)[-1].textFormat() == Qt.TextFormat.PlainText
