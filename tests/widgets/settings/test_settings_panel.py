"""The pipeline's settings: one signal per action of the user, none for values from outside."""

from dataclasses import replace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QAbstractButton, QAbstractSpinBox, QApplication, QComboBox, QLabel, QScrollArea

from core_pipeline.poses import FACEFX
from core_pipeline.settings import Constraint, Settings
from widgets.settings.settings_panel import SettingsPanel

# the offscreen platform has no window manager to talk to
pytestmark = pytest.mark.qt_log_ignore("This plugin does not support")

PAPER = Settings.paper()


@pytest.fixture
def panel(qtbot):
    panel = SettingsPanel()
    qtbot.addWidget(panel)
    panel.resize(320, 900)
    panel.set_settings(PAPER, FACEFX)
    with qtbot.waitExposed(panel):
        panel.show()
    return panel


@pytest.fixture
def changes(panel):
    seen = []
    panel.settings_changed.connect(lambda settings, label: seen.append((settings, label)))
    return seen


def choose(qtbot, box, text):
    """Choose from a box with the keyboard."""
    box.setFocus()
    at = box.findText(text)
    step = Qt.Key.Key_Down if at > box.currentIndex() else Qt.Key.Key_Up
    for _ in range(abs(at - box.currentIndex())):
        qtbot.keyClick(box, step)
    assert box.currentText() == text


def pick(box, text):
    """Choose in one go, as from the open list."""
    box.setCurrentText(text)
    box.activated.emit(box.currentIndex())


def click(qtbot, button):
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)


def type_value(qtbot, box, text):
    box.setFocus()
    box.selectAll()
    qtbot.keyClicks(box, text)
    qtbot.keyClick(box, Qt.Key.Key_Return)


def notes(panel):
    return [label.text() for label in panel.findChildren(QLabel) if label.isVisible()]


def rows(panel):
    return panel.constraints.table.rows


def test_values_from_outside_emit_nothing(panel, changes):
    panel.set_settings(Settings.smartbody(), FACEFX)
    panel.set_settings(replace(PAPER, window=0.3, windows={}, priorities=("open", "PBM")), FACEFX[:5])
    panel.set_settings(PAPER, FACEFX)
    assert changes == []


def test_the_shown_settings_are_the_given_ones(panel):
    given = replace(Settings.smartbody(), window=0.25, windows={"W": 0.12}, spline="linear", speed_limit=9.5)
    panel.set_settings(given, FACEFX)
    assert panel.constraints.constraints() == given.constraints
    assert panel.windows.windows() == {"W": 0.12}
    assert panel.priorities.priorities() == given.priorities
    assert panel.window_width.value() == 0.25
    assert panel.speed_limit.value() == 9.5
    assert panel.spline.currentData() == "linear"


def test_a_preset_is_one_change_and_keeps_the_spline(qtbot, panel, changes):
    panel.set_settings(PAPER.with_spline("bspline"), FACEFX)
    choose(qtbot, panel.preset, "SmartBody")
    assert changes == [(Settings.smartbody().with_spline("bspline"), "Preset SmartBody")]


def test_the_preset_box_follows_the_values(panel):
    for settings, name in (
        (PAPER, "Paper"),
        (Settings.smartbody().with_spline("linear"), "SmartBody"),
        (replace(PAPER, speed_limit=3), "Custom"),
    ):
        panel.set_settings(settings, FACEFX)
        assert panel.preset.currentText() == name


def test_custom_cannot_be_chosen(qtbot, panel, changes):
    for _ in range(3):
        qtbot.keyClick(panel.preset, Qt.Key.Key_Down)
    assert panel.preset.currentText() == "SmartBody"
    assert len(changes) == 1


def test_smartbody_comes_with_a_warning(panel):
    warning = "SmartBody's speed limit of 6 keeps lips from closing in fast speech."
    assert warning not in notes(panel)
    panel.set_settings(Settings.smartbody(), FACEFX)
    assert warning in notes(panel)


def test_a_typed_speed_limit_is_one_change(qtbot, panel, changes):
    type_value(qtbot, panel.speed_limit, "12.5")
    assert changes == [(replace(PAPER, speed_limit=12.5), "Speed limit")]
    assert panel.preset.currentText() == "Custom"


def test_each_step_of_a_box_is_a_change(qtbot, panel, changes):
    qtbot.keyClick(panel.window_width, Qt.Key.Key_Up)
    qtbot.keyClick(panel.window_width, Qt.Key.Key_Up)
    assert [round(s.window, 3) for s, _ in changes] == [0.19, 0.2]
    assert {label for _, label in changes} == {"Smoothing window"}


def test_the_spline_is_one_change(qtbot, panel, changes):
    choose(qtbot, panel.spline, "B-spline, as printed")
    assert changes == [(PAPER.with_spline("bspline"), "Spline")]


def test_choosing_what_is_chosen_is_no_change(panel, changes):
    pick(panel.preset, "Paper")
    pick(panel.spline, panel.spline.currentText())
    assert changes == []


