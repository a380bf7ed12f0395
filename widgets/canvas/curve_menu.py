"""The canvas' context menu: what can be done at a place, with the keys of the present keymap beside it."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping

from PySide6.QtCore import QT_TRANSLATE_NOOP, QCoreApplication, Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu, QWidget

#: (text, action) of each entry; None is a line between groups.
_ROWS = (
    (QT_TRANSLATE_NOOP("CurveMenu", "Delete keys"), "delete"),
    None,
    (QT_TRANSLATE_NOOP("CurveMenu", "Cut"), "cut"),
    (QT_TRANSLATE_NOOP("CurveMenu", "Copy"), "copy"),
    (QT_TRANSLATE_NOOP("CurveMenu", "Paste"), "paste"),
    (QT_TRANSLATE_NOOP("CurveMenu", "Paste reversed in time"), "paste_reversed"),
    None,
    (QT_TRANSLATE_NOOP("CurveMenu", "Scale keys"), "scale"),
    (QT_TRANSLATE_NOOP("CurveMenu", "Reverse in time"), "reverse"),
    (QT_TRANSLATE_NOOP("CurveMenu", "Mirror values"), "mirror"),
    None,
    (QT_TRANSLATE_NOOP("CurveMenu", "Swap with the previous version"), "swap"),
    (QT_TRANSLATE_NOOP("CurveMenu", "Slide to another version"), "slide"),
    (QT_TRANSLATE_NOOP("CurveMenu", "Duplicate from a similar bigram"), "duplicate"),
    None,
    (QT_TRANSLATE_NOOP("CurveMenu", "Select all keys"), "select_all"),
    (QT_TRANSLATE_NOOP("CurveMenu", "Show only this pose, or all again"), "isolate"),
    None,
    (QT_TRANSLATE_NOOP("CurveMenu", "Frame selection"), "frame"),
    (QT_TRANSLATE_NOOP("CurveMenu", "Frame all"), "frame_all"),
)


class CurveMenu(QMenu):
    """The menu; it is deleted when it closes.

    acts      action → what does it; "add" adds a key at the place the menu is for, to the pose `active`
    keys      action → its key, as this system writes it
    disabled  actions that cannot be done now
    """

    def __init__(
        self,
        parent: QWidget,
        active: str,
        acts: Mapping[str, Callable[[], object]],
        keys: Mapping[str, str],
        disabled: Collection[str],
    ) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self._offer(
            self.tr("Add key to {0}").format(active), self.tr("Double-click"), acts["add"], "add" not in disabled
        )
        for row in _ROWS:
            if row is None:
                self.addSeparator()
            else:
                text, action = row
                shown = QCoreApplication.translate("CurveMenu", str(text))
                self._offer(shown, keys[action], acts[action], action not in disabled)

    def _offer(self, text: str, key: str, act: Callable[[], object], enabled: bool) -> None:
        action = QAction(f"{text}\t{key}", self)
        action.setEnabled(enabled)
        action.triggered.connect(lambda _=False: act())
        self.addAction(action)
