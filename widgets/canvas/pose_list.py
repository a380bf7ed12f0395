"""The poses beside the canvas: colour, name, solo, eye and lock; the current one is highlighted."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from PySide6.QtCore import QModelIndex, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QIcon, QKeyEvent, QMouseEvent, QPainter, QPen, QPixmap
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTreeWidget, QTreeWidgetItem, QWidget

from .. import theme

NAME, EYE, LOCK, SOLO = range(4)

_ROW = 24
_SWATCH = 12
#: Pixels of the widest list that asks for room for whole names.
_WIDEST = 240


class PoseList(QTreeWidget):
    """Picks the active pose; its eye, lock and solo switch say what is wanted.

    Up and down pick, V shows or hides the current pose, L locks or unlocks it, S makes it solo. While poses
    are solo the eyes of the others have no effect. Poses without a curve are dimmed and have a hollow swatch.
    """

    pose_picked = Signal(str)
    visibility_changed = Signal(str, bool)
    lock_changed = Signal(str, bool)
    #: These poses alone are to be shown, none: all again. frozenset of poses.
    solo_wanted = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._poses: tuple[str, ...] = ()
        self._items: dict[str, QTreeWidgetItem] = {}
        self._meanings: Mapping[str, str] = {}
        self._drawn: frozenset[str] = frozenset()
        self._visible: frozenset[str] = frozenset()
        self._locked: frozenset[str] = frozenset()
        self._solo: frozenset[str] = frozenset()
        self._active = ""
        self.setAccessibleName(self.tr("Poses"))
        self.setAccessibleDescription(
            self.tr("Up and down pick a pose, V shows or hides it, L locks or unlocks it, S shows it alone.")
        )
        self.setColumnCount(4)
        self.setHeaderHidden(True)
        self.setRootIsDecorated(False)
        self.setIndentation(0)
        self.setUniformRowHeights(True)
        self.setAllColumnsShowFocus(True)
        self.setIconSize(QSize(_SWATCH + 4, _SWATCH + 4))
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setStyleSheet(
            f"QTreeWidget{{border:1px solid {theme.PANEL.name()};background:{theme.PANEL.name()};outline:0}}"
            f"QTreeWidget:focus{{border-color:{theme.ACCENT.name()}}}"
            f"QTreeWidget::item:selected{{background:{theme.CHECKED.name()};color:{theme.BRIGHT.name()}}}"
        )
        header = self.header()
        header.setMinimumSectionSize(_ROW)
        header.setStretchLastSection(False)
        header.setSectionResizeMode(NAME, QHeaderView.ResizeMode.Stretch)
        for column in (EYE, LOCK, SOLO):
            header.setSectionResizeMode(column, QHeaderView.ResizeMode.Fixed)
            header.resizeSection(column, 26)
        header.moveSection(SOLO, EYE)
        self._icons = {
            "seen": theme.icon("eye-outline", theme.MUTED),
            "unseen": theme.icon("eye-off-outline", theme.BRIGHT),
            "open": theme.icon("lock-open-variant-outline", theme.BORDER),
            "locked": theme.icon("lock", theme.HIGHLIGHT),
            "solo": theme.icon("alpha-s-box", theme.HIGHLIGHT),
            "together": theme.icon("alpha-s-box-outline", theme.BORDER),
        }
        self.currentItemChanged.connect(self._pick)
        self.setTextElideMode(Qt.TextElideMode.ElideMiddle)  # names differ at their ends: tongue up, tongue out
        self.setMinimumWidth(150)

    # Values come down

    def set_poses(self, poses: tuple[str, ...], meanings: Mapping[str, str] | None = None) -> None:
        """The poses in order, all visible and unlocked; `meanings` are tooltips."""
        self._poses, self._meanings = tuple(poses), dict(meanings or {})
        self._visible, self._locked, self._solo = frozenset(poses), frozenset(), frozenset()
        self._active = self._active if self._active in poses else ""
        active = self._active
        self.clear()
        self._items = {pose: QTreeWidgetItem([pose]) for pose in poses}
        for item in self._items.values():
            item.setSizeHint(NAME, QSize(60, _ROW))
        self.addTopLevelItems(list(self._items.values()))
        self._refresh()
        self.set_active(active)

    def set_drawn(self, poses: Collection[str]) -> None:
        """The poses that have a curve in the open bigram."""
        if frozenset(poses) != self._drawn:
            self._drawn = frozenset(poses)
            self._refresh()

    def set_active(self, pose: str) -> None:
        """The current pose; "" for none."""
        self._active = pose
        if pose in self._items:
            self.setCurrentItem(self._items[pose])
        else:
            self.setCurrentIndex(QModelIndex())

    def set_visible_poses(self, poses: Collection[str]) -> None:
        """The poses whose eye is open."""
        self._visible = frozenset(poses)
        self._refresh()

    def set_locked(self, poses: Collection[str]) -> None:
        """The poses whose lock is closed."""
        self._locked = frozenset(poses)
        self._refresh()

    def set_solo(self, poses: Collection[str]) -> None:
        """The poses that alone are shown; none: all whose eye is open."""
        self._solo = frozenset(poses)
        self._refresh()

    def sizeHint(self) -> QSize:
        """Wide enough for the names and both icons, tall enough for every pose."""
        names = max((self.fontMetrics().horizontalAdvance(pose) for pose in self._poses), default=60)
        return QSize(min(max(150, names + _SWATCH + 120), _WIDEST), _ROW * max(3, len(self._poses)) + 4)

    def _refresh(self) -> None:
        for index, (pose, item) in enumerate(self._items.items()):
            drawn, seen, locked = pose in self._drawn, pose in self._visible, pose in self._locked
            item.setIcon(NAME, _swatch(theme.pose_colour(pose, index), drawn))
            item.setForeground(NAME, theme.TEXT if drawn else theme.FAINT)
            item.setIcon(EYE, self._icons["seen" if seen else "unseen"])
            item.setIcon(LOCK, self._icons["locked" if locked else "open"])
            solo = pose in self._solo
            item.setIcon(SOLO, self._icons["solo" if solo else "together"])
            alone = self.tr("Show all poses again (S)") if solo else self.tr("Show {0} alone (S); Shift: also")
            item.setToolTip(SOLO, alone.format(pose))
            eye = self.tr("Hide {0} (V); its curve stays") if seen else self.tr("Show {0} (V)")
            lock = self.tr("Unlock {0} (L)") if locked else self.tr("Lock {0} (L)")
            meaning = self._meanings.get(pose, "")
            item.setToolTip(NAME, f"{pose}: {meaning}" if meaning else pose)
            item.setToolTip(EYE, eye.format(pose))
            item.setToolTip(LOCK, lock.format(pose))
            states = [
                self.tr("has a curve") if drawn else self.tr("no curve"),
                self.tr("visible") if seen else self.tr("hidden"),
                self.tr("locked") if locked else self.tr("unlocked"),
                *([self.tr("solo")] if solo else []),
            ]
            role = Qt.ItemDataRole.AccessibleTextRole
            item.setData(NAME, role, ", ".join([pose, *states]))
            item.setData(EYE, role, f"{pose} {states[1]}")
            item.setData(LOCK, role, f"{pose} {states[2]}")
            item.setData(SOLO, role, f"{pose} " + (self.tr("solo") if solo else self.tr("not solo")))

    # Wishes go up

    def _pick(self, item: QTreeWidgetItem | None, _before: QTreeWidgetItem | None) -> None:
        # A value that came down is the active pose already.
        if item is not None and item.text(NAME) not in ("", self._active):
            self._active = item.text(NAME)
            self.pose_picked.emit(self._active)

    def _wish(self, pose: str, column: int, *, also: bool = False) -> None:
        if column == EYE:
            self.visibility_changed.emit(pose, pose not in self._visible)
        elif column == LOCK:
            self.lock_changed.emit(pose, pose not in self._locked)
        elif also:
            self.solo_wanted.emit(self._solo ^ {pose})
        else:
            self.solo_wanted.emit(frozenset() if self._solo == {pose} else frozenset({pose}))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """On an eye, a lock or solo (with Shift: beside others): only that; elsewhere: pick the pose."""
        index = self.indexAt(event.position().toPoint())
        if index.isValid() and index.column() != NAME and event.button() == Qt.MouseButton.LeftButton:
            also = bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier)
            self._wish(self._poses[index.row()], index.column(), also=also)
            event.accept()
        else:
            super().mousePressEvent(event)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """As two clicks."""
        self.mousePressEvent(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Dragging over the list picks nothing."""
        event.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """V, L and S for the current pose; Space is left to the window."""
        column = {Qt.Key.Key_V: EYE, Qt.Key.Key_L: LOCK, Qt.Key.Key_S: SOLO}.get(Qt.Key(event.key()))
        if column is not None and not event.modifiers() and self._active:
            self._wish(self._active, column)
        elif event.key() == Qt.Key.Key_Space:
            event.ignore()
        else:
            super().keyPressEvent(event)


def _swatch(colour: QColor, filled: bool) -> QIcon:
    pixmap = QPixmap(2 * (_SWATCH + 4), 2 * (_SWATCH + 4))
    pixmap.setDevicePixelRatio(2)
    pixmap.fill(Qt.GlobalColor.transparent)
    painter = QPainter(pixmap)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    square = QRectF(QPointF(2.5, 2.5), QPointF(_SWATCH + 1.5, _SWATCH + 1.5))
    painter.setPen(QPen(colour if filled else theme.mix(colour, theme.PANEL, 0.5), 1.2))
    painter.setBrush(colour if filled else Qt.BrushStyle.NoBrush)
    painter.drawRoundedRect(square, 2, 2)
    painter.end()
    icon = QIcon(pixmap)
    icon.addPixmap(pixmap, QIcon.Mode.Selected)  # not tinted when its row is current
    return icon
