"""The mapping panel: what makes each pose, said plainly, and one wish for every step of the hand."""

import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QAbstractButton, QAbstractSpinBox, QApplication, QComboBox, QListWidget, QSlider

from core_pipeline.faces.mapping_json import MAX_AMOUNT
from tests.helpers import mouse
from widgets.preview.mapping_panel import REFERENCE, MappingPanel
from widgets.preview.mix_table import other_side
from widgets.wrapped_label import WrappedLabel

# the offscreen platform has no window manager to talk to
pytestmark = pytest.mark.qt_log_ignore("This plugin does not support")

SHAPES = ("jawOpen", "mouthPucker", "mouthSmileLeft", "mouthSmileRight", "tongueOut")
POSES = ("open", "wide", "tBack")
MIXES = {"open": {"jawOpen": 0.9}, "wide": {"mouthSmileLeft": 0.35, "mouthSmileRight": 0.35}}
PRESETS = (("arkit52", "ARKit-52"), ("facefx", "FaceFX"))


@pytest.fixture
def panel(qtbot):
    panel = MappingPanel()
    qtbot.addWidget(panel)
    panel.resize(380, 420)
    panel.set_rig("head.glb", SHAPES, POSES, MIXES, PRESETS, "arkit52", ("The rig was made with z up.",))
    with qtbot.waitExposed(panel):
        panel.show()
    return panel


@pytest.fixture
def wishes(panel):
    seen = []
    panel.pose_shown.connect(lambda pose: seen.append(("shown", pose)))
    panel.mix_changed.connect(lambda pose, mix: seen.append((pose, mix)))
    panel.preset_chosen.connect(lambda name: seen.append(("preset", name)))
    panel.save_wanted.connect(lambda: seen.append("save"))
    panel.revert_wanted.connect(lambda: seen.append("revert"))
    return seen


def pick(qtbot, panel, pose):
    item = panel.poses.item(POSES.index(pose))
    at = panel.poses.visualItemRect(item).center()
    qtbot.mouseClick(panel.poses.viewport(), Qt.MouseButton.LeftButton, pos=at)


def rows(panel):
    return {row.shape: row for row in panel.mix.table.rows}


def texts(panel):
    return [label.text() for label in panel.findChildren(type(panel._missing)) if label.isVisible()]


def test_a_click_on_a_pose_shows_its_shapes_and_asks_for_it_on_the_face(qtbot, panel, wishes):
    pick(qtbot, panel, "wide")
    assert panel.mix.mix() == MIXES["wide"]
    assert set(wishes) == {("shown", "wide")}
    qtbot.keyClick(panel.poses, Qt.Key.Key_Up)
    assert panel.mix.mix() == MIXES["open"]
    assert wishes[-1] == ("shown", "open")


def test_a_pose_that_cannot_be_made_is_dimmed_and_says_so(qtbot, panel):
    there, gone = (panel.poses.item(POSES.index(pose)) for pose in ("open", "tBack"))
    assert gone.foreground().color().lightness() < there.foreground().color().lightness()
    role = Qt.ItemDataRole.AccessibleTextRole
    assert gone.data(role) == "tBack: not available on this face"
    assert there.data(role) == "open"
    assert "Not available on this face" not in texts(panel)
    pick(qtbot, panel, "tBack")
    assert "Not available on this face" in texts(panel)


def test_every_step_of_a_slide_is_one_wish_and_the_number_follows(panel, wishes):
    row = rows(panel)["jawOpen"]
    width = row.slider.width()
    mouse.drag(row.slider, QPointF(0.6 * width, 10), QPointF(0.2 * width, 10), steps=4)
    amounts = [mix["jawOpen"] for pose, mix in wishes]
    assert len(amounts) == 4  # taken where it was, the bar moved at every step
    assert amounts == sorted(amounts, reverse=True)
    assert amounts[-1] == pytest.approx(0.3, abs=0.02)
    assert row.amount.value() == amounts[-1] == panel.mix.mix()["jawOpen"]
    mouse.press(row.slider, QPointF(width + 50, 10))
    mouse.release(row.slider, QPointF(width + 50, 10))
    assert wishes[-1] == ("open", {"jawOpen": 1.5})


def test_keys_move_the_bar_and_a_typed_number_may_leave_it(qtbot, panel, wishes):
    row = rows(panel)["jawOpen"]
    qtbot.keyClick(row.slider, Qt.Key.Key_Right)
    assert wishes == [("open", {"jawOpen": 0.91})]
    row.amount.setFocus()
    row.amount.selectAll()
    qtbot.keyClicks(row.amount, "-0.4")
    qtbot.keyClick(row.amount, Qt.Key.Key_Return)
    assert wishes[-1] == ("open", {"jawOpen": -0.4})
    assert row.slider.value() == 0
    assert panel.mix.mix() == {"jawOpen": -0.4}


