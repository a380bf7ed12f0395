"""The preview: what the mouse and keys wish for, and what is to be seen."""

import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, QSize, Qt
from PySide6.QtGui import QColor, QImage, QMouseEvent, QWheelEvent
from PySide6.QtWidgets import QLabel, QPushButton, QToolButton
from pytestqt.qtbot import QtBot

from widgets.preview.face_view import FaceView
from widgets.preview.name_tag import Tag

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


def test_double_click_and_home_want_the_reset(qtbot, view):
    reset = collect(view.reset_wanted)
    qtbot.mouseDClick(view, Qt.MouseButton.LeftButton, pos=CENTRE)
    qtbot.keyClick(view, Qt.Key.Key_Home)
    assert len(reset) == 2


def test_a_hand_on_the_face_is_told_while_it_holds(qtbot, view):
    held = collect(view.held)
    drag(qtbot, view, Qt.MouseButton.LeftButton)
    assert held == [(True,), (False,)]


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


# ── tags ──


def test_each_face_has_its_tag_in_its_own_part_of_the_picture(view):
    view.set_tags([Tag("Toon"), Tag("Ada"), Tag("A rig with a very long name indeed")])
    for number, tag in enumerate(view.name_tags):
        assert 100 * number <= tag.x()
        assert tag.geometry().right() < 100 * (number + 1)
        assert tag.geometry().bottom() < view.height()
        assert tag.isVisible()
    assert view.name_tags[0].name.text() == "Toon"
    assert view.name_tags[2].name.text().endswith("…")


def test_a_name_with_odd_letters_is_seen_whole(view):
    def seen(name):
        view.set_tags([Tag(name)])
        button = view.name_tags[0].name
        button.resize(90, button.height())
        return button.grab().toImage()

    view.setStyleSheet("QToolButton{padding:4px;border:1px solid transparent}")  # as in the window
    assert seen("a__b") != seen("a\u2007\u2007b"), "the lines under the letters are not cut off"
    assert seen("a & b") != seen("a b")
    assert view.name_tags[0].name.text() == "a b"
    view.set_tags([Tag("a & b")])
    assert view.name_tags[0].name.text() == "a && b"


@pytest.mark.parametrize("size", [(280, 240), (160, 160), (700, 300), (200, 640)])
def test_tags_stay_in_the_picture_and_apart_at_any_size(qtbot, view, size):
    view.set_tags([Tag("Toon"), Tag("Woman"), Tag("Crab", "It cannot make W.", mute=True)])
    view.resize(*size)
    boxes = [tag.geometry() for tag in view.name_tags]
    assert all(view.rect().contains(box) for box in boxes)
    assert not any(a.intersects(b) for i, a in enumerate(boxes) for b in boxes[:i])


def test_name_scissors_and_cross_tell_which_face(qtbot, view):
    view.resize(500, 300)
    face, cut, away = collect(view.face_wanted), collect(view.cutaway_wanted), collect(view.away_wanted)
    view.set_tags([Tag("Toon"), Tag("Ada", cut=True)])
    for button in (view.name_tags[1].name, view.name_tags[1].cut, view.name_tags[1].away):
        qtbot.mouseClick(button, Qt.MouseButton.LeftButton)
    assert (face, cut, away) == ([(1,)], [(1, False)], [(1,)])


def test_a_face_alone_cannot_be_sent_away(view):
    view.set_tags([Tag("Toon")])
    assert view.name_tags[0].away.isHidden()
    view.set_tags([Tag("Toon"), Tag("Ada")])
    assert not view.name_tags[0].away.isHidden()


def test_c_cuts_all_heads_open_and_closes_them_again(qtbot, view):
    cut = collect(view.cutaway_wanted)
    view.set_tags([Tag("Toon", cut=True), Tag("Ada")])
    qtbot.keyClick(view, Qt.Key.Key_C)
    view.set_tags([Tag("Toon", cut=True), Tag("Ada", cut=True)])
    qtbot.keyClick(view, Qt.Key.Key_C)
    assert cut == [(0, True), (1, True), (0, False), (1, False)]


def test_showing_tags_is_not_a_wish(view):
    cut = collect(view.cutaway_wanted)
    view.set_tags([Tag("Toon", cut=True)])
    assert view.name_tags[0].cut.isChecked()
    assert cut == []


def test_a_face_that_can_say_nothing_of_this_says_so_over_itself(view):
    view.set_frame(halves(300, 200, "#000000", "#000000"))
    view.set_tags([Tag("Toon"), Tag("Crab", "Not available on this face: open, W", mute=True)])
    shown = view.grab().toImage()
    bright = [x for x in range(300) for y in range(30, 160) if shown.pixelColor(x, y).red() > 120]
    assert bright
    assert min(bright) >= 150, "over the crab alone"
    assert "open, W" in view.name_tags[1].name.toolTip()
    assert "open, W" in view.name_tags[1].name.accessibleDescription()


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
    view.set_tags([Tag("Toon"), Tag("Ada")])
    for control in (view, *view.findChildren(QToolButton), view.findChild(QPushButton), view.findChild(QLabel)):
        assert control.accessibleName()
