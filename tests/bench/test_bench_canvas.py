"""From mouse event to painted frame, nine poses of twelve keys on 900×500 pixels.

The budget is 16 ms in the median (editor page); the aim is 4. Run with --benchmark-only.
"""

from itertools import cycle

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QApplication

from core_pipeline.curves import Curve
from core_pipeline.poses import FACEFX
from tests.helpers.budget import within
from widgets.canvas.curve_canvas import CurveCanvas
from widgets.canvas.curve_panel import CurvePanel


def nine_poses():
    widget = CurveCanvas()
    widget.resize(900, 500)
    dice = np.random.default_rng(2013)
    widget.set_poses(FACEFX)
    widget.set_bigram("f", "ah")
    widget.set_curves({pose: Curve(np.linspace(0.02, 0.98, 12), dice.uniform(0.1, 0.9, 12)) for pose in FACEFX})
    widget.set_active("FV")
    return widget


@pytest.fixture
def canvas(qtbot):
    widget = nine_poses()
    qtbot.addWidget(widget)
    widget.show()
    qtbot.waitExposed(widget)
    return widget


def send(canvas, kind, at, button, buttons):
    viewport = canvas.viewport()
    globally = QPointF(viewport.mapToGlobal(at))
    QApplication.sendEvent(viewport, QMouseEvent(kind, at, globally, button, buttons, Qt.KeyboardModifier.NoModifier))


def test_one_step_of_a_drag(canvas, benchmark):
    left, none = Qt.MouseButton.LeftButton, Qt.MouseButton.NoButton
    curve = canvas.curves["FV"]
    start = canvas.point_of(float(curve.t[5]), float(curve.v[5]))
    send(canvas, QEvent.Type.MouseButtonPress, start, left, left)
    places = cycle([start + QPointF(12 * np.sin(i / 5), i % 40 - 20) for i in range(4, 84)])
    previews = []
    canvas.preview_changed.connect(previews.append)

    def step():
        send(canvas, QEvent.Type.MouseMove, next(places), none, left)
        QApplication.processEvents()

    benchmark(step)
    assert previews
    within(benchmark, 0.016)


def test_one_step_of_the_playhead(canvas, benchmark):
    times = cycle(np.linspace(0.01, 0.99, 97).tolist())

    def step():
        canvas.set_playhead(next(times))
        QApplication.processEvents()

    benchmark(step)
    within(benchmark, 0.004)


@pytest.mark.parametrize("gesture", ["move", "scale", "move, with figures", "blend"])
def test_one_step_of_every_gesture_with_everything_selected(qtbot, benchmark, gesture):
    """All 108 keys at once: the transform box around them, and beside the canvas fields and table that follow."""
    canvas = nine_poses()
    shown = CurvePanel(canvas) if "figures" in gesture else canvas
    qtbot.addWidget(shown)
    if shown is not canvas:
        shown.resize(1100, 560)
        shown.show_table(True)
    shown.show()
    qtbot.waitExposed(shown)
    canvas.set_ghost({pose: Curve(curve.t, curve.v[::-1]) for pose, curve in canvas.curves.items()})
    canvas.select_all()
    canvas.select_all()
    assert len(canvas.selection) == 108
    if gesture == "blend":
        canvas.slide()
    elif gesture == "scale":
        canvas.begin_scale()
    else:
        canvas.begin_move()
    start, none = canvas.point_of(0.5, 0.5), Qt.MouseButton.NoButton
    places = cycle([start + QPointF(60 + 25 * np.sin(i / 5), i % 40 - 20) for i in range(4, 84)])
    shares = cycle([*range(1, 99), *range(99, 1, -1)])
    previews = []
    canvas.preview_changed.connect(previews.append)

    def step():
        if gesture == "blend":
            canvas.blend_bar.slider.setValue(next(shares))
        else:
            send(canvas, QEvent.Type.MouseMove, next(places), none, none)
        QApplication.processEvents()

    benchmark(step)
    assert previews
    within(benchmark, 0.016)
