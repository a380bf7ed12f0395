"""A hand at the curve canvas: real mouse, wheel and key events, and an owner that hands every edit back in."""

import numpy as np
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QKeyEvent, QMouseEvent, QWheelEvent
from PySide6.QtWidgets import QApplication

from core_pipeline.curves import Curve
from core_pipeline.poses import FACEFX
from widgets.canvas.curve_canvas import CurveCanvas

NONE = Qt.KeyboardModifier.NoModifier
SHIFT = Qt.KeyboardModifier.ShiftModifier
CTRL = Qt.KeyboardModifier.ControlModifier
ALT = Qt.KeyboardModifier.AltModifier
LEFT, MIDDLE, RIGHT = Qt.MouseButton.LeftButton, Qt.MouseButton.MiddleButton, Qt.MouseButton.RightButton
NO_BUTTON = Qt.MouseButton.NoButton

OPEN = Curve.of([(0, 0), (0.34, 0.02), (0.55, 0.62), (0.72, 0.8), (1, 0.12)])
FV = Curve.of([(0, 0.2), (0.12, 0.78), (0.26, 0.97), (0.42, 0.55), (0.56, 0.06), (1, 0)])


def open_canvas() -> CurveCanvas:
    """A canvas of 900×500 pixels with FV, the active pose, and open."""
    widget = CurveCanvas()
    widget.resize(900, 500)
    widget.set_poses(FACEFX)
    widget.set_bigram("f", "ah")
    widget.set_curves({"open": OPEN, "FV": FV})
    widget.set_active("FV")
    return widget


class Hand:
    """A canvas with an owner that hands every edit back in, as the program does, and notes what was said."""

    def __init__(self, canvas: CurveCanvas) -> None:
        self.canvas = canvas
        self.edits, self.previews, self.hints, self.actives, self.selections = [], [], [], [], []
        self.cancelled = self.played = 0
        self.curves = {"open": OPEN, "FV": FV}
        self.history = [self.curves]
        canvas.edited.connect(self._take)
        canvas.preview_changed.connect(self.previews.append)
        canvas.hint_changed.connect(self.hints.append)
        canvas.active_changed.connect(self.actives.append)
        canvas.selection_changed.connect(self.selections.append)
        canvas.cancelled.connect(self._count_cancel)
        canvas.play_wanted.connect(self._count_play)

    def _take(self, changes, label):
        self.edits.append((changes, label))
        merged = {**self.curves, **changes}
        self.curves = {pose: curve for pose, curve in merged.items() if curve is not None}
        self.history.append(self.curves)
        self.canvas.set_curves(self.curves)

    def _count_cancel(self):
        self.cancelled += 1

    def _count_play(self):
        self.played += 1

    def mouse(self, kind, at, button, buttons, held=NONE):
        viewport = self.canvas.viewport()
        event = QMouseEvent(kind, at, QPointF(viewport.mapToGlobal(at)), button, buttons, held)
        QApplication.sendEvent(viewport, event)

    def press(self, t, v, held=NONE, button=LEFT):
        self.mouse(QEvent.Type.MouseButtonPress, self.canvas.point_of(t, v), button, button, held)

    def move(self, t, v, held=NONE, button=LEFT):
        self.mouse(QEvent.Type.MouseMove, self.canvas.point_of(t, v), NO_BUTTON, button, held)

    def release(self, t, v, held=NONE, button=LEFT):
        self.mouse(QEvent.Type.MouseButtonRelease, self.canvas.point_of(t, v), button, NO_BUTTON, held)

    def click(self, t, v, held=NONE):
        self.press(t, v, held)
        self.release(t, v, held)

    def double_click(self, t, v, held=NONE):
        self.click(t, v, held)
        self.mouse(QEvent.Type.MouseButtonDblClick, self.canvas.point_of(t, v), LEFT, LEFT, held)
        self.release(t, v, held)

    def drag(self, start, end, held=NONE, steps=6, button=LEFT):
        self.press(*start, held, button)
        for share in np.linspace(0, 1, steps + 1)[1:]:
            self.move(*(a + (b - a) * share for a, b in zip(start, end, strict=True)), held, button)
        self.release(*end, held, button)

    def key(self, key, held=NONE, text=""):
        for kind in (QEvent.Type.KeyPress, QEvent.Type.KeyRelease):
            QApplication.sendEvent(self.canvas, QKeyEvent(kind, key, held, text))

    def wheel(self, t, v, turn, held=NONE):
        at = self.canvas.point_of(t, v)
        everywhere = QPointF(self.canvas.viewport().mapToGlobal(at))
        no_phase = Qt.ScrollPhase.NoScrollPhase
        event = QWheelEvent(at, everywhere, QPoint(), QPoint(0, turn), NO_BUTTON, held, no_phase, False)
        QApplication.sendEvent(self.canvas.viewport(), event)

    def undo(self):
        """As the program does it: the curves from before come down, as the very same objects."""
        self.history.pop()
        self.curves = self.history[-1]
        self.canvas.set_curves(self.curves)
