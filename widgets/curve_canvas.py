"""The curve canvas: the curves of the open bigram over its normalised time, to be moved by hand.

Shows values, says what is wanted. While a gesture runs it shows its own working copy and tells it by
`preview_changed`; at the end it emits `edited` once, and the owner hands the new curves back in.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping

from PySide6.QtCore import QEvent, QPointF, Qt, Signal
from PySide6.QtGui import QAction, QContextMenuEvent, QKeyEvent, QMouseEvent
from PySide6.QtWidgets import QMenu, QWidget

from core_pipeline.curves import Curve

from .curve_controller import CurveController, Edit, Modifiers
from .curve_hints import hint_text, pair_title, selection_text
from .curve_plot import CurvePlot
from .curve_scene import KEY_REACH

NUDGE_STEP = 0.01
NUDGE_FINE = 0.001
NUDGE_COARSE = 0.05

_Key = Qt.Key
_ARROWS = {_Key.Key_Left: (-1, 0), _Key.Key_Right: (1, 0), _Key.Key_Up: (0, 1), _Key.Key_Down: (0, -1)}
_HELD = (_Key.Key_Shift, _Key.Key_Control, _Key.Key_Alt)


def _modifiers(held: Qt.KeyboardModifier) -> Modifiers:
    name = Qt.KeyboardModifier
    return Modifiers(bool(held & name.ShiftModifier), bool(held & name.ControlModifier), bool(held & name.AltModifier))


class CurveCanvas(CurvePlot):
    """Curves of one bigram: select, move, add, delete keys; zoom and pan.

    Values come in by set_…; curves given while a gesture runs wait until it has ended.
    """

    #: The working copies that just became others: dict pose → Curve.
    preview_changed = Signal(object)
    #: One gesture has ended: dict pose → Curve, None where the curve is gone; name of the gesture.
    edited = Signal(object, str)
    #: A gesture that sent previews has ended without an edit.
    cancelled = Signal()
    active_changed = Signal(str)
    #: What is selected, as a line for the status bar.
    selection_changed = Signal(str)
    #: What can be done now, or why something was refused.
    hint_changed = Signal(str)
    play_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(CurveController(), parent)
        self._pair = ("", "")
        self._last = QPointF()
        self._panning = False
        self._previewed = False
        self._told_selection = ""
        self._told_active = ""
        self._told_hint = ""
        self.setAccessibleName(self.tr("Curves"))
        self.viewport().setMouseTracking(True)

    # Values come down

    def set_poses(self, poses: tuple[str, ...]) -> None:
        """All poses of the set, in order; all become visible and unlocked."""
        self._stop()
        self._control.set_poses(poses)
        self._told_active = self._control.active
        self._tell()

    def set_bigram(self, first: str, second: str) -> None:
        """The open bigram's phones; another one than before ends a running gesture and clears the selection."""
        if (first, second) != self._pair:
            self._stop()
            self._control.selection = frozenset()
            self._pair = (first, second)
            self._show_phones(first.capitalize(), second.capitalize())
            self.setAccessibleName(self.tr("Curves of {0}").format(pair_title(first, second)))
        self._tell()

    def set_curves(self, curves: Mapping[str, Curve]) -> None:
        """The curves of the open bigram, pose → curve."""
        self._control.set_curves(curves)
        self._tell()

    def set_active(self, pose: str) -> None:
        """The pose that is bold, is picked first and gets new keys."""
        self._control.set_active(pose)
        self._told_active = self._control.active
        self._tell()

    def set_visible_poses(self, poses: Collection[str]) -> None:
        """The poses that are drawn; the curves of the others stay as they are."""
        self._control.set_visible(poses)
        self._tell()

    def set_locked(self, poses: Collection[str]) -> None:
        """The poses that refuse edits."""
        self._control.set_locked(poses)
        self._tell()

    def set_snap(self, on: bool) -> None:
        """Whether keys keep to the grid; Ctrl does the opposite while it is held."""
        self._control.snap = on

    # What is shown, for the owner and for tests

    @property
    def curves(self) -> dict[str, Curve]:
        """The curves as shown now, working copies included."""
        return dict(self._control.curves)

    @property
    def active(self) -> str:
        """The active pose."""
        return self._control.active

    @property
    def selection(self) -> frozenset[tuple[str, int]]:
        """Selected keys as (pose, index)."""
        return self._control.selection

    @property
    def busy(self) -> bool:
        """Whether a gesture is running."""
        return self._control.busy

    def select(self, keys: Collection[tuple[str, int]]) -> None:
        """Selects these keys; unknown, hidden or locked ones are left out."""
        if not self.busy:
            self._control.select(keys)
            self._tell()

    # Single actions, also for menus

    def select_all(self) -> None:
        """All keys of the active curve; once more: of every curve."""
        if not self.busy:
            self._control.select_all()
            self._tell()

    def delete_selection(self) -> None:
        """Wishes the selected keys away."""
        self._do(self._control.delete)

    def nudge(self, dt: float, dv: float) -> None:
        """Wishes the selected keys moved by a little, as far as there is room."""
        self._do(lambda: self._control.nudge(dt, dv))

    def select_next(self, step: int = 1) -> None:
        """The next key of the active curve, or the previous one with step −1."""
        if not self.busy:
            self._control.select_next(step)
            self._tell()

    def _do(self, action: Callable[[], Edit | None]) -> None:
        if not self.busy:
            self._finish(action())

    # The mouse

    def mousePressEvent(self, ev: QMouseEvent) -> None:
        """Left: select, move, marquee. Middle, or Alt on nothing: pan."""
        ev.accept()
        self.setFocus(Qt.FocusReason.MouseFocusReason)
        if self.busy or self._panning:
            return
        x, y = self._at(ev)
        held = _modifiers(ev.modifiers())
        left = ev.button() == Qt.MouseButton.LeftButton
        empty = self._control.key_at(x, y) is None
        if ev.button() == Qt.MouseButton.MiddleButton or (left and held.alt and empty):
            self._panning, self._last = True, ev.position()
            self._show_cursor()
        elif left and self._area().adjusted(-KEY_REACH, -KEY_REACH, KEY_REACH, KEY_REACH).contains(x, y):
            self._control.press(x, y, held)
            self._tell()

    def mouseDoubleClickEvent(self, ev: QMouseEvent) -> None:
        """A key on the active curve; holding on, it can be moved at once, as a second gesture."""
        ev.accept()
        x, y = self._at(ev)
        left, free = ev.button() == Qt.MouseButton.LeftButton, self._control.key_at(x, y) is None
        if left and free and self._area().contains(x, y):
            self._do(lambda: self._control.add(x, y))
        if self._control.refusal is None:
            self.mousePressEvent(ev)

    def mouseMoveEvent(self, ev: QMouseEvent) -> None:
        """Goes on with the gesture, or shows what lies under the pointer."""
        ev.accept()
        if self._panning:
            if ev.buttons() == Qt.MouseButton.NoButton:
                self._stop_panning()
                return
            self._pan(ev.position() - self._last)
            self._last = ev.position()
            return
        self._last = ev.position()
        if self.busy and not ev.buttons() & Qt.MouseButton.LeftButton:
            self._release(ev)  # the release went elsewhere
            return
        self._move(ev.modifiers())

    def _move(self, held: Qt.KeyboardModifier) -> None:
        x, y = self._scene(self._last)
        hover, band = self._control.hover, self._control.band
        changed = self._control.move(x, y, _modifiers(held))
        if changed:
            self._previewed = True
            self.preview_changed.emit(dict(changed))
        if changed or self._control.hover != hover or self._control.band != band:
            self._tell()

    def mouseReleaseEvent(self, ev: QMouseEvent) -> None:
        """Ends the gesture."""
        ev.accept()
        if self._panning:
            self._stop_panning()
        elif ev.button() == Qt.MouseButton.LeftButton and self.busy:
            self._release(ev)

    def _release(self, ev: QMouseEvent) -> None:
        x, y = self._at(ev)
        self._finish(self._control.release(x, y))

    def _stop_panning(self) -> None:
        self._panning = False
        self._show_cursor()

    def leaveEvent(self, ev: QEvent) -> None:
        """Nothing is under the pointer any more."""
        if self._control.hover is not None and not self.busy:
            self._control.hover = None
            self._tell()
        ev.accept()

    def contextMenuEvent(self, ev: QContextMenuEvent) -> None:
        """What can be done at the pointer, or with the selection when asked for by key."""
        ev.accept()
        if self.busy or self._panning:
            return
        by_mouse = ev.reason() == QContextMenuEvent.Reason.Mouse
        x, y = self._scene(QPointF(ev.pos())) if by_mouse else self._scene(QPointF(self.viewport().rect().center()))
        self._menu = self.menu_at(x, y)
        self._menu.popup(ev.globalPos())

    def menu_at(self, x: float, y: float) -> QMenu:
        """The context menu for a place, in scene pixels; a key there is selected first."""
        control = self._control
        key = control.key_at(x, y)
        if key is not None and key not in control.selection and control.refuses(key[0]) is None:
            control.set_active(key[0])
            control.selection = frozenset({key})
            self._tell()
        menu = QMenu(self)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)

        def add(text: str, shortcut: str, act: Callable[[], object], enabled: bool = True) -> None:
            action = QAction(text + ("\t" + shortcut if shortcut else ""), menu)
            action.setEnabled(enabled)
            action.triggered.connect(act)
            menu.addAction(action)

        here = key is None and self._area().contains(x, y) and control.refuses(control.active) is None
        add(
            self.tr("Add key to {0}").format(control.active),
            self.tr("Double-click"),
            lambda: self._do(lambda: control.add(x, y, anywhere=True)),
            here,
        )
        add(self.tr("Delete keys"), self.tr("Del"), self.delete_selection, bool(control.selection))
        menu.addSeparator()
        add(self.tr("Select all keys"), self.tr("Ctrl+A"), self.select_all, bool(control.editable()))
        add(self.tr("Frame selection"), "F", self.frame, bool(control.selection))
        add(self.tr("Frame all"), self.tr("Home"), self.frame_all)
        return menu

    # The keyboard

    def event(self, ev: QEvent) -> bool:
        """Claims the canvas' own keys before a window shortcut takes them."""
        if isinstance(ev, QKeyEvent) and ev.type() == QEvent.Type.ShortcutOverride and self._act_of(ev) is not None:
            ev.accept()
            return True
        return bool(super().event(ev))

    def keyPressEvent(self, ev: QKeyEvent) -> None:
        """Esc, Del, arrows, Ctrl+A, comma and point, F, Home, Space; modifiers take effect in a drag at once."""
        if ev.key() in _HELD and self._control.dragging:
            self._move(_held_after(ev))
            return
        act = self._act_of(ev)
        if act is None:
            ev.ignore()
        else:
            act()

    def keyReleaseEvent(self, ev: QKeyEvent) -> None:
        """A modifier let go takes effect in a drag at once."""
        if ev.key() in _HELD and self._control.dragging:
            self._move(_held_after(ev))
        else:
            ev.ignore()

    def _act_of(self, ev: QKeyEvent) -> Callable[[], object] | None:
        key, held = ev.key(), _modifiers(ev.modifiers())
        if key in _ARROWS and not held.alt:
            step = NUDGE_FINE if held.shift else NUDGE_COARSE if held.ctrl else NUDGE_STEP
            dt, dv = _ARROWS[_Key(key)]
            return lambda: self.nudge(dt * step, dv * step)
        if key == _Key.Key_A and held == Modifiers(ctrl=True):
            return self.select_all
        if key == _Key.Key_Escape and (self.busy or self.selection):
            return self._escape
        if held != Modifiers():
            return None
        acts: dict[int, Callable[[], object]] = {
            _Key.Key_Delete: self.delete_selection,
            _Key.Key_Backspace: self.delete_selection,
            _Key.Key_Comma: lambda: self.select_next(-1),
            _Key.Key_Period: lambda: self.select_next(1),
            _Key.Key_F: self.frame,
            _Key.Key_Home: self.frame_all,
            _Key.Key_Space: self.play_wanted.emit,
        }
        return acts.get(key)

    def _escape(self) -> None:
        if self.busy:
            self._stop()
        else:
            self._control.selection = frozenset()
        self._tell()

    # Telling

    def _stop(self) -> None:
        """Ends a running gesture as if it had never been."""
        if self._control.cancel():
            self._finish(None)

    def _finish(self, edit: Edit | None) -> None:
        previewed, self._previewed = self._previewed, False
        if edit is not None:
            self.edited.emit(dict(edit.changes), edit.label)
        elif previewed:
            self.cancelled.emit()
        self._tell()

    def _tell(self) -> None:
        """Says what has become different since the last time, and repaints."""
        control = self._control
        if control.active != self._told_active:
            self._told_active = control.active
            self.active_changed.emit(control.active)
        text = selection_text(control, self._pair)
        if text != self._told_selection:
            self._told_selection = text
            self.setAccessibleDescription(text)
            self.selection_changed.emit(text)
        hint = hint_text(control)
        if hint != self._told_hint:
            self._told_hint = hint
            self.hint_changed.emit(hint)
        self._show_cursor()
        self._item.update()

    def _show_cursor(self) -> None:
        control = self._control
        shape = Qt.CursorShape.CrossCursor
        if self._panning:
            shape = Qt.CursorShape.ClosedHandCursor
        elif control.hover is not None and control.hover[0] in control.locked:
            shape = Qt.CursorShape.ForbiddenCursor
        elif control.hover is not None or control.dragging:
            shape = Qt.CursorShape.SizeAllCursor
        if self.viewport().cursor().shape() != shape:
            self.viewport().setCursor(shape)

    def _at(self, ev: QMouseEvent) -> tuple[float, float]:
        self._last = ev.position()
        return self._scene(self._last)


def _held_after(ev: QKeyEvent) -> Qt.KeyboardModifier:
    """The modifiers once this press or release of one of them has happened."""
    name = Qt.KeyboardModifier
    which = {_Key.Key_Shift: name.ShiftModifier, _Key.Key_Control: name.ControlModifier, _Key.Key_Alt: name.AltModifier}
    own = which[_Key(ev.key())]
    return ev.modifiers() | own if ev.type() == QEvent.Type.KeyPress else ev.modifiers() & ~own
