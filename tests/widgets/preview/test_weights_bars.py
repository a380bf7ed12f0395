"""The bars of the pose weights."""

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint
from PySide6.QtGui import QHelpEvent
from PySide6.QtWidgets import QApplication, QToolTip

from core_pipeline.poses import FACEFX
from widgets import theme
from widgets.preview.weights_bars import WeightsBars

# the offscreen platform has no window manager to talk to
pytestmark = pytest.mark.qt_log_ignore("This plugin does not support")


@pytest.fixture
def bars(qtbot):
    bars = WeightsBars()
    qtbot.addWidget(bars)
    bars.set_poses(FACEFX)
    bars.resize(300, 220)
    with qtbot.waitExposed(bars):
        bars.show()
    return bars


def lengths(bars):
    """Painted pixels of each pose's bar, right of its dot and name."""
    image = bars.grab().toImage()
    found = []
    for i, pose in enumerate(FACEFX):
        y = round(8 + (i + 0.5) * (bars.height() - 16) / len(FACEFX))
        wanted = theme.pose_colour(pose, i)
        found.append(sum(image.pixelColor(x, y) == wanted for x in range(40, bars.width())))
    return np.array(found)


def one(pose, weight):
    return [weight if name == pose else 0.0 for name in FACEFX]


def test_a_bar_is_as_long_as_its_weight(bars):
    bars.set_weights(np.ones(9))
    whole = lengths(bars)
    bars.set_weights(np.full(9, 0.5))
    assert lengths(bars) / whole == pytest.approx(np.full(9, 0.5), abs=0.03)


def test_each_pose_has_its_own_bar_and_zero_has_none(bars):
    bars.set_weights(one("FV", 0.7))
    painted = lengths(bars)
    assert painted[FACEFX.index("FV")] > 50
    assert np.count_nonzero(painted) == 1


def test_weights_outside_0_to_1_stay_on_their_track(bars):
    bars.set_weights(np.ones(9))
    whole = lengths(bars)
    bars.set_weights(np.full(9, 3.0))
    assert lengths(bars).tolist() == whole.tolist()
    bars.set_weights(np.full(9, -1.0))
    assert not lengths(bars).any()


def test_less_than_a_hundredth_costs_no_repaint(qtbot, bars):
    painted = []
    bars.paintEvent, paint = lambda event: (painted.append(event), paint(event)), bars.paintEvent
    bars.set_weights(one("open", 0.500))
    QApplication.processEvents()
    assert len(painted) == 1
    bars.set_weights(one("open", 0.5004))
    QApplication.processEvents()
    assert len(painted) == 1
    bars.set_weights(one("open", 0.52))
    QApplication.processEvents()
    assert len(painted) == 2


def test_the_wrong_number_of_weights_is_refused(bars):
    with pytest.raises(ValueError, match="9 poses"):
        bars.set_weights([0.5])
    with pytest.raises(ValueError, match="9 poses"):
        bars.set_weights(np.zeros((9, 1)))


def test_other_poses_start_at_zero(bars):
    bars.set_weights(np.ones(9))
    bars.set_poses(("smile", "blink"))
    assert bars.poses == ("smile", "blink")
    assert bars.weights.tolist() == [0.0, 0.0]
    assert not bars.grab().isNull()


def test_no_poses_at_all_is_harmless(bars):
    bars.set_poses(())
    bars.set_weights([])
    assert not bars.grab().isNull()


def test_a_new_size_is_painted_anew(bars):
    bars.set_weights(np.ones(9))
    before = lengths(bars)
    bars.resize(420, 220)
    assert (lengths(bars) - before).tolist() == [120] * 9


def test_the_tooltip_says_what_the_pose_means(qtbot, bars):
    bars.set_weights(one("PBM", 0.4))
    row = FACEFX.index("PBM")
    assert bars.tooltip(row) == "PBM: lips sealed · 0.40"
    at = QPoint(60, round(8 + (row + 0.5) * (bars.height() - 16) / 9))
    QApplication.sendEvent(bars, QHelpEvent(QEvent.Type.ToolTip, at, bars.mapToGlobal(at)))
    assert QToolTip.text() == "PBM: lips sealed · 0.40"
    QToolTip.hideText()


def test_it_is_named(bars):
    assert bars.accessibleName() == "Pose weights"
    assert bars.accessibleDescription().startswith("open 0.00")
