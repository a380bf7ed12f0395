"""The line above the canvas: what it says, what it gives up where it is narrow, and its buttons."""

import pytest
from PySide6.QtCore import Qt

from core_pipeline.curves import Curve
from tests.helpers.curve_hand import FV, LEFT
from widgets import theme
from widgets.canvas.canvas_header import CanvasHeader


@pytest.fixture
def header(qtbot):
    header = CanvasHeader()
    qtbot.addWidget(header)
    header.set_bigram("f", "ah")
    header.set_example("fat", (0, 2))
    header.set_usage(2)
    header.set_status("draft")
    header.resize(900, header.sizeHint().height())
    header.show()
    return header


@pytest.fixture
def joined(header, hand, canvas):
    """A header over a canvas, as the window joins them."""
    header.action_wanted.connect(canvas.act)
    header.snap_toggled.connect(canvas.set_snap)
    header.polygon_toggled.connect(canvas.set_polygon)
    canvas.keys_changed.connect(header.set_keys)
    canvas.set_keymap("Maya")
    return header


def test_it_tells_bigram_example_use_and_status(header):
    assert header.text == "F – Ah · as in “fat” · used 2× in this sentence · draft"
    header.set_usage(0)
    header.set_example("")
    assert header.text == "F – Ah · not in this sentence · draft"


def test_the_letters_of_the_bigram_stand_out(header):
    assert f'“<b style="color:{theme.HIGHLIGHT.name()}">fa</b>t”' in header.detail
    header.set_example("<b>&", (1, 2))
    assert "&lt;<b " in header.detail
    assert "&gt;&amp;”" in header.detail


def test_it_gives_up_words_then_the_use_then_the_status_where_it_is_narrow(header):
    shown = []
    for width in range(900, 120, -5):
        header.resize(width, header.height())
        now = [part in header.detail for part in ("as in", "in this sentence", "used", "draft")]
        if not shown or shown[-1] != now:
            shown.append(now)
    stages = [[1, 1, 1, 1], [1, 0, 1, 1], [1, 0, 0, 1], [1, 0, 0, 0], [0, 0, 0, 0]]
    assert shown[0] == stages[0]
    assert shown[-4:] == stages[-4:]  # before that, where some buttons go, a little room comes back
    assert all(now in stages for now in shown)


def test_buttons_that_keys_replace_make_room_for_the_text(header):
    shown = []
    for width in range(900, 200, -10):
        header.resize(width, header.height())
        shown.append(sum(button.isVisible() for button in header.buttons))
        if shown[-1] > 3:
            assert "as in" in header.detail, width
    assert shown[0] == len(header.buttons) == 9
    assert shown[-1] == 3
    assert shown == sorted(shown, reverse=True)


def test_the_bigram_is_whole_when_all_buttons_have_gone(header):
    header.set_bigram("kg", "bmp")
    title = header._title
    for width in range(900, title.sizeHint().width() + 34, -5):
        header.resize(width, header.height())
        header.layout().activate()
        assert title.width() >= title.sizeHint().width(), width


def test_every_button_has_a_name_and_tells_its_key_in_the_present_map(joined):
    assert all(button.accessibleName() and button.toolTip() for button in joined.buttons)
    assert joined.button_of("frame_all").toolTip() == "Frame all (A)"
    assert joined.button_of("reverse").toolTip() == "Reverse in time (Ctrl+M)"


def test_a_switch_shows_what_it_is_told_and_wishes_the_opposite(header, qtbot):
    header.set_snap(True)
    with qtbot.waitSignal(header.snap_toggled) as wish:
        qtbot.mouseClick(header.buttons[0], LEFT)
    assert wish.args == [False]


def test_buttons_do_what_the_keys_do(joined, hand, canvas, qtbot):
    def click(action):
        qtbot.mouseClick(joined.button_of(action), LEFT)

    click("reverse")
    click("mirror")
    assert [label for _, label in hand.edits] == ["Reverse keys", "Mirror values"]
    hand.undo()
    hand.undo()
    click("copy")
    canvas.set_active("W")
    click("paste")
    assert canvas.curves["W"].same_as(FV)
    canvas.set_neighbours({"F – Aa": {"open": Curve.of([(0, 0), (1, 0)])}})
    click("duplicate")
    assert canvas.blend_bar.isVisible()
    assert canvas.blend_bar.slider.value() == 100
    qtbot.keyClick(canvas.blend_bar.slider, Qt.Key.Key_Escape)


def test_the_straight_lines_between_keys_can_be_hidden(joined, canvas, qtbot):
    def ink():
        image = canvas.grab().toImage()
        return sum(
            image.pixelColor(x, y) != theme.BACKGROUND
            for x in range(60, image.width(), 2)
            for y in range(0, image.height(), 2)
        )

    with_lines = ink()
    qtbot.mouseClick(joined.buttons[1], LEFT)
    without = ink()
    assert without < with_lines
    qtbot.mouseClick(joined.buttons[1], LEFT)
    assert ink() == with_lines
