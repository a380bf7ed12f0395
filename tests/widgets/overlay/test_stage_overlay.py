"""The stage overlay under a real mouse and keyboard.

name │ open    ╱╲__╱╲___╱╲      a click opens the bigram that made the place
name │ FV      ___╱╲_______
Time     0.1  0.2  0.3          a drag scrubs, Shift+drag loops
Phoneme  sil  ah   f   ah
Start    0.0  0.1  0.2
"""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QHelpEvent, QMouseEvent, QWheelEvent
from PySide6.QtWidgets import QApplication, QToolTip

from core_pipeline.curve_set import CurveSet
from core_pipeline.curves import Curve
from core_pipeline.pipeline import run
from core_pipeline.schedule import Schedule
from tests.helpers.stages import curve_set, schedule, sentence
from widgets import theme
from widgets.overlay.stage_footer import ROW, fit_labels
from widgets.overlay.stage_overlay import StageOverlay

LEFT, MIDDLE, NO_BUTTON = Qt.MouseButton.LeftButton, Qt.MouseButton.MiddleButton, Qt.MouseButton.NoButton
PLAIN, SHIFT = Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ShiftModifier


@pytest.fixture
def overlay(qtbot):
    overlay = StageOverlay()
    overlay.resize(1200, 300)
    qtbot.addWidget(overlay)
    overlay.set_stages(sentence())
    overlay.set_active_pose("open")
    with qtbot.waitExposed(overlay):
        overlay.show()
    return overlay


def heard(signal):
    said = []
    signal.connect(lambda *values: said.append(values))
    return said


def mouse(overlay, kind, at, button=LEFT, keys=PLAIN):
    held = NO_BUTTON if kind == QEvent.Type.MouseButtonRelease else button
    pressed = NO_BUTTON if kind == QEvent.Type.MouseMove else button
    event = QMouseEvent(kind, QPointF(at), QPointF(overlay.mapToGlobal(at)), pressed, held, keys)
    QApplication.sendEvent(overlay, event)


def drag(overlay, start, end, button=LEFT, keys=PLAIN, moves=6):
    mouse(overlay, QEvent.Type.MouseButtonPress, start, button, keys)
    for k in range(1, moves + 1):
        mouse(overlay, QEvent.Type.MouseMove, start + (end - start) * k / moves, button, keys)
    mouse(overlay, QEvent.Type.MouseButtonRelease, end, button, keys)


def wheel(overlay, at, turn, keys=PLAIN):
    event = QWheelEvent(
        QPointF(at), QPointF(overlay.mapToGlobal(at)), QPoint(), QPoint(0, turn), NO_BUTTON, keys,
        Qt.ScrollPhase.NoScrollPhase, False,
    )  # fmt: skip
    QApplication.sendEvent(overlay, event)


def place(overlay, pose, t):
    row = overlay.row_of(pose)
    return QPoint(round(overlay.axis.px(t)), row.top + row.height // 2)


def time_row(overlay, t, row=0):
    return QPoint(round(overlay.axis.px(t)), overlay.rows_height + row * ROW + ROW // 2)


def pixel(overlay):
    """Seconds of one pixel: as exact as a mouse can be."""
    return 1 / overlay.axis.scale


def count(overlay, colour, near=40, rect=None):
    """How many pixels have nearly this colour."""
    image = overlay.grab().toImage().convertToFormat(overlay.grab().toImage().Format.Format_RGB32)
    pixels = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), image.width(), 4)[..., 2::-1]
    if rect is not None:
        pixels = pixels[rect.top : rect.bottom]
    return int((np.abs(pixels.astype(int) - QColor(colour).getRgb()[:3]).max(axis=-1) < near).sum())


# Back to the bigram


