"""The preview: what the mouse and keys wish for, and what is to be seen."""

import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, QSize, Qt
from PySide6.QtGui import QColor, QImage, QMouseEvent, QWheelEvent
from PySide6.QtWidgets import QLabel, QPushButton, QToolButton
from pytestqt.qtbot import QtBot

from widgets.preview.face_view import FaceView

CENTRE = QPoint(150, 100)


@pytest.fixture
def view(qtbot: QtBot) -> FaceView:
    view = FaceView()
    view.resize(300, 200)
    qtbot.addWidget(view)
    with qtbot.waitExposed(view):
        view.show()
    return view


def collect(signal):
    seen = []
    signal.connect(lambda *values: seen.append(values))
    return seen


def halves(width, height, left="#cc2200", right="#0022cc"):
    image = QImage(width, height, QImage.Format.Format_RGB32)
    image.fill(QColor(left))
    for x in range(width // 2, width):
        for y in range(height):
            image.setPixelColor(x, y, QColor(right))
    return image


def button(view, name):
    return next(found for found in view.findChildren(QToolButton) if found.accessibleName() == name)


def drag(qtbot, view, which, modifier=Qt.KeyboardModifier.NoModifier):
    qtbot.mousePress(view, which, modifier, CENTRE)
    for step in (QPoint(160, 95), QPoint(175, 110)):
        qtbot.mouseMove(view, step)
    qtbot.mouseRelease(view, which, modifier, QPoint(175, 110))
    qtbot.mouseMove(view, QPoint(20, 20))


def test_left_drag_orbits_by_the_pixels_moved(qtbot, view):
    orbited, panned = collect(view.orbited), collect(view.panned)
    drag(qtbot, view, Qt.MouseButton.LeftButton)
    assert orbited == [(10.0, -5.0), (15.0, 15.0)]
    assert panned == []


def test_middle_drag_pans(qtbot, view):
    orbited, panned = collect(view.orbited), collect(view.panned)
    drag(qtbot, view, Qt.MouseButton.MiddleButton)
    assert panned == [(10.0, -5.0), (15.0, 15.0)]
    assert orbited == []


def test_shift_makes_the_left_drag_pan(qapp, qtbot, view):
    orbited, panned = collect(view.orbited), collect(view.panned)
    qtbot.mousePress(view, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.ShiftModifier, CENTRE)
    place = QPointF(157, 104)
    left, shift = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.ShiftModifier
    qapp.sendEvent(view, QMouseEvent(QEvent.Type.MouseMove, place, view.mapToGlobal(place), left, left, shift))
    qtbot.mouseRelease(view, Qt.MouseButton.LeftButton, shift, QPoint(157, 104))
    assert panned == [(7.0, 4.0)]
    assert orbited == []


def test_a_move_without_a_button_wishes_nothing(qtbot, view):
    orbited, panned = collect(view.orbited), collect(view.panned)
    qtbot.mouseMove(view, CENTRE)
    qtbot.mouseMove(view, QPoint(10, 10))
    assert orbited == panned == []


@pytest.mark.parametrize(("delta", "steps"), [(120, 1.0), (-240, -2.0), (15, 0.125)])
def test_the_wheel_zooms_in_steps(qapp, view, delta, steps):
    zoomed = collect(view.zoomed)
    place = QPointF(CENTRE)
    event = QWheelEvent(
        place,
        view.mapToGlobal(place),
        QPoint(),
        QPoint(0, delta),
        Qt.MouseButton.NoButton,
        Qt.KeyboardModifier.NoModifier,
        Qt.ScrollPhase.NoScrollPhase,
        False,
    )
    qapp.sendEvent(view, event)
    assert zoomed == [(steps,)]


def test_double_click_home_and_button_want_the_reset(qtbot, view):
    reset = collect(view.reset_wanted)
    qtbot.mouseDClick(view, Qt.MouseButton.LeftButton, pos=CENTRE)
    qtbot.keyClick(view, Qt.Key.Key_Home)
    qtbot.mouseClick(button(view, "Reset the view"), Qt.MouseButton.LeftButton)
    assert len(reset) == 3


def test_button_and_key_want_the_cut_away(qtbot, view):
    wanted = collect(view.cutaway_wanted)
    qtbot.mouseClick(button(view, "Cut-away"), Qt.MouseButton.LeftButton)
    qtbot.keyClick(view, Qt.Key.Key_C)
    assert wanted == [(True,), (False,)]


def test_showing_the_cut_away_is_not_a_wish(view):
    wanted = collect(view.cutaway_wanted)
    view.set_cutaway(True)
    assert button(view, "Cut-away").isChecked()
    assert wanted == []


def test_keys_can_what_the_mouse_can(qtbot, view):
    orbited, panned, zoomed = collect(view.orbited), collect(view.panned), collect(view.zoomed)
    qtbot.keyClick(view, Qt.Key.Key_Left)
    qtbot.keyClick(view, Qt.Key.Key_Down)
    qtbot.keyClick(view, Qt.Key.Key_Right, Qt.KeyboardModifier.ShiftModifier)
    qtbot.keyClick(view, Qt.Key.Key_Plus)
    qtbot.keyClick(view, Qt.Key.Key_Minus)
    assert orbited == [(-20.0, 0.0), (0.0, 20.0)]
    assert panned == [(20.0, 0.0)]
    assert zoomed == [(1.0,), (-1.0,)]


def test_it_tells_its_size_in_device_pixels(qtbot, view):
    ratio = view.devicePixelRatioF()
    sizes = collect(view.resized)
    view.resize(320, 240)
    qtbot.waitUntil(lambda: bool(sizes))
    assert sizes == [(round(320 * ratio), round(240 * ratio))]
    assert view.frame_size() == QSize(*sizes[0])


def test_a_frame_of_the_right_size_is_shown_pixel_by_pixel(view):
    frame = halves(view.frame_size().width(), view.frame_size().height())
    view.set_frame(frame)
    shown = view.grab().toImage()
    middle = frame.width() // 2
    assert shown.pixelColor(middle - 1, 100) == QColor("#cc2200")
    assert shown.pixelColor(middle, 100) == QColor("#0022cc")


def test_a_frame_of_another_shape_keeps_its_proportions(view):
    frame = QImage(400, 400, QImage.Format.Format_RGB32)
    frame.fill(QColor("#000000"))
    for x in range(100, 300):
        for y in range(150, 250):
            frame.setPixelColor(x, y, QColor("#ffffff"))
    view.set_frame(frame)
    shown = view.grab().toImage()
    ratio = shown.devicePixelRatio()
    row = [shown.pixelColor(x, round(100 * ratio)).red() > 127 for x in range(shown.width())]
    column = [shown.pixelColor(round(150 * ratio), y).red() > 127 for y in range(shown.height())]
    assert sum(row) == pytest.approx(2 * sum(column), abs=2)
    assert sum(row) == pytest.approx(shown.width() / 2, abs=2)


def test_the_caption_is_painted_and_can_be_taken_away(view):
    view.set_frame(halves(300, 200, "#000000", "#000000"))
    plain = view.grab().toImage()
    view.set_caption("Toon · 512 × 512 · 58 fps")
    assert view.grab().toImage() != plain
    view.set_caption("")
    assert view.grab().toImage() == plain


def test_a_message_says_why_and_offers_to_try_again(qtbot, view):
    view.set_message("The face cannot be drawn.", retry=True)
    label, retry = view.findChild(QLabel), view.findChild(QPushButton)
    assert label.isVisible()
    assert label.text() == "The face cannot be drawn."
    assert label.geometry().intersects(view.rect())
    with qtbot.waitSignal(view.retry_wanted):
        qtbot.mouseClick(retry, Qt.MouseButton.LeftButton)


def test_without_retry_there_is_no_button_and_a_frame_clears_the_message(view):
    view.set_message("No face is loaded.")
    label, retry = view.findChild(QLabel), view.findChild(QPushButton)
    assert label.isVisible()
    assert not retry.isVisible()
    view.set_frame(halves(300, 200))
    assert not label.isVisible()


def test_every_control_has_a_name_for_screen_readers(view):
    for control in (view, *view.findChildren(QToolButton), view.findChild(QPushButton), view.findChild(QLabel)):
        assert control.accessibleName()
