"""Colours that can be told apart, line styles that can be told apart without them, and icons that exist."""

from itertools import combinations, pairwise

import pytest
from PySide6.QtCore import QSize
from PySide6.QtGui import QColor, QPalette
from PySide6.QtWidgets import QApplication

from core_pipeline.curve_set import STATUSES
from core_pipeline.poses import FACEFX
from widgets import theme

STAGES = ["red", "green", "blue", "yellow", "cyan", "magenta"]


@pytest.fixture
def dressed(qapp):
    before = qapp.palette(), qapp.font(), qapp.styleSheet()
    theme.apply(qapp)
    yield qapp
    qapp.setPalette(before[0])
    qapp.setFont(before[1])
    qapp.setStyleSheet(before[2])


def contrast(a: QColor, b: QColor) -> float:
    """WCAG 2 contrast ratio, 1 to 21."""

    def luminance(colour: QColor) -> float:
        parts = (colour.redF(), colour.greenF(), colour.blueF())
        linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
        return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]

    high, low = sorted((luminance(a), luminance(b)), reverse=True)
    return (high + 0.05) / (low + 0.05)


def test_every_pose_has_its_own_colour_that_shows_on_the_canvas():
    colours = [theme.pose_colour(pose, index) for index, pose in enumerate(FACEFX)]
    for colour in colours:
        assert contrast(colour, theme.BACKGROUND) > 4.5
    for a, b in combinations(colours, 2):
        assert abs(a.red() - b.red()) + abs(a.green() - b.green()) + abs(a.blue() - b.blue()) > 40


def test_other_pose_sets_go_round_the_same_colours():
    assert theme.pose_colour("jaw", 2) == theme.POSE_COLOURS["ShCh"]
    assert theme.pose_colour("jaw", 2 + len(theme.POSE_COLOURS)) == theme.POSE_COLOURS["ShCh"]


def test_changing_a_colour_that_was_handed_out_changes_no_other():
    theme.pose_colour("FV").setRed(0)
    assert theme.pose_colour("FV").red() != 0


@pytest.mark.parametrize("styles", [theme.STAGE_STYLES, theme.STAGE_STYLES_CVD])
def test_stages_differ_by_line_style_and_not_by_colour_alone(styles, qapp):
    assert list(styles) == STAGES
    assert len({style.label for style in styles.values()}) == 6
    assert len({style.colour.name() for style in styles.values()}) == 6
    # Red and blue are both thin and solid: one is many short curves, the other one long.
    assert len({(style.width, style.dash) for style in styles.values()}) == 5
    for style in styles.values():
        pen = style.pen()
        assert pen.isCosmetic()
        assert [round(part * pen.widthF(), 6) for part in pen.dashPattern()] == list(style.dash)


def test_statuses_stand_on_one_ramp_from_dark_to_light():
    assert tuple(theme.STATUS_COLOURS) == STATUSES
    lightness = [colour.lightnessF() for colour in theme.STATUS_COLOURS.values()]
    assert all(b - a > 0.1 for a, b in pairwise(lightness))


def test_texts_can_be_read_on_every_surface():
    for surface in (theme.WINDOW, theme.PANEL, theme.BACKGROUND, theme.RAISED):
        assert contrast(theme.TEXT, surface) > 7
        assert contrast(theme.MUTED, surface) > 4.5
        assert contrast(theme.FAINT, surface) > 2.5


def test_mix_goes_from_one_colour_to_the_other():
    assert theme.mix(theme.ACCENT, theme.WINDOW, 1) == theme.ACCENT
    assert theme.mix(theme.ACCENT, theme.WINDOW, 0) == theme.WINDOW
    assert theme.mix(QColor(0, 0, 0), QColor(200, 100, 50), 0.5) == QColor(100, 50, 25)


def test_apply_makes_the_program_dark(dressed):
    assert dressed.palette().color(QPalette.ColorRole.Window) == theme.WINDOW
    assert dressed.palette().color(QPalette.ColorGroup.Disabled, QPalette.ColorRole.Text) == theme.FAINT
    assert dressed.font().pointSizeF() == theme.POINT_SIZE
    assert "{" in dressed.styleSheet()
    assert "{{" not in dressed.styleSheet()
    dressed.setStyleSheet("")  # it wraps the style
    assert QApplication.style().objectName() == "fusion"


def test_icons_are_drawn_in_the_colour_asked_for(qapp):
    image = theme.icon("magnet", theme.WEAK).pixmap(QSize(32, 32)).toImage()
    colours = {
        image.pixelColor(x, y).name() for x in range(32) for y in range(32) if image.pixelColor(x, y).alpha() == 255
    }
    assert colours == {theme.WEAK.name()}


def test_an_icon_that_does_not_exist_is_an_error(qapp):
    with pytest.raises(Exception, match="no-such-icon"):
        theme.icon("no-such-icon")
