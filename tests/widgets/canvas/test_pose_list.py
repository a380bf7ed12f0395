"""The list of poses: picks, and wishes about eyes and locks; shows only what it is told."""

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QKeyEvent

from core_pipeline.poses import FACEFX, MEANING
from widgets import theme
from widgets.canvas.pose_list import EYE, LOCK, NAME, SOLO, PoseList

ROLE = Qt.ItemDataRole.AccessibleTextRole


@pytest.fixture
def poses(qtbot):
    widget = PoseList()
    qtbot.addWidget(widget)
    widget.set_poses(FACEFX, MEANING)
    widget.set_drawn({"open", "FV"})
    widget.set_active("FV")
    widget.resize(widget.sizeHint())
    widget.show()
    return widget


@pytest.fixture
def wishes(poses):
    said = []
    poses.pose_picked.connect(lambda pose: said.append(("pick", pose)))
    poses.visibility_changed.connect(lambda pose, on: said.append(("eye", pose, on)))
    poses.lock_changed.connect(lambda pose, on: said.append(("lock", pose, on)))
    return said


def place(poses, row, column) -> QPoint:
    return poses.visualRect(poses.model().index(row, column)).center()


def click(qtbot, poses, pose, column):
    at = place(poses, FACEFX.index(pose), column)
    qtbot.mouseClick(poses.viewport(), Qt.MouseButton.LeftButton, pos=at)


def test_a_click_on_a_name_picks_the_pose(qtbot, poses, wishes):
    click(qtbot, poses, "PBM", NAME)
    assert wishes == [("pick", "PBM")]


def test_a_click_on_an_eye_or_a_lock_wishes_only_that(qtbot, poses, wishes):
    click(qtbot, poses, "PBM", EYE)
    click(qtbot, poses, "open", LOCK)
    assert wishes == [("eye", "PBM", False), ("lock", "open", True)]
    assert poses.currentItem().text(NAME) == "FV"


def test_the_list_shows_what_it_is_told_and_not_what_was_wished(qtbot, poses, wishes):
    row = poses.topLevelItem(FACEFX.index("PBM"))
    click(qtbot, poses, "PBM", EYE)
    assert row.data(EYE, ROLE) == "PBM visible"
    poses.set_visible_poses(set(FACEFX) - {"PBM"})
    poses.set_locked({"PBM"})
    assert row.data(EYE, ROLE) == "PBM hidden"
    assert row.data(LOCK, ROLE) == "PBM locked"
    click(qtbot, poses, "PBM", EYE)
    click(qtbot, poses, "PBM", LOCK)
    assert wishes == [("eye", "PBM", False), ("eye", "PBM", True), ("lock", "PBM", False)]


def test_a_value_from_outside_is_not_answered_with_a_wish(poses, wishes):
    poses.set_active("wide")
    poses.set_drawn({"wide"})
    poses.set_poses(("open", "wide"))
    assert poses.currentItem().text(NAME) == "wide"
    poses.set_active("")
    assert poses.currentItem() is None
    assert not wishes


def test_the_keyboard_picks_hides_and_locks(qtbot, poses, wishes):
    qtbot.keyClick(poses, Qt.Key.Key_Down)
    qtbot.keyClick(poses, Qt.Key.Key_V)
    qtbot.keyClick(poses, Qt.Key.Key_L)
    assert wishes == [("pick", "wide"), ("eye", "wide", False), ("lock", "wide", True)]


def test_space_is_left_to_the_window(poses):
    event = QKeyEvent(QKeyEvent.Type.KeyPress, Qt.Key.Key_Space, Qt.KeyboardModifier.NoModifier)
    event.accept()
    poses.keyPressEvent(event)
    assert not event.isAccepted()


def test_poses_without_a_curve_are_dimmed(poses):
    colours = {pose: poses.topLevelItem(i).foreground(NAME).color() for i, pose in enumerate(FACEFX)}
    assert {pose for pose, colour in colours.items() if colour == theme.TEXT} == {"open", "FV"}
    assert {colour.name() for pose, colour in colours.items() if pose not in {"open", "FV"}} == {theme.FAINT.name()}


def test_every_row_can_be_read_out(poses):
    row = poses.topLevelItem(FACEFX.index("PBM"))
    assert poses.accessibleName()
    assert row.data(NAME, ROLE) == "PBM, no curve, visible, unlocked"
    assert row.toolTip(NAME) == "PBM: lips sealed"


def test_all_poses_fit_without_scrolling(poses):
    assert not poses.verticalScrollBar().isVisible()
    assert poses.visualRect(poses.model().index(len(FACEFX) - 1, NAME)).bottom() < poses.viewport().height()


def test_solo_wishes_one_pose_alone_and_again_all(qtbot, poses):
    said = []
    poses.solo_wanted.connect(said.append)
    poses.solo_wanted.connect(poses.set_solo)
    click(qtbot, poses, "PBM", SOLO)
    row = poses.topLevelItem(FACEFX.index("PBM"))
    assert row.data(SOLO, ROLE) == "PBM solo"
    assert row.data(NAME, ROLE) == "PBM, no curve, visible, unlocked, solo"
    click(qtbot, poses, "open", SOLO)
    click(qtbot, poses, "open", SOLO)
    assert said == [{"PBM"}, {"open"}, set()]
    assert poses.currentItem().text(NAME) == "FV"


def test_shift_puts_a_pose_beside_the_ones_that_are_solo(qtbot, poses):
    said = []
    poses.solo_wanted.connect(said.append)
    poses.set_solo({"PBM"})
    at = place(poses, FACEFX.index("open"), SOLO)
    qtbot.mouseClick(poses.viewport(), Qt.MouseButton.LeftButton, Qt.KeyboardModifier.ShiftModifier, at)
    at = place(poses, FACEFX.index("PBM"), SOLO)
    qtbot.mouseClick(poses.viewport(), Qt.MouseButton.LeftButton, Qt.KeyboardModifier.ShiftModifier, at)
    assert said == [{"PBM", "open"}, set()]


def test_s_makes_the_current_pose_solo(qtbot, poses):
    with qtbot.waitSignal(poses.solo_wanted) as wish:
        qtbot.keyClick(poses, Qt.Key.Key_S)
    assert wish.args == [{"FV"}]


def test_names_are_whole_in_the_list_s_own_size(poses):
    names = ("mouth open", "tongue up", "tongue back")
    poses.set_poses(names)
    poses.resize(poses.sizeHint())
    longest = max(poses.fontMetrics().horizontalAdvance(name) for name in names)
    assert poses.columnWidth(NAME) >= longest + poses.iconSize().width()
    poses.set_poses(("x" * 500,))
    assert poses.sizeHint().width() < 300
