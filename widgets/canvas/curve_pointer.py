"""The mouse on the canvas, and what the canvas tells while things change.

While a gesture runs the canvas shows its own working copy and tells it by `preview_changed`; at the end it
emits `edited` once, and the owner hands the new curves back in.
"""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, QPointF, Qt, Signal
from PySide6.QtGui import QFocusEvent, QMouseEvent
from PySide6.QtWidgets import QWidget

from .curve_controller import CurveController, Edit
from .curve_hints import hint_text, pair_title, selection_text
from .curve_keyboard import modifiers_of
from .curve_plot import CurvePlot
from .curve_scene import KEY_REACH
from .keymaps import KEYMAPS, NEUTRAL
from .transform_box import HANDLE_REACH, PADDING

#: How far outside the plot a press still means it: handles of keys at the edge lie there.
MARGIN = max(KEY_REACH, PADDING + HANDLE_REACH)

_Shape = Qt.CursorShape
_HANDLE_CURSORS = {
    (True, False): _Shape.SizeHorCursor,
    (False, True): _Shape.SizeVerCursor,
}


class CurvePointer(CurvePlot):
    """The plot with a hand on it."""

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
    #: Curves, selected keys, the active pose, whether it may be edited or a gesture runs: one has become another.
    shown_changed = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(CurveController(), parent)
        self._pair = ("", "")
        self._keymap = KEYMAPS[NEUTRAL]
        self._last = QPointF()
        self._inside = False
        self._panning = False
        self._no_menu = False
        self._previewed = False
        self._told_selection = ""
        self._told_active = ""
        self._told_hint = ""
        self._told_shown: object = None
        self.viewport().setMouseTracking(True)

    @property
    def busy(self) -> bool:
        """Whether a gesture is running."""
        return self._control.busy

    def _do(self, action: Callable[[], Edit | None]) -> None:
        if not self.busy:
            self._finish(action())

    def mousePressEvent(self, ev: QMouseEvent) -> None:
        """Left: select, move, scale, marquee; middle, or Alt on nothing: pan. A click ends what no button holds."""
        ev.accept()
        self._inside, self._no_menu = True, False
        modal = self._control.modal
        self.setFocus(Qt.FocusReason.MouseFocusReason)
        if modal:
            self._end_modal(ev)
            return
        if self.busy or self._panning:
            return
        x, y = self._at(ev)
        held = modifiers_of(ev.modifiers())
        left = ev.button() == Qt.MouseButton.LeftButton
        empty = self._control.key_at(x, y) is None and self._control.handle_at(x, y) is None
        if ev.button() == Qt.MouseButton.MiddleButton or (left and held.alt and empty):
            self._panning, self._last = True, ev.position()
            self._show_cursor()
        elif left and self._area().adjusted(-MARGIN, -MARGIN, MARGIN, MARGIN).contains(x, y):
            self._control.press(x, y, held)
            self._tell()

    def _end_modal(self, ev: QMouseEvent) -> None:
        if ev.button() == Qt.MouseButton.LeftButton and self.busy:
            if not self._control.blending:
                self._at(ev)
                self._move(ev.modifiers())
            self._keep()
        elif ev.button() == Qt.MouseButton.RightButton:
            self._no_menu = True  # this press was no wish for one
            self._stop()

    def mouseDoubleClickEvent(self, ev: QMouseEvent) -> None:
        """A key on the active curve; holding on, it can be moved at once, as a second gesture."""
        ev.accept()
        x, y = self._at(ev)
        left = ev.button() == Qt.MouseButton.LeftButton
        free = self._control.key_at(x, y) is None and self._control.handle_at(x, y) is None
        if left and free and self._area().contains(x, y):
            self._do(lambda: self._control.add(x, y))
        if self._control.refusal is None:
            self.mousePressEvent(ev)

    def mouseMoveEvent(self, ev: QMouseEvent) -> None:
        """Goes on with the gesture, or shows what lies under the pointer."""
        ev.accept()
        self._inside = True
        if self._panning:
            if ev.buttons() == Qt.MouseButton.NoButton:
                self._stop_panning()
                return
            self._pan(ev.position() - self._last)
            self._last = ev.position()
            return
        self._last = ev.position()
        if self.busy and not self._control.modal and not ev.buttons() & Qt.MouseButton.LeftButton:
            self._keep()  # the release went elsewhere
            return
        self._move(ev.modifiers())

    def _move(self, held: Qt.KeyboardModifier) -> None:
        control = self._control
        x, y = self._scene(self._last)
        before = control.hover, control.hover_handle, control.band
        changed = control.move(x, y, modifiers_of(held))
        if changed:
            self._previewed = True
            self.preview_changed.emit(dict(changed))
        if changed or (control.hover, control.hover_handle, control.band) != before:
            self._tell()

    def mouseReleaseEvent(self, ev: QMouseEvent) -> None:
        """Ends the gesture."""
        ev.accept()
        if self._panning:
            self._stop_panning()
        elif ev.button() == Qt.MouseButton.LeftButton and self.busy and not self._control.modal:
            self._at(ev)
            self._keep()

    def _keep(self) -> None:
        """Ends a running gesture as it stands."""
        self._finish(self._control.release(*self._scene(self._last)))

    def _stop(self) -> None:
        """Ends a running gesture as if it had never been."""
        if self._control.cancel():
            self._finish(None)

    def _stop_panning(self) -> None:
        self._panning = False
        self._show_cursor()

    def leaveEvent(self, ev: QEvent) -> None:
        """Nothing is under the pointer any more."""
        ev.accept()
        self._inside = False
        control = self._control
        if not self.busy and (control.hover is not None or control.hover_handle is not None):
            control.hover = control.hover_handle = None
            self._tell()

    def focusOutEvent(self, ev: QFocusEvent) -> None:
        """What no button holds is kept when the hand goes elsewhere."""
        super().focusOutEvent(ev)
        if self._control.modal and not self._control.blending:
            self._keep()

    def close(self) -> bool:
        """Ends a gesture unkept before the plot is taken apart."""
        self._stop()
        return bool(super().close())

    # Telling

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
        hint = hint_text(control, self._keymap)
        if hint != self._told_hint:
            self._told_hint = hint
            self.hint_changed.emit(hint)
        may = control.refuses(control.active) is None
        shown = control.busy, control.active, may, control.selection, tuple(control.curves.items())
        if shown != self._told_shown:
            self._told_shown = shown
            self.shown_changed.emit()
        self._show_cursor()
        self._item.update()

    def _show_cursor(self) -> None:
        control = self._control
        shape = _Shape.CrossCursor
        if self._panning:
            shape = _Shape.ClosedHandCursor
        elif control.hover_handle is not None:
            i, j = control.hover_handle
            diagonal = _Shape.SizeBDiagCursor if i == j else _Shape.SizeFDiagCursor
            shape = _HANDLE_CURSORS.get((bool(i), bool(j)), diagonal)
        elif control.hover is not None and control.hover[0] in control.locked:
            shape = _Shape.ForbiddenCursor
        elif control.hover is not None or control.dragging:
            shape = _Shape.SizeAllCursor
        if self.viewport().cursor().shape() != shape:
            self.viewport().setCursor(shape)

    def _at(self, ev: QMouseEvent) -> tuple[float, float]:
        self._last = ev.position()
        return self._scene(self._last)

    def _show_pair(self, first: str, second: str) -> None:
        self._pair = (first, second)
        self._show_phones(first.capitalize(), second.capitalize())
        self.setAccessibleName(self.tr("Curves of {0}").format(pair_title(first, second)))
