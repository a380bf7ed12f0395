"""Ten empty bigrams are filled by mouse alone and by keyboard alone; every gesture is counted.

A gesture is a click, a double-click, a drag or one key pressed. Each bigram ends with curves for the poses that a
similar bigram has, its strongest peak raised by hand.
"""

import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from app.editor import Editor
from core_pipeline.phonemes import Pair
from tests.helpers import mouse

Key = Qt.Key
LEFT = Qt.MouseButton.LeftButton
CTRL = Qt.KeyboardModifier.ControlModifier

TEN: tuple[Pair, ...] = (
    ("f", "ah"), ("d", "ih"), ("bmp", "aa"), ("ah", "r"), ("th", "ah"),
    ("z", "ih"), ("kg", "ao"), ("l", "ow"), ("w", "eh"), ("sh", "er"),
)  # fmt: skip


class Hand:
    """Does and counts."""

    def __init__(self, editor: Editor) -> None:
        self.editor, self.window = editor, editor.window
        self.gestures = 0

    def click(self, widget, at=None) -> None:
        self.gestures += 1
        QTest.mouseClick(widget, LEFT, pos=at if at is not None else widget.rect().center())

    def double_click(self, at: QPointF) -> None:
        self.gestures += 1
        viewport = self.window.canvas.viewport()
        QTest.mouseClick(viewport, LEFT, pos=at.toPoint())
        QTest.mouseDClick(viewport, LEFT, pos=at.toPoint())

    def drag(self, start: QPointF, end: QPointF) -> None:
        self.gestures += 1
        mouse.drag(self.window.canvas.viewport(), start, end)

    def key(self, widget, key, held=Qt.KeyboardModifier.NoModifier) -> None:
        self.gestures += 1
        QTest.keyClick(widget, key, held)

    def type(self, widget, text: str) -> None:
        self.gestures += len(text)
        QTest.keyClicks(widget, text)


@pytest.fixture
def emptied(editor: Editor) -> Hand:
    curve_set = editor.document.curve_set
    for pair in TEN:
        curve_set = curve_set.with_bigram(pair, None)
    editor.document.new(curve_set)
    editor.wiring.bigram.open(("oy", "oy"))
    return Hand(editor)


def _check(hand: Hand, most: int) -> None:
    curve_set, stack = hand.editor.document.curve_set, hand.editor.document.undo_stack
    for pair in TEN:
        bigram = curve_set.bigrams[pair]
        assert bigram.status == "draft"
        assert max(curve.v.max() for curve in bigram.curves.values()) > 0.3, pair
    assert hand.gestures <= most, hand.gestures
    while stack.canUndo():
        stack.undo()
    assert not any(pair in hand.editor.document.curve_set.bigrams for pair in TEN)


def test_by_mouse_alone(emptied: Hand, qtbot: QtBot) -> None:
    """Click the cell, the button that duplicates, the canvas to keep; drag the peak: four gestures each."""
    hand, canvas, grid = emptied, emptied.window.canvas, emptied.window.picker.grid
    for pair in TEN:
        hand.click(grid.viewport(), grid.rect_of(pair).center())
        assert not canvas.curves
        hand.click(hand.window.header.button_of("duplicate"))
        hand.click(canvas.viewport(), canvas.point_of(0.97, 0.97).toPoint())
        assert not canvas.busy
        curve = canvas.curves[canvas.active]
        top = int(curve.v.argmax())
        at = canvas.point_of(float(curve.t[top]), float(curve.v[top]))
        hand.drag(at, at - QPointF(0, 24))
    _check(hand, 40)


def test_by_keyboard_alone(emptied: Hand, qtbot: QtBot) -> None:
    """Search and Enter, Ctrl+D and Enter; walk to a key and nudge it up."""
    hand, canvas, search = emptied, emptied.window.canvas, emptied.window.picker.search
    hand.window.activateWindow()
    typed = 0
    for pair in TEN:
        hand.key(hand.window.focusWidget() or canvas, Key.Key_F, CTRL)
        qtbot.waitUntil(search.hasFocus)
        search.selectAll()
        before = hand.gestures
        hand.type(search, " ".join(pair))
        typed += hand.gestures - before
        hand.key(search, Key.Key_Return)
        qtbot.waitUntil(canvas.hasFocus)
        assert not canvas.curves
        hand.key(canvas, Key.Key_D, CTRL)
        hand.key(canvas.blend_bar.slider, Key.Key_Return)
        assert canvas.hasFocus()
        hand.key(canvas, Key.Key_Period)
        hand.key(canvas, Key.Key_Period)
        hand.key(canvas, Key.Key_Up, CTRL)
    assert hand.gestures - typed == 70
    _check(hand, 70 + typed)


def test_from_nothing_by_mouse_and_by_keyboard(emptied: Hand, qtbot: QtBot) -> None:
    """Two poses each: pose and double-click; or Page Down, Insert and an arrow."""
    hand, canvas, grid, poses = emptied, emptied.window.canvas, emptied.window.picker.grid, emptied.window.pose_list
    for pair in TEN[:5]:
        hand.click(grid.viewport(), grid.rect_of(pair).center())
        for pose, at in (("open", (0.7, 0.6)), ("wide", (0.4, 0.4))):
            hand.click(poses.viewport(), poses.visualItemRect(poses._items[pose]).center())
            hand.double_click(canvas.point_of(*at))
    assert hand.gestures == 5 * 5
    hand.gestures = 0
    canvas.setFocus()
    for pair in TEN[5:]:
        hand.editor.wiring.bigram.open(pair)
        for _ in range(2):
            hand.key(canvas, Key.Key_PageDown)
            hand.key(canvas, Key.Key_Insert)
            hand.key(canvas, Key.Key_Right, CTRL)
    assert hand.gestures == 5 * 6
    for pair in TEN:
        assert len(hand.editor.document.curve_set.bigrams[pair].curves) == 2