def test_a_pose_may_have_its_own_window(qtbot, panel, changes):
    click(qtbot, panel.windows.table.add)
    assert dict(changes[-1][0].windows) == {"PBM": 0.1, "FV": 0.1, "open": 0.18}
    assert changes[-1][1] == "Smoothing window of open"
    type_value(qtbot, panel.windows.table.rows[0].width_box, "0.06")
    assert changes[-1][0].windows["PBM"] == 0.06
    click(qtbot, panel.windows.table.rows[1].remove)
    assert dict(changes[-1][0].windows) == {"PBM": 0.06, "open": 0.18}
    assert len(changes) == 3


def test_two_rows_cannot_name_the_same_pose(panel):
    box = panel.windows.table.rows[0].pose
    offered = [box.itemText(i) for i in range(box.count())]
    assert "PBM" in offered
    assert "FV" not in offered


def test_a_limit_is_edited_in_its_row(qtbot, panel, changes):
    type_value(qtbot, rows(panel)[1].limit, "0.8")
    assert changes[0][0].constraints == (
        Constraint("open", "FV", 0.5),
        Constraint("open", "PBM", 0.8),
        Constraint("open", "ShCh", 0.5),
    )
    assert changes[0][1] == "Constraint of open and PBM"
    assert len(changes) == 1


def test_limits_reach_from_0_to_2(qtbot, panel, changes):
    limit = rows(panel)[0].limit
    type_value(qtbot, limit, "5")
    assert changes == []
    type_value(qtbot, limit, "2")
    type_value(qtbot, limit, "0")
    assert [settings.constraints[0].limit for settings, _ in changes] == [2.0, 0.0]


def test_rows_are_added_and_removed(qtbot, panel, changes):
    click(qtbot, panel.constraints.table.add)
    assert changes[-1] == (
        replace(PAPER, constraints=(*PAPER.constraints, Constraint("open", "W", 0.5))),
        "Add constraint",
    )
    assert len(rows(panel)) == 4
    click(qtbot, rows(panel)[0].remove)
    assert changes[-1][0].constraints == (*PAPER.constraints[1:], Constraint("open", "W", 0.5))
    assert changes[-1][1] == "Remove constraint"
    assert len(changes) == 2


def test_every_pair_can_be_constrained_but_no_more(qtbot, panel, changes):
    panel.set_settings(PAPER, ("open", "FV", "PBM", "ShCh"))
    for _ in range(3):
        assert panel.constraints.table.add.isEnabled()
        click(qtbot, panel.constraints.table.add)
    assert not panel.constraints.table.add.isEnabled()
    assert len({frozenset((c.a, c.b)) for c in changes[-1][0].constraints}) == 6


def test_all_poses_can_be_chosen_in_a_row(qtbot, panel, changes):
    row = rows(panel)[0]
    assert [row.b.itemText(i) for i in range(row.b.count())] == list(FACEFX)
    pick(row.b, "tRoof")
    assert changes[-1][0].constraints[0] == Constraint("open", "tRoof", 0.5)
    assert "open + tRoof has no effect: tRoof has no priority." in notes(panel)


def test_a_pose_against_itself_is_refused_with_a_sentence(panel, changes):
    pick(rows(panel)[0].a, "FV")
    assert panel.problem == "The pose FV is constrained against itself: name two poses."
    assert panel.problem in notes(panel)
    assert changes == []
    pick(rows(panel)[0].b, "PBM")
    assert changes[-1][0].constraints[0] == Constraint("FV", "PBM", 0.5)
    assert panel.problem == ""


def test_the_same_pair_twice_is_refused_with_a_sentence(panel, changes):
    pick(rows(panel)[0].b, "PBM")
    assert panel.problem == "The poses open and PBM stand in two rows: choose another pose in one of them."
    assert changes == []
    panel.set_settings(PAPER, FACEFX)
    assert panel.problem == ""
    assert panel.constraints.constraints() == PAPER.constraints


def test_the_field_in_use_keeps_the_focus_through_new_values(qtbot, panel, changes):
    panel.settings_changed.connect(lambda settings, _: panel.set_settings(settings, FACEFX))
    box = rows(panel)[1].limit
    box.setFocus()
    for _ in range(3):
        qtbot.keyClick(box, Qt.Key.Key_Up)
    assert box.hasFocus()
    assert rows(panel)[1].limit is box
    assert changes[-1][0].constraints[1].limit == pytest.approx(0.65)


def test_removing_the_last_row_leaves_the_focus_in_the_table(qtbot, panel):
    button = rows(panel)[-1].remove
    button.setFocus()
    qtbot.keyClick(button, Qt.Key.Key_Space)
    assert len(rows(panel)) == 2
    assert rows(panel)[-1].remove.hasFocus()


def test_finer_values_than_shown_survive_other_edits(qtbot, panel, changes):
    fine = replace(PAPER, window=0.1234, windows={"PBM": 0.0567}, constraints=(Constraint("open", "PBM", 0.333),))
    panel.set_settings(fine, FACEFX)
    click(qtbot, panel.constraints.table.add)
    click(qtbot, panel.windows.table.add)
    settings = changes[-1][0]
    assert settings.window == 0.1234
    assert settings.windows["PBM"] == 0.0567
    assert settings.constraints[0].limit == 0.333


