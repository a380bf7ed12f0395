"""Python's garbage is collected on the thread of the interface alone: an object of Qt's must not die on another."""

from __future__ import annotations

import gc

from PySide6.QtCore import QObject, QTimer

#: Milliseconds between two looks.
_LOOK_MS = 200


class Collector(QObject):
    """Takes over from Python's own collector, which runs on whatever thread happens to allocate, until `stop`."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        gc.disable()
        self._timer = QTimer(self)
        self._timer.setInterval(_LOOK_MS)
        self._timer.timeout.connect(self.look)
        self._timer.start()

    def look(self) -> None:
        """Collect what Python would have collected by now."""
        young, middle, old = gc.get_count()
        limits = gc.get_threshold()
        if young > limits[0]:
            generation = 0
            if middle > limits[1]:
                generation = 2 if old > limits[2] else 1
            gc.collect(generation)

    def stop(self) -> None:
        """Leave it to Python again."""
        self._timer.stop()
        gc.enable()
