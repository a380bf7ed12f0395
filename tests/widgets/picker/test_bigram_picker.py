"""Finding and opening bigrams with the mouse, the arrow keys and the search."""

from itertools import product

import pytest
from PySide6.QtCore import QEvent, QPoint, Qt
from PySide6.QtGui import QAccessible, QColor, QFocusEvent
from PySide6.QtWidgets import QApplication

from core_pipeline.phonemes import COMMON
from widgets import theme
from widgets.picker.bigram_picker import BigramPicker, phones_in

# the offscreen platform has no window manager to talk to
pytestmark = pytest.mark.qt_log_ignore("This plugin does not support")

F_AH = ("f", "ah")


def show(qtbot, width=408, height=620, phonemes=COMMON):
    picker = BigramPicker()
    qtbot.addWidget(picker)
    picker.set_phonemes(phonemes)
    picker.resize(width, height)
    with qtbot.waitExposed(picker):
        picker.show()
    QApplication.processEvents()
    return picker


@pytest.fixture
def picker(qtbot):
    return show(qtbot)


@pytest.fixture
def picks(picker):
    return collect(picker.picked)


def collect(signal):
    seen = []
    signal.connect(lambda *values: seen.append(values[0] if len(values) == 1 else values))
    return seen


def click(qtbot, picker, pair):
    qtbot.mouseClick(picker.grid.viewport(), Qt.MouseButton.LeftButton, pos=picker.grid.rect_of(pair).center())


def colour(picker, pair, offset=None):
    """What is painted in the middle of a cell, or at an offset from its top left corner."""
    rect = picker.grid.rect_of(pair)
    at = rect.center() if offset is None else rect.topLeft() + QPoint(*offset)
    return picker.grid.viewport().grab().toImage().pixelColor(at)


def test_a_click_opens_the_bigram_of_that_row_and_column(qtbot, picker, picks):
    click(qtbot, picker, F_AH)
    click(qtbot, picker, ("bmp", "kg"))
    assert picks == [F_AH, ("bmp", "kg")]
    assert picker.current == ("bmp", "kg")


def test_a_right_click_opens_nothing(qtbot, picker, picks):
    at = picker.grid.rect_of(F_AH).center()
    qtbot.mouseClick(picker.grid.viewport(), Qt.MouseButton.RightButton, pos=at)
    assert picks == []


def test_a_drag_over_the_cells_opens_only_the_pressed_one(qtbot, picker, picks):
    viewport = picker.grid.viewport()
    qtbot.mousePress(viewport, Qt.MouseButton.LeftButton, pos=picker.grid.rect_of(F_AH).center())
    for phone in COMMON[1:7]:
        qtbot.mouseMove(viewport, picker.grid.rect_of(("f", phone)).center())
    qtbot.mouseRelease(viewport, Qt.MouseButton.LeftButton, pos=picker.grid.rect_of(("f", "w")).center())
    assert picks == [F_AH]
    assert picker.current == F_AH


def test_arrow_keys_open_the_neighbours_at_once(qtbot, picker, picks):
    picker.set_current(F_AH)
    picker.grid.setFocus()
    for key in (Qt.Key.Key_Right, Qt.Key.Key_Down, Qt.Key.Key_Left, Qt.Key.Key_Up):
        qtbot.keyClick(picker.grid, key)
    assert picks == [("f", "aa"), ("d", "aa"), ("d", "ah"), F_AH]


def test_an_arrow_at_the_edge_opens_nothing_and_enter_opens_again(qtbot, picker, picks):
    picker.set_current(F_AH)
    qtbot.keyClick(picker.grid, Qt.Key.Key_Left)
    assert picks == []
    qtbot.keyClick(picker.grid, Qt.Key.Key_Return)
    assert picks == [F_AH]


def test_values_from_outside_emit_nothing(picker, picks):
    picker.set_current(F_AH)
    picker.set_statuses({F_AH: "draft"})
    picker.set_weak({F_AH: "missing"})
    picker.set_used({F_AH: 2})
    picker.set_current(("ah", "d"))
    picker.set_phonemes(COMMON[::-1])
    assert picks == []
    assert picker.current == ("ah", "d")


def test_a_bigram_outside_the_square_is_shown_as_none(picker):
    picker.set_current(F_AH)
    picker.set_current(("sil", "ah"))
    assert picker.current is None


def test_tab_leaves_the_square(qtbot, picker):
    picker.grid.setFocus()
    picker.set_current(F_AH)
    qtbot.keyClick(picker.grid, Qt.Key.Key_Tab)
    assert picker.current == F_AH


