"""Phones edited in the overlay's black rows, with a real mouse and keyboard.

Phoneme  sil | ah | f | ah …     drag |, double-click a name, right-click for more
Word           “appy”
"""

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest

from tests.helpers import mouse
from tests.helpers.stages import sentence
from widgets.overlay.phone_hand import PhoneHand
from widgets.overlay.stage_footer import ROW


@pytest.fixture
def overlay(qtbot):
    overlay = PhoneHand()
    overlay.resize(1200, 300)
    qtbot.addWidget(overlay)
    overlay.set_stages(sentence())
    overlay.set_phone_choices(["ae", "ah", "f", "sil"])
    with qtbot.waitExposed(overlay):
        overlay.show()
    return overlay


def edge(overlay, boundary, row=1):
    x = overlay.axis.px(float(overlay._stages.schedule.times[boundary]))
    return QPointF(round(x), overlay.rows_height + row * ROW + ROW // 2)


def middle(overlay, phone, row=1):
    a, b = overlay._stages.schedule.times[phone : phone + 2]
    return QPoint(round(overlay.axis.px(float(a + b) / 2)), overlay.rows_height + row * ROW + ROW // 2)


def heard(signal):
    said = []
    signal.connect(lambda *values: said.append(values))
    return said


@pytest.mark.parametrize("row", [1, 2])
def test_a_boundary_is_dragged_and_dropped(overlay, row):
    dragged, dropped, scrubbed = heard(overlay.edge_dragged), heard(overlay.edge_dropped), heard(overlay.scrubbed)
    start = edge(overlay, 2, row)
    mouse.drag(overlay, start, start + QPointF(30, 0), steps=4)
    assert [boundary for boundary, _ in dragged] == [2] * 4
    assert dropped == [(2, pytest.approx(overlay.axis.time(start.x() + 30)))]
    assert scrubbed == []


def test_escape_gives_a_drag_up(overlay):
    dropped, let_be = heard(overlay.edge_dropped), heard(overlay.edge_let_be)
    start = edge(overlay, 2)
    mouse.press(overlay, start)
    mouse.move(overlay, start + QPointF(20, 0))
    QTest.keyClick(overlay, Qt.Key.Key_Escape)
    mouse.release(overlay, start + QPointF(20, 0))
    assert let_be == [()]
    assert dropped == []


def test_the_mouse_shows_where_a_boundary_can_be_taken(overlay):
    QTest.mouseMove(overlay, edge(overlay, 3).toPoint())
    mouse.send(overlay, mouse.QEvent.Type.MouseMove, edge(overlay, 3), mouse.No, mouse.No)
    assert overlay.cursor().shape() == Qt.CursorShape.SplitHCursor
    mouse.send(overlay, mouse.QEvent.Type.MouseMove, QPointF(middle(overlay, 2)), mouse.No, mouse.No)
    assert overlay.cursor().shape() == Qt.CursorShape.ArrowCursor


def test_a_double_click_renames_and_only_known_names_count(overlay):
    renamed = heard(overlay.phone_renamed)
    QTest.mouseDClick(overlay, Qt.MouseButton.LeftButton, pos=middle(overlay, 2))
    assert overlay.field.isVisible()
    assert overlay.field.text() == overlay._stages.schedule.phones[2]
    QTest.keyClicks(overlay.field, "qq")
    QTest.keyClick(overlay.field, Qt.Key.Key_Return)
    assert renamed == []
    QTest.mouseDClick(overlay, Qt.MouseButton.LeftButton, pos=middle(overlay, 2))
    QTest.keyClicks(overlay.field, "ae")
    QTest.keyClick(overlay.field, Qt.Key.Key_Return)
    assert renamed == [(2, "ae")]
    assert not overlay.field.isVisible()


def test_f2_renames_the_phone_at_the_playhead(overlay):
    renamed = heard(overlay.phone_renamed)
    overlay.set_playhead(float(overlay._stages.schedule.times[3]) + 0.01)
    QTest.keyClick(overlay, Qt.Key.Key_F2)
    QTest.keyClicks(overlay.field, "f")
    QTest.keyClick(overlay.field, Qt.Key.Key_Return)
    assert renamed == [(3, "f")]


def test_escape_closes_the_field_without_a_change(overlay):
    renamed = heard(overlay.phone_renamed)
    QTest.mouseDClick(overlay, Qt.MouseButton.LeftButton, pos=middle(overlay, 2))
    QTest.keyClicks(overlay.field, "ae")
    QTest.keyClick(overlay.field, Qt.Key.Key_Escape)
    assert not overlay.field.isVisible()
    assert renamed == []


def test_the_menu_inserts_and_removes(overlay, qtbot):
    inserted, removed = heard(overlay.phone_inserted), heard(overlay.phone_removed)
    menu = overlay.menu_at(middle(overlay, 2))
    menu.actions()[2].trigger()
    QTest.keyClicks(overlay.field, "f")
    QTest.keyClick(overlay.field, Qt.Key.Key_Return)
    assert inserted == [(2, "f", True)]
    menu.actions()[3].trigger()
    assert removed == [(2,)]
    assert overlay.menu_at(QPoint(300, 20)) is None


def test_nothing_is_edited_without_names(overlay):
    overlay.set_phone_choices([])
    assert overlay.edge_at(edge(overlay, 2).toPoint()) is None
    QTest.mouseDClick(overlay, Qt.MouseButton.LeftButton, pos=middle(overlay, 2))
    assert not overlay.field.isVisible()


def test_words_get_a_row_of_their_own_where_there_are_any(overlay, qtbot):
    assert overlay.footer_rows == 3
    overlay.set_words([("appy", 0.1, 0.5)])
    assert overlay.footer_rows == 4
    scrubbed = heard(overlay.scrubbed)
    qtbot.mouseClick(overlay, Qt.MouseButton.LeftButton, pos=middle(overlay, 2, row=3))
    assert scrubbed == [(pytest.approx(float(overlay._stages.schedule.times[2])),)]
    overlay.set_words([])
    assert overlay.footer_rows == 3
