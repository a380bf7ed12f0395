"""The curve canvas with a hand on it, for every test that needs one."""

import pytest

from tests.helpers.curve_hand import Hand, open_canvas


@pytest.fixture
def canvas(qtbot):
    widget = open_canvas()
    qtbot.addWidget(widget)
    widget.show()
    qtbot.waitExposed(widget)
    return widget


@pytest.fixture
def hand(canvas):
    return Hand(canvas)