@pytest.mark.parametrize(
    ("pose", "t", "pair"), [("FV", 0.19, ("ah", "f")), ("FV", 0.26, ("f", "ah")), ("PBM", 0.47, ("bmp", "d"))]
)
def test_a_click_in_a_row_names_the_bigram_that_won_there(overlay, qtbot, pose, t, pair):
    picked = heard(overlay.bigram_picked)
    qtbot.mouseClick(overlay, LEFT, PLAIN, place(overlay, pose, t))
    ((index, time, where),) = picked
    assert overlay._stages.schedule.pairs()[index] == pair
    assert where == pose
    assert time == pytest.approx(t, abs=pixel(overlay))
    assert index == overlay._stages.winner(pose, time)


def test_a_drag_across_a_row_opens_nothing(overlay):
    picked = heard(overlay.bigram_picked)
    drag(overlay, place(overlay, "open", 0.2), place(overlay, "open", 0.4))
    assert picked == []


def test_a_click_on_a_name_activates_the_pose(overlay, qtbot):
    chosen = heard(overlay.pose_activated)
    row = overlay.row_of("PBM")
    qtbot.mouseClick(overlay, LEFT, PLAIN, QPoint(30, row.top + 5))
    assert chosen == [("PBM",)]


def test_the_active_row_is_the_tall_one(overlay):
    tall = overlay.row_of("open").height
    overlay.set_active_pose("FV")
    assert overlay.row_of("FV").height == tall > 2 * overlay.row_of("open").height


# Scrubbing, looping, zooming


def test_a_press_in_the_time_row_scrubs_at_once_and_the_release_ends_it(overlay):
    scrubbed, finished = heard(overlay.scrubbed), heard(overlay.scrub_finished)
    drag(overlay, time_row(overlay, 0.1), time_row(overlay, 0.7))
    times = [t for (t,) in scrubbed]
    assert times[0] == pytest.approx(0.1, abs=pixel(overlay))
    assert times == sorted(times)
    assert len(times) == 7
    assert finished == [(times[-1],)]
    assert times[-1] == pytest.approx(0.7, abs=pixel(overlay))


def test_scrubbing_beyond_the_end_stays_in_the_utterance(overlay):
    scrubbed = heard(overlay.scrubbed)
    drag(overlay, time_row(overlay, 0.5), QPoint(5000, time_row(overlay, 0.5).y()))
    assert scrubbed[-1] == (overlay.axis.end,)


def test_a_drag_in_the_phoneme_row_scrubs_too_and_a_click_goes_to_the_phones_start(overlay, qtbot):
    scrubbed, finished = heard(overlay.scrubbed), heard(overlay.scrub_finished)
    drag(overlay, time_row(overlay, 0.1, row=1), time_row(overlay, 0.5, row=1))
    assert scrubbed[-1][0] == pytest.approx(0.5, abs=pixel(overlay))
    assert len(finished) == 1
    qtbot.mouseClick(overlay, LEFT, PLAIN, time_row(overlay, 0.37, row=1))
    assert scrubbed[-1] == finished[-1] == (pytest.approx(0.3),)


def test_shift_drag_in_the_time_row_wishes_a_loop_and_leaves_the_old_one_until_it_is_granted(overlay):
    overlay.set_loop_range((0.0, 0.1))
    wished, scrubbed = heard(overlay.loop_range_changed), heard(overlay.scrubbed)
    drag(overlay, time_row(overlay, 0.6), time_row(overlay, 0.2), keys=SHIFT)
    ((loop,),) = wished
    assert loop == pytest.approx((0.2, 0.6), abs=pixel(overlay))
    assert scrubbed == []
    assert overlay._loop == (0.0, 0.1)
    drag(overlay, time_row(overlay, 0.6), time_row(overlay, 0.6), keys=SHIFT)
    assert wished[-1] == (None,)


def test_escape_gives_a_loop_drag_up(overlay, qtbot):
    wished = heard(overlay.loop_range_changed)
    mouse(overlay, QEvent.Type.MouseButtonPress, time_row(overlay, 0.2), keys=SHIFT)
    mouse(overlay, QEvent.Type.MouseMove, time_row(overlay, 0.5), keys=SHIFT)
    assert overlay._loop is not None
    qtbot.keyClick(overlay, Qt.Key.Key_Escape)
    mouse(overlay, QEvent.Type.MouseButtonRelease, time_row(overlay, 0.5), keys=SHIFT)
    assert overlay._loop is None
    assert wished == []


