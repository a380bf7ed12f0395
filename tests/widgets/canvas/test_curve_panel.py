"""Figures for the hand: the bar of values under the canvas and the table of keys beside it, by real keys."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QApplication, QLineEdit

from core_pipeline.curves import Curve
from tests.helpers.curve_hand import CTRL, FV, LEFT, OPEN, SHIFT, open_canvas
from widgets.canvas.curve_panel import CurvePanel
from widgets.canvas.key_table import TIME, WEIGHT

Key = Qt.Key
ROLE = Qt.ItemDataRole.AccessibleTextRole


@pytest.fixture
def canvas(qapp):
    return open_canvas()


@pytest.fixture
def panel(canvas, qtbot):
    widget = CurvePanel(canvas)
    qtbot.addWidget(widget)
    widget.resize(1000, 520)
    widget.show()
    widget.activateWindow()
    qtbot.waitExposed(widget)
    return widget


@pytest.fixture
def table(panel, qtbot):
    panel.show_table(True)
    panel.table.setFocus()
    qtbot.waitUntil(panel.table.hasFocus)
    return panel.table


def enter(qtbot, field, text):
    field.setFocus()
    field.selectAll()
    qtbot.keyClicks(field, text)
    qtbot.keyClick(field, Key.Key_Return)


def enter_cell(qtbot, table, row, column, text):
    """Types into a cell as a user does: the first character opens the editor."""
    index, flag = table.model().index(row, column), table.selectionModel().SelectionFlag
    keep = row in table.picked
    table.selectionModel().setCurrentIndex(index, flag.NoUpdate if keep else flag.ClearAndSelect | flag.Rows)
    qtbot.keyClicks(table, text[0])
    editor = QApplication.focusWidget()
    assert isinstance(editor, QLineEdit)
    qtbot.keyClicks(editor, text[1:])
    qtbot.keyClick(editor, Key.Key_Return)
    qtbot.waitUntil(table.hasFocus)


# The bar


def test_the_fields_show_the_selection(panel, canvas):
    assert not panel.values.time.isEnabled()
    canvas.select([("FV", 2)])
    assert (panel.values.time.text(), panel.values.weight.text()) == ("0.26", "0.97")
    canvas.select([("FV", 1), ("FV", 2)])
    assert (panel.values.time.text(), panel.values.time.placeholderText()) == ("", "0.12 … 0.26")
    canvas.select([("FV", 0), ("open", 0)])
    assert panel.values.time.text() == "0"


def test_the_fields_follow_a_drag(hand, panel):
    hand.press(0.26, 0.97)
    hand.move(0.3, 0.7)
    assert float(panel.values.weight.text()) == pytest.approx(0.7, abs=3e-3)
    hand.release(0.3, 0.7)


@pytest.mark.parametrize(
    ("text", "weights"),
    [("*0.5", [0.39, 0.485]), ("+0.1", [0.88, 1.0]), ("=.3", [0.3, 0.3]), (".3", [0.3, 0.3]), ("-0.1", [0.68, 0.87])],
)
def test_what_is_typed_acts_on_the_whole_selection_in_one_edit(hand, panel, canvas, qtbot, text, weights):
    canvas.select([("FV", 1), ("FV", 2)])
    enter(qtbot, panel.values.weight, text)
    ((changes, label),) = hand.edits
    assert label == "Type values"
    np.testing.assert_allclose(changes["FV"].v[1:3], weights)
    assert changes["FV"].t.tolist() == FV.t.tolist()
    assert canvas.selection == {("FV", 1), ("FV", 2)}
    hand.undo()
    assert canvas.curves["FV"] is FV


def test_a_time_may_pass_other_keys_and_the_selection_goes_with_it(hand, panel, canvas, qtbot):
    canvas.select([("FV", 1)])
    enter(qtbot, panel.values.time, "0.5")
    assert hand.edits[0][0]["FV"].keys()[3] == (0.5, 0.78)
    assert canvas.selection == {("FV", 3)}
    assert panel.values.time.text() == "0.5"


@pytest.mark.parametrize(
    ("field", "text", "why"),
    [("time", "0.42", "in the way"), ("weight", "half", "“half” is no value"), ("time", "=1", "")],
)
def test_what_cannot_be_is_refused_with_a_sentence(hand, panel, canvas, qtbot, field, text, why):
    canvas.select([("FV", 1), ("FV", 2)] if not why else [("FV", 1)])
    before = getattr(panel.values, field).text()
    enter(qtbot, getattr(panel.values, field), text)
    assert not hand.edits
    assert (why or "in the way") in hand.hints[-1]
    assert getattr(panel.values, field).text() == before


def test_escape_takes_back_what_was_typed_and_gives_the_keyboard_to_the_canvas(hand, panel, canvas, qtbot):
    canvas.select([("FV", 1)])
    panel.values.time.setFocus()
    qtbot.keyClicks(panel.values.time, "0.9")
    qtbot.keyClick(panel.values.time, Key.Key_Escape)
    assert panel.values.time.text() == "0.12"
    assert canvas.hasFocus()
    assert not hand.edits


def test_enter_without_a_change_is_no_edit(hand, panel, canvas, qtbot):
    canvas.select([("FV", 1)])
    panel.values.time.setFocus()
    qtbot.keyClick(panel.values.time, Key.Key_Return)
    assert not hand.edits


def test_tab_goes_from_the_canvas_through_the_fields_to_the_table(panel, canvas, qtbot):
    panel.show_table(True)
    canvas.select([("FV", 1)])
    canvas.setFocus()
    seen = []
    for _ in range(4):
        qtbot.keyClick(QApplication.focusWidget(), Key.Key_Tab)
        seen.append(QApplication.focusWidget())
    assert seen == [panel.values.time, panel.values.weight, panel.table_button, panel.table]
    qtbot.keyClick(panel.table, Key.Key_Backtab, SHIFT)
    assert panel.table_button.hasFocus()


# The table


def test_the_table_shows_the_active_curve(panel, table, canvas):
    model = table.model()
    assert [model.index(row, WEIGHT).data() for row in range(6)] == [
        "0.200",
        "0.780",
        "0.970",
        "0.550",
        "0.060",
        "0.000",
    ]
    canvas.set_active("open")
    assert model.rowCount() == 5
    canvas.set_active("tBack")
    assert model.rowCount() == 0


def test_a_value_typed_into_a_cell_is_one_edit(hand, table, canvas, qtbot):
    enter_cell(qtbot, table, 2, WEIGHT, "0.5")
    ((changes, label),) = hand.edits
    assert label == "Type values"
    assert changes["FV"].v.tolist() == [0.2, 0.78, 0.5, 0.55, 0.06, 0]
    assert table.model().index(2, WEIGHT).data() == "0.500"
    enter_cell(qtbot, table, 2, TIME, "0.3")
    assert hand.edits[1][0]["FV"].t[2] == 0.3
    hand.undo()
    hand.undo()
    assert canvas.curves["FV"] is FV


def test_an_expression_acts_on_all_selected_rows_and_a_number_on_one(hand, table, canvas, qtbot):
    canvas.select([("FV", 1), ("FV", 2)])
    enter_cell(qtbot, table, 1, WEIGHT, "*0.5")
    assert hand.edits[-1][0]["FV"].v.tolist() == [0.2, 0.39, 0.485, 0.55, 0.06, 0]
    enter_cell(qtbot, table, 1, WEIGHT, "1")
    assert hand.edits[-1][0]["FV"].v.tolist() == [0.2, 1, 0.485, 0.55, 0.06, 0]
    assert canvas.selection == {("FV", 1), ("FV", 2)}


def test_rows_and_keys_are_selected_together(table, canvas, qtbot):
    qtbot.mouseClick(table.viewport(), LEFT, pos=table.visualRect(table.model().index(3, TIME)).center())
    assert canvas.selection == {("FV", 3)}
    qtbot.keyClick(table, Key.Key_Down, SHIFT)
    assert canvas.selection == {("FV", 3), ("FV", 4)}
    canvas.select([("FV", 0), ("open", 2)])
    assert table.picked == {0}
    assert canvas.selection == {("FV", 0), ("open", 2)}


def test_a_whole_curve_by_keyboard_alone(hand, table, canvas, qtbot):
    """A pose without a curve: Insert begins one, then keys are typed, added and removed."""
    canvas.set_active("PBM")
    qtbot.keyClick(table, Key.Key_Insert)
    assert hand.edits[-1][0]["PBM"].keys() == [(0, 0), (0.5, 0.5), (1, 0)]
    enter_cell(qtbot, table, 1, WEIGHT, "0.9")
    qtbot.keyClick(table, Key.Key_Insert)
    assert canvas.curves["PBM"].t.tolist() == [0, 0.5, 0.75, 1]
    enter_cell(qtbot, table, 2, TIME, "0.6")
    qtbot.keyClick(table, Key.Key_Delete)
    assert canvas.curves["PBM"].keys() == [(0, 0), (0.5, 0.9), (1, 0)]
    assert [label for _, label in hand.edits] == ["Add key", "Type values", "Add key", "Type values", "Delete keys"]


def test_a_locked_pose_is_read_and_not_edited(hand, table, canvas, qtbot):
    canvas.set_locked({"FV"})
    table.setCurrentIndex(table.model().index(1, WEIGHT))
    qtbot.keyClicks(table, "5")
    assert QApplication.focusWidget() is table
    qtbot.keyClick(table, Key.Key_Insert)
    assert not hand.edits
    assert "FV is locked" in hand.hints[-1]


def test_every_cell_can_be_read_out(table, panel):
    assert table.accessibleName() == "Keys of FV"
    assert table.accessibleDescription()
    assert table.model().index(2, WEIGHT).data(ROLE) == "FV key 3 weight 0.970"
    for field in (panel.values.time, panel.values.weight, panel.table_button):
        assert field.accessibleName()


def test_the_table_follows_a_drag_a_moment_later(hand, table, canvas, qtbot):
    hand.press(0.26, 0.97)
    hand.move(0.3, 0.7)
    qtbot.waitUntil(lambda: table.model().index(2, TIME).data() == "0.300")
    hand.release(0.3, 0.7)


def test_the_button_shows_and_hides_the_table(panel, qtbot):
    assert not panel.table.isVisible()
    qtbot.mouseClick(panel.table_button, LEFT, pos=QPoint(8, 8))
    assert panel.table.isVisible()
    qtbot.mouseClick(panel.table_button, LEFT, pos=QPoint(8, 8))
    assert not panel.table.isVisible()


def test_escape_in_the_table_gives_the_keyboard_to_the_canvas(table, canvas, qtbot):
    qtbot.keyClick(table, Key.Key_Escape)
    assert canvas.hasFocus()


def test_letters_are_left_to_the_window(table):
    event = QKeyEvent(QKeyEvent.Type.KeyPress, Key.Key_Q, Qt.KeyboardModifier.NoModifier, "q")
    event.accept()
    table.keyPressEvent(event)
    assert not event.isAccepted()


def test_a_curve_from_outside_is_shown_without_a_wish(hand, table, canvas):
    canvas.set_curves({"FV": Curve.of([(0, 0), (1, 1)]), "open": OPEN})
    assert table.model().rowCount() == 2
    assert not hand.edits
    assert not canvas.selection
    hand.key(Key.Key_A, CTRL)
    assert table.picked == {0, 1}
