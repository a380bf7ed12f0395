"""The blind comparison's dialog: an answer needs a side and a strength, and nothing tells what is what."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QImage

from core_pipeline.study import LEFT, RIGHT
from widgets.window.study_view import StudyView


@pytest.fixture
def view(qtbot) -> StudyView:
    view = StudyView()
    qtbot.addWidget(view)
    view.set_trial("Fat cats.", 3, 20)
    view.show()
    return view


def click(qtbot, button) -> None:
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)


def test_an_answer_is_a_side_and_a_strength(view, qtbot):
    assert view.place.text() == "Pair 3 of 20: “Fat cats.”"
    assert not view.next.isEnabled()
    click(qtbot, view.side_buttons[RIGHT])
    assert not view.next.isEnabled()
    click(qtbot, view.strength_buttons[4])
    click(qtbot, view.strength_buttons[2])
    with qtbot.waitSignal(view.answered) as answered:
        click(qtbot, view.next)
    assert answered.args == [RIGHT, 2]


def test_the_next_pair_begins_anew(view, qtbot):
    click(qtbot, view.side_buttons[LEFT])
    click(qtbot, view.strength_buttons[5])
    view.set_trial("Five fish.", 4, 20)
    assert view.sides.checkedButton() is None
    assert view.strengths.checkedButton() is None
    assert not view.next.isEnabled()


def test_clips_are_replayed_as_often_as_one_likes(view, qtbot):
    asked = []
    view.play_wanted.connect(asked.append)
    for side in (LEFT, RIGHT, LEFT, LEFT):
        click(qtbot, view.plays[side])
    assert asked == [LEFT, RIGHT, LEFT, LEFT]


def test_each_side_has_its_picture(view):
    for side, colour in ((LEFT, "#ff0000"), (RIGHT, "#0000ff")):
        image = QImage(40, 40, QImage.Format.Format_RGB888)
        image.fill(QColor(colour))
        view.set_image(side, image)
        shown = view.screens[side].grab().toImage()
        assert shown.pixelColor(shown.width() // 2, shown.height() // 2) == QColor(colour)


def test_without_a_pair_nothing_can_be_judged_and_results_are_told(view):
    view.set_trial(None)
    view.set_results(["all: ours 60 %"])
    assert not any(b.isEnabled() for b in (view.next, *view.plays.values(), *view.side_buttons.values()))
    assert view.results.isVisible()
    assert view.csv.isVisible()
    view.set_trial("Fat cats.", 1, 2)
    view.set_results(())
    assert not view.results.isVisible()