def test_the_wheel_zooms_about_the_mouse_and_with_shift_pans(overlay):
    at = place(overlay, "open", 0.3)
    wheel(overlay, at, 480)
    assert overlay.axis.span < 0.5
    assert overlay.axis.px(0.3) == pytest.approx(at.x(), abs=1)
    left = overlay.axis.left
    wheel(overlay, at, 120, keys=SHIFT)
    assert overlay.axis.left < left
    wheel(overlay, at, -2400)
    assert overlay.axis.is_fitted


def test_middle_drag_pans(overlay):
    wheel(overlay, place(overlay, "open", 0.4), 720)
    at = place(overlay, "open", 0.4)
    drag(overlay, at, at + QPoint(80, 0), button=MIDDLE)
    assert overlay.axis.px(0.4) == pytest.approx(at.x() + 80, abs=1)


def test_double_click_on_the_time_row_and_home_show_everything(overlay, qtbot):
    overlay._set_axis(overlay.axis.zoomed(5, 0.4))
    qtbot.mouseDClick(overlay, LEFT, PLAIN, time_row(overlay, 0.4))
    assert overlay.axis.is_fitted
    overlay._set_axis(overlay.axis.zoomed(5, 0.4))
    qtbot.keyClick(overlay, Qt.Key.Key_Home)
    assert overlay.axis.is_fitted


# Keyboard


def test_arrows_step_through_the_phones(overlay, qtbot):
    overlay.scrubbed.connect(overlay.set_playhead)
    scrubbed = heard(overlay.scrubbed)
    for key in (Qt.Key.Key_Right, Qt.Key.Key_Right, Qt.Key.Key_Left, Qt.Key.Key_Left, Qt.Key.Key_Left):
        qtbot.keyClick(overlay, key)
    assert [t for (t,) in scrubbed] == pytest.approx([0.1, 0.2, 0.1, 0.0, 0.0])


def test_enter_opens_the_bigram_under_the_playhead(overlay, qtbot):
    overlay.set_active_pose("FV")
    overlay.set_playhead(0.19)
    picked = heard(overlay.bigram_picked)
    qtbot.keyClick(overlay, Qt.Key.Key_Return)
    assert picked == [(1, 0.19, "FV")]


def test_up_and_down_walk_the_poses_and_plus_and_minus_zoom(overlay, qtbot):
    chosen = heard(overlay.pose_activated)
    qtbot.keyClick(overlay, Qt.Key.Key_Down)
    qtbot.keyClick(overlay, Qt.Key.Key_Up)
    assert chosen == [("W",), ("open",)]
    overlay.set_playhead(0.2)
    qtbot.keyClick(overlay, Qt.Key.Key_Plus)
    assert not overlay.axis.is_fitted
    assert overlay.axis.sees(0.2)
    qtbot.keyClick(overlay, Qt.Key.Key_Minus)
    assert overlay.axis.is_fitted


def test_other_keys_are_left_to_the_window(overlay, qtbot):
    from PySide6.QtWidgets import QWidget

    class Window(QWidget):
        keys = ()

        def keyPressEvent(self, event):
            self.keys += (event.key(),)

    window = Window()
    qtbot.addWidget(window)
    overlay.setParent(window)
    qtbot.keyClick(overlay, Qt.Key.Key_Space)
    qtbot.keyClick(overlay, Qt.Key.Key_Right)
    assert window.keys == (Qt.Key.Key_Space,)
    overlay.setParent(None)


# What is drawn


def cached(overlay):
    overlay.grab()
    return {row.pose: overlay.row_pixmap(row).cacheKey() for row in overlay.rows}


