"""The stage overlay's time axis: which seconds are seen, and where on the widget. A value, no Qt.

|‹ start            left ├──────── seen ────────┤ right              end ›|
                      x0 px                   x1 px
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

#: The least that can be seen at once, in seconds.
CLOSEST = 0.05

_STEPS = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 60.0, 120.0, 300.0, 600.0, 1800.0, 3600.0)


@dataclass(frozen=True)
class TimeAxis:
    """Maps seconds to pixels and back. Immutable; every change returns a new axis.

    start, end   seconds of everything there is, start < end
    left, right  seconds seen, within start and end
    x0, x1       pixels of left and right
    """

    start: float = 0.0
    end: float = 1.0
    left: float = 0.0
    right: float = 1.0
    x0: float = 0.0
    x1: float = 1.0

    @property
    def span(self) -> float:
        """Seconds seen."""
        return self.right - self.left

    @property
    def scale(self) -> float:
        """Pixels per second."""
        return (self.x1 - self.x0) / self.span

    @property
    def is_fitted(self) -> bool:
        """Whether everything is seen."""
        return self.left <= self.start and self.right >= self.end

    def px(self, t: Any) -> Any:
        """Pixels of a time in seconds; a float or an array of any shape."""
        return self.x0 + (t - self.left) * self.scale

    def time(self, px: float) -> float:
        """Seconds at a pixel, held within start and end."""
        return min(max(self.left + (px - self.x0) / self.scale, self.start), self.end)

    def sees(self, t: float) -> bool:
        """Whether a time lies in what is seen."""
        return self.left <= t <= self.right

    def shows_any(self, first: float, last: float) -> bool:
        """Whether some of first…last lies in what is seen."""
        return last > self.left and first < self.right

    def with_pixels(self, x0: float, x1: float) -> TimeAxis:
        """The same seconds on other pixels; at least one pixel is kept."""
        return replace(self, x0=x0, x1=max(x1, x0 + 1.0))

    def with_content(self, start: float, end: float) -> TimeAxis:
        """Another utterance: still everything if everything was seen, else as much of the old view as exists."""
        end = end if end > start else start + 1.0
        axis = replace(self, start=start, end=end)
        return axis.fitted() if self.is_fitted else axis.at(self.left, self.span)

    def fitted(self) -> TimeAxis:
        """Everything is seen."""
        return replace(self, left=self.start, right=self.end)

    def at(self, left: float, span: float | None = None) -> TimeAxis:
        """Seen from `left` on, moved so that nothing outside start and end is seen."""
        whole = self.end - self.start
        span = min(max(self.span if span is None else span, min(CLOSEST, whole)), whole)
        if span >= whole * (1 - 1e-9):
            return self.fitted()
        left = min(max(left, self.start), self.end - span)
        right = self.end if left >= self.end - span else left + span
        return replace(self, left=left, right=right)

    def zoomed(self, factor: float, about: float) -> TimeAxis:
        """`factor` times as near (> 1 sees less), with the time `about` staying where it is."""
        span = min(max(self.span / factor, min(CLOSEST, self.end - self.start)), self.end - self.start)
        return self.at(about - (about - self.left) * span / self.span, span)

    def panned(self, pixels: float) -> TimeAxis:
        """The content moves right by `pixels`."""
        return self.at(self.left - pixels / self.scale)

    def revealing(self, first: float, last: float) -> TimeAxis:
        """Moved as little as shows first…last with a margin of a tenth of the view; the same axis if they are seen."""
        if self.sees(first) and self.sees(last):
            return self
        margin = 0.1 * self.span
        if first < self.left or last - first > self.span - 2 * margin:
            return self.at(first - margin)
        return self.at(last + margin - self.span)

    def following(self, t: float) -> TimeAxis:
        """The page that shows t: turned when t nears the right edge or has left, so that t stands near the left."""
        if (
            self.is_fitted
            or self.left <= t <= self.left + 0.92 * self.span
            or (self.right >= self.end and self.sees(t))
        ):
            return self
        return self.at(t - 0.08 * self.span)

    def step(self, pixels: float) -> float:
        """The least round number of seconds that is at least `pixels` wide."""
        wanted = pixels / self.scale
        return next((s for s in _STEPS if s >= wanted * (1 - 1e-9)), 3600.0 * math.ceil(wanted / 3600.0))

    def ticks(self, step: float) -> list[float]:
        """The multiples of `step` that are seen, in seconds."""
        first = math.ceil(self.left / step - 1e-6)
        last = math.floor(self.right / step + 1e-6)
        return [i * step for i in range(first, last + 1)]


def clock(t: float, step: float = 0.01) -> str:
    """A time as the axis writes it: "0.25", "3.4", "12", and "1:05" from a minute on.

    step  seconds between two labels; decides the decimals
    """
    decimals = 0 if step >= 1 else 1 if step >= 0.1 else 2
    if abs(t) < 60:
        return f"{t:.{decimals}f}"
    rounded = round(t, decimals)
    minutes, seconds = divmod(abs(rounded), 60)
    digits = f"{seconds:0{3 + decimals if decimals else 2}.{decimals}f}"
    return f"{'-' if t < 0 else ''}{int(minutes)}:{digits}"
