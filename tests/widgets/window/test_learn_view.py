"""The dialog of learned bigrams: rows, selection, and what the buttons ask for."""

import numpy as np
import pytest
from PySide6.QtCore import Qt

from core_pipeline.curves import Curve
from widgets.window.learn_view import LearnRow, LearnView

ROWS = [
    LearnRow(("ah", "d"), 12, 0.05, "draft"),
    LearnRow(("f", "ah"), 3, 0.2, "empty"),
    LearnRow(("w", "ih"), 1, 0.1, "approved", accepted=True),
    LearnRow(("oy", "oy"), 0, 0.0, "empty"),
]


@pytest.fixture
def view(qtbot) -> LearnView:
    view = LearnView()
    qtbot.addWidget(view)
    view.set_rows(ROWS)
    view.show()
    return view


def column(view: LearnView, k: int) -> list[str]:
    return [view.table.item(i, k).text() for i in range(view.table.rowCount())]


def test_most_heard_first_and_unheard_last(view):
    assert column(view, 0) == ["ah–d", "f–ah", "w–ih", "oy–oy"]
    assert column(view, 1) == ["12", "3", "1", ""]
    assert column(view, 2) == ["0.050", "0.200", "0.100", ""]
    assert column(view, 3) == ["draft", "empty", "learned, accepted", "empty"]


def test_the_worst_fit_is_found_by_sorting(view, qtbot):
    header = view.table.horizontalHeader()
    x = header.sectionViewportPosition(2) + header.sectionSize(2) // 2
    for _ in range(2):
        qtbot.mouseClick(header.viewport(), Qt.MouseButton.LeftButton, pos=header.rect().center().__class__(x, 8))
    order = column(view, 2)
    assert order in (["0.200", "0.100", "0.050", ""], ["", "0.050", "0.100", "0.200"])


def test_accepting_asks_for_the_selected(view, qtbot):
    assert view.selected() == [("ah", "d")]
    view.table.setFocus()
    qtbot.keyClick(view.table, Qt.Key.Key_Down, Qt.KeyboardModifier.ShiftModifier)
    with qtbot.waitSignal(view.accept_wanted) as wanted:
        qtbot.mouseClick(view.accept_one, Qt.MouseButton.LeftButton)
    assert wanted.args == [[("ah", "d"), ("f", "ah")]]


def test_the_selection_survives_new_rows(view):
    view.table.selectRow(1)
    view.set_rows([ROWS[0], LearnRow(("f", "ah"), 3, 0.2, "draft", accepted=True), *ROWS[2:]])
    assert view.selected() == [("f", "ah")]
    assert column(view, 3)[1] == "learned, accepted"
    assert not view.accept_empty.isEnabled() or any(r == "empty" for r in column(view, 3))


def test_progress_can_be_stopped(view, qtbot):
    assert not view.progress.isVisible()
    view.set_progress(0.4, "take1.csv")
    assert view.progress.value() == 400
    assert not view.folder.isEnabled()
    with qtbot.waitSignal(view.cancel_wanted):
        qtbot.mouseClick(view.cancel, Qt.MouseButton.LeftButton)


def test_the_plot_shows_occurrences_and_the_curve(view, qtbot):
    plot = view.plot
    plot.set_poses(["open", "W"])
    bare = plot.picture.grab().toImage()
    t = np.linspace(0, 1, 21)
    plot.set_bigram("x", [(t, 0.5 * np.sin(np.pi * t))], {"open": Curve.of([(0, 0), (0.5, 1), (1, 0)])}, {})
    drawn = plot.picture.grab().toImage()
    assert drawn != bare
    with qtbot.waitSignal(plot.pose_picked) as picked:
        plot.poses.setFocus()
        qtbot.keyClick(plot.poses, Qt.Key.Key_Down)
    assert picked.args == ["W"]
    assert plot.pose == "W"
