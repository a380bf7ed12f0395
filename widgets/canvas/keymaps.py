"""Which key does what on the canvas: three keymaps as data, for hands that come from elsewhere. No Qt.

Keys are written as Qt writes them: "Ctrl+Shift+V", "PgDown", "\\". Escape, Enter, the arrows and the
modifiers mean the same in every map.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

#: Action → its keys, the one that hints name first.
Keymap = Mapping[str, tuple[str, ...]]

NEUTRAL = "neutral"

#: What all three have in common.
_COMMON: dict[str, tuple[str, ...]] = {
    "add": ("Ins",),
    "delete": ("Del", "Backspace"),
    "reverse": ("Ctrl+M",),
    "mirror": ("Ctrl+Shift+M",),
    "copy": ("Ctrl+C",),
    "cut": ("Ctrl+X",),
    "paste": ("Ctrl+V",),
    "paste_reversed": ("Ctrl+Shift+V",),
    "swap": ("\\",),
    "slide": ("Alt+D",),
    "duplicate": ("Ctrl+D",),
    "select_all": ("Ctrl+A",),
    "select_none": ("Ctrl+Shift+A",),
    "previous_key": ("[",),
    "next_key": ("]",),
    "previous_pose": ("PgUp",),
    "next_pose": ("PgDown",),
    "frame": ("F",),
    "frame_all": ("Home",),
    "play": ("Space",),
    "time_only": ("X",),
    "weight_only": ("Y",),
}

_OWN: dict[str, dict[str, tuple[str, ...]]] = {
    NEUTRAL: {"grab": ("G",), "scale": ("S",), "isolate": ("I",)},
    "Maya": {
        "grab": ("W",),
        "scale": ("R",),
        "isolate": ("Ctrl+1",),
        "add": ("S", "Ins"),
        "frame_all": ("A", "Home"),
    },
    "Blender": {
        "grab": ("G",),
        "scale": ("S",),
        "isolate": ("/",),
        "add": ("I", "Ins"),
        "delete": ("X", "Del", "Backspace"),
        "select_all": ("A", "Ctrl+A"),
        "select_none": ("Alt+A",),
    },
}

#: Name → keymap; the first is the default.
KEYMAPS: Mapping[str, Keymap] = MappingProxyType(
    {name: MappingProxyType({**_COMMON, **own}) for name, own in _OWN.items()}
)

#: The only actions while a gesture is under way; outside of one their keys may mean something else.
IN_GESTURE = frozenset({"time_only", "weight_only"})


def action_of(keymap: Keymap, key: str, *, in_gesture: bool) -> str | None:
    """The action of a key, None when it has none there."""
    for action, keys in keymap.items():
        if key in keys and (action in IN_GESTURE) == in_gesture:
            return action
    return None
