"""A capture: what a face's channels (ARKit's, a rig's) did, before it is put into poses.

rows at uneven times, some of them lost  ─→  an even grid, and which of its frames were really seen
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import UserError

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

#: A grid frame counts as seen when the rows around it are no further apart than this many steps.
HOLE = 2.6
#: Seconds of the longest capture, and the rates that cameras have.
LONGEST = 3 * 3600.0
RATES = (24.0, 25.0, 30.0, 48.0, 50.0, 60.0, 90.0, 100.0, 120.0, 240.0)


@dataclass(frozen=True, eq=False)
class Capture:
    """channels, (f, channels) values on an even grid, fps, start in seconds; seen (f,); notes on what was repaired."""

    channels: tuple[str, ...]
    fps: float
    start: float
    values: Array
    seen: Mask
    notes: tuple[str, ...] = ()


def even(channels: tuple[str, ...], times: Array, values: Array, notes: list[str], place: str) -> Capture:
    """Rows at any rising times (r,) as an even grid at the rate they mostly have.

    values  (r, channels); a row with NaN was not seen
    UserError when no row was seen, or the rows make no sense as a recording.
    """
    good = np.isfinite(values).all(axis=1)
    if not good.any():
        raise UserError(f"{place}: the face is lost in every row. Choose another take.")
    span = float(times[-1] - times[0])
    if span > LONGEST:
        raise UserError(f"{place} lasts {span / 3600:.1f} hours, or its times are wrong. Cut it into shorter takes.")
    fps = _rate(times)
    count = round(span * fps) + 1
    grid = times[0] + np.arange(count) / fps
    seen_times, seen_values = times[good], values[good]
    after = np.clip(seen_times.searchsorted(grid), 0, seen_times.size - 1)
    before = np.clip(seen_times.searchsorted(grid, side="right") - 1, 0, seen_times.size - 1)
    near = np.minimum(np.abs(seen_times[after] - grid), np.abs(grid - seen_times[before])) <= 0.5 / fps
    within = (seen_times[after] - seen_times[before] <= HOLE / fps) & (grid >= seen_times[0]) & (grid <= seen_times[-1])
    made = np.stack([np.interp(grid, seen_times, column) for column in seen_values.T], axis=1)
    lost = int((~good).sum())
    if lost:
        notes.append(f"In {lost} of {good.size} rows the face was lost; they are left out.")
    holes = np.flatnonzero(np.diff(times) > HOLE / fps)
    if holes.size:
        notes.append(f"{holes.size} gaps in the recording, {np.diff(times)[holes].sum():.2f} s in all, are left out.")
    return Capture(channels, fps, float(times[0]), made, near | within, tuple(notes))


def _rate(times: Array) -> float:
    """Frames a second: a camera's own rate when the rows come within 3 % of it."""
    if times.size < 2:
        return 60.0
    fps = 1.0 / float(np.median(np.diff(times)))
    nearest = min(RATES, key=lambda rate: abs(rate - fps))
    return nearest if abs(nearest - fps) <= 0.03 * nearest else float(np.clip(fps, 1.0, 1000.0))
