"""Layouts of the docks brought to life: presets, and those the user has saved."""

from __future__ import annotations

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QInputDialog

from ..layouts import PRESETS
from ..shortcuts import Shortcuts
from .parts import Parts

#: So many layouts of the user's are kept; a name longer than this does not fit the menu.
MOST, LONGEST = 20, 40


class Layouts(QObject):
    """The menu View → Layout."""

    def __init__(self, parts: Parts, shortcuts: Shortcuts, parent: QObject) -> None:
        super().__init__(parent)
        self._window = parts.window
        self._state = parts.state
        self._shortcuts = shortcuts
        self._names: list[str] = []
        actions = self._window.actions_
        for name, action in zip(PRESETS, actions.layouts, strict=True):
            action.triggered.connect(lambda _=False, name=name: self._window.use_layout(name))
        actions.save_layout.triggered.connect(self._ask_save)
        actions.remove_layout.triggered.connect(self._ask_remove)
        for name in self._state.texts("layouts"):
            self._offer(name)
        self._show()

    @property
    def names(self) -> tuple[str, ...]:
        """The user's own layouts."""
        return tuple(self._names)

    def save(self, name: str) -> None:
        """Keep the docks as they are now; the name may be an old one's."""
        name = " ".join(name.split())[:LONGEST]
        if not name or (name not in self._names and len(self._names) == MOST):
            self._window.hint_label.setText(self.tr("A layout needs a name, and there is room for {0}.").format(MOST))
            return
        self._state.put(_key(name), self._window.docks_state())
        if name not in self._names:
            self._offer(name)
            self._show()
        self._window.hint_label.setText(self.tr("Layout “{0}” saved").format(name))

    def use(self, name: str) -> None:
        """Bring a saved layout back."""
        if not self._window.take_docks(self._state.layout(_key(name))):
            self._window.hint_label.setText(
                self.tr("The layout “{0}” is damaged, or for a higher window: save it again.").format(name)
            )

    def remove(self, name: str) -> None:
        """Forget a saved layout."""
        self._names.remove(name)
        self._state.remove(_key(name))
        registry = self._window.actions_.registry
        registry[_id(name)].action.deleteLater()
        registry.forget(_id(name))
        self._show()

    def _offer(self, name: str) -> None:
        self._names.append(name)
        text = name.replace("&", "&&")
        action = self._window.actions_.layouts_menu.add(_id(name), text, (), self.tr("Bring this layout back"))
        action.triggered.connect(lambda _=False: self.use(name))

    def _show(self) -> None:
        self._state.put("layouts", self._names)
        self._window.actions_.remove_layout.setEnabled(bool(self._names))
        self._shortcuts.apply()

    def _ask_save(self) -> None:
        title, label = self.tr("Save this layout"), self.tr("Name of the layout:")
        name, wanted = QInputDialog.getText(self._window, title, label)
        if wanted:
            self.save(name)

    def _ask_remove(self) -> None:
        title, label = self.tr("Remove a layout"), self.tr("Forget which layout?")
        name, wanted = QInputDialog.getItem(self._window, title, label, self._names, 0, False)
        if wanted and name in self._names:
            self.remove(name)


def _id(name: str) -> str:
    return f"layout.own.{name}"


def _key(name: str) -> str:
    """Where the view state keeps it; a slash would make a group."""
    return f"layout {name.replace('/', '|').replace(chr(92), '|')}"
