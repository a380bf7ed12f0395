"""Keys brought to life: the keymap that was asked for, the dialog of shortcuts, and what is kept of both."""

from __future__ import annotations

from PySide6.QtCore import QObject
from PySide6.QtGui import QAction

from widgets.canvas.canvas_keys import canvas_title
from widgets.canvas.keymaps import KEYMAPS
from widgets.window.shortcut_editor import KeyRow, ShortcutEditor

from ..shortcuts import Shortcuts
from .parts import Parts


class KeysOfWindow(QObject):
    """Joins the keymaps, the shortcuts and their dialog."""

    def __init__(self, parts: Parts, parent: QObject) -> None:
        super().__init__(parent)
        self._window = parts.window
        self._state = parts.state
        self._editor: ShortcutEditor | None = None
        self.shortcuts = Shortcuts(self._window.actions_.registry, self._state, self)
        self.shortcuts.changed.connect(self._show)
        self._window.actions_.keymaps.triggered.connect(self._chosen)
        self._window.actions_.shortcuts.triggered.connect(self.open)
        self._window.keymap_question.chosen.connect(self.set_keymap)

    def restore(self) -> None:
        """Last time's keymap; whoever never chose one is asked, without being kept from anything."""
        keymap = self._state.text("keymap")
        if keymap in KEYMAPS:
            self.set_keymap(keymap)
        else:
            self._window.keymap_question.show()

    def set_keymap(self, name: str) -> None:
        """Use a keymap, on the canvas and for the window's defaults."""
        for action in self._window.actions_.keymaps.actions():
            if action.data() == name:
                action.trigger()

    def open(self) -> None:
        """Show every command and its keys."""
        if self._editor is None:
            self._editor = ShortcutEditor(self._window)
            self._editor.keys_wanted.connect(self.shortcuts.set_keys)
            self._editor.reset_wanted.connect(self.shortcuts.reset)
            self._editor.reset_all_wanted.connect(self.shortcuts.reset_all)
        self._show()
        self._editor.show()
        self._editor.raise_()
        self._editor.search.setFocus()

    def _chosen(self, action: QAction) -> None:
        self._window.canvas.set_keymap(action.data())
        self._window.keymap_question.hide()
        self._state.put("keymap", action.data())
        self.shortcuts.set_keymap(action.data())

    def _show(self) -> None:
        if self._editor is not None:
            self._editor.set_rows([*self._of_window(), *self._of_canvas()])

    def _of_window(self) -> list[KeyRow]:
        keys = self.shortcuts
        return [
            KeyRow(entry.id, entry.group, entry.title, keys.keys(entry.id), keys.default(entry.id))
            for entry in self._window.actions_.registry
        ]

    def _of_canvas(self) -> list[KeyRow]:
        """The present keymap first; keys of the others are no conflict, so they carry the map's name."""
        present = self._window.actions_.keymap
        rows = []
        for name in (present, *(name for name in KEYMAPS if name != present)):
            group = self.tr("Canvas, keymap {0}").format(name.capitalize())
            rows += [
                KeyRow(f"{name}:{action}", group, canvas_title(action), keys, keys, fixed=True)
                for action, keys in KEYMAPS[name].items()
            ]
        return rows