def test_the_tooltip_says_word_status_and_uses(picker):
    picker.set_words({F_AH: "fat"})
    picker.set_statuses({F_AH: "draft"})
    picker.set_used({F_AH: 2})
    model = picker.grid.pairs
    tip = model.data(model.index_of(F_AH), Qt.ItemDataRole.ToolTipRole)
    assert tip == "F – Ah as in fat · draft · used 2×"
    picker.set_weak({F_AH: "speed-limited 38 %"})
    picker.set_overridden({F_AH})
    tip = model.data(model.index_of(F_AH), Qt.ItemDataRole.ToolTipRole)
    assert tip == "F – Ah as in fat · draft · speed-limited 38 % · used 2× · this character's own"
    assert model.data(model.index_of(("ah", "f")), Qt.ItemDataRole.ToolTipRole) == "Ah – F · empty"


def test_cells_have_accessible_names(picker):
    picker.set_statuses({F_AH: "approved"})
    table = QAccessible.queryAccessibleInterface(picker.grid)
    # its children are row by row, each with its header in front, after a row of headers
    cell = table.child((COMMON.index("f") + 1) * (len(COMMON) + 1) + COMMON.index("ah") + 1)
    assert cell.text(QAccessible.Text.Name) == "F – Ah"
    assert cell.text(QAccessible.Text.Description) == "F – Ah · approved"


@pytest.mark.parametrize("status", list(theme.STATUS_COLOURS))
def test_the_fill_is_the_status(picker, status):
    picker.set_statuses({F_AH: status})
    assert colour(picker, F_AH) == theme.STATUS_COLOURS[status]


def test_a_weak_bigram_is_orange_whatever_its_status(picker):
    picker.set_statuses({F_AH: "approved", ("f", "aa"): "approved"})
    picker.set_weak({F_AH: "missing"})
    assert colour(picker, F_AH) == theme.WEAK
    assert colour(picker, ("f", "aa")) == theme.STATUS_COLOURS["approved"]


def test_rings_say_in_sentence_and_open(picker):
    picker.set_used({("d", "ih"): 1})
    picker.set_current(F_AH)
    assert colour(picker, ("d", "ih"), (0, 5)) == theme.BRIGHT
    assert colour(picker, F_AH, (0, 5)) == theme.HIGHLIGHT
    assert colour(picker, ("r", "ih"), (0, 5)) == theme.STATUS_COLOURS["empty"]


def test_the_ring_of_an_approved_bigram_stands_out_from_its_pale_fill(picker):
    picker.set_statuses({("d", "ih"): "approved"})
    picker.set_used({("d", "ih"): 1})
    assert colour(picker, ("d", "ih"), (0, 5)) == theme.BRIGHT
    assert colour(picker, ("d", "ih"), (1, 5)) == theme.SUNKEN
    assert colour(picker, ("d", "ih")) == theme.STATUS_COLOURS["approved"]


def test_the_open_bigram_still_shows_that_it_is_in_the_sentence(picker):
    picker.set_used({F_AH: 1})
    picker.set_current(F_AH)
    assert colour(picker, F_AH, (0, 5)) == theme.HIGHLIGHT
    assert colour(picker, F_AH, (1, 5)) == theme.BRIGHT


def test_a_dot_marks_the_characters_own(picker):
    bottom_right = (picker.grid.cell.width() - 4, picker.grid.cell.height() - 4)
    assert colour(picker, F_AH, bottom_right) == theme.STATUS_COLOURS["empty"]
    picker.set_overridden({F_AH})
    assert colour(picker, F_AH, bottom_right) == theme.BRIGHT


def test_the_cell_under_the_pointer_is_ringed(qtbot, picker):
    cell = picker.grid.rect_of(("ih", "l"))
    qtbot.mouseMove(picker.grid.viewport(), cell.center())
    assert colour(picker, ("ih", "l"), (-1, 5)) == theme.TEXT
    QApplication.sendEvent(picker.grid, QEvent(QEvent.Type.Leave))
    assert colour(picker, ("ih", "l"), (-1, 5)) == theme.SUNKEN


def test_the_names_of_the_open_row_and_column_stand_out(picker):
    picker.set_current(F_AH)
    row = picker.grid.verticalHeader().viewport().grab().toImage()
    at = picker.grid.rect_of(F_AH).center().y()
    assert row.pixelColor(2, at) == theme.CHECKED
    assert row.pixelColor(2, at - picker.grid.cell.height()) == theme.WINDOW
    column = picker.grid.horizontalHeader().viewport().grab().toImage()
    assert column.pixelColor(picker.grid.rect_of(F_AH).x() + 1, 1) == theme.CHECKED


