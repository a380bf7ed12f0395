"""Test sentences: those that are pinned, in the user's order, and those said lately."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QEvent, QObject, QSignalBlocker, QSize, Qt, Signal
from PySide6.QtGui import QAction, QKeyEvent, QResizeEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QFrame,
    QHBoxLayout,
    QLabel,
    QListWidget,
    QListWidgetItem,
    QSizePolicy,
    QSplitter,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from .. import theme

#: Pixels from which on both lists are shown.
_BOTH = 220


class SentenceList(QWidget):
    """Two lists. Enter, a click or the arrows with Alt say a sentence.

    picked(text)         say this
    order_wanted(texts)  the pinned ones in another order
    pin_wanted(text)     keep this one; "" for the one in the sentence field
    unpin_wanted(text)   let this one go
    import_wanted()      keep the lines of a file
    """

    picked = Signal(str)
    order_wanted = Signal(list)
    pin_wanted = Signal(str)
    unpin_wanted = Signal(str)
    import_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.pinned = self._list(self.tr("Pinned sentences"))
        self.pinned.setToolTip(self.tr("Enter says one; drag or Ctrl+Up and Ctrl+Down reorder; Del unpins"))
        self.pinned.setDragDropMode(QAbstractItemView.DragDropMode.InternalMove)
        self.pinned.setDefaultDropAction(Qt.DropAction.MoveAction)
        self.pinned.model().rowsMoved.connect(lambda *_: self.order_wanted.emit(self.texts))
        self.recent = self._list(self.tr("Sentences said lately"))
        self.recent.setToolTip(self.tr("Enter says one again; P pins it"))
        self.pin = self._button("pin", self.tr("Pin the sentence in the field"), lambda: self.pin_wanted.emit(""))
        self.unpin = self._button("pin-off", self.tr("Unpin the selected sentence (Del)"), self._unpin)
        self.up = self._button("arrow-up", self.tr("Move up (Ctrl+Up)"), lambda: self._move(-1))
        self.down = self._button("arrow-down", self.tr("Move down (Ctrl+Down)"), lambda: self._move(1))
        self.load = self._button("file-import", self.tr("Pin the lines of a text file"), self.import_wanted.emit)
        self.pinned.itemSelectionChanged.connect(self._show_buttons)
        bar = QHBoxLayout()
        bar.setSpacing(2)
        bar.addWidget(self._title(self.tr("Pinned")), 1)
        for button in (self.pin, self.unpin, self.up, self.down, self.load):
            bar.addWidget(button)
        upper, lower = QWidget(), QWidget()
        for part, head, body in (
            (upper, bar, self.pinned),
            (lower, self._title(self.tr("Said lately")), self.recent),
        ):
            column = QVBoxLayout(part)
            column.setContentsMargins(0, 0, 0, 0)
            column.setSpacing(4)
            column.addLayout(head) if isinstance(head, QHBoxLayout) else column.addWidget(head)
            column.addWidget(body, 1)
        both = QSplitter(Qt.Orientation.Vertical)
        both.setChildrenCollapsible(False)
        both.addWidget(upper)
        both.addWidget(lower)
        both.setStretchFactor(0, 3)
        both.setStretchFactor(1, 2)
        self._lower = lower
        column = QVBoxLayout(self)
        column.setContentsMargins(6, 4, 6, 6)
        column.addWidget(both)
        self.setFocusProxy(self.pinned)
        self._show_buttons()

    def minimumSizeHint(self) -> QSize:
        """Room for a few pinned sentences."""
        return QSize(160, 64)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """In a low dock the pinned ones stand alone."""
        super().resizeEvent(event)
        self._lower.setVisible(event.size().height() >= _BOTH)

    def set_pinned(self, texts: Sequence[str]) -> None:
        """The pinned sentences; the selected one stays selected. Emits nothing."""
        if list(texts) != self.texts:
            _fill(self.pinned, texts)
        self._show_buttons()

    def set_recent(self, texts: Sequence[str]) -> None:
        """What was said, the newest first; emits nothing."""
        _fill(self.recent, texts)

    def set_current(self, text: str) -> None:
        """The sentence that is in the field; emits nothing."""
        for box in (self.pinned, self.recent):
            found = box.findItems(text, Qt.MatchFlag.MatchExactly)
            for i in range(box.count()):
                box.item(i).setFont(theme.font(bold=box.item(i) in found))
            if found and not box.hasFocus():
                with QSignalBlocker(box):
                    box.setCurrentItem(found[0])
        self._show_buttons()

    @property
    def texts(self) -> list[str]:
        """The pinned sentences as shown."""
        return [self.pinned.item(i).text() for i in range(self.pinned.count())]

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Enter says, Del unpins, P pins, Ctrl+Up and Ctrl+Down reorder."""
        if event.type() != QEvent.Type.KeyPress or not isinstance(event, QKeyEvent):
            return super().eventFilter(watched, event)
        key, held = Qt.Key(event.key()), event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier
        if key in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self._pick(watched.currentItem())
        elif watched is self.pinned and key == Qt.Key.Key_Delete:
            self._unpin()
        elif watched is self.recent and key == Qt.Key.Key_P and not held:
            self._pin_recent()
        elif (
            watched is self.pinned
            and held == Qt.KeyboardModifier.ControlModifier
            and key in (Qt.Key.Key_Up, Qt.Key.Key_Down)
        ):
            self._move(-1 if key == Qt.Key.Key_Up else 1)
        else:
            return super().eventFilter(watched, event)
        return True

    def _list(self, name: str) -> QListWidget:
        box = QListWidget()
        box.setAccessibleName(name)
        box.setFrameShape(QFrame.Shape.NoFrame)
        box.setTextElideMode(Qt.TextElideMode.ElideRight)
        box.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        box.setMinimumHeight(40)
        box.itemClicked.connect(self._pick)
        box.installEventFilter(self)
        box.setContextMenuPolicy(Qt.ContextMenuPolicy.ActionsContextMenu)
        say = QAction(self.tr("Say it"), box)
        say.triggered.connect(lambda: self._pick(box.currentItem()))
        box.addAction(say)
        return box

    def _title(self, text: str) -> QLabel:
        label = QLabel(text)
        label.setStyleSheet(f"color:{theme.MUTED.name()}")
        label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        return label

    def _button(self, icon: str, name: str, act: object) -> QToolButton:
        button = QToolButton()
        button.setIcon(theme.icon(icon))
        button.setText(name)
        button.setToolTip(name)
        button.setAccessibleName(name)
        button.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        button.clicked.connect(lambda _=False: act())
        return button

    def _show_buttons(self) -> None:
        row, count = self.pinned.currentRow(), self.pinned.count()
        self.unpin.setEnabled(row >= 0)
        self.up.setEnabled(row > 0)
        self.down.setEnabled(0 <= row < count - 1)

    def _pick(self, item: QListWidgetItem | None) -> None:
        if item is not None:
            self.picked.emit(item.text())

    def _unpin(self) -> None:
        item = self.pinned.currentItem()
        if item is not None:
            self.unpin_wanted.emit(item.text())

    def _pin_recent(self) -> None:
        item = self.recent.currentItem()
        if item is not None:
            self.pin_wanted.emit(item.text())

    def _move(self, step: int) -> None:
        row, texts = self.pinned.currentRow(), self.texts
        if row >= 0 and 0 <= row + step < len(texts):
            texts.insert(row + step, texts.pop(row))
            self.order_wanted.emit(texts)
            self.pinned.setCurrentRow(row + step)


def _fill(box: QListWidget, texts: Sequence[str]) -> None:
    """Other lines; the current one stays current, or its place."""
    with QSignalBlocker(box):
        current, row = box.currentItem(), box.currentRow()
        text = current.text() if current is not None else ""
        box.clear()
        for line in texts:
            item = QListWidgetItem(line, box)
            item.setToolTip(line)
        if text in texts:
            box.setCurrentRow(list(texts).index(text))
        elif row >= 0:
            box.setCurrentRow(min(row, box.count() - 1))