def names(panel):
    return [panel.priorities.list.item(i).text() for i in range(panel.priorities.list.count())]


def test_priorities_stand_highest_first_the_rest_below(panel):
    assert names(panel) == ["PBM", "FV", "ShCh", "wide", "W", "open", "tBack", "tRoof", "tTeeth"]
    assert panel.priorities.list.ticked() == list(reversed(PAPER.priorities))


def drag(qtbot, panel, start, end):
    ranks = panel.priorities.list
    centre = [ranks.visualItemRect(ranks.item(i)).center() for i in range(ranks.count())]
    qtbot.mousePress(ranks.viewport(), Qt.MouseButton.LeftButton, pos=centre[start])
    step = 1 if end > start else -1
    for i in range(start, end + step, step):
        qtbot.mouseMove(ranks.viewport(), centre[i])
    qtbot.mouseRelease(ranks.viewport(), Qt.MouseButton.LeftButton, pos=centre[end])


def test_dragging_a_priority_is_one_change(qtbot, panel, changes):
    drag(qtbot, panel, 5, 1)
    assert len(changes) == 1
    assert changes[0] == (replace(PAPER, priorities=("W", "wide", "ShCh", "FV", "open", "PBM")), "Priorities")
    assert names(panel)[:3] == ["PBM", "open", "FV"]


def test_a_drag_back_to_its_place_is_no_change(qtbot, panel, changes):
    ranks = panel.priorities.list
    centre = [ranks.visualItemRect(ranks.item(i)).center() for i in range(3)]
    qtbot.mousePress(ranks.viewport(), Qt.MouseButton.LeftButton, pos=centre[0])
    for i in (1, 2, 1, 0):
        qtbot.mouseMove(ranks.viewport(), centre[i])
    qtbot.mouseRelease(ranks.viewport(), Qt.MouseButton.LeftButton, pos=centre[0])
    assert changes == []
    assert names(panel)[0] == "PBM"


def test_a_priority_cannot_be_dragged_among_the_unticked(qtbot, panel, changes):
    drag(qtbot, panel, 4, 8)
    assert changes[-1][0].priorities[0] == "W"
    assert names(panel)[6:] == ["tBack", "tRoof", "tTeeth"]


def test_alt_arrows_and_buttons_move_a_priority(qtbot, panel, changes):
    ranks = panel.priorities.list
    ranks.setCurrentRow(0)
    qtbot.keyClick(ranks, Qt.Key.Key_Up, Qt.KeyboardModifier.AltModifier)
    assert changes == []
    qtbot.keyClick(ranks, Qt.Key.Key_Down, Qt.KeyboardModifier.AltModifier)
    assert changes[-1][0].priorities[-2:] == ("PBM", "FV")
    assert ranks.currentItem().text() == "PBM"
    click(qtbot, panel.priorities.up)
    assert changes[-1][0].priorities == PAPER.priorities
    assert not panel.priorities.up.isEnabled()
    assert panel.priorities.down.isEnabled()
    assert len(changes) == 2


def test_a_tick_gives_and_takes_a_priority(qtbot, panel, changes):
    ranks = panel.priorities.list
    ranks.setCurrentRow(7)
    qtbot.keyClick(ranks, Qt.Key.Key_Space)
    assert changes[-1][0].priorities == ("tRoof", *PAPER.priorities)
    assert names(panel)[6] == "tRoof"
    ranks.setCurrentRow(0)
    qtbot.keyClick(ranks, Qt.Key.Key_Space)
    assert "PBM" not in changes[-1][0].priorities
    assert len(changes) == 2


def test_poses_that_the_face_lacks_are_kept(qtbot, panel, changes):
    panel.set_settings(PAPER, ("open", "W"))
    assert names(panel) == ["PBM", "FV", "ShCh", "wide", "W", "open"]
    type_value(qtbot, panel.speed_limit, "11")
    assert changes[-1][0] == replace(PAPER, speed_limit=11)


def test_every_control_is_named_and_reachable(panel):
    controls = [
        child
        for kind in (QComboBox, QAbstractSpinBox, QAbstractButton)
        for child in panel.findChildren(kind)
        if child.isVisible()
    ]
    assert len(controls) > 25
    for control in controls:
        assert control.accessibleName(), control
        assert control.focusPolicy() & Qt.FocusPolicy.TabFocus


@pytest.mark.parametrize("height", [400, 900])
def test_nothing_is_cut_off_in_a_narrow_dock(qtbot, panel, height):
    panel.set_settings(Settings.smartbody(), FACEFX)
    panel.resize(300, height)
    QApplication.processEvents()
    scroll = panel.findChild(QScrollArea)
    assert scroll.widget().width() <= scroll.viewport().width()
    for row in rows(panel):
        assert row.remove.geometry().right() < row.width()
        assert row.limit.width() >= row.fontMetrics().horizontalAdvance("0.00") + 20
