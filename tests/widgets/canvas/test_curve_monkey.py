"""A monkey at the canvas: thousands of weighted random events, and the laws hold after every one of them.

MONKEY_SEED and MONKEY_EVENTS in the environment choose others: 20,000 events found what 3,000 did not.
"""

import os
import random

import numpy as np
import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from core_pipeline.curves import MIN_GAP, Curve
from core_pipeline.poses import FACEFX
from tests.helpers.curve_hand import ALT, CTRL, FV, LEFT, MIDDLE, NO_BUTTON, NONE, OPEN, RIGHT, SHIFT, Hand, open_canvas
from widgets.canvas.curve_panel import CurvePanel
from widgets.canvas.keymaps import KEYMAPS

SEED = int(os.environ.get("MONKEY_SEED", "20130"))
EVENTS = int(os.environ.get("MONKEY_EVENTS", "3000"))

Key = Qt.Key
HELD = (NONE, NONE, NONE, SHIFT, CTRL, ALT, SHIFT | CTRL)
ARROWS = (Key.Key_Left, Key.Key_Right, Key.Key_Up, Key.Key_Down)
SINGLE = (*ARROWS, Key.Key_Delete, Key.Key_Escape, Key.Key_Comma, Key.Key_F, Key.Key_Home, Key.Key_Return)
COMMANDS = (
    *((Key.Key_Insert, NONE), (Key.Key_M, CTRL), (Key.Key_C, CTRL), (Key.Key_X, CTRL), (Key.Key_V, CTRL)),
    *((Key.Key_V, CTRL | SHIFT), (Key.Key_Backslash, NONE), (Key.Key_D, ALT), (Key.Key_A, CTRL), (Key.Key_I, NONE)),
    *((Key.Key_PageDown, NONE), (Key.Key_PageUp, NONE), (Key.Key_M, CTRL | SHIFT), (Key.Key_D, CTRL)),
)
IN_GESTURE = (*ARROWS, Key.Key_X, Key.Key_Y, Key.Key_Return, Key.Key_Return, Key.Key_Escape)
TYPED = ("*0.5", "*2", "+0.1", "-.2", "=.3", "0.7", "/0", "zzz", "1", "0", "*.5 +.2", "=.4 *.5")
CLIPBOARDS = ("", "text", '{"schema": "lipstitch.Curves.1", "curves": {"x": [[1, 2]]}}')
#: Narrower than any canvas makes it: keys as a file may bring them.
NEAR = Curve(np.array([0.2, 0.2002, 0.6, 1.0]), np.array([0.0, 0.5, 0.9, 0.1]))


