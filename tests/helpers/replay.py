"""Replays a drag at the rate of a fast mouse and tells how long every event took to be seen.

An event counts from the moment it was due, not from when the program came round to it, so that a stall
is seen in every event it delayed.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QEventLoop, QPointF, QTimer
from PySide6.QtWidgets import QApplication, QWidget

from tests.helpers import mouse

#: Events a second.
RATE = 200


def recorded(seconds: float = 2.0, seed: int = 2013) -> list[tuple[float, float]]:
    """A hand's way in pixels from where it began, one place per event: slow, fast, resting, and trembling a little."""
    dice = np.random.default_rng(seed)
    count = round(seconds * RATE)
    u = np.linspace(0, 1, count)
    x = 45 * np.sin(2.2 * np.pi * u) * np.minimum(1, 6 * u)
    y = 55 * np.sin(5 * np.pi * u**1.5) * np.minimum(1, 6 * u)
    resting = (u > 0.45) & (u < 0.55)
    x[resting], y[resting] = x[resting][0], y[resting][0]
    jitter = dice.normal(0, 0.4, (count, 2))
    return list(zip((x + jitter[:, 0]).tolist(), (y + jitter[:, 1]).tolist(), strict=True))


@dataclass
class Seen:
    """When things were seen, on the performance counter, by name."""

    times: dict[str, list[float]] = field(default_factory=dict)

    def note(self, name: str) -> Callable[..., None]:
        """Something to call when `name` has been seen."""
        times = self.times.setdefault(name, [])
        return lambda *_: times.append(time.perf_counter())

    def painted(self, name: str, widget: QWidget) -> None:
        """Notes every painting of a widget whose class paints in Python, when it is done."""
        paint, note = widget.paintEvent, self.note(name)

        def paint_and_note(event):
            paint(event)
            note()

        widget.paintEvent = paint_and_note

    def delays(self, name: str, due: list[float]) -> NDArray[np.float64]:
        """Milliseconds from each moment in `due` until `name` was seen next; those never seen are left out."""
        seen, moments = np.array(self.times[name]), np.array(due)
        at = seen.searchsorted(moments)
        return 1e3 * (seen[at[at < seen.size]] - moments[at < seen.size])


def _rest() -> None:
    """Lets a millisecond of events pass without busy waiting: the face needs the processor."""
    loop = QEventLoop()
    QTimer.singleShot(1, loop.quit)
    loop.exec()


def replay(widget: QWidget, start: QPointF, way: list[tuple[float, float]]) -> list[float]:
    """Presses at `start`, goes the way at RATE, releases; when each event was due, on the performance counter.

    A program that is late gets the newest place only, as window systems do.
    """
    mouse.press(widget, start)
    begin = time.perf_counter()
    due = [begin + k / RATE for k in range(len(way))]
    every, k = QEventLoop.ProcessEventsFlag.AllEvents, 0
    while k < len(way):
        QApplication.processEvents(every)
        now = time.perf_counter()
        if due[k] > now:
            _rest()
            continue
        while k + 1 < len(way) and due[k + 1] <= now:
            k += 1
        x, y = way[k]
        mouse.move(widget, start + QPointF(x, y))
        k += 1
    end = time.perf_counter() + 0.15
    while time.perf_counter() < end:
        QApplication.processEvents(every, 10)
    mouse.release(widget, start + QPointF(*way[-1]))
    return due
