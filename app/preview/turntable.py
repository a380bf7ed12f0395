"""A turntable: turns evenly by the machine's clock, however many pictures are drawn, and rests while it is held."""

from __future__ import annotations

import time
from collections.abc import Callable

from PySide6.QtCore import QObject, Qt, QTimer, Signal

from core_pipeline.faces.looks import TURN_SECONDS

_FRAME = 16  # milliseconds


class Turntable(QObject):
    """turned(degrees): so much farther since the last time."""

    turned = Signal(float)

    def __init__(self, clock: Callable[[], float] = time.monotonic, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._clock = clock
        self._at = 0.0
        self._on = self._held = False
        self._timer = QTimer(self)
        self._timer.setTimerType(Qt.TimerType.PreciseTimer)
        self._timer.setInterval(_FRAME)
        self._timer.timeout.connect(self._turn)

    @property
    def turning(self) -> bool:
        """Whether it is on and nobody holds it."""
        return self._timer.isActive()

    def set_on(self, on: bool) -> None:
        """Turn, or stand."""
        self._on = on
        self._go()

    def hold(self, held: bool) -> None:
        """Rest while a hand is on it."""
        self._held = held
        self._go()

    def _go(self) -> None:
        self._at = self._clock()
        self._timer.start() if self._on and not self._held else self._timer.stop()

    def _turn(self) -> None:
        now = self._clock()
        self.turned.emit(360.0 * (now - self._at) / TURN_SECONDS)
        self._at = now