@pytest.mark.parametrize(
    ("width", "height", "cell"),
    [(300, 420, (12, 12)), (408, 620, (17, 17)), (408, 470, (17, 14)), (700, 480, (31, 16)), (900, 900, (41, 28))],
)
def test_cells_fill_the_width_and_grow_with_the_dock(qtbot, width, height, cell):
    picker = show(qtbot, width, height)
    assert picker.grid.cell.toTuple() == pytest.approx(cell, abs=1)
    assert picker.grid.rect_of(F_AH).size().toTuple() == (picker.grid.cell.width() - 1, picker.grid.cell.height() - 1)
    assert picker.grid.width() - picker.grid.rect_of(("ah", "bmp")).right() - picker.grid.verticalHeader().width() < 23
    assert not picker.grid.horizontalScrollBar().isVisible()
    assert not picker.grid.verticalScrollBar().isVisible()


def test_legend_and_coverage_follow_the_square_closely(qtbot):
    picker = show(qtbot, 408, 900)
    bottom = picker.grid.mapTo(picker, picker.grid.rect_of(("bmp", "bmp")).bottomRight())
    head = picker.grid.horizontalHeader().height()
    assert picker.legend.y() - (bottom.y() + head) < 12


def test_in_little_height_the_square_scrolls_and_shows_the_open_bigram(qtbot):
    picker = show(qtbot, 300, 330)
    picker.set_current(("bmp", "bmp"))
    assert picker.grid.viewport().rect().contains(picker.grid.rect_of(("bmp", "bmp")).center())
    assert not picker.grid.horizontalScrollBar().isVisible()


def test_any_phoneme_list_will_do(qtbot):
    phonemes = tuple(f"p{i}" for i in range(35))
    picker = show(qtbot, 600, 800, phonemes)
    picks = collect(picker.picked)
    click(qtbot, picker, ("p34", "p0"))
    qtbot.keyClicks(picker.search, "p3-p34")
    assert picks == [("p34", "p0"), ("p3", "p34")]


def test_a_phone_that_may_still_grow_waits_for_enter_or_a_space(qtbot):
    picker = show(qtbot, phonemes=("f", "t", "th"))
    picks = collect(picker.picked)
    qtbot.keyClicks(picker.search, "f th")
    assert picks == [("f", "th")]
    for end in (" ", "\r"):
        picker.search.clear()
        qtbot.keyClicks(picker.search, "f t" + end)
    assert picks == [("f", "th"), ("f", "t"), ("f", "t")]


def test_an_empty_phoneme_list_is_harmless(qtbot):
    picker = show(qtbot, phonemes=())
    picker.set_statuses({F_AH: "draft"})
    picker.set_current(F_AH)
    qtbot.keyClick(picker.grid, Qt.Key.Key_Down)
    assert not picker.grid.grab().isNull()
    assert picker.current is None


@pytest.mark.parametrize("text", ["f ah", "f-ah", "F – Ah", " f  ah "])
def test_two_phones_in_the_search_open_their_bigram(qtbot, picker, picks, text):
    wanted = collect(picker.search_wanted)
    picker.search.setText(text)
    assert picks == [F_AH]
    assert picker.current == F_AH
    assert wanted == []


def test_typing_a_bigram_opens_it_once(qtbot, picker, picks):
    qtbot.keyClicks(picker.search, "th ih")
    assert picks == [("th", "ih")]


def test_one_phone_shows_its_row_and_column_and_opens_nothing(qtbot, picker, picks):
    picker.set_statuses(dict.fromkeys(product(COMMON, COMMON), "approved"))
    qtbot.keyClicks(picker.search, "f")
    full = theme.STATUS_COLOURS["approved"]
    assert colour(picker, ("f", "kg")) == colour(picker, ("kg", "f")) == full
    assert colour(picker, ("kg", "kg")).lightness() < full.lightness() / 2
    assert picks == []


def test_a_word_is_asked_for_and_its_bigrams_are_ringed(qtbot, picker, picks):
    wanted = collect(picker.search_wanted)
    qtbot.keyClicks(picker.search, "fat")
    assert wanted == ["fa", "fat"]
    assert picker.legend.message == "Looking for “fat”…"
    picker.set_matches([])
    assert picker.legend.message == "No such bigram and no such word"
    picker.set_matches([F_AH, ("ah", "d"), F_AH])
    assert picker.legend.message == "2 bigrams · Enter steps through them"
    assert colour(picker, ("ah", "d"), (0, 5)) == theme.LINK
    assert picks == []
    for _ in range(3):
        qtbot.keyClick(picker.search, Qt.Key.Key_Return)
    assert picks == [F_AH, ("ah", "d"), F_AH]


