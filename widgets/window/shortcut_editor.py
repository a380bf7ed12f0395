"""Every command and its keys: to look up, to change, to put back."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtWidgets import (
    QDialog,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QLineEdit,
    QPushButton,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)

from .. import theme
from .key_field import KeyField

_ID = Qt.ItemDataRole.UserRole


@dataclass(frozen=True)
class KeyRow:
    """A command and its keys, portable text.

    fixed  of a keymap of the canvas: shown, not changed here
    """

    id: str
    group: str
    title: str
    keys: tuple[str, ...]
    default: tuple[str, ...]
    fixed: bool = False


class ShortcutEditor(QDialog):
    """Shows rows; what the user wants comes out as wishes, what became of it comes back by `set_rows`.

    keys_wanted(id, keys)  give this command these keys; whoever had them loses them
    reset_wanted(id)       its default keys again
    reset_all_wanted()     all default keys again
    """

    keys_wanted = Signal(str, tuple)
    reset_wanted = Signal(str)
    reset_all_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(self.tr("Keyboard shortcuts"))
        self.resize(640, 620)
        self._rows: dict[str, KeyRow] = {}
        self._more = False  # the key that is recorded is one more, not instead
        self._wanted = ""  # recorded, but another command has it
        self.search = QLineEdit()
        self.search.setClearButtonEnabled(True)
        self.search.setPlaceholderText(self.tr("Find a command or a key, such as ctrl+e"))
        self.search.setAccessibleName(self.tr("Find a command or a key"))
        self.search.setAccessibleDescription(self.tr("Down goes to the list"))
        self.search.addAction(theme.icon("magnify", theme.MUTED), QLineEdit.ActionPosition.LeadingPosition)
        self.search.textChanged.connect(self._filter)
        self.search.installEventFilter(self)
        self.tree = QTreeWidget()
        self.tree.setColumnCount(2)
        self.tree.setHeaderLabels([self.tr("Command"), self.tr("Keys")])
        self.tree.setAccessibleName(self.tr("Commands and their keys"))
        self.tree.setAccessibleDescription(self.tr("Enter changes the key of a command"))
        self.tree.setAlternatingRowColors(True)
        self.tree.setUniformRowHeights(True)
        self.tree.setIndentation(14)
        self.tree.header().setStretchLastSection(False)
        self.tree.header().setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        self.tree.header().setSectionResizeMode(1, QHeaderView.ResizeMode.ResizeToContents)
        self.tree.currentItemChanged.connect(self._show_buttons)
        self.tree.itemActivated.connect(lambda *_: self._record())
        self.field = KeyField()
        self.field.recorded.connect(self._recorded)
        self.field.ended.connect(self.tree.setFocus)
        self.note = QLabel()
        self.note.setWordWrap(True)
        self.note.setTextFormat(Qt.TextFormat.PlainText)
        self.note.setMinimumHeight(2 * self.note.fontMetrics().height())
        self.note.setAlignment(Qt.AlignmentFlag.AlignTop | Qt.AlignmentFlag.AlignLeft)
        self.record = self._button(self.tr("&Change…"), self.tr("Press another key for this command"), self._record)
        self.add = self._button(self.tr("&Add…"), self.tr("One more key for this command"), self._record_more)
        self.remove = self._button(self.tr("Re&move"), self.tr("No key for this command"), self._remove)
        self.reset = self._button(self.tr("&Reset"), self.tr("The keys it came with"), self._reset)
        self.take = self._button(self.tr("&Take the Key"), self.tr("The other command loses it"), self._take)
        self.reset_all = self._button(
            self.tr("Reset A&ll"), self.tr("All keys as they came"), self.reset_all_wanted.emit
        )
        close = self._button(self.tr("Close"), self.tr("Close this window"), self.close)
        buttons = QHBoxLayout()
        for button in (self.record, self.add, self.remove, self.reset, self.take):
            buttons.addWidget(button)
        buttons.addStretch(1)
        buttons.addWidget(self.reset_all)
        buttons.addWidget(close)
        column = QVBoxLayout(self)
        column.addWidget(self.search)
        column.addWidget(self.tree, 1)
        column.addWidget(self.field)
        column.addWidget(self.note)
        column.addLayout(buttons)
        self._show_buttons()

    def set_rows(self, rows: Sequence[KeyRow]) -> None:
        """All commands, group by group; what is selected and typed stays."""
        current = self._current()
        self._rows = {row.id: row for row in rows}
        self.tree.clear()
        groups: dict[str, QTreeWidgetItem] = {}
        for row in rows:
            group = groups.get(row.group)
            if group is None:
                group = groups[row.group] = QTreeWidgetItem(self.tree, [row.group])
                group.setFlags(Qt.ItemFlag.ItemIsEnabled)
                group.setFont(0, theme.font(bold=True))
                group.setFirstColumnSpanned(True)
                group.setExpanded(True)
            item = QTreeWidgetItem(group, [row.title, _native(row.keys)])
            item.setData(0, _ID, row.id)
            if row.fixed:
                item.setForeground(0, theme.MUTED)
                item.setToolTip(0, self.tr("A key of the canvas: choose another keymap to change it"))
            elif row.keys != row.default:
                item.setFont(1, theme.font(bold=True))
                item.setForeground(1, theme.HIGHLIGHT)
                item.setToolTip(1, self.tr("By default: {0}").format(_native(row.default) or self.tr("none")))
            if current is not None and row.id == current.id:
                self.tree.setCurrentItem(item)
        self._filter()

    def shown(self) -> list[str]:
        """The ids that are listed now."""
        return [item.data(0, _ID) for item in self._items() if not item.isHidden()]

    def select(self, name: str) -> None:
        """Go to a command."""
        for item in self._items():
            if item.data(0, _ID) == name:
                self.tree.setCurrentItem(item)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """From the search, Down and Enter go to the list."""
        if watched is not self.search or not isinstance(event, QKeyEvent) or event.type() != QEvent.Type.KeyPress:
            return super().eventFilter(watched, event)
        if event.key() in (Qt.Key.Key_Down, Qt.Key.Key_Return, Qt.Key.Key_Enter):
            first = next((item for item in self._items() if not item.isHidden()), None)
            if first is not None:
                self.tree.setCurrentItem(first)
                self.tree.setFocus(Qt.FocusReason.TabFocusReason)
            return True
        return super().eventFilter(watched, event)

    def _button(self, text: str, tip: str, act: object) -> QPushButton:
        button = QPushButton(text)
        button.setToolTip(tip)
        button.setAccessibleDescription(tip)
        button.setAutoDefault(False)
        button.clicked.connect(lambda _=False: act())
        return button

    def _items(self) -> list[QTreeWidgetItem]:
        groups = (self.tree.topLevelItem(i) for i in range(self.tree.topLevelItemCount()))
        return [group.child(i) for group in groups for i in range(group.childCount())]

    def _current(self) -> KeyRow | None:
        item = self.tree.currentItem()
        return self._rows.get(item.data(0, _ID)) if item is not None else None

    def _filter(self) -> None:
        words = self.search.text().casefold().split()
        for item in self._items():
            row = self._rows[item.data(0, _ID)]
            text = f"{row.group} {row.title} {_native(row.keys)} {' '.join(row.keys)}".casefold()
            item.setHidden(not all(word in text for word in words))
        for i in range(self.tree.topLevelItemCount()):
            group = self.tree.topLevelItem(i)
            group.setHidden(all(group.child(j).isHidden() for j in range(group.childCount())))
        self._show_buttons()

    def _show_buttons(self) -> None:
        self._wanted = ""
        self.take.hide()
        row = self._current()
        free = row is not None and not row.fixed
        for button in (self.record, self.add):
            button.setEnabled(free)
        self.remove.setEnabled(free and bool(row.keys))
        self.reset.setEnabled(free and row.keys != row.default)
        self.reset_all.setEnabled(any(row.keys != row.default for row in self._rows.values()))
        fixed = row is not None and row.fixed
        self._say(self.tr("The canvas's keys come from its keymap: Edit → Keys of the Canvas.") if fixed else "")

    def _say(self, text: str, *, warning: bool = False) -> None:
        self.note.setStyleSheet(f"color:{(theme.WEAK if warning else theme.MUTED).name()}")
        self.note.setText(text)

    # ── wishes ───────────────────────────────────────────────────────────────────────────────────

    def _record(self) -> None:
        row = self._current()
        if row is not None and not row.fixed:
            self._more = False
            self._show_buttons()
            self.field.wait()

    def _record_more(self) -> None:
        self._record()
        self._more = True

    def _recorded(self, key: str) -> None:
        row = self._current()
        if row is None:
            return
        shown = _native((key,))
        others = [other for other in self._rows.values() if key in other.keys and other.id != row.id]
        owner = next((other for other in others if not other.fixed), None)
        if owner is not None:
            self._wanted = key
            self.take.show()
            self._say(
                self.tr("{0} already does “{1}” ({2}). Take the key, or change to another.").format(
                    shown, owner.title, owner.group
                ),
                warning=True,
            )
            self.take.setFocus(Qt.FocusReason.OtherFocusReason)
            return
        self._want(row, key)
        if others:
            self._say(
                self.tr("{0} also does “{1}” ({2}): with the focus there, it keeps that meaning.").format(
                    shown, others[0].title, others[0].group
                ),
                warning=True,
            )
        else:
            self._say(self.tr("{0} now does “{1}”.").format(shown, row.title))

    def _want(self, row: KeyRow, key: str) -> None:
        keys = (*(old for old in row.keys if old != key), key) if self._more else (key,)
        self.keys_wanted.emit(row.id, keys)

    def _take(self) -> None:
        row, key = self._current(), self._wanted
        if row is not None and key:
            self._want(row, key)
            self._show_buttons()
            self._say(self.tr("{0} now does “{1}”.").format(_native((key,)), row.title))
            self.tree.setFocus(Qt.FocusReason.OtherFocusReason)

    def _remove(self) -> None:
        row = self._current()
        if row is not None:
            self.keys_wanted.emit(row.id, ())

    def _reset(self) -> None:
        row = self._current()
        if row is not None:
            self.reset_wanted.emit(row.id)


def _native(keys: Sequence[str]) -> str:
    return ", ".join(QKeySequence(key).toString(QKeySequence.SequenceFormat.NativeText) for key in keys)
