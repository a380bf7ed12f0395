"""How long the user has worked on each bigram, shown quietly: the paper reckons five minutes for one (section 5)."""

from __future__ import annotations

from collections import Counter

from PySide6.QtCore import QObject, QTimer

from core_pipeline.phonemes import Pair

from .open_bigram import OpenBigram
from .parts import Parts

#: Without any sign of work for so many seconds the clock stands still.
IDLE = 30
_TICK_MS = 1000


class TimeSpent(QObject):
    """Counts seconds of work, bigram by bigram, until the program ends.

    seconds  pair → seconds
    """

    def __init__(self, parts: Parts, bigram: OpenBigram, parent: QObject) -> None:
        super().__init__(parent)
        self._window, self._bigram, self._player = parts.window, bigram, parts.preview.player
        self.seconds: Counter[Pair] = Counter()
        self._left = IDLE
        canvas = self._window.canvas
        for signal in (canvas.preview_changed, canvas.edited, canvas.selection_changed, bigram.opened):
            signal.connect(self._wake)
        self._clock = QTimer(self)
        self._clock.setInterval(_TICK_MS)
        self._clock.timeout.connect(self.tick)
        self._clock.start()

    def close(self) -> None:
        """Stop counting."""
        self._clock.stop()

    def tick(self) -> None:
        """A second has passed."""
        self._left -= 1
        pair = self._bigram.pair
        if pair is not None and self._window.isActiveWindow() and (self._left > 0 or self._player.playing):
            self.seconds[pair] += 1
        self._show()

    def _wake(self, *_: object) -> None:
        self._left = IDLE
        self._show()

    def _show(self) -> None:
        pair = self._bigram.pair
        minutes, seconds = divmod(self.seconds[pair] if pair is not None else 0, 60)
        self._window.header.set_time_spent(f"{minutes}:{seconds:02}" if minutes or seconds >= 10 else "")
