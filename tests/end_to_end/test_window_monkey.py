"""A monkey at the whole window: menus, keys, mouse, tabs, lists; the laws hold after every event.

MONKEY_SEED and MONKEY_EVENTS in the environment choose others; a fiftieth of the events of the canvas alone.
"""

import gc
import os
import random

from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QGuiApplication, QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

from app.editor import Editor
from core_pipeline.phonemes import SILENCE
from widgets.canvas.keymaps import KEYMAPS

SEED = int(os.environ.get("MONKEY_SEED", "20130"))
EVENTS = int(os.environ.get("MONKEY_EVENTS", "3000")) // 50

Key, Button = Qt.Key, Qt.MouseButton
NONE, SHIFT, CTRL, ALT = (
    Qt.KeyboardModifier.NoModifier,
    Qt.KeyboardModifier.ShiftModifier,
    Qt.KeyboardModifier.ControlModifier,
    Qt.KeyboardModifier.AltModifier,
)
KEYS = (Key.Key_Up, Key.Key_Down, Key.Key_Left, Key.Key_Right, Key.Key_Tab, Key.Key_Return, Key.Key_Escape, Key.Key_A)
KEYS += (Key.Key_Delete, Key.Key_Insert, Key.Key_G, Key.Key_S, Key.Key_Space, Key.Key_Home, Key.Key_Z, Key.Key_F6)
TYPED = ("f ah", "exp", "zzz", "undo", "fish", "reset", "blue")


class Monkey:
    """Does one random thing after the other to a window."""

    def __init__(self, editor: Editor, dice: random.Random) -> None:
        self.editor, self.window, self.dice = editor, editor.window, dice
        # What opens a dialog, a file or another face is for other tests.
        self.actions = [
            entry.action
            for entry in self.window.actions_.registry
            if not entry.id.startswith(("file.", "help.", "character.", "sentence.next", "sentence.previous"))
            and not entry.action.text().endswith("…")
        ]
        self.moves = {
            self.trigger: 8,
            self.key: 8,
            self.drag: 12,
            self.click: 6,
            self.undo: 6,
            self.open: 4,
            self.palette: 2,
            self.keymap: 1,
            self.resize: 1,
        }

    def act(self) -> None:
        move = self.dice.choices(list(self.moves), list(self.moves.values()))[0]
        move()
        QApplication.processEvents()

    def trigger(self) -> None:
        self.dice.choice(self.actions).trigger()

    def key(self) -> None:
        widget = QApplication.focusWidget() or self.window
        QTest.keyClick(widget, self.dice.choice(KEYS), self.dice.choice((NONE, NONE, NONE, SHIFT, CTRL, ALT)))

    def drag(self) -> None:
        canvas = self.dice.choice((self.window.canvas, self.window.canvas, self.window.beside.canvas))
        if not canvas.isVisible():
            return
        viewport, curve = canvas.viewport(), canvas.curves.get(canvas.active)
        if curve is not None:
            i = self.dice.randrange(len(curve))
            at = canvas.point_of(float(curve.t[i]), float(curve.v[i]))
        else:
            at = self.somewhere(viewport)
        self.mouse(viewport, QEvent.Type.MouseButtonPress, at)
        for _ in range(3):
            self.mouse(viewport, QEvent.Type.MouseMove, self.somewhere(viewport))
            if self.dice.random() < 0.1:
                self.trigger()  # in the middle of a drag
        self.mouse(viewport, QEvent.Type.MouseButtonRelease, self.somewhere(viewport))

    def click(self) -> None:
        w = self.window
        views = (w.pose_list, w.picker.grid, w.weak_list.list, w.sentence_list.pinned)
        widget = self.dice.choice([*(view.viewport() for view in views), w.bigram_tabs, w.header, w.stage_panel])
        if widget.isVisible() and not widget.visibleRegion().isEmpty():
            QTest.mouseClick(widget, Button.LeftButton, pos=self.somewhere(widget).toPoint())

    def undo(self) -> None:
        stack = self.editor.document.undo_stack
        (stack.undo if self.dice.random() < 0.6 else stack.redo)()

    def open(self) -> None:
        phones = self.editor.document.curve_set.phonemes
        self.editor.wiring.bigram.open((self.dice.choice(phones), self.dice.choice(phones)))

    def palette(self) -> None:
        self.window.actions_.palette.trigger()
        field = self.editor.wiring.palette.view.field
        QTest.keyClicks(field, self.dice.choice(TYPED))
        for key in self.dice.choices((Key.Key_Down, Key.Key_Up, Key.Key_Backspace), k=2):
            QTest.keyClick(field, key)
        QTest.keyClick(field, Key.Key_Escape)

    def keymap(self) -> None:
        self.editor.wiring.keys.set_keymap(self.dice.choice(list(KEYMAPS)))

    def resize(self) -> None:
        self.window.resize(*self.dice.choice(((1600, 1000), (1280, 720), (1280, 900))))

    def somewhere(self, widget: QWidget) -> QPointF:
        return QPointF(self.dice.uniform(0, widget.width() - 1), self.dice.uniform(0, widget.height() - 1))

    @staticmethod
    def mouse(widget: QWidget, kind: QEvent.Type, at: QPointF) -> None:
        press = kind == QEvent.Type.MouseButtonPress
        held = Button.NoButton if kind == QEvent.Type.MouseButtonRelease else Button.LeftButton
        button = Button.LeftButton if press or held == Button.NoButton else Button.NoButton
        QApplication.sendEvent(widget, QMouseEvent(kind, at, widget.mapToGlobal(at), button, held, NONE))

    def check(self) -> None:
        """The laws."""
        editor, w = self.editor, self.window
        document, wiring = editor.document, editor.wiring
        pair, curve_set = wiring.bigram.pair, document.curve_set
        assert pair is not None
        assert SILENCE in pair or pair == w.picker.current  # the square has no silence
        assert wiring.tabs.pairs[wiring.tabs._at] == pair
        assert len(set(wiring.tabs.pairs)) == len(wiring.tabs.pairs)
        assert w.beside.isHidden() == (wiring.beside.pair is None)
        for canvas, shown in ((w.canvas, pair), (w.beside.canvas, wiring.beside.pair)):
            if not canvas.busy and shown is not None:
                bigram = curve_set.bigrams.get(shown)
                curves = bigram.curves if bigram is not None else {}
                assert set(canvas.curves) == set(curves)
                assert all(canvas.curves[pose] is curve for pose, curve in curves.items())
        assert w.isWindowModified() == document.is_dirty
        assert w.isVisible()
        assert w.canvas.width() > 100


