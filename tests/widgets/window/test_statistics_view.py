"""The statistics: our table beside table 2, and the curve of figure 2."""

import pytest

from core_pipeline.phonemes import COMMON
from core_pipeline.statistics import TABLE_2, Frequencies, Progress
from widgets.window.statistics_view import StatisticsView

SAID = Frequencies(COMMON, {("ah", "d"): 60, ("f", "ah"): 30, ("oy", "oy"): 10}, 7)
NOW = Progress(441, 331, 12, 0.968, 0.2)


@pytest.fixture
def view(qtbot):
    view = StatisticsView()
    qtbot.addWidget(view)
    view.set_frequencies("script.txt", SAID, NOW)
    with qtbot.waitExposed(view):
        view.show()
    return view


def texts(table, row):
    return [table.item(row, column).text() for column in range(3)]


def test_tables_stand_side_by_side(view):
    assert texts(view.table, 0) == ["ah – d", "60.00 %", "4.62 %"]
    assert texts(view.table, 1) == ["f – ah", "30.00 %", ""]
    assert view.table.rowCount() == 3
    assert texts(view.table_2, 0) == ["ah – d", "4.62 %", "60.00 %"]
    assert texts(view.table_2, 1) == ["d – ih", "3.44 %", ""]
    assert view.table_2.rowCount() == len(TABLE_2)


def test_the_summary_says_what_the_paper_says_and_how_far_the_work_is(view):
    text = view.summary.text()
    for part in ("script.txt: 100 pairs in 7 sentences", "438 of 441", "the paper: 104", "first 3 cover 99.1 %"):
        assert part in text
    assert "Drawn: 331 bigrams, 96.8 % of this speech; approved: 12, 20.0 %." in text


def test_the_curve_rises_from_nothing_to_all(view):
    curve = view.curve
    assert curve.point(0, 0.0).x() < curve.point(441, 1.0).x()
    assert curve.point(0, 0.0).y() > curve.point(441, 1.0).y()
    before = curve.grab().toImage()
    curve.set_frequencies(Frequencies(COMMON, dict.fromkeys([(a, b) for a in COMMON for b in COMMON], 1)))
    assert curve.grab().toImage() != before  # now a straight line
    curve.set_frequencies(Frequencies((), {}))
    assert not curve.grab().isNull()


def test_names_for_screen_readers(view):
    assert view.table.accessibleName()
    assert view.table_2.accessibleName()
    assert "cover 99.1 %" in view.curve.accessibleDescription()
