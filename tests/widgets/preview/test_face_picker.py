"""The picker: portraits to click, or to reach with the arrow keys."""

import pytest
from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QColor, QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QMenu

from widgets.preview.face_picker import Choice, FacePicker

CHOICES = [Choice(name, name.title(), f"somewhere/{name}") for name in ("toon", "ada", "crab", "man", "woman", "mine")]


@pytest.fixture
def picker(qtbot):
    picker = FacePicker()
    qtbot.addWidget(picker)
    picker.open("Choose a face", CHOICES, "ada", QRect(100, 100, 80, 20))
    qtbot.waitUntil(picker.isVisible)
    return picker


def test_a_click_picks_and_closes(qtbot, picker):
    item = picker.faces.item(3)
    with qtbot.waitSignal(picker.picked) as caught:
        at = picker.faces.visualItemRect(item).center()
        QTest.mouseClick(picker.faces.viewport(), Qt.MouseButton.LeftButton, pos=at)
    assert caught.args == ["man"]
    assert not picker.isVisible()


def test_the_current_face_is_chosen_and_arrows_and_enter_reach_another(qtbot, picker):
    assert picker.faces.currentItem().text() == "Ada"
    QTest.keyClick(picker.faces, Qt.Key.Key_Right)
    with qtbot.waitSignal(picker.picked) as caught:
        QTest.keyClick(picker.faces, Qt.Key.Key_Return)
    assert caught.args == ["crab"]


def test_escape_picks_nothing(qtbot, picker):
    with qtbot.assertNotEmitted(picker.picked):
        QTest.keyClick(picker.faces, Qt.Key.Key_Escape)
    assert not picker.isVisible()


def test_buttons_ask_for_a_file_or_a_folder(qtbot, picker):
    for button, wanted in ((picker.file, picker.file_wanted), (picker.folder, picker.folder_wanted)):
        picker.show()
        with qtbot.waitSignal(wanted):
            QTest.mouseClick(button, Qt.MouseButton.LeftButton)
        assert not picker.isVisible()


def test_a_portrait_takes_the_place_of_the_letter_and_stays_when_the_picker_opens_again(picker):
    red = QImage(192, 192, QImage.Format.Format_RGB32)
    red.fill(QColor("#d01010"))
    picker.set_picture("crab", red)
    picker.set_picture("unknown", red)

    def middle(name):
        item = next(picker.faces.item(i) for i in range(picker.faces.count()) if picker.faces.item(i).text() == name)
        icon = item.icon().pixmap(96, 96).toImage()
        return icon.pixelColor(icon.width() // 2, icon.height() // 2)

    assert middle("Crab") == QColor("#d01010")
    assert middle("Man") != QColor("#d01010")
    picker.open("Add a face", CHOICES[2:], "", QRect(0, 0, 10, 10))
    assert middle("Crab") == QColor("#d01010")
    assert picker.faces.currentRow() == 0
    assert picker.title.text() == "Add a face"


def test_it_stays_on_the_screen(picker):
    room = picker.screen().availableGeometry()
    for corner in (room.topLeft(), room.bottomRight()):
        picker.open("Choose a face", CHOICES, "toon", QRect(corner.x() - 5, corner.y() - 5, 10, 10))
        assert room.contains(picker.geometry())


def test_screen_readers_hear_name_and_place(picker):
    assert picker.accessibleName()
    assert picker.faces.accessibleName()
    spoken = picker.faces.item(1).data(Qt.ItemDataRole.AccessibleTextRole)
    assert spoken == "Ada. somewhere/ada"


def test_del_or_the_menu_takes_a_users_face_off_the_list_and_none_of_ours(qtbot, picker):
    picker.open("Choose a face", [CHOICES[0], Choice("a.glb", "A", listed=True)], "toon", QRect(0, 0, 10, 10))
    with qtbot.assertNotEmitted(picker.forgotten):
        QTest.keyClick(picker.faces, Qt.Key.Key_Delete)
        picker.faces.customContextMenuRequested.emit(picker.faces.visualItemRect(picker.faces.item(0)).center())
    assert picker.findChildren(QMenu) == []
    QTest.keyClick(picker.faces, Qt.Key.Key_Right)
    with qtbot.waitSignal(picker.forgotten) as caught:
        QTest.keyClick(picker.faces, Qt.Key.Key_Delete)
    assert caught.args == ["a.glb"]
    assert picker.keys == ["toon"]
    assert picker.isVisible()

    picker.open("Choose a face", [CHOICES[0], Choice("b.glb", "B", listed=True)], "toon", QRect(0, 0, 10, 10))
    picker.faces.customContextMenuRequested.emit(picker.faces.visualItemRect(picker.faces.item(1)).center())
    (menu,) = picker.findChildren(QMenu)
    with qtbot.waitSignal(picker.forgotten) as caught:
        QTest.keyClick(menu, Qt.Key.Key_Down)
        QTest.keyClick(menu, Qt.Key.Key_Return)
    assert caught.args == ["b.glb"]
    assert picker.keys == ["toon"]
