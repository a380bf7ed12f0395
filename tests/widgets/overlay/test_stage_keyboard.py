"""Everything that the mouse can do in the stage overlay, by keyboard: walk, read, open, zoom, loop."""

import pytest
from PySide6.QtCore import Qt

from tests.helpers.stages import sentence
from widgets.overlay.stage_keyboard import FINE
from widgets.overlay.stage_overlay import StageOverlay
from widgets.overlay.stage_panel import StagePanel

Key = Qt.Key
SHIFT, CTRL = Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.ControlModifier


@pytest.fixture
def overlay(qtbot):
    """One whose wishes are granted, as the program does."""
    overlay = StageOverlay()
    overlay.resize(1200, 300)
    qtbot.addWidget(overlay)
    overlay.set_stages(sentence())
    overlay.set_active_pose("open")
    overlay.scrubbed.connect(overlay.set_playhead)
    overlay.pose_activated.connect(overlay.set_active_pose)
    overlay.loop_range_changed.connect(overlay.set_loop_range)
    with qtbot.waitExposed(overlay):
        overlay.show()
    return overlay


def heard(signal):
    said = []
    signal.connect(lambda *values: said.append(values[0]))
    return said


def test_shift_and_arrows_go_by_hundredths_and_stop_at_both_ends(overlay, qtbot):
    scrubbed, ended = heard(overlay.scrubbed), heard(overlay.scrub_finished)
    for key in (Key.Key_Right, Key.Key_Right, Key.Key_Left, Key.Key_Left, Key.Key_Left):
        qtbot.keyClick(overlay, key, SHIFT)
    assert scrubbed == ended == pytest.approx([FINE, 2 * FINE, FINE, 0, 0])
    overlay.set_playhead(overlay.axis.end)
    qtbot.keyClick(overlay, Key.Key_Right, SHIFT)
    assert scrubbed[-1] == overlay.axis.end


def test_a_loop_by_keyboard(overlay, qtbot):
    loops = heard(overlay.loop_range_changed)
    end = overlay.axis.end
    overlay.set_playhead(0.2)
    qtbot.keyClick(overlay, Key.Key_I)
    overlay.set_playhead(0.4)
    qtbot.keyClick(overlay, Key.Key_O)
    overlay.set_playhead(0.1)
    qtbot.keyClick(overlay, Key.Key_O)  # before where it begins: from the start
    overlay.set_playhead(0.3)
    qtbot.keyClick(overlay, Key.Key_I)  # behind where it ends: to the end
    qtbot.keyClick(overlay, Key.Key_Delete)
    assert loops == [(0.2, end), (0.2, 0.4), (0.0, 0.1), (0.3, end), None]


def test_b_loops_the_open_bigram(overlay, qtbot):
    loops = heard(overlay.loop_range_changed)
    overlay.set_current(1, ("ah", "f"))
    qtbot.keyClick(overlay, Key.Key_B)
    times = sentence().schedule.times
    assert loops == [(times[1], times[3])]


def test_walking_reads_the_active_pose_at_the_playhead(qtbot):
    panel = StagePanel()
    panel.resize(1600, 330)
    qtbot.addWidget(panel)
    panel.set_stages(sentence())
    panel.set_active_pose("open")
    panel.scrubbed.connect(panel.set_playhead)
    panel.pose_activated.connect(panel.set_active_pose)
    panel.show()
    said = heard(panel.hovered)
    qtbot.keyClick(panel.overlay, Key.Key_Right)
    qtbot.keyClick(panel.overlay, Key.Key_Right)
    assert said[-1].startswith("t 0.20 s")
    assert "open" in said[-1]
    for _ in range(4):
        qtbot.keyClick(panel.overlay, Key.Key_Down)
    assert panel.overlay.active_pose in said[-1]
    assert "open" not in said[-1].split()
    assert panel.reading.text()


def test_pages_turn_where_it_is_zoomed(overlay, qtbot):
    overlay.set_playhead(0.0)
    for _ in range(6):
        qtbot.keyClick(overlay, Key.Key_Plus)
    first = overlay.axis
    qtbot.keyClick(overlay, Key.Key_PageDown)
    assert overlay.axis.left == pytest.approx(first.left + 0.9 * first.span)
    qtbot.keyClick(overlay, Key.Key_PageUp)
    assert overlay.axis.left == pytest.approx(first.left)
    qtbot.keyClick(overlay, Key.Key_Home)
    assert overlay.axis.is_fitted


@pytest.mark.parametrize("key", [Key.Key_Left, Key.Key_I, Key.Key_Home, Key.Key_B])
def test_keys_with_ctrl_are_the_windows(overlay, qtbot, key):
    said = [heard(s) for s in (overlay.scrubbed, overlay.loop_range_changed, overlay.pose_activated)]
    overlay.set_playhead(0.3)
    qtbot.keyClick(overlay, key, CTRL)
    assert said == [[], [], []]


def test_without_a_sentence_no_key_does_anything(overlay, qtbot):
    overlay.set_stages(None)
    said = [heard(s) for s in (overlay.scrubbed, overlay.loop_range_changed, overlay.pose_activated)]
    for key in (Key.Key_Left, Key.Key_I, Key.Key_O, Key.Key_B, Key.Key_Delete, Key.Key_Down, Key.Key_PageUp):
        qtbot.keyClick(overlay, key)
    assert said == [[], [], []]
