"""The method box: a choice goes up, differences come down; the curve lies grey on the row."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor

from core_pipeline import pipeline
from core_pipeline.methods.compare import Difference
from core_pipeline.weights import Weights, bake
from tests.helpers.corpora import english, schedules
from widgets.overlay.method_box import NONE, MethodBox
from widgets.overlay.stage_layers import METHOD
from widgets.overlay.stage_panel import StagePanel


@pytest.fixture
def box(qtbot) -> MethodBox:
    box = MethodBox()
    qtbot.addWidget(box)
    box.set_methods([(NONE, "No other method"), ("dam", "Animemes"), ("visemes", "Visemes")])
    box.show()
    return box


def test_a_choice_goes_up(box, qtbot):
    box.box.setFocus()
    with qtbot.waitSignal(box.chosen) as chosen:
        qtbot.keyClick(box.box, Qt.Key.Key_Down)
    assert chosen.args == ["dam"]


def test_differences_are_a_number_and_a_table_worst_first(box, qtbot):
    assert not box.details.isVisible()
    box.set_differences([Difference("open", 0.03, -0.1), Difference("W", 0.04, 0.2)])
    assert box.details.text() == "RMSE 0.035"
    qtbot.mouseClick(box.details, Qt.MouseButton.LeftButton)
    assert box.table.isVisible()
    cells = [[box.table.item(i, k).text() for k in range(3)] for i in range(2)]
    assert cells == [["W", "0.040", "+0.200"], ["open", "0.030", "-0.100"]]
    qtbot.keyClick(box.table, Qt.Key.Key_Escape)
    assert not box.popup.isVisible()
    qtbot.mouseClick(box.details, Qt.MouseButton.LeftButton)
    assert box.popup.isVisible()
    box.set_differences(None)
    assert not box.popup.isVisible()


def test_while_something_is_learned_nothing_else_can_be_chosen(box):
    box.set_busy("learning 30 %")
    assert not box.box.isEnabled()
    assert box.details.text() == "learning 30 %"
    box.set_busy("")
    assert box.box.isEnabled()


def test_the_second_face_is_asked_for(box, qtbot):
    box.set_differences([Difference("open", 0.03, -0.1)])
    with qtbot.waitSignal(box.beside_toggled) as toggled:
        qtbot.mouseClick(box.beside, Qt.MouseButton.LeftButton)
    assert toggled.args == [True]


def test_its_curve_is_grey_and_dashed(qtbot):
    """A method that holds `wide` at 0.9 where the stages have nothing: grey pixels and gaps appear, and go again."""
    panel = StagePanel()
    qtbot.addWidget(panel)
    panel.resize(1200, 420)
    panel.set_stages(stages := pipeline.run(schedules()[0], english()))
    panel.show()

    def grey() -> int:
        image = panel.overlay.grab().toImage()
        wanted = QColor(METHOD)
        close = 0
        for x in range(150, image.width() - 20, 2):
            for y in range(image.height()):
                c = image.pixelColor(x, y)
                near = max(abs(c.red() - wanted.red()), abs(c.green() - wanted.green()), abs(c.blue() - wanted.blue()))
                close += near < 30
        return close

    before = grey()
    baked = bake(stages.magenta, "pchip", 60)
    frames = np.full_like(baked.frames, 0.9)
    panel.set_method(Weights(baked.poses, 60.0, baked.start, frames))
    assert grey() > before + 200
    panel.set_method(None)
    assert grey() == before
