"""How large moving pictures are drawn: coarser while the machine cannot keep up, so that nothing stutters."""

from __future__ import annotations

from collections import deque
from collections.abc import Hashable

#: Shares of the full side, from the finest.
STEPS = (1.0, 0.8, 0.64, 0.5)
#: Seconds a moving picture may take.
BUDGET = 0.020
#: A picture is never drawn coarser than this, in pixels of its shorter side.
SMALLEST = 200
#: So many pictures are looked at before anything changes, and so many more before it becomes finer again.
_SURE, _SURER = 6, 40
#: Part of the budget below which a finer step is tried: it costs up to 1.6 times as much.
_EASY = 0.5


class Pace:
    """Chooses a step from how long the last pictures took. What else is drawn begins with the finest again."""

    def __init__(self) -> None:
        self._step = 0
        self._times: deque[float] = deque(maxlen=_SURER)
        self._what: Hashable = None

    def size(self, size: tuple[int, int], what: Hashable) -> tuple[int, int]:
        """How large to draw `what` where (w, h) pixels are wanted."""
        if what != self._what:
            self._what, self._step = what, 0
            self._times.clear()
        share = max(STEPS[self._step], min(1.0, SMALLEST / max(min(size), 1)))
        return max(round(size[0] * share), 1), max(round(size[1] * share), 1)

    def took(self, seconds: float) -> None:
        """How long the last picture took."""
        self._times.append(seconds)
        usual = sorted(self._times)[len(self._times) // 2]
        if len(self._times) >= _SURE and usual > BUDGET and self._step < len(STEPS) - 1:
            self._go(self._step + 1)
        elif len(self._times) == _SURER and usual < _EASY * BUDGET and self._step > 0:
            self._go(self._step - 1)

    def _go(self, step: int) -> None:
        self._step = step
        self._times.clear()
