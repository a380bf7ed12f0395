"""Menus that know their actions: what each one is called, where it stands and which keys it has by default.

The palette and the list of shortcuts read what the menus are built from, so an action is described once.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from PySide6.QtGui import QAction, QActionGroup, QKeySequence
from PySide6.QtWidgets import QMenu, QMenuBar

from widgets import theme

#: Keys as Qt writes them on every system, "Ctrl+Shift+S"; several in a tuple.
Keys = str | tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Entry:
    """One action of the window.

    id       its name in the user's settings; never changes
    group    the menu it stands in, "View" or "View → Character"
    default  the keys it has until the user says otherwise, portable text
    name     what it is always called, where the menu says more: "Redo" of "Redo Move keys"
    """

    id: str
    group: str
    action: QAction
    default: tuple[str, ...]
    name: str = ""

    @property
    def title(self) -> str:
        """What it is called, without mnemonic and dots."""
        return self.name or plain(self.action.text())


class Registry:
    """All actions of one window, in the order of its menus."""

    def __init__(self, bar: QMenuBar) -> None:
        self._bar = bar
        self._entries: dict[str, Entry] = {}

    def __iter__(self) -> Iterator[Entry]:
        return iter(self._entries.values())

    def __getitem__(self, name: str) -> Entry:
        """The action of this id; KeyError when there is none."""
        return self._entries[name]

    def __contains__(self, name: str) -> bool:
        return name in self._entries

    def menu(self, title: str) -> Menu:
        """A new menu at the end of the bar."""
        return Menu(self, self._bar.addMenu(title), plain(title))

    def register(self, entry: Entry) -> None:
        """Take an action in; ValueError when its id is taken."""
        if entry.id in self._entries:
            raise ValueError(f"two actions are called {entry.id}")
        self._entries[entry.id] = entry
        entry.action.setObjectName(entry.id)
        entry.action.setShortcuts([QKeySequence(key) for key in entry.default])

    def forget(self, name: str) -> None:
        """Give an action away that is no more: its menu forgets it with the QAction itself."""
        del self._entries[name]


class Menu:
    """One menu; `add` makes an action and puts it at the end."""

    def __init__(self, registry: Registry, menu: QMenu, group: str) -> None:
        self.menu = menu
        self._registry = registry
        self._group = group

    def add(
        self, name: str, text: str, keys: Keys = (), tip: str = "", *, icon: str = "", checked: bool | None = None
    ) -> QAction:
        """A new action.

        name     its id, "file.open"
        text     with a mnemonic, and with "…" when it asks for more
        checked  its first state when it is a switch
        """
        action = QAction(text, self.menu)
        if icon:
            action.setIcon(theme.icon(icon))
        if tip:
            action.setStatusTip(tip)
            action.setToolTip(tip)
        if checked is not None:
            action.setCheckable(True)
            action.setChecked(checked)
        return self.put(name, action, keys)

    def put(self, name: str, action: QAction, keys: Keys = (), title: str = "") -> QAction:
        """An action that somebody else has made; `title`: what lists call it, whatever it says of itself."""
        self.menu.addAction(action)
        self._registry.register(Entry(name, self._group, action, (keys,) if isinstance(keys, str) else keys, title))
        return action

    def line(self) -> None:
        """A line between groups."""
        self.menu.addSeparator()

    def submenu(self, title: str) -> Menu:
        """A menu in this one."""
        return Menu(self._registry, self.menu.addMenu(title), f"{self._group} → {plain(title)}")

    def choice(self) -> QActionGroup:
        """For actions of which exactly one is on."""
        return QActionGroup(self.menu)


def plain(text: str) -> str:
    """A menu's text as it is read: "Save &As…" → "Save As"."""
    return text.replace("&&", "\0").replace("&", "").replace("\0", "&").removesuffix("…")