class Monkey:
    """Does one random thing after the other to a canvas with its panel."""

    def __init__(self, hand: Hand, panel: CurvePanel, dice: random.Random) -> None:
        self.hand, self.canvas, self.panel, self.dice = hand, hand.canvas, panel, dice
        # What it does → how often.
        self.moves = {
            self.press: 14,
            self.move: 30,
            self.release: 12,
            self.drag: 12,
            self.drag_handle: 6,
            self.gesture_by_key: 8,
            self.double_click: 6,
            self.key: 12,
            self.command: 10,
            self.key_in_gesture: 8,
            self.slide: 3,
            self.type_value: 3,
            self.type_in_table: 2,
            self.wheel: 3,
            self.pan: 1,
            self.look: 3,
            self.undo: 2,
            self.bigram: 1,
            self.right_click: 1,
            self.clipboard: 1,
            self.keymap: 1,
        }

    def step(self) -> str:
        (move,) = self.dice.choices(list(self.moves), self.moves.values())
        move()
        return move.__name__

    def anywhere(self):
        if self.canvas.curves and self.dice.random() < 0.6:
            return self.dice.choice(self.dice.choice(list(self.canvas.curves.values())).keys())
        return self.dice.uniform(-0.2, 1.2), self.dice.uniform(-0.2, 1.2)

    def held(self):
        return self.dice.choice(HELD)

    def press(self):
        self.hand.press(*self.anywhere(), self.held())

    def move(self):
        self.hand.move(*self.anywhere(), self.held(), self.dice.choice((LEFT, LEFT, NO_BUTTON)))

    def release(self):
        self.hand.release(*self.anywhere())

    def drag(self):
        self.hand.drag(self.anywhere(), self.anywhere(), self.held())

    def drag_handle(self):
        """On a handle of the transform box, where there is one."""
        control = self.canvas._control
        box = control.box()
        if box is None:
            return self.hand.key(Key.Key_A, CTRL)
        x, y = self.dice.choice(list(box.handles(control.view).values()))
        return self.hand.drag((control.view.t(x), control.view.v(y)), self.anywhere(), self.held())

    def gesture_by_key(self):
        """Grabs or scales, goes about, and keeps or takes back; or leaves it under way."""
        self.hand.key(self.dice.choice((Key.Key_G, Key.Key_S, Key.Key_R, Key.Key_W)))
        for _ in range(self.dice.randrange(4)):
            self.hand.move(*self.anywhere(), self.held(), NO_BUTTON)
            if self.dice.random() < 0.3:
                self.hand.key(self.dice.choice((Key.Key_X, Key.Key_Y)))
        end = self.dice.randrange(4)
        if end == 0:
            self.hand.key(Key.Key_Return)
        elif end == 1:
            self.hand.key(Key.Key_Escape)
        elif end == 2:
            self.hand.click(*self.anywhere())

    def double_click(self):
        self.hand.double_click(*self.anywhere(), self.held())

    def key(self):
        self.hand.key(self.dice.choice(SINGLE), self.dice.choice((NONE, NONE, NONE, SHIFT)))

    def command(self):
        self.hand.key(*self.dice.choice(COMMANDS))

    def key_in_gesture(self):
        if self.canvas.busy:
            self.hand.key(self.dice.choice(IN_GESTURE), self.dice.choice((NONE, NONE, SHIFT)))

    def slide(self):
        """Along the slider between versions, and keeps or takes back; or leaves it open."""
        self.dice.choice((self.canvas.slide, self.canvas.duplicate))()
        for _ in range(self.dice.randrange(4)):
            if self.canvas._control.blending and self.dice.random() < 0.3:
                slider = self.canvas.blend_bar.slider
                QTest.keyClick(slider, self.dice.choice((Key.Key_Up, Key.Key_Down)))
            self.canvas.blend_bar.slider.setValue(self.dice.choice((0, 100, self.dice.randrange(101))))
        end = self.dice.randrange(3)
        if end < 2:
            self.hand.key((Key.Key_Return, Key.Key_Escape)[end])

    def type_value(self):
        field = self.dice.choice((self.panel.values.time, self.panel.values.weight))
        field.typed.emit(self.dice.choice(TYPED))

    def type_in_table(self):
        model = self.panel.table.model()
        if model.rowCount():
            index = model.index(self.dice.randrange(model.rowCount()), self.dice.randrange(2))
            model.setData(index, self.dice.choice(TYPED))

    def wheel(self):
        self.hand.wheel(*self.anywhere(), self.dice.choice((-120, 120)), self.held())

    def pan(self):
        self.hand.drag(self.anywhere(), self.anywhere(), button=MIDDLE)

    def look(self):
        """What the owner may hand down at any moment."""
        canvas, dice = self.canvas, self.dice
        canvas.set_locked({pose for pose in ("open", "wide") if dice.random() < 0.3})
        canvas.set_visible_poses({pose for pose in FACEFX if dice.random() < 0.9})
        canvas.set_solo({pose for pose in FACEFX if dice.random() < 0.4} if dice.random() < 0.2 else ())
        canvas.set_snap(dice.random() < 0.3)
        canvas.set_active(dice.choice(FACEFX))
        canvas.set_boundary(dice.uniform(0.2, 0.8))
        canvas.set_curves(self.hand.curves)
        if dice.random() < 0.3:
            canvas.set_ghost(dice.choice(self.hand.history))
            canvas.set_neighbours({name: dice.choice(self.hand.history) for name in "ab"[: dice.randrange(3)]})

    def undo(self):
        if len(self.hand.history) > 1 and not self.canvas.busy:
            self.hand.undo()
            self.hand.edits.pop()

    def bigram(self):
        self.canvas.set_bigram(self.dice.choice("fd"), "ah")

    def right_click(self):
        """Only while a gesture runs: elsewhere it opens a menu."""
        if self.canvas.busy:
            self.hand.mouse(QEvent.Type.MouseButtonPress, self.canvas.point_of(*self.anywhere()), RIGHT, RIGHT)

    def clipboard(self):
        QGuiApplication.clipboard().setText(self.dice.choice(CLIPBOARDS))

    def keymap(self):
        self.canvas.set_keymap(self.dice.choice(list(KEYMAPS)))


