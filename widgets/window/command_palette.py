"""The command palette: everything that can be done or opened, by a few of its letters, without the mouse."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QEvent, QModelIndex, QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent, QStandardItem, QStandardItemModel
from PySide6.QtWidgets import QApplication, QFrame, QLabel, QLineEdit, QListView, QVBoxLayout, QWidget

from .. import theme
from .palette_choices import Choice, ranked
from .palette_rows import OFFER, ROW, PaletteRows

#: Rows in sight, pixels across, pixels from the top of the window.
_ROWS, _WIDTH, _TOP = 11, 640, 64

_STEPS = {Qt.Key.Key_Up: -1, Qt.Key.Key_Down: 1, Qt.Key.Key_PageUp: -_ROWS, Qt.Key.Key_PageDown: _ROWS}


class CommandPalette(QFrame):
    """A field and a list, over the upper middle of its parent while it is open.

    chosen(id)         the user wants this; the palette has closed
    query_changed(text)  what is typed now; whoever knows more answers with `set_found`
    """

    chosen = Signal(str)
    query_changed = Signal(str)

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setObjectName("palette")
        self.setAccessibleName(self.tr("Command palette"))
        self.setStyleSheet(
            f"QFrame#palette{{background:{theme.PANEL.name()};border:1px solid {theme.ACCENT.name()};"
            "border-radius:8px} QListView{background:transparent}"
        )
        self._choices: Sequence[Choice] = ()
        self._found: Sequence[Choice] = ()
        self._recent: Sequence[str] = ()
        self._before: QWidget | None = None
        self.field = QLineEdit()
        self.field.setPlaceholderText(self.tr("A command, two phones (f ah), a word or a sentence"))
        self.field.setAccessibleName(self.tr("Find a command, a bigram or a sentence"))
        self.field.setAccessibleDescription(self.tr("Up and down choose, Enter does it, Escape closes"))
        self.field.addAction(theme.icon("magnify", theme.MUTED), QLineEdit.ActionPosition.LeadingPosition)
        self.field.textChanged.connect(self._typed)
        self.field.installEventFilter(self)
        self._rows = QStandardItemModel(self)
        self.list = QListView()
        self.list.setModel(self._rows)
        self.list.setItemDelegate(PaletteRows(self.list))
        self.list.setAccessibleName(self.tr("What fits"))
        self.list.setAccessibleDescription(self.tr("The best first"))
        self.list.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.list.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.list.setUniformItemSizes(True)
        self.list.setFrameShape(QFrame.Shape.NoFrame)
        self.list.clicked.connect(self._take)
        self.note = QLabel()
        self.note.setStyleSheet(f"color:{theme.MUTED.name()}")
        column = QVBoxLayout(self)
        column.setContentsMargins(8, 8, 8, 7)
        column.setSpacing(6)
        column.addWidget(self.field)
        column.addWidget(self.list)
        column.addWidget(self.note)
        parent.installEventFilter(self)
        self.hide()

    def open(self, choices: Sequence[Choice], recent: Sequence[str] = ()) -> None:
        """Show it, empty; `recent`: ids, the newest first."""
        if not self.isVisible():
            self._before = QApplication.focusWidget()
        self._choices, self._recent, self._found = choices, recent, ()
        self.field.clear()
        self._show()
        self.show()
        self.raise_()
        self.field.setFocus(Qt.FocusReason.ShortcutFocusReason)

    def set_found(self, query: str, found: Sequence[Choice]) -> None:
        """What somebody else knows for what is typed; an answer to an older query is passed over."""
        if query == self.query:
            self._found = found
            self._show()

    @property
    def query(self) -> str:
        """What is typed."""
        return self.field.text().strip()

    @property
    def titles(self) -> list[str]:
        """What is listed, from the top."""
        return [self._rows.item(i).text() for i in range(self._rows.rowCount())]

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """The field's keys walk through the list; the palette keeps its place in the window."""
        if watched is self.parent() and event.type() == QEvent.Type.Resize and self.isVisible():
            self._place()
        elif watched is self.field:
            if event.type() == QEvent.Type.FocusOut and self.isVisible():
                self._close()
            elif event.type() == QEvent.Type.KeyPress and isinstance(event, QKeyEvent):
                return self._key(event)
        return super().eventFilter(watched, event)

    def _key(self, event: QKeyEvent) -> bool:
        key = Qt.Key(event.key())
        if key == Qt.Key.Key_Escape:
            self._close(back=True)
        elif key in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self._take(self.list.currentIndex())
        elif key in _STEPS:
            self._step(_STEPS[key])
        else:
            return key in (Qt.Key.Key_Tab, Qt.Key.Key_Backtab)
        return True

    def _step(self, step: int) -> None:
        count = self._rows.rowCount()
        if count:
            row = self.list.currentIndex().row() + step
            row = row % count if abs(step) == 1 else min(max(row, 0), count - 1)
            self.list.setCurrentIndex(self._rows.index(row, 0))

    def _typed(self) -> None:
        self._found = ()
        self._show()
        self.query_changed.emit(self.query)

    def _show(self) -> None:
        offers = ranked(self.query, self._choices, self._recent, self._found)
        self._rows.clear()
        for offer in offers:
            item = QStandardItem(offer.choice.title)
            item.setData(offer, OFFER)
            item.setEditable(False)
            item.setToolTip(offer.choice.title)
            spoken = ", ".join(filter(None, (offer.choice.title, offer.choice.group, offer.choice.keys)))
            item.setData(spoken, Qt.ItemDataRole.AccessibleTextRole)
            self._rows.appendRow(item)
        if offers:
            self.list.setCurrentIndex(self._rows.index(0, 0))
            self.note.setText(self.tr("↑↓ choose · Enter does it · Esc closes"))
        else:
            self.note.setText(self.tr("Nothing is called that. A bigram is typed as two phones, such as f ah."))
        self._place()

    def _place(self) -> None:
        window = self.parentWidget()
        rows = min(max(self._rows.rowCount(), 1), _ROWS, max(3, (window.height() - 2 * _TOP - 100) // ROW))
        self.list.setFixedHeight(rows * ROW)
        width = min(_WIDTH, window.width() - 40)
        self.setFixedWidth(width)
        self.adjustSize()
        self.move((window.width() - width) // 2, _TOP)

    def _take(self, index: QModelIndex) -> None:
        if not index.isValid():
            return
        choice = index.data(OFFER).choice
        if not choice.enabled:
            self.note.setText(self.tr("“{0}” cannot be done now.").format(choice.title))
            return
        self._close(back=True)
        self.chosen.emit(choice.id)

    def _close(self, *, back: bool = False) -> None:
        before, self._before = self._before, None
        self.hide()
        if back and before is not None and before.isVisible():
            before.setFocus(Qt.FocusReason.OtherFocusReason)
