"""From part to part of the window by one key: toolbar, canvas and every dock; the part with the focus is marked."""

from __future__ import annotations

from collections.abc import Collection

from PySide6.QtCore import QObject, Qt
from PySide6.QtWidgets import QApplication, QDockWidget, QMainWindow, QWidget


class FocusRing(QObject):
    """Goes round, and comes back to what had the focus in a part before.

    docks  the names of the docks in their order; the owner may add more
    first  the parts that are no docks
    """

    def __init__(self, window: QMainWindow, docks: Collection[str], *first: QWidget) -> None:
        super().__init__(window)
        self._window = window
        self._docks = docks
        self._first = first
        self._last: dict[QWidget, QWidget] = {}
        self._marked: QDockWidget | None = None
        app = QApplication.instance()
        if isinstance(app, QApplication):
            app.focusChanged.connect(self._focus_changed)

    def go(self, step: int = 1) -> None:
        """To the next part, or the previous one with step −1."""
        parts = self._parts()
        here = self._part_of(QApplication.focusWidget())
        at = parts.index(here) if here in parts else -1 if step > 0 else 0
        for i in range(1, len(parts) + 1):  # a part may have nothing that takes the focus
            part = parts[(at + step * i) % len(parts)]
            if self._enter(part):
                return

    def _parts(self) -> list[QWidget]:
        docks = {dock.objectName(): dock for dock in self._window.findChildren(QDockWidget)}  # raising reorders them
        shown = (docks[name] for name in self._docks if name in docks and not docks[name].isHidden())
        return [*(part for part in self._first if part.isVisible()), *shown]

    def _enter(self, part: QWidget) -> bool:
        if isinstance(part, QDockWidget):
            part.raise_()
        before = self._last.get(part)
        wanted = [before] if before is not None else []
        inner = part.widget() if isinstance(part, QDockWidget) else part
        wanted += [inner, *inner.findChildren(QWidget)]
        for widget in wanted:
            target = widget
            while (proxy := target.focusProxy()) is not None:
                target = proxy
            takes = target.focusPolicy().value & Qt.FocusPolicy.TabFocus.value
            if takes and target.isEnabled() and target.isVisibleTo(part):
                target.setFocus(Qt.FocusReason.TabFocusReason)
                return True
        return False

    def _part_of(self, widget: QWidget | None) -> QWidget | None:
        while widget is not None and widget is not self._window:
            if isinstance(widget, QDockWidget) or widget in self._first:
                return widget
            widget = widget.parentWidget()
        return None

    def _focus_changed(self, _before: QWidget | None, now: QWidget | None) -> None:
        if now is None or now.window() is not self._window:
            return
        part = self._part_of(now)
        if part is not None:
            self._last[part] = now
        dock = part if isinstance(part, QDockWidget) else None
        if dock is not self._marked:
            for changed in (self._marked, dock):
                if changed is not None:
                    changed.setProperty("here", changed is dock)
                    changed.style().polish(changed)
                    changed.update()
            self._marked = dock