def test_a_monkey_at_the_window(editor: Editor, qtbot: QtBot) -> None:
    with qtbot.waitSignal(editor.session.stages_changed, timeout=20_000):
        editor.wiring.sentence.type("Fat cats.", play=False)
    QGuiApplication.clipboard().clear()
    start = dict(editor.document.curve_set.bigrams)
    monkey = Monkey(editor, random.Random(SEED))
    monkey.check()
    for i in range(EVENTS):
        monkey.act()
        try:
            monkey.check()
        except AssertionError as error:
            raise AssertionError(f"seed {SEED}, event {i}") from error
    for canvas in (editor.window.canvas, editor.window.beside.canvas):
        QTest.keyClick(canvas, Key.Key_Escape)
    while editor.document.undo_stack.canUndo():
        editor.document.undo_stack.undo()
    now = editor.document.curve_set.bigrams
    assert all(now[pair] is bigram for pair, bigram in start.items())
    assert not editor.document.is_dirty


def test_edits_and_undos_leave_no_objects_behind(editor: Editor, qtbot: QtBot) -> None:
    document, pairs = editor.document, (("f", "ah"), ("l", "ow"))

    def round_trip() -> int:
        for i in range(8):
            editor.wiring.bigram.open(pairs[i % 2])
            editor.window.canvas.select_all()
            editor.window.canvas.nudge(0.0, 0.01)
            QApplication.processEvents()
        while document.undo_stack.canUndo():
            document.undo_stack.undo()
        document.undo_stack.clear()
        QApplication.processEvents()
        gc.collect()
        kinds = (str(type(thing).__module__).split(".")[0] for thing in gc.get_objects())
        return sum(kind in {"PySide6", "shiboken6", "app", "widgets"} for kind in kinds)

    qtbot.waitUntil(lambda: editor.preview.milliseconds > 0, timeout=20_000)  # the face has loaded what it needs
    round_trip()
    before = round_trip()
    assert round_trip() - before < 5
