"""How the stage overlay shares its height among the poses. Pure arithmetic, no Qt."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

#: One tall row on the same time axis as the small ones · all rows alike · the active pose alone.
MODES = ("focus", "all", "one")

#: Least heights in pixels: a row at 0 throughout (room for its name), a row that moves, the active row.
IDLE, BUSY, ACTIVE = 14, 18, 44
#: How many times as tall as the others the active row wants to be.
FOCUS = 4.0


@dataclass(frozen=True)
class Row:
    """One pose's strip of the overlay, in pixels."""

    pose: str
    index: int
    top: int
    height: int
    active: bool
    idle: bool

    @property
    def bottom(self) -> int:
        """The first pixel below."""
        return self.top + self.height


def lay_out(poses: Sequence[str], active: str, peaks: Mapping[str, float], mode: str, height: int) -> tuple[Row, ...]:
    """Rows from top to bottom in the order of the pose set, filling `height` pixels.

    peaks  pose → its highest weight. When there is no room for all poses, those that move least are left
           out; the active pose never is.
    """
    shown = [active] if mode == "one" and active in poses else list(poses)
    least = {p: _least(p, active, peaks, mode) for p in shown}
    for pose in sorted(shown, key=lambda p: (p == active, peaks.get(p, 0.0), -poses.index(p))):
        if len(shown) == 1 or sum(least[p] for p in shown) <= height:
            break
        shown.remove(pose)
    wish = {p: _wish(p, active, peaks, mode) for p in shown}
    rows, top = [], 0
    for pose, tall in zip(shown, _share([least[p] for p in shown], [wish[p] for p in shown], height), strict=True):
        rows.append(Row(pose, list(poses).index(pose), top, tall, pose == active, not peaks.get(pose, 0.0)))
        top += tall
    return tuple(rows)


def _least(pose: str, active: str, peaks: Mapping[str, float], mode: str) -> int:
    if mode != "focus":
        return IDLE
    return ACTIVE if pose == active else BUSY if peaks.get(pose, 0.0) else IDLE


def _wish(pose: str, active: str, peaks: Mapping[str, float], mode: str) -> float:
    if mode != "focus":
        return 1.0
    return FOCUS if pose == active else 1.0 if peaks.get(pose, 0.0) else 0.0


def _share(least: Sequence[int], wish: Sequence[float], height: int) -> list[int]:
    """Heights in proportion to `wish`, none below `least`, together `height`."""
    fixed: set[int] = {i for i, w in enumerate(wish) if not w} if any(wish) else set()
    while True:
        free = [i for i in range(len(least)) if i not in fixed]
        room = max(height - sum(least[i] for i in fixed), 0)
        unit = room / sum(wish[i] or 1.0 for i in free) if free else 0.0
        short = {i for i in free if unit * (wish[i] or 1.0) < least[i]}
        if not short or len(short) == len(free):
            break
        fixed |= short
    edges = [0.0]
    for i in range(len(least)):
        edges.append(edges[-1] + (least[i] if i in fixed else unit * (wish[i] or 1.0)))
    marks = [round(edge) for edge in edges]
    return [b - a for a, b in pairwise(marks)]