def test_only_the_rows_that_an_edit_changed_are_drawn_anew(overlay):
    curves = curve_set()
    more = Curve.of([(0, 0), (0.3, 0.9), (0.6, 0.7), (1, 0)])
    edited = curves.with_bigram(("ah", "f"), curves.bigrams["ah", "f"].with_curve("FV", more))
    before = cached(overlay)
    overlay.set_stages(sentence())
    assert cached(overlay) == before
    overlay.set_stages(sentence(curves=edited))
    after = cached(overlay)
    # FV itself, and `open`, which gives way to it
    assert {pose for pose in before if before[pose] != after[pose]} == {"FV", "open"}


def test_the_open_bigram_the_loop_and_the_playhead_draw_no_row_anew(overlay):
    before = cached(overlay)
    overlay.set_current(1, ("ah", "f"))
    overlay.set_loop_range((0.1, 0.3))
    overlay.set_playhead(0.4)
    overlay.set_source_phones(["sil", "ae", "f", "ah", "p", "t", "l", "ow", "sil"])
    assert cached(overlay) == before


def test_moving_the_playhead_repaints_narrow_strips_only(qtbot):
    regions = []

    class Watched(StageOverlay):
        def paintEvent(self, event):
            regions.append(event.region())
            super().paintEvent(event)

    overlay = Watched()
    overlay.resize(1200, 300)
    qtbot.addWidget(overlay)
    overlay.set_stages(sentence())
    with qtbot.waitExposed(overlay):
        overlay.show()
    QApplication.processEvents()
    overlay.set_playhead(0.2)
    QApplication.processEvents()
    regions.clear()
    overlay.set_playhead(0.7)
    qtbot.waitUntil(lambda: bool(regions))
    (region,) = regions
    old, new = (round(overlay.axis.px(t)) for t in (0.2, 0.7))
    for x in (old, new):
        assert region.contains(QPoint(x, 150))
        assert not region.contains(QPoint(x + 2, 150))
    assert not region.contains(QPoint((old + new) // 2, 150))
    image = overlay.grab().toImage()
    assert image.pixelColor(new, 150) == theme.PLAYHEAD
    assert image.pixelColor(old, 150) != theme.PLAYHEAD


@pytest.mark.parametrize("stage", ["red", "blue", "yellow", "magenta"])
def test_each_stage_is_seen_in_its_colour_when_it_is_on(overlay, stage):
    colour = theme.STAGE_STYLES[stage].colour
    overlay.set_shown([])
    without = count(overlay, colour)
    overlay.set_shown([stage])
    assert count(overlay, colour) > without + 20


def test_a_stage_that_changed_nothing_is_not_drawn(overlay):
    stages = run(schedule("ah f"), curve_set())
    overlay.set_stages(stages)
    assert np.array_equal(stages.blue["FV"].v, stages.yellow["FV"].v)
    overlay.set_shown(["yellow", "cyan"])
    row = overlay.row_of("FV")
    assert count(overlay, theme.STAGE_STYLES["yellow"].colour, rect=row) == 0
    assert count(overlay, theme.STAGE_STYLES["cyan"].colour, rect=row) == 0


def test_cyan_shows_where_a_pose_gave_way(overlay):
    overlay.set_shown(["cyan"])
    assert count(overlay, theme.STAGE_STYLES["cyan"].colour, rect=overlay.row_of("open")) > 10
    assert count(overlay, theme.STAGE_STYLES["cyan"].colour, rect=overlay.row_of("FV")) == 0


def test_the_safe_palette_replaces_the_colours(overlay):
    safe = theme.STAGE_STYLES_CVD["blue"].colour
    overlay.set_shown(["blue"])
    before = count(overlay, safe, near=12)
    overlay.set_palette_safe(True)
    assert count(overlay, safe, near=12) > before + 20


def test_the_final_curve_stands_out(overlay):
    overlay.clearFocus()  # the focus ring is blue, too
    magenta = count(overlay, theme.STAGE_STYLES["magenta"].colour)
    assert magenta > 2 * count(overlay, theme.STAGE_STYLES["red"].colour)
    assert magenta > 2 * count(overlay, theme.STAGE_STYLES["blue"].colour)


def test_the_ghost_is_grey_and_goes_again(overlay):
    plain = count(overlay, theme.MUTED, near=14)
    overlay.set_ghost(sentence(curves=curve_set(height=0.4)))
    assert count(overlay, theme.MUTED, near=14) > plain + 50
    overlay.set_ghost(None)
    assert count(overlay, theme.MUTED, near=14) == plain


def test_every_occurrence_of_the_open_bigram_is_tinted(overlay):
    overlay.set_stages(sentence("ah f d ah f d"))

    def ground(t):
        return overlay.grab().toImage().pixelColor(round(overlay.axis.px(t)) + 3, 2).name()

    plain = ground(0.05)
    overlay.set_current(0, ("ah", "f"))
    assert ground(0.05) != plain
    assert ground(0.35) not in {plain, ground(0.05)}
    assert ground(0.25) == plain
    overlay.set_current(None, None)
    assert ground(0.05) == ground(0.35) == plain


# Reading


def test_the_mouse_reads_the_place_and_leaving_ends_it(overlay, qtbot):
    readings = heard(overlay.read_out)
    qtbot.mouseMove(overlay, place(overlay, "FV", 0.19))
    ((reading,),) = readings
    assert reading.pose == "FV"
    assert reading.pair == ("ah", "f")
    assert reading.values[-1] == pytest.approx(float(overlay._stages.magenta["FV"].at(np.array(reading.time))))
    QApplication.sendEvent(overlay, QEvent(QEvent.Type.Leave))
    assert readings[-1] == (None,)


def test_an_edit_under_the_resting_mouse_is_read_anew(overlay, qtbot):
    qtbot.mouseMove(overlay, place(overlay, "FV", 0.3))  # the test before may have left it at the very place
    qtbot.mouseMove(overlay, place(overlay, "FV", 0.19))
    readings = heard(overlay.read_out)
    overlay.set_stages(sentence(curves=curve_set(height=0.4)))
    assert readings[-1][0].values[-1] < 0.41
    overlay.set_stages(None)
    assert readings[-1] == (None,)


def test_tooltips_explain_poses_phones_and_what_has_no_room(overlay, qtbot):
    overlay.set_source_phones(["sil", "ae", "f", "ah", "p", "t", "l", "ow", "sil"])

    def tip(at):
        QApplication.sendEvent(overlay, QHelpEvent(QEvent.Type.ToolTip, at, overlay.mapToGlobal(at)))
        return QToolTip.text()

    assert "lips sealed" in tip(QPoint(30, overlay.row_of("PBM").top + 5))
    assert "ae → ah" in tip(time_row(overlay, 0.15, row=1))
    overlay.resize(900, 140)
    assert "tTeeth" in tip(QPoint(20, overlay.rows_height + 5))
    QToolTip.hideText()


# Following


def test_a_zoomed_view_turns_the_page_with_the_playhead_only_while_following(overlay):
    overlay._set_axis(overlay.axis.zoomed(4, 0.0))
    overlay.set_playhead(0.5)
    assert not overlay.axis.sees(0.5)
    overlay.set_following(True)
    overlay.set_playhead(0.5)
    assert overlay.axis.sees(0.5)


def test_opening_a_bigram_out_of_sight_brings_it_into_view(overlay):
    overlay._set_axis(overlay.axis.zoomed(4, 0.0))
    overlay.set_current(6, ("l", "ow"))
    assert overlay.axis.sees(0.6)
    assert overlay.axis.sees(0.8)


def test_opening_a_bigram_at_the_edge_of_the_view_moves_nothing(overlay):
    overlay._set_axis(overlay.axis.at(0.25, 0.3))
    before = overlay.axis
    overlay.set_current(1, ("ah", "f"))
    assert overlay.axis == before


# Odd utterances and sizes


def test_without_a_sentence_a_hint_is_shown_and_nothing_can_be_clicked(overlay, qtbot):
    said = [
        heard(s) for s in (overlay.bigram_picked, overlay.scrubbed, overlay.pose_activated, overlay.loop_range_changed)
    ]
    for empty in (None, run(Schedule([], []), curve_set())):
        overlay.set_stages(empty)
        assert count(overlay, theme.MUTED, near=60) > 100
        for at in (QPoint(600, 50), QPoint(600, 280), QPoint(20, 20)):
            qtbot.mouseClick(overlay, LEFT, PLAIN, at)
            wheel(overlay, at, 120)
        for key in (Qt.Key.Key_Left, Qt.Key.Key_Return, Qt.Key.Key_Plus, Qt.Key.Key_Home):
            qtbot.keyClick(overlay, key)
    assert said == [[], [], [], []]


@pytest.mark.parametrize("phones", ["ah", "sil", "sil sil sil", "ah f"])
def test_tiny_utterances_are_drawn_and_take_every_gesture(overlay, qtbot, phones):
    overlay.set_stages(sentence(phones))
    overlay.set_current(0, ("ah", "f"))
    overlay.grab()
    picked = heard(overlay.bigram_picked)
    qtbot.mouseClick(overlay, LEFT, PLAIN, place(overlay, "open", 0.05))
    assert len(picked) == (1 if " " in phones else 0)
    wheel(overlay, place(overlay, "open", 0.05), 1200)
    qtbot.keyClick(overlay, Qt.Key.Key_Right)
    overlay.grab()


def test_a_thousand_phones_are_drawn_whole_and_near(overlay):
    stages = sentence(" ".join(["ah f d ow bmp"] * 200))
    overlay.set_stages(stages)
    magenta = theme.STAGE_STYLES["magenta"].colour
    assert count(overlay, magenta, near=90) > 1000
    overlay._set_axis(overlay.axis.at(50.0, 0.5))
    assert count(overlay, magenta) > 200
    assert overlay.axis.sees(50.2)


def test_no_curves_at_all_leave_flat_rows(overlay):
    overlay.set_stages(run(schedule("ah f d"), CurveSet()))
    assert all(row.idle for row in overlay.rows)
    assert count(overlay, theme.STAGE_STYLES["magenta"].colour) == 0
    overlay.set_stages(run(schedule("ah f d"), CurveSet(poses=())))
    overlay.grab()


@pytest.mark.parametrize(("width", "height", "least"), [(1600, 300, 9), (900, 166, 4), (300, 120, 2), (60, 120, 1)])
def test_rows_that_have_no_room_are_left_out_and_the_rest_stays_legible(overlay, width, height, least):
    overlay.resize(width, height)
    assert len(overlay.rows) >= least
    assert overlay.row_of("open") is not None
    assert min(row.height for row in overlay.rows) >= 13
    assert overlay.rows[-1].bottom == overlay.rows_height
    overlay.grab()


names = st.lists(st.sampled_from(["ah", "bmp", "kg", "l", "sil", "tTeeth"]), min_size=1, max_size=40)


@given(names, st.data())
def test_phone_labels_never_overlap(qapp, names, data):
    widths = data.draw(st.lists(st.floats(0.5, 90), min_size=len(names), max_size=len(names)))
    x = np.concatenate(([100.0], 100.0 + np.cumsum(widths)))
    metrics, small = QFontMetricsF(theme.font(9)), QFontMetricsF(theme.font(7))
    labels = fit_labels(names, ["hh"] * len(names), x, 7, metrics, small)
    assert all(b.x >= a.x + a.width for a, b in pairwise(labels))
    assert all(label.text == names[label.phone - 7] for label in labels)
    if min(widths) > 80:
        assert [label.text for label in labels] == names
        assert {label.small for label in labels} == {"hh"}


def test_it_introduces_itself(overlay):
    assert overlay.accessibleName()
    assert "Enter" in overlay.accessibleDescription()
    assert overlay.focusPolicy() == Qt.FocusPolicy.StrongFocus
