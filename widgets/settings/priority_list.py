"""Which pose gives way: the priorities of section 3.2.2, highest on top.

Poses without a tick are never constrained; they stand below the others.
"""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSignalBlocker, QSize, Qt, Signal
from PySide6.QtGui import QIcon, QKeyEvent, QMouseEvent, QPainter, QPixmap
from PySide6.QtWidgets import (
    QAbstractItemView,
    QFrame,
    QHBoxLayout,
    QListWidget,
    QListWidgetItem,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from .. import theme

_ROW = 22


def _dot(pose: str, index: int) -> QIcon:
    pixmap = QPixmap(20, 20)
    pixmap.setDevicePixelRatio(2)
    pixmap.fill(Qt.GlobalColor.transparent)
    painter = QPainter(pixmap)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(theme.pose_colour(pose, index))
    painter.drawEllipse(1, 1, 8, 8)
    painter.end()
    return QIcon(pixmap)


class _Ranks(QListWidget):
    """The rows; dragging one moves it while the button is down and tells once, on release."""

    moved = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setIconSize(QSize(10, 10))
        self.setUniformItemSizes(True)
        self.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        palette = self.palette()
        palette.setColor(palette.ColorRole.Window, theme.MUTED)  # Fusion draws the boxes with it
        self.setPalette(palette)
        self._from = -1
        self._dragged = False

    def ticked(self) -> list[str]:
        """The names with a tick, top to bottom."""
        items = (self.item(i) for i in range(self.count()))
        return [item.text() for item in items if item.checkState() == Qt.CheckState.Checked]

    def shift(self, step: int) -> bool:
        """Move the current row by `step` among the ticked ones; whether it moved."""
        at = self.currentRow()
        to = at + step
        if not (0 <= at < len(self.ticked()) and 0 <= to < len(self.ticked())):
            return False
        with QSignalBlocker(self):
            self.insertItem(to, self.takeItem(at))
            self.setCurrentRow(to)
        return True

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Alt+Up and Alt+Down move the row itself."""
        step = {Qt.Key.Key_Up: -1, Qt.Key.Key_Down: 1}.get(Qt.Key(event.key()))
        if step is not None and event.modifiers() & Qt.KeyboardModifier.AltModifier:
            if self.shift(step):
                self.moved.emit()
        else:
            super().keyPressEvent(event)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Take hold of a row."""
        super().mousePressEvent(event)
        index = self.indexAt(event.position().toPoint())
        self._from = index.row() if event.button() == Qt.MouseButton.LeftButton else -1
        self._dragged = False

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Carry it along."""
        to = self.indexAt(event.position().toPoint()).row()
        if self._from < 0 or to < 0:
            return
        while self.currentRow() != to and self.shift(1 if to > self.currentRow() else -1):
            self._dragged = True

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Let go."""
        if self._dragged:
            self._dragged = False
            if self.currentRow() != self._from:
                self.moved.emit()
        else:
            super().mouseReleaseEvent(event)
        self._from = -1


class PriorityList(QWidget):
    """edited(priorities): poses from lowest to highest, as Settings has them, after one action of the user."""

    edited = Signal(tuple)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.list = _Ranks()
        self.list.setAccessibleName(self.tr("Priorities, highest first"))
        hint = self.tr("Drag, or Alt+Up and Alt+Down. A pose without a tick is never constrained.")
        self.list.setAccessibleDescription(hint)
        self.list.setToolTip(hint)
        self.list.moved.connect(self._tell)
        self.list.itemChanged.connect(lambda _: self._tell())
        self.list.currentRowChanged.connect(lambda _: self._enable())
        self.up = self._button("arrow-up", self.tr("Higher priority"), -1)
        self.down = self._button("arrow-down", self.tr("Lower priority"), 1)
        buttons = QVBoxLayout()
        buttons.setSpacing(2)
        buttons.addWidget(self.up)
        buttons.addWidget(self.down)
        buttons.addStretch(1)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(4)
        row.addWidget(self.list, 1)
        row.addLayout(buttons)

    def set_priorities(self, priorities: Sequence[str], poses: Sequence[str]) -> None:
        """`priorities` from lowest to highest; the others of `poses` stand below without a tick. Emits nothing."""
        names = [*reversed(priorities), *(pose for pose in poses if pose not in priorities)]
        items = [self.list.item(i) for i in range(self.list.count())]
        if [item.text() for item in items] == names and self.list.ticked() == names[: len(priorities)]:
            return
        current = self.list.currentItem().text() if self.list.currentItem() else ""
        place = {pose: i for i, pose in enumerate(poses)}
        with QSignalBlocker(self.list):
            self.list.clear()
            for name in names:
                item = QListWidgetItem(_dot(name, place.get(name, 0)), name)
                item.setSizeHint(QSize(60, _ROW))
                item.setFlags(item.flags() | Qt.ItemFlag.ItemIsUserCheckable)
                item.setCheckState(Qt.CheckState.Checked if name in priorities else Qt.CheckState.Unchecked)
                if name not in priorities:
                    item.setForeground(theme.MUTED)
                self.list.addItem(item)
            if current in names:
                self.list.setCurrentRow(names.index(current))
        self.list.setFixedHeight(max(len(names), 1) * _ROW)
        self._enable()

    def priorities(self) -> tuple[str, ...]:
        """From lowest to highest."""
        return tuple(reversed(self.list.ticked()))

    def _button(self, icon: str, name: str, step: int) -> QToolButton:
        button = QToolButton()
        button.setIcon(theme.icon(icon))
        button.setToolTip(name)
        button.setAccessibleName(name)
        button.setText(name)
        button.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        button.clicked.connect(lambda: self._shift(step))
        return button

    def _shift(self, step: int) -> None:
        if self.list.shift(step):
            self._tell()

    def _tell(self) -> None:
        self._enable()
        self.edited.emit(self.priorities())

    def _enable(self) -> None:
        at, ranked = self.list.currentRow(), len(self.list.ticked())
        self.up.setEnabled(0 < at < ranked)
        self.down.setEnabled(0 <= at < ranked - 1)
