"""Editing what is said, in the overlay's black rows: boundaries are dragged, phones renamed, put in, taken out.

drag a boundary in Phoneme or Start     move it; Esc gives it up
double-click a phone                    rename it
right-click a phone                     rename, insert, remove
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QPoint, QRect, QStringListModel, Qt, Signal
from PySide6.QtGui import QContextMenuEvent, QKeyEvent, QMouseEvent
from PySide6.QtWidgets import QCompleter, QLineEdit, QMenu, QWidget

from .stage_footer import ROW
from .stage_overlay import StageOverlay
from .stage_picking import phone_at

#: Pixels from a boundary within which it is taken hold of.
GRIP = 4
#: Pixels that the field for a phone's name has at least.
FIELD = 54


class PhoneField(QLineEdit):
    """Where a phone's name is typed: Enter keeps it, Escape does not."""

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Qt's hook."""
        if event.key() == Qt.Key.Key_Escape:
            self.setText("")
            self.hide()
        else:
            super().keyPressEvent(event)


class PhoneHand(StageOverlay):
    """The overlay with hands for its phones.

    edge_dragged(boundary, seconds)  while the mouse moves: show it
    edge_dropped(boundary, seconds)  the mouse let go: keep it
    edge_let_be()                    the drag was given up
    phone_renamed(phone, name)
    phone_inserted(phone, name, after)
    phone_removed(phone)
    """

    edge_dragged = Signal(int, float)
    edge_dropped = Signal(int, float)
    edge_let_be = Signal()
    phone_renamed = Signal(int, str)
    phone_inserted = Signal(int, str, bool)
    phone_removed = Signal(int)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._edge: int | None = None
        self._choices = QStringListModel(self)
        self._known: frozenset[str] = frozenset()
        self.field = PhoneField(self)
        self.field.hide()
        self.field.setAccessibleName(self.tr("Name of the phone"))
        self.field.setAccessibleDescription(self.tr("Enter renames the phone"))
        completer = QCompleter(self._choices, self.field)
        completer.setCompletionMode(QCompleter.CompletionMode.InlineCompletion)
        self.field.setCompleter(completer)
        self.field.editingFinished.connect(self._typed)
        self._asked: tuple[str, int] = ("", 0)

    def set_phone_choices(self, phones: Sequence[str]) -> None:
        """The names a phone may have; without any, nothing can be edited."""
        self._choices.setStringList(list(phones))
        self._known = frozenset(phones)

    # Boundaries

    def edge_at(self, at: QPoint) -> int | None:
        """The inner boundary under the mouse, in the rows of phones; None elsewhere."""
        if self._stages is None or not self._known or self._zone(at) not in ("phone", "start"):
            return None
        edges = np.asarray(self.axis.px(self._stages.schedule.times[1:-1]))
        if not edges.size or at.x() < self.axis.x0 - GRIP:
            return None
        nearest = int(np.argmin(np.abs(edges - at.x())))
        return nearest + 1 if abs(edges[nearest] - at.x()) <= GRIP else None

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Qt's hook: takes hold of a boundary."""
        at = event.position().toPoint()
        if event.button() == Qt.MouseButton.LeftButton and not self._gesture:
            self._edge = self.edge_at(at)
            if self._edge is not None:
                self._gesture, self._from = "edge", at
                return
        super().mousePressEvent(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Qt's hook: the boundary goes with the mouse."""
        at = event.position().toPoint()
        if self._gesture == "edge" and self._edge is not None:
            self.edge_dragged.emit(self._edge, self.axis.time(at.x()))
            return
        super().mouseMoveEvent(event)
        if not self._gesture and self.edge_at(at) is not None:
            self.setCursor(Qt.CursorShape.SplitHCursor)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Qt's hook: the boundary stays where it is let go."""
        if self._gesture != "edge" or event.button() != Qt.MouseButton.LeftButton:
            super().mouseReleaseEvent(event)
            return
        self._gesture = ""
        at = event.position().toPoint()
        if self._edge is not None and at.x() != self._from.x():
            self.edge_dropped.emit(self._edge, self.axis.time(at.x()))
        else:
            self.edge_let_be.emit()
        self._edge = None

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Qt's hook: Escape gives a drag up; F2 renames the phone at the playhead."""
        if event.key() == Qt.Key.Key_Escape and self._gesture == "edge":
            self._gesture, self._edge = "", None
            self.edge_let_be.emit()
        elif event.key() == Qt.Key.Key_F2 and self._stages is not None and self._known:
            self._ask("rename", phone_at(self._stages, self._playhead))
        else:
            super().keyPressEvent(event)

    # Names

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Qt's hook: a double-click on a phone renames it."""
        at = event.position().toPoint()
        phone = self._phone_under(at)
        if event.button() == Qt.MouseButton.LeftButton and phone is not None and self._zone(at) == "phone":
            self._ask("rename", phone)
        else:
            super().mouseDoubleClickEvent(event)

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        """Qt's hook: what can be done to a phone."""
        menu = self.menu_at(event.pos())
        if menu is None:
            super().contextMenuEvent(event)
        else:
            menu.popup(event.globalPos())

    def menu_at(self, at: QPoint) -> QMenu | None:
        """The context menu of the phone at a place; None where there is none."""
        phone = self._phone_under(at)
        if phone is None or self._stages is None:
            return None
        menu = QMenu(self)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        menu.addAction(self.tr("Rename…"), lambda: self._ask("rename", phone))
        menu.addAction(self.tr("Insert a Phone Before…"), lambda: self._ask("before", phone))
        menu.addAction(self.tr("Insert a Phone After…"), lambda: self._ask("after", phone))
        remove = menu.addAction(self.tr("Remove"), lambda: self.phone_removed.emit(phone))
        remove.setEnabled(len(self._stages.schedule) > 1)
        return menu

    def _phone_under(self, at: QPoint) -> int | None:
        editable = self._stages is not None and bool(self._known) and self._zone(at) in ("phone", "start")
        if not editable or self._stages is None or not self.axis.x0 - GRIP <= at.x() <= self.axis.x1 + GRIP:
            return None
        return phone_at(self._stages, self.axis.time(at.x()))

    def _ask(self, what: str, phone: int) -> None:
        """A field over the phone, with its name for a start."""
        if self._stages is None:
            return
        self._asked = (what, phone)
        left, right = (round(float(x)) for x in self.axis.px(self._stages.schedule.times[phone : phone + 2]))
        middle, wide = (left + right) // 2, max(FIELD, right - left)
        box = QRect(middle - wide // 2, self.rows_height + ROW - 3, wide, ROW + 6)
        box.moveLeft(max(0, min(box.left(), self.width() - wide)))
        self.field.setGeometry(box)
        names = self._sources if len(self._sources) == len(self._stages.schedule) else self._stages.schedule.phones
        self.field.setText(names[phone] if what == "rename" else "")
        self.field.selectAll()
        self.field.show()
        self.field.setFocus()

    def _typed(self) -> None:
        """Enter, or the focus went elsewhere; a name nobody knows changes nothing."""
        if not self.field.isVisible():
            return
        (what, phone), name = self._asked, self.field.text().strip()
        self.field.hide()
        self.setFocus()
        if name not in self._known:
            return
        if what == "rename":
            self.phone_renamed.emit(phone, name)
        else:
            self.phone_inserted.emit(phone, name, what == "after")