def test_enter_before_the_answer_opens_the_first_bigram_when_it_comes(qtbot, picker, picks):
    qtbot.keyClicks(picker.search, "fat")
    qtbot.keyClick(picker.search, Qt.Key.Key_Return)
    assert picks == []
    picker.set_matches([F_AH, ("ah", "d")])
    assert picks == [F_AH]


def test_more_phones_show_each_pair(qtbot, picker):
    wanted = collect(picker.search_wanted)
    picker.search.setText("f ah d")
    assert wanted == []
    assert colour(picker, F_AH, (0, 5)) == theme.LINK
    assert colour(picker, ("ah", "d"), (0, 5)) == theme.LINK


def test_a_late_answer_to_an_emptied_search_changes_nothing(qtbot, picker):
    qtbot.keyClicks(picker.search, "fat")
    qtbot.keyClick(picker.search, Qt.Key.Key_Escape)
    picker.set_matches([F_AH])
    assert picker.legend.message == ""
    assert colour(picker, F_AH, (0, 5)) == theme.STATUS_COLOURS["empty"]


def test_escape_ends_the_search(qtbot, picker):
    picker.set_statuses({("kg", "kg"): "approved"})
    qtbot.keyClicks(picker.search, "f")
    qtbot.keyClick(picker.search, Qt.Key.Key_Escape)
    assert picker.search.text() == ""
    assert colour(picker, ("kg", "kg")) == theme.STATUS_COLOURS["approved"]


def test_enter_on_one_bigram_asks_to_work_on_it_and_on_several_steps_on(qtbot, picker, picks):
    entered = collect(picker.entered)
    qtbot.keyClicks(picker.search, "f ah")
    assert not entered
    qtbot.keyClick(picker.search, Qt.Key.Key_Return)
    assert len(entered) == 1
    picker.search.clear()
    qtbot.keyClicks(picker.search, "f ah d")
    qtbot.keyClick(picker.search, Qt.Key.Key_Return)
    assert len(entered) == 1
    picker.set_current(F_AH)
    qtbot.keyClick(picker.grid, Qt.Key.Key_Down)
    assert len(entered) == 1
    qtbot.keyClick(picker.grid, Qt.Key.Key_Return)
    assert len(entered) == 2


def test_down_goes_from_the_search_to_the_square(qtbot, picker):
    picker.search.setFocus()
    qtbot.keyClick(picker.search, Qt.Key.Key_Down)
    assert picker.grid.hasFocus()


def test_the_order_menu_reorders_both_sides_and_keeps_the_open_bigram(picker, picks):
    picker.set_current(F_AH)
    picker.set_orders({"Table 1": COMMON, "Reversed": COMMON[::-1]})
    assert picker.order.isVisible()
    picker.order.menu().actions()[1].trigger()
    assert picker.grid.pairs.phonemes == COMMON[::-1]
    assert picker.current == F_AH
    assert picker.grid.rect_of(("bmp", "bmp")).y() == 0
    assert picks == []
    picker.set_orders({"Table 1": COMMON[1:], "Reversed": COMMON[:0:-1]})  # another set has the same order again
    assert (picker.order_name, picker.grid.pairs.phonemes) == ("Reversed", COMMON[:0:-1])
    picker.set_order("no such order")
    assert picker.order_name == "Reversed"


def test_the_coverage_bar_says_and_shows_how_much(picker):
    picker.set_coverage("331 of 441 · 96.8 % of running speech", 0.75)
    assert picker.coverage.text == "331 of 441 · 96.8 % of running speech"
    image = picker.coverage.grab().toImage()
    assert image.pixelColor(round(image.width() * 0.73), 2) == theme.CHECKED
    assert image.pixelColor(round(image.width() * 0.77), 2) == theme.SUNKEN


def test_the_focused_square_has_a_frame(qtbot, picker):
    corner = QColor(colour(picker, ("ah", "ah"), (0, 0)))
    picker.grid.setFocus()
    QApplication.sendEvent(picker.grid, QFocusEvent(QEvent.Type.FocusIn))
    assert corner != theme.ACCENT
    assert colour(picker, ("ah", "ah"), (0, 0)) == theme.ACCENT


def test_every_control_has_a_name(picker):
    for control in (picker.search, picker.order, picker.grid, picker.legend, picker.coverage):
        assert control.accessibleName()


def test_phones_in_reads_only_phones():
    assert phones_in("F_ah>d", COMMON) == ("f", "ah", "d")
    assert phones_in("f at", COMMON) == ()
    assert phones_in(" - ", COMMON) == ()
    assert phones_in("aa", ("AA", "B")) == ("AA",)