def check(hand, told):
    """The laws, whatever has happened; `told` edits had been told before the last event."""
    canvas, history = hand.canvas, hand.history
    assert len(hand.edits) == len(history) - 1
    for (changes, label), before in zip(hand.edits[told:], history[told:], strict=False):
        assert label
        assert changes
        for pose, curve in changes.items():
            assert canvas._control.refuses(pose) is None
            assert curve is not None or pose in before
            assert curve is None or not curve.same_as(before.get(pose))
    least = min((np.diff(c.t).min() for c in history[0].values() if len(c) > 1), default=MIN_GAP)
    for curve in canvas.curves.values():
        assert (np.diff(curve.t) > min(least, MIN_GAP) / 2).all()
        assert ((curve.t >= 0) & (curve.t <= 1) & (curve.v >= 0) & (curve.v <= 1)).all()
    visible, locked = canvas._control.visible, canvas._control.locked
    if canvas.busy:
        assert canvas.blend_bar.isVisibleTo(canvas) == canvas._control.blending
    else:
        assert canvas.curves == hand.curves
        assert not canvas.blend_bar.isVisibleTo(canvas)
        assert all(index < len(canvas.curves[pose]) for pose, index in canvas.selection)
        assert all(pose in visible and pose not in locked for pose, _ in canvas.selection)


def test_the_monkey_breaks_no_law(qtbot):
    """Edits come one for one with steps of the history; every one can be undone to the very objects of the start."""
    canvas = open_canvas()
    panel = CurvePanel(canvas)
    qtbot.addWidget(panel)
    panel.resize(1000, 520)
    panel.show_table(True)
    hand = Hand(canvas)
    canvas.solo_wanted.connect(canvas.set_solo)
    canvas.set_ghost({"FV": OPEN, "W": FV})
    hand.curves = {"open": OPEN, "FV": FV, "tRoof": NEAR}
    hand.history = [hand.curves]
    canvas.set_curves(hand.curves)
    panel.show()
    qtbot.waitExposed(panel)
    monkey = Monkey(hand, panel, random.Random(SEED))
    labels = set()
    for number in range(EVENTS):
        told = len(hand.edits)
        done = "nothing"
        try:
            done = monkey.step()
            check(hand, min(told, len(hand.edits)))
        except AssertionError as broken:
            pytest.fail(f"event {number}, {done}, seed {SEED}: {broken!r}")
        labels |= {label for _, label in hand.edits[told:]}
        if number % 100 == 0:
            QApplication.processEvents()
    hand.key(Key.Key_Escape)
    while len(hand.history) > 1:
        hand.undo()
    assert all(canvas.curves[pose] is curve for pose, curve in {"open": OPEN, "FV": FV, "tRoof": NEAR}.items())
    if EVENTS >= 3000:
        assert len(labels) >= 9, labels