@pytest.mark.parametrize("typed", ["9", "-9"])
def test_no_number_is_too_large_for_the_file(qtbot, panel, wishes, typed):
    box = rows(panel)["jawOpen"].amount
    box.setFocus()
    box.selectAll()
    qtbot.keyClicks(box, typed)
    qtbot.keyClick(box, Qt.Key.Key_Return)
    assert all(abs(mix["jawOpen"]) <= MAX_AMOUNT for _, mix in wishes)
    assert abs(panel.mix.mix()["jawOpen"]) <= MAX_AMOUNT


def test_left_and_right_move_together_until_told_otherwise(qtbot, panel, wishes):
    pick(qtbot, panel, "wide")
    wishes.clear()
    left, right = rows(panel)["mouthSmileLeft"], rows(panel)["mouthSmileRight"]
    qtbot.keyClick(left.slider, Qt.Key.Key_PageUp)
    assert wishes == [("wide", {"mouthSmileLeft": 0.45, "mouthSmileRight": 0.45})]
    assert right.slider.amount == right.amount.value() == 0.45
    qtbot.mouseClick(panel.mix.sides, Qt.MouseButton.LeftButton, pos=panel.mix.sides.rect().center() / 4)
    assert not panel.mix.sides.isChecked()
    qtbot.keyClick(right.slider, Qt.Key.Key_Left)
    assert wishes[-1] == ("wide", {"mouthSmileLeft": 0.45, "mouthSmileRight": 0.44})


@pytest.mark.parametrize(
    ("shape", "twin"), [("a.Smile_L", "a.Smile_R"), ("purseUR", "purseUL"), ("jawOpen", None), ("mouthRollLower", None)]
)
def test_the_other_side_is_found_by_its_name(shape, twin):
    assert other_side(shape, ("a.Smile_L", "a.Smile_R", "purseUL", "purseUR", "jawOpen", "mouthRollLower")) == twin


def test_a_shape_is_searched_added_moved_and_left_out(qtbot, panel, wishes):
    pick(qtbot, panel, "tBack")
    wishes.clear()
    field = panel.mix.add.lineEdit()
    field.setFocus()
    qtbot.keyClicks(field, "TONGUE")
    qtbot.keyClick(field, Qt.Key.Key_Return)
    assert wishes == [("tBack", {"tongueOut": 0.0})]
    assert field.text() == ""
    slider = rows(panel)["tongueOut"].slider
    assert slider.hasFocus()
    assert "Not available on this face" in texts(panel)  # nothing moves yet
    qtbot.keyClick(slider, Qt.Key.Key_PageUp)
    assert wishes[-1] == ("tBack", {"tongueOut": 0.1})
    assert "Not available on this face" not in texts(panel)
    assert panel.preset.currentText() == "Own mix"
    qtbot.mouseClick(rows(panel)["tongueOut"].remove, Qt.MouseButton.LeftButton)
    assert wishes[-1] == ("tBack", {})
    assert "Not available on this face" in texts(panel)
    assert panel.mix.add.findText("tongueOut") >= 0


def test_names_that_begin_alike_are_told_apart_by_their_end(panel):
    box = panel.mix.add
    assert {names.textElideMode() for names in (box.view(), box.completer().popup())} == {Qt.TextElideMode.ElideMiddle}


def test_what_fits_no_name_adds_nothing(qtbot, panel, wishes):
    field = panel.mix.add.lineEdit()
    field.setFocus()
    qtbot.keyClicks(field, "elbow")
    qtbot.keyClick(field, Qt.Key.Key_Return)
    assert wishes == []
    qtbot.keyClick(field, Qt.Key.Key_Escape)
    assert field.text() == ""


def test_a_name_from_the_list_is_added_once(qtbot, panel, wishes):
    box = panel.mix.add
    box.setFocus()
    qtbot.keyClick(box, Qt.Key.Key_Down)
    qtbot.waitUntil(box.view().isVisible)
    assert wishes == []  # looking adds nothing
    box.view().setCurrentIndex(box.model().index(0, 0))
    qtbot.keyClick(box.view(), Qt.Key.Key_Return)
    assert wishes == [("open", {"jawOpen": 0.9, "mouthPucker": 0.0})]


def test_a_name_from_the_suggestions_is_added_once(qtbot, panel, wishes):
    box = panel.mix.add
    box.setFocus()
    qtbot.keyClicks(box, "smile")
    popup = box.completer().popup()
    qtbot.waitUntil(popup.isVisible)
    for _ in range(2):
        qtbot.keyClick(popup, Qt.Key.Key_Down)
    qtbot.keyClick(popup, Qt.Key.Key_Return)
    assert wishes == [("open", {"jawOpen": 0.9, "mouthSmileRight": 0.0})]
    assert box.currentText() == ""


