"""Arrangements of the docks: presets for kinds of work, sized for the window they are in."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

from PySide6.QtCore import QT_TRANSLATE_NOOP, Qt
from PySide6.QtWidgets import QDockWidget, QMainWindow

#: In a window lower than this, docks of one side share one place, as tabs.
LOW = 860

AUTHOR = "author"

#: Docks in one place, by the names of add_dock; the first is on top of the others.
Stack = tuple[str, ...]


@dataclass(frozen=True)
class Preset:
    """Which docks stand where. Docks that are not named go behind the last ones of their side.

    left, right  places from the top
    hides        whether docks that are not named are hidden
    wide         pixels across at most, left and right; and as often a quarter of the window at most
    low          pixels of each side's second place
    below        share of the height that the bottom takes
    """

    title: str
    left: tuple[Stack, ...] = ()
    right: tuple[Stack, ...] = ()
    bottom: Stack = ("stages",)
    hides: bool = True
    wide: tuple[int, int] = (420, 400)
    quarters: float = 1.0
    low: tuple[int, int] = (150, 190)
    below: float = 0.34


PRESETS: Mapping[str, Preset] = MappingProxyType(
    {
        AUTHOR: Preset(
            str(QT_TRANSLATE_NOOP("Layouts", "&Author")),
            (("bigrams",), ("weak", "sentences")),
            (("preview",), ("weights", "settings", "mapping")),
            hides=False,
        ),
        "review": Preset(
            str(QT_TRANSLATE_NOOP("Layouts", "&Review")),
            (("weak", "queue", "sentences"),),
            (("preview",),),
            wide=(420, 640),
            quarters=1.3,
            below=0.42,
        ),
        "face": Preset(
            str(QT_TRANSLATE_NOOP("Layouts", "&Face")),
            (("mapping",),),
            (("preview",), ("weights",)),
            (),
            wide=(400, 620),
            quarters=1.5,
        ),
        "curves": Preset(str(QT_TRANSLATE_NOOP("Layouts", "&Curves Only")), bottom=()),
    }
)

_LEFT, _RIGHT = Qt.DockWidgetArea.LeftDockWidgetArea, Qt.DockWidgetArea.RightDockWidgetArea
_BELOW = Qt.DockWidgetArea.BottomDockWidgetArea


def arrange(window: QMainWindow, name: str, homes: Mapping[str, Qt.DockWidgetArea], hidden: Sequence[str]) -> None:
    """Put the docks of a window as a preset wants them.

    name    one of PRESETS (KeyError otherwise)
    homes   every dock's name → where it was built
    hidden  the names of docks that are built hidden
    """
    preset = PRESETS[name]
    width, height = window.width(), window.height()
    docks = {dock.objectName(): dock for dock in window.findChildren(QDockWidget)}
    for dock in docks.values():
        window.removeDockWidget(dock)
    named = {key for stack in (*preset.left, *preset.right, preset.bottom) for key in stack}
    low = height < LOW
    left, right = _across(preset) if low else (preset.left, preset.right)
    for i, (area, stacks) in enumerate(((_LEFT, left), (_RIGHT, right), (_BELOW, (preset.bottom,)))):
        others = tuple(key for key in homes if homes[key] == area and key not in named)
        places = _places(stacks, others, low=low)
        seen = []
        for place in places:
            stack = [docks[key] for key in place if key in docks]
            for dock in stack:
                window.addDockWidget(area, dock)
                dock.setVisible(dock.objectName() in named if preset.hides else dock.objectName() not in hidden)
                if dock is not stack[0]:
                    window.tabifyDockWidget(stack[0], dock)
            shown = [dock for dock in stack if not dock.isHidden()]
            if shown:
                shown[0].raise_()
                seen.append(shown[0])
        if not seen:
            continue
        if area == _BELOW:
            window.resizeDocks(seen, [int(height * preset.below)], Qt.Orientation.Vertical)
            continue
        window.resizeDocks(seen[:1], [min(preset.wide[i], int(width / 4 * preset.quarters))], Qt.Orientation.Horizontal)
        if len(seen) == 2:
            upper = int(height * (0.92 - preset.below if preset.bottom else 0.92))
            window.resizeDocks(seen, [upper - preset.low[i], preset.low[i]], Qt.Orientation.Vertical)


def _across(preset: Preset) -> tuple[tuple[Stack, ...], tuple[Stack, ...]]:
    """Left and right where all of a side are in one place: what changes the face is not put upon it."""
    right = tuple(tuple(key for key in stack if key != "mapping") for stack in preset.right)
    return (preset.left if right == preset.right else (*preset.left, ("mapping",))), right


def _places(stacks: Sequence[Stack], others: Stack, *, low: bool) -> list[Stack]:
    """The places of a side, and who stands there: in a low window all in one."""
    if low or not stacks:
        return [(*(key for stack in stacks for key in stack), *others)]
    return [*stacks[:-1], (*stacks[-1], *others)]
