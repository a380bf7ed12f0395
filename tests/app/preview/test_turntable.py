"""The turntable keeps to the clock, not to the number of pictures."""

import pytest

from app.preview.turntable import Turntable
from core_pipeline.faces.looks import TURN_SECONDS


@pytest.fixture
def table(qtbot):
    now = [100.0]
    table = Turntable(clock=lambda: now[0])
    table.now = now
    yield table
    table.set_on(False)


def degrees(table, qtbot, seconds):
    """What it turns at its next step, when so much time has passed."""
    table.now[0] += seconds
    with qtbot.waitSignal(table.turned, timeout=5000) as caught:
        pass
    return caught.args[0]


def test_it_turns_as_far_as_time_has_passed(table, qtbot):
    table.set_on(True)
    assert degrees(table, qtbot, 0.02) == pytest.approx(360 * 0.02 / TURN_SECONDS)
    assert degrees(table, qtbot, 0.5) == pytest.approx(360 * 0.5 / TURN_SECONDS)


def test_a_hand_holds_it_and_the_time_is_not_made_up_for(table, qtbot):
    table.set_on(True)
    table.hold(True)
    assert not table.turning
    table.now[0] += 10
    table.hold(False)
    assert degrees(table, qtbot, 0.1) == pytest.approx(360 * 0.1 / TURN_SECONDS)


def test_letting_go_does_not_start_one_that_is_off(table):
    table.hold(True)
    table.hold(False)
    assert not table.turning
