"""The curve canvas: the curves of the open bigram over its normalised time, to be moved by hand.

Shows values, says what is wanted. The mouse is in curve_pointer, other versions in curve_compare; here are
the values that come down, the single actions, and the keyboard, whose keys are data in keymaps.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping

from PySide6.QtCore import QEvent, QPointF, Qt, Signal
from PySide6.QtGui import QContextMenuEvent, QGuiApplication, QKeyEvent
from PySide6.QtWidgets import QMenu, QWidget

from core_pipeline.curves import Curve

from .curve_clipboard import Copied, NotCurvesError, from_text, to_text
from .curve_compare import CurveCompare
from .curve_controller import CUT, Edit
from .curve_hints import UNREADABLE, key_name
from .curve_keyboard import HELD, held_after, key_of, modifiers_of
from .curve_menu import CurveMenu
from .keymaps import KEYMAPS, NEUTRAL, action_of

NUDGE_STEP = 0.01
NUDGE_FINE = 0.001
NUDGE_COARSE = 0.05

#: Pixels an arrow key moves the pointer of a gesture that no button holds.
ARROW_PIXELS = 8.0

_Key = Qt.Key
_ARROWS = {_Key.Key_Left: (-1, 0), _Key.Key_Right: (1, 0), _Key.Key_Up: (0, 1), _Key.Key_Down: (0, -1)}
_ENTER = (_Key.Key_Return, _Key.Key_Enter)


class CurveCanvas(CurveCompare):
    """Curves of one bigram: select, move, scale, add, delete, copy keys; swap versions; zoom and pan.

    Values come in by set_…; curves given while a gesture runs wait until it has ended.
    """

    play_wanted = Signal()
    #: These poses alone are to be shown, none: all again. frozenset of poses.
    solo_wanted = Signal(object)
    #: Another keymap: dict action → its first key, as this system writes it.
    keys_changed = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAccessibleName(self.tr("Curves"))
        self._acts: dict[str, Callable[[], object]] = {
            "add": self.add_key,
            "delete": self.delete_selection,
            "reverse": self.reverse,
            "mirror": self.mirror,
            "copy": self.copy,
            "cut": self.cut,
            "paste": self.paste,
            "paste_reversed": lambda: self.paste(backwards=True),
            "swap": self.swap,
            "slide": self.slide,
            "duplicate": self.duplicate,
            "select_all": self.select_all,
            "select_none": lambda: self.select(()),
            "previous_key": lambda: self.select_next(-1),
            "next_key": self.select_next,
            "previous_pose": lambda: self.next_pose(-1),
            "next_pose": self.next_pose,
            "frame": self.frame,
            "frame_all": self.frame_all,
            "play": self.play_wanted.emit,
            "grab": self.begin_move,
            "scale": self.begin_scale,
            "isolate": self.isolate,
            "time_only": lambda: self._keep_axis("t"),
            "weight_only": lambda: self._keep_axis("v"),
        }

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
            self._show_pair(first, second)
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

    def set_solo(self, poses: Collection[str]) -> None:
        """While there are any, these alone are drawn."""
        self._control.set_solo(poses)
        self._tell()

    def set_locked(self, poses: Collection[str]) -> None:
        """The poses that refuse edits."""
        self._control.set_locked(poses)
        self._tell()

    def set_snap(self, on: bool) -> None:
        """Whether keys keep to the grid; Ctrl does the opposite while it is held."""
        self._control.snap = on

    def set_keymap(self, name: str = NEUTRAL) -> None:
        """Which keys do what: one of keymaps.KEYMAPS (KeyError otherwise)."""
        self._keymap = KEYMAPS[name]
        self.keys_changed.emit(self.keys)
        self._tell()

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
    def keys(self) -> dict[str, str]:
        """Action → its first key in the present keymap, as this system writes it."""
        return {action: key_name(names[0]) for action, names in self._keymap.items()}

    @property
    def editable(self) -> bool:
        """Whether the active pose can be edited now."""
        return self._control.refuses(self._control.active) is None

    def select(self, keys: Collection[tuple[str, int]]) -> None:
        """Selects these keys; unknown, hidden or locked ones are left out."""
        if not self.busy:
            self._control.select(keys)
            self._tell()

    # Single actions, also for menus

    def act(self, action: str) -> None:
        """Does what the key of a keymap's action does; KeyError when there is no such action."""
        self._acts[action]()

    def select_all(self) -> None:
        """All keys of the active curve; once more: of every curve."""
        if not self.busy:
            self._control.select_all()
            self._tell()

    def select_next(self, step: int = 1) -> None:
        """The next key of the active curve, or the previous one with step −1."""
        if not self.busy:
            self._control.select_next(step)
            self._tell()

    def next_pose(self, step: int = 1) -> None:
        """Makes the next visible pose active, or the previous one with step −1."""
        if not self.busy:
            self._control.next_pose(step)
            self._tell()

    def add_key(self) -> None:
        """Wishes a key half way to the next one; see CurveController.add_between."""
        self._do(self._control.add_between)

    def delete_selection(self) -> None:
        """Wishes the selected keys away."""
        self._do(self._control.delete)

    def nudge(self, dt: float, dv: float) -> None:
        """Wishes the selected keys moved by a little, as far as there is room."""
        self._do(lambda: self._control.nudge(dt, dv))

    def reverse(self) -> None:
        """Wishes the selection mirrored in time; without a selection the active curve."""
        self._do(self._control.reverse)

    def mirror(self) -> None:
        """Wishes the selection's weights turned upside down; without a selection the active curve's."""
        self._do(self._control.mirror)

    def type_value(self, axis: str, text: str, keys: Mapping[str, list[int]] | None = None) -> None:
        """Wishes times ("t") or weights ("v") of the selection, or of `keys`, as typed: “.3”, “*0.5”, “+0.1”."""
        self._do(lambda: self._control.type_value(axis, text, keys))

    def isolate(self) -> None:
        """Wishes the active pose shown alone, or all poses again."""
        control = self._control
        self.solo_wanted.emit(frozenset() if control.solo or not control.active else frozenset({control.active}))

    def copy(self) -> None:
        """Puts the selected keys on the clipboard; without a selection the active curve."""
        copied = self._control.copy()
        if copied is not None:
            QGuiApplication.clipboard().setText(to_text(Copied(copied.curves, copied.whole, self._pair)))
        self._tell()

    def cut(self) -> None:
        """Copies the selected keys and wishes them away."""
        if self._control.selection and not self.busy:
            self.copy()
        self._do(lambda: self._control.delete(CUT))

    def paste(self, *, backwards: bool = False) -> None:
        """Wishes in what is on the clipboard, `backwards` mirrored in time; says so when these are no curves."""
        self._do(lambda: self._pasted(backwards))

    def _pasted(self, backwards: bool) -> Edit | None:
        try:
            copied = from_text(QGuiApplication.clipboard().text())
        except NotCurvesError as reason:
            self._control.refusal = UNREADABLE[str(reason)], ""
            return None
        return self._control.paste(copied, backwards=backwards)

    # Gestures that no button holds

    def begin_move(self) -> None:
        """The selection follows the pointer until a click or Enter."""
        if not self._inside:
            self._last = QPointF(self.viewport().rect().center())
        if not self.busy:
            self._control.begin_move(*self._scene(self._last))
            self._tell()

    def begin_scale(self) -> None:
        """The selection stretches about its middle until a click or Enter."""
        if not self.busy:
            start = self._control.begin_scale(self._scene(self._last) if self._inside else None)
            if start is not None and not self._inside:
                self._last = QPointF(self.viewportTransform().map(QPointF(*start)))
            self._tell()

    def _keep_axis(self, axis: str) -> None:
        self._control.keep_axis(axis)
        self._move(QGuiApplication.keyboardModifiers())

    # The menu

    def contextMenuEvent(self, ev: QContextMenuEvent) -> None:
        """What can be done at the pointer, or with the selection when asked for by key."""
        ev.accept()
        if self.busy or self._panning or self._no_menu:
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
        can = {
            "add": key is None and self._area().contains(x, y) and self.editable,
            "delete": bool(control.selection),
            "cut": bool(control.selection),
            "scale": control.box() is not None,
            "select_all": bool(control.editable()),
            "frame": bool(control.selection),
        }
        acts = {**self._acts, "add": lambda: self._do(lambda: control.add(x, y, anywhere=True))}
        return CurveMenu(self, control.active, acts, self.keys, {action for action, able in can.items() if not able})

    # The keyboard

    def event(self, ev: QEvent) -> bool:
        """Claims the canvas' own keys before a window shortcut takes them; all of them while a gesture runs."""
        key = ev if isinstance(ev, QKeyEvent) and ev.type() == QEvent.Type.ShortcutOverride else None
        if key is not None and (self.busy or self._act_of(key) is not None):
            ev.accept()
            return True
        return bool(super().event(ev))

    def keyPressEvent(self, ev: QKeyEvent) -> None:
        """The keymap's keys, Esc, Enter, arrows; modifiers take effect in a drag at once."""
        if ev.key() in HELD and self._control.dragging:
            self._move(held_after(ev))
            return
        act = self._act_of(ev)
        if act is None:
            ev.ignore()
        else:
            act()

    def keyReleaseEvent(self, ev: QKeyEvent) -> None:
        """A modifier let go takes effect in a drag at once."""
        if ev.key() in HELD and self._control.dragging:
            self._move(held_after(ev))
        else:
            ev.ignore()

    def _act_of(self, ev: QKeyEvent) -> Callable[[], object] | None:
        key, held = ev.key(), modifiers_of(ev.modifiers())
        if key == _Key.Key_Escape and (self.busy or self.selection):
            return self._escape
        if key in _ENTER and self._control.modal:
            return self._keep
        if key in _ARROWS and not held.alt and not self._control.blending:
            dt, dv = _ARROWS[_Key(key)]
            if self._control.modal:
                return lambda: self._steer(dt, dv, ev.modifiers())
            step = NUDGE_FINE if held.shift else NUDGE_COARSE if held.ctrl else NUDGE_STEP
            return lambda: self.nudge(dt * step, dv * step)
        action = action_of(self._keymap, key_of(ev), in_gesture=self._control.dragging)
        return self._acts[action] if action is not None else None

    def _steer(self, across: int, up: int, held: Qt.KeyboardModifier) -> None:
        self._last += QPointF(across * ARROW_PIXELS, -up * ARROW_PIXELS)
        self._move(held)

    def _escape(self) -> None:
        if self.busy:
            self._stop()
        else:
            self._control.selection = frozenset()
        self._tell()
