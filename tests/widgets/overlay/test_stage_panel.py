"""The bottom dock: switching stages, reading places, choosing the view."""

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QApplication, QComboBox, QToolButton

from core_pipeline.curve_set import CurveSet
from core_pipeline.pipeline import run
from tests.helpers.stages import curve_set, schedule, sentence
from widgets import theme
from widgets.overlay.stage_layers import LAYERS
from widgets.overlay.stage_panel import StagePanel

LEFT, RIGHT, PLAIN, ALT = (
    Qt.MouseButton.LeftButton,
    Qt.MouseButton.RightButton,
    Qt.KeyboardModifier.NoModifier,
    Qt.KeyboardModifier.AltModifier,
)
ALL = {layer.name for layer in LAYERS}
FIRST = {layer.name for layer in LAYERS if layer.default_on}


@pytest.fixture
def panel(qtbot):
    panel = StagePanel()
    panel.resize(1600, 330)
    qtbot.addWidget(panel)
    panel.set_stages(sentence())
    panel.set_active_pose("open")
    with qtbot.waitExposed(panel):
        panel.show()
    return panel


def chip(panel, name):
    return next(chip for chip in panel.chips if chip.name == name)


def heard(signal):
    said = []
    signal.connect(lambda *values: said.append(values))
    return said