def test_presets_saving_and_taking_back_are_wishes(qtbot, panel, wishes):
    panel.preset.setFocus()
    qtbot.keyClick(panel.preset, Qt.Key.Key_Down)
    assert wishes == [("preset", "facefx")]
    assert not panel.save.isEnabled()
    panel.set_changed(True)
    qtbot.mouseClick(panel.save, Qt.MouseButton.LeftButton)
    qtbot.mouseClick(panel.revert, Qt.MouseButton.LeftButton)
    assert wishes[1:] == ["save", "revert"]


def test_values_from_outside_are_silent_and_the_pose_stays(qtbot, panel, wishes):
    pick(qtbot, panel, "wide")
    wishes.clear()
    panel.set_rig("head.glb", SHAPES, POSES, {"wide": {"jawOpen": 0.2}}, PRESETS, "", ())
    assert wishes == []
    assert panel.pose == "wide"
    assert panel.mix.mix() == {"jawOpen": 0.2}
    assert panel.preset.currentText() == "Own mix"
    panel.set_rig("", (), (), {}, (), "")
    assert wishes == []
    assert panel.pose == ""


def test_our_own_characters_are_shown_but_not_changed(panel, qtbot, wishes):
    panel.set_rig("Toon", POSES, POSES, {p: {p: 1.0} for p in POSES}, PRESETS, "facefx", (), editable=False)
    panel.set_changed(True)
    row = rows(panel)["open"]
    mouse.drag(row.slider, QPointF(80, 10), QPointF(10, 10))
    assert wishes == []
    assert row.amount.value() == 1.0
    assert not any(w.isEnabled() for w in (row.amount, row.remove, panel.save, panel.revert, panel.preset))
    assert not panel.mix.add.isVisible()
    pick(qtbot, panel, "wide")
    assert ("shown", "wide") in wishes


def test_the_eye_holds_and_lets_go_and_hiding_lets_go(qtbot, panel, wishes):
    qtbot.mouseClick(panel.hold, Qt.MouseButton.LeftButton)
    assert wishes == [("shown", "open")]
    panel.set_held(False)
    assert not panel.hold.isChecked()
    panel.set_held(True)
    qtbot.mouseClick(panel.hold, Qt.MouseButton.LeftButton)
    assert wishes[-1] == ("shown", "")
    wishes.clear()
    panel.hide()
    assert wishes == [("shown", "")]


def test_the_reference_comes_and_goes(panel):
    image = QImage(2 * REFERENCE, 2 * REFERENCE, QImage.Format.Format_RGB32)
    image.fill(Qt.GlobalColor.red)
    panel.set_reference(image, "open on our face Toon")
    picture = panel.grab().toImage()
    reds = sum(picture.pixelColor(x, 100).name() == "#ff0000" for x in range(picture.width()))
    assert reds == pytest.approx(REFERENCE, abs=2)
    panel.set_reference(QImage(), "")
    assert not panel._reference.isVisible()


def test_every_control_has_a_name(qtbot, panel):
    pick(qtbot, panel, "wide")
    controls = [
        control
        for kind in (QAbstractButton, QAbstractSpinBox, QComboBox, QListWidget, QSlider)
        for control in panel.findChildren(kind)
        if control.isVisible()
    ]
    assert len(controls) >= 10
    assert [c for c in controls if not c.accessibleName()] == []


def test_it_fits_a_narrow_dock(qtbot, panel):
    panel.resize(330, 250)
    pick(qtbot, panel, "wide")
    assert panel.width() == 330
    qtbot.waitUntil(lambda: all(row.remove.width() < 50 for row in panel.mix.table.rows))  # laid out
    for row in panel.mix.table.rows:
        assert row.slider.width() >= 70
        assert row.remove.mapTo(panel, row.remove.rect().topRight()).x() < panel.width()


def test_words_about_a_pose_are_whole_at_any_width(qtbot, panel):
    picture = QImage(REFERENCE, REFERENCE, QImage.Format.Format_RGB32)
    picture.fill(0)
    panel.set_reference(picture, "Toon")
    for width in (330, 345, 420, 700, 330):
        panel.resize(width, 700)
        for row in range(panel.poses.count()):
            panel.poses.setCurrentRow(row)
            QApplication.processEvents()
            for label in panel.findChildren(WrappedLabel):
                if label.isVisible():
                    assert label.height() >= label.heightForWidth(label.width()), (width, label.text())
