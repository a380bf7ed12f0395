"""Marks of weak bigrams: where they stand, what they say, what a click on one opens."""

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest

from tests.helpers import stages as small
from widgets import theme
from widgets.overlay.stage_marks import Mark, mark_at, place_of
from widgets.overlay.stage_overlay import StageOverlay

MISSING = Mark(("ah", "f"), 0.2, "", "missing")
JITTER = Mark(("bmp", "d"), 0.5, "open", "jitter: open turns 3 times")
HINT = Mark(("d", "l"), 0.6, "open", "suggestion, not reviewed", serious=False)


@pytest.fixture
def overlay(qtbot):
    overlay = StageOverlay()
    qtbot.addWidget(overlay)
    overlay.resize(800, 300)
    overlay.set_stages(small.sentence())
    overlay.set_active_pose("open")
    overlay.show()
    overlay.set_marks((MISSING, JITTER, HINT))
    return overlay


def point(overlay, mark):
    at = place_of(mark, overlay.axis, overlay.row_of)
    return QPoint(round(at.x()), round(at.y()) - 3)


def orange(overlay, at):
    image = overlay.grab().toImage()
    colours = [image.pixelColor(at.x() + dx, at.y() + dy) for dx in range(-3, 4) for dy in range(-3, 4)]
    return sum(c == theme.WEAK for c in colours)


def test_a_mark_stands_at_its_time_in_its_poses_row_else_at_the_top(overlay):
    row = overlay.row_of("open")
    assert place_of(MISSING, overlay.axis, overlay.row_of).y() < 12
    at = place_of(JITTER, overlay.axis, overlay.row_of)
    assert at.x() == pytest.approx(overlay.axis.px(0.5))
    assert row.top < at.y() < row.bottom
    assert place_of(Mark(("d", "l"), 99.0, "open", ""), overlay.axis, overlay.row_of) is None


def test_weak_ones_are_full_and_hints_hollow(overlay):
    assert orange(overlay, point(overlay, MISSING)) > 8
    assert orange(overlay, point(overlay, JITTER)) > 8
    assert orange(overlay, point(overlay, HINT)) == 0
    overlay.set_marks(())
    assert orange(overlay, point(overlay, JITTER)) == 0


def test_the_nearest_mark_is_read_and_told(overlay):
    near = QPointF(point(overlay, JITTER)) + QPointF(2, 1)
    assert mark_at(near, overlay._marks, overlay.axis, overlay.row_of)[0] is JITTER
    assert overlay._tip(point(overlay, JITTER)) == "bmp – d: jitter: open turns 3 times"
    assert mark_at(QPointF(5, 150), overlay._marks, overlay.axis, overlay.row_of) == []


def test_a_click_on_a_mark_opens_its_bigram_where_it_is(qtbot, overlay):
    picked = []
    overlay.bigram_picked.connect(lambda *what: picked.append(what))
    for mark in (MISSING, JITTER):
        QTest.mouseClick(overlay, Qt.MouseButton.LeftButton, pos=point(overlay, mark))
    pairs = small.sentence().schedule.pairs()
    assert [(pairs[index], time, pose) for index, time, pose in picked] == [
        (("ah", "f"), 0.2, "open"),
        (("bmp", "d"), 0.5, "open"),
    ]


def test_the_other_sets_result_is_drawn_beside_this_one(overlay):
    overlay.set_marks(())
    alone = overlay.grab().toImage()
    overlay.set_other(small.sentence(curves=small.curve_set(height=0.4)))
    both = overlay.grab().toImage()
    assert alone != both
    overlay.set_other(None)
    assert overlay.grab().toImage() == alone