def place(panel, pose, t):
    row = panel.overlay.row_of(pose)
    return QPoint(round(panel.overlay.axis.px(t)), row.top + row.height // 2)


def test_chips_stand_in_pipeline_order_and_say_the_papers_steps(panel):
    assert [c.text() for c in panel.chips] == [style.label for style in theme.STAGE_STYLES.values()]
    assert panel.shown() == FIRST
    assert panel.overlay._shown == FIRST


def test_a_click_switches_a_stage(panel, qtbot):
    qtbot.mouseClick(chip(panel, "blue"), LEFT)
    assert panel.overlay._shown == panel.shown() == FIRST - {"blue"}
    qtbot.mouseClick(chip(panel, "blue"), LEFT)
    assert panel.overlay._shown == FIRST


@pytest.mark.parametrize("number", range(1, 7))
def test_alt_and_a_number_switch_a_stage(panel, qtbot, number):
    panel.activateWindow()
    qtbot.waitUntil(panel.isActiveWindow)
    before = panel.shown()
    qtbot.keyClick(panel.overlay, Qt.Key(Qt.Key.Key_0 + number), ALT)
    qtbot.waitUntil(lambda: panel.shown() ^ before == {LAYERS[number - 1].name})


def test_a_right_click_shows_one_stage_alone_and_again_all_as_before(panel, qtbot):
    qtbot.mouseClick(chip(panel, "yellow"), LEFT)
    before = panel.shown()
    qtbot.mouseClick(chip(panel, "cyan"), RIGHT)
    assert panel.overlay._shown == panel.shown() == {"cyan"}
    qtbot.mouseClick(chip(panel, "cyan"), RIGHT)
    assert panel.overlay._shown == panel.shown() == before


@pytest.mark.parametrize("number", range(1, 7))
def test_shift_alt_and_a_number_show_one_stage_alone_and_again_all_as_before(panel, qtbot, number):
    panel.activateWindow()
    qtbot.waitUntil(panel.isActiveWindow)
    for shown in ({LAYERS[number - 1].name}, FIRST):
        qtbot.keyClick(panel.overlay, Qt.Key(Qt.Key.Key_0 + number), ALT | Qt.KeyboardModifier.ShiftModifier)
        qtbot.waitUntil(lambda shown=shown: panel.overlay._shown == panel.shown() == shown)


def test_alt_click_and_s_show_one_stage_alone_too(panel, qtbot):
    qtbot.mouseClick(chip(panel, "blue"), LEFT, ALT)
    assert panel.overlay._shown == panel.shown() == {"blue"}
    qtbot.keyClick(chip(panel, "red"), Qt.Key.Key_S)
    assert panel.overlay._shown == panel.shown() == {"red"}
    qtbot.keyClick(chip(panel, "red"), Qt.Key.Key_S)
    assert panel.shown() == FIRST
    qtbot.keyClick(chip(panel, "red"), Qt.Key.Key_Space)
    assert panel.shown() == FIRST - {"red"}


def test_a_stage_that_was_off_can_be_alone_and_what_was_shown_comes_back(panel, qtbot):
    qtbot.mouseClick(chip(panel, "green"), RIGHT)
    assert panel.shown() == {"green"}
    qtbot.mouseClick(chip(panel, "green"), RIGHT)
    assert panel.shown() == FIRST


def test_alone_may_pass_from_one_stage_to_another(panel, qtbot):
    qtbot.mouseClick(chip(panel, "blue"), RIGHT)
    qtbot.mouseClick(chip(panel, "cyan"), RIGHT)
    assert panel.shown() == {"cyan"}
    qtbot.mouseClick(chip(panel, "cyan"), RIGHT)
    assert panel.shown() == FIRST


def test_a_double_click_shows_one_stage_alone(panel, qtbot):
    target = chip(panel, "magenta")
    qtbot.mouseClick(target, LEFT)
    qtbot.mouseDClick(target, LEFT)
    assert panel.overlay._shown == panel.shown() == {"magenta"}
    qtbot.mouseClick(target, LEFT)
    qtbot.mouseDClick(target, LEFT)
    assert panel.overlay._shown == panel.shown() == FIRST


def test_the_only_stage_alone_brings_back_all(panel, qtbot):
    for name in FIRST - {"magenta"}:
        qtbot.mouseClick(chip(panel, name), LEFT)
    qtbot.mouseClick(chip(panel, "magenta"), RIGHT)
    assert panel.overlay._shown == panel.shown() == ALL


def test_wishes_pass_through(panel, qtbot):
    picked, chosen = heard(panel.bigram_picked), heard(panel.pose_activated)
    scrubbed, finished, loops = heard(panel.scrubbed), heard(panel.scrub_finished), heard(panel.loop_range_changed)
    overlay = panel.overlay
    qtbot.mouseClick(overlay, LEFT, PLAIN, place(panel, "FV", 0.19))
    qtbot.mouseClick(overlay, LEFT, PLAIN, QPoint(30, overlay.row_of("FV").top + 4))
    foot = QPoint(round(overlay.axis.px(0.4)), overlay.rows_height + 6)
    qtbot.mouseClick(overlay, LEFT, PLAIN, foot)
    qtbot.mouseClick(overlay, LEFT, Qt.KeyboardModifier.ShiftModifier, foot)
    assert [picked[0][0], picked[0][2]] == [1, "FV"]
    assert chosen == [("FV",)]
    assert scrubbed == finished == [(pytest.approx(0.4, abs=0.002),)]
    assert loops == [(None,)]


def test_the_reading_tells_the_steps_and_where_they_come_from(panel, qtbot):
    texts = heard(panel.hovered)
    qtbot.mouseMove(panel.overlay, place(panel, "open", 0.25))
    ((text,),) = texts
    assert text.startswith("t 0.25 s  open  stitched 0.")
    assert " → " in text
    assert text.endswith("(click to open)")
    assert "from F–Ah" in text or "from Ah–" in text
    assert "<b>" in panel.reading.text()
    qtbot.mouseMove(panel.overlay, QPoint(20, 5))
    assert texts[-1] == ("",)
    assert not panel.reading.text()


def test_a_pose_at_rest_claims_no_origin(panel, qtbot):
    panel.set_stages(run(schedule("ah f d"), CurveSet()))
    texts = heard(panel.hovered)
    qtbot.mouseMove(panel.overlay, place(panel, "open", 0.1))
    assert "open  at rest  Ah–F (click to open)" in texts[-1][0]


def test_the_mode_box_chooses_the_rows(panel):
    box = panel.findChild(QComboBox)
    assert [box.itemText(i) for i in range(3)] == ["Focus + context", "All poses", "One pose"]
    assert len(panel.overlay.rows) == 9
    assert panel.overlay.row_of("open").height > 60
    box.setCurrentIndex(1)
    assert len({row.height for row in panel.overlay.rows}) <= 2
    box.setCurrentIndex(2)
    assert [row.pose for row in panel.overlay.rows] == ["open"]
    panel.set_active_pose("FV")
    assert [row.pose for row in panel.overlay.rows] == ["FV"]


def test_a_narrow_panel_keeps_the_samples_and_a_short_reading(panel, qtbot):
    assert all(c.toolButtonStyle() == Qt.ToolButtonStyle.ToolButtonTextBesideIcon for c in panel.chips)
    panel.resize(900, 200)
    QApplication.processEvents()
    assert panel.width() == 900
    assert all(c.toolButtonStyle() == Qt.ToolButtonStyle.ToolButtonIconOnly for c in panel.chips)
    assert all(c.accessibleName() and c.toolTip() for c in panel.chips)
    panel.resize(560, 200)
    QApplication.processEvents()
    qtbot.mouseMove(panel.overlay, place(panel, "open", 0.25))
    assert "click" not in panel.reading.text()
    assert "–Ah" in panel.reading.text() or "Ah–" in panel.reading.text()


def test_the_safe_palette_reaches_the_chips(panel):
    before = chip(panel, "blue").icon().cacheKey()
    panel.set_palette_safe(True)
    assert chip(panel, "blue").icon().cacheKey() != before
    sample = chip(panel, "blue").icon().pixmap(24, 12).toImage().pixelColor(12, 6)
    assert sample == theme.STAGE_STYLES_CVD["blue"].colour


@pytest.mark.parametrize(
    ("setter", "value", "back"),
    [
        ("set_source_phones", ["sil", "ae", "f", "ah", "p", "t", "l", "ow", "sil"], None),
        ("set_playhead", 0.35, 0.0),
        ("set_loop_range", (0.1, 0.2), None),
        ("set_ghost", sentence(curves=curve_set(height=0.3)), None),
        ("set_palette_safe", True, False),
        ("set_active_pose", "FV", "open"),
        ("set_stages", None, sentence()),
    ],
)
def test_each_value_is_seen_and_can_be_taken_back(panel, setter, value, back):
    before = panel.grab().toImage()
    getattr(panel, setter)(value)
    assert panel.grab().toImage() != before
    getattr(panel, setter)(back)
    assert panel.grab().toImage() == before


def test_the_open_bigram_is_seen_and_source_phones_of_another_sentence_are_not(panel):
    before = panel.grab().toImage()
    panel.set_source_phones(["ae"])
    assert panel.grab().toImage() == before
    panel.set_current(1, ("ah", "f"))
    assert panel.grab().toImage() != before
    panel.set_current(None, None)
    assert panel.grab().toImage() == before


def test_following_reaches_the_overlay(panel):
    panel.overlay._set_axis(panel.overlay.axis.zoomed(4, 0.0))
    panel.set_following(True)
    panel.set_playhead(0.5)
    assert panel.overlay.axis.sees(0.5)


def test_every_control_has_a_name(panel):
    for control in (*panel.findChildren(QToolButton), panel.mode_box, panel.overlay, panel.reading):
        assert control.accessibleName()
