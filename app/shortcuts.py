"""Which keys the window's actions have: the defaults of the keymap, and over them what the user has changed."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QKeySequence

from widgets.canvas.keymaps import NEUTRAL

from .menus import Entry, Registry
from .settings import ViewState

#: Where hands from elsewhere expect other keys than ours: keymap → action → keys.
KEYMAP_DEFAULTS: Mapping[str, Mapping[str, tuple[str, ...]]] = MappingProxyType(
    {
        NEUTRAL: {},
        "Maya": {
            "playback.play": ("Alt+V", "F5"),
            "edit.redo": ("Ctrl+Y", "Shift+Z"),
            "edit.undo": ("Ctrl+Z", "Z"),
            "camera.front": (),  # Ctrl+1 isolates a pose there; Ctrl+0 does the same
        },
        "Blender": {"tools.palette": ("F3", "Ctrl+K")},
    }
)

_PORTABLE = QKeySequence.SequenceFormat.PortableText
_NATIVE = QKeySequence.SequenceFormat.NativeText


class Shortcuts(QObject):
    """Gives every action of a registry its keys.

    changed()  some action has other keys
    """

    changed = Signal()

    def __init__(self, registry: Registry, state: ViewState, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._registry = registry
        self._state = state
        self._keymap = NEUTRAL
        self._own: dict[str, tuple[str, ...]] = {}  # also of actions that are not there at present
        for line in state.texts("shortcuts"):
            name, *keys = line.split("\t")
            self._own[name] = tuple(key for key in keys if is_key(key))
        self.apply()

    def set_keymap(self, name: str) -> None:
        """Use the defaults of a keymap (KeyError when there is none of that name)."""
        KEYMAP_DEFAULTS[name]
        self._keymap = name
        self.apply()

    def keys(self, name: str) -> tuple[str, ...]:
        """The keys an action has now."""
        own = self._own.get(name)
        return self.default(name) if own is None else own

    def default(self, name: str) -> tuple[str, ...]:
        """The keys it has in this keymap when nobody changed them."""
        other = KEYMAP_DEFAULTS[self._keymap].get(name)
        return self._registry[name].default if other is None else other

    def set_keys(self, name: str, keys: tuple[str, ...]) -> None:
        """Give an action these keys, and take them away from any other."""
        for entry in self._registry:
            kept = tuple(key for key in self.keys(entry.id) if key not in keys)
            if entry.id != name and kept != self.keys(entry.id):
                self._own[entry.id] = kept
        self._own[name] = keys
        self._keep()

    def reset(self, name: str) -> None:
        """Give an action its default keys, except those another one got meanwhile."""
        self._own.pop(name, None)
        taken = {key for other in self._own for key in self._own[other] if other in self._registry}
        free = tuple(key for key in self.default(name) if key not in taken)
        if free != self.default(name):
            self._own[name] = free
        self._keep()

    def reset_all(self) -> None:
        """Give every action its default keys."""
        self._own.clear()
        self._keep()

    def apply(self) -> None:
        """Hand the keys to the actions, and name them in the tooltips; call it when actions have been added."""
        for entry in self._registry:
            keys = self.keys(entry.id)
            entry.action.setShortcuts([QKeySequence(key) for key in keys])
            _tell(entry, keys)
        self.changed.emit()

    def _keep(self) -> None:
        self._own = {
            name: keys for name, keys in self._own.items() if name not in self._registry or keys != self.default(name)
        }
        self._state.put("shortcuts", ["\t".join((name, *keys)) for name, keys in self._own.items()])
        self._state.write()
        self.apply()


def is_key(text: str) -> bool:
    """Whether Qt can read this as one key with its modifiers."""
    sequence = QKeySequence(text, _PORTABLE)
    return sequence.count() == 1 and bool(sequence.toString(_PORTABLE))


def native(keys: tuple[str, ...]) -> str:
    """Keys as this system writes them: "Ctrl+Shift+Z, Ctrl+Y"."""
    return ", ".join(QKeySequence(key).toString(_NATIVE) for key in keys)


def _tell(entry: Entry, keys: tuple[str, ...]) -> None:
    tip = entry.action.statusTip()
    if tip:
        entry.action.setToolTip(f"{tip} ({native(keys)})" if keys else tip)
