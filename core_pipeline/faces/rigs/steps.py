"""How far the reading of a rig has come, step by step; whoever is told may end it."""

from __future__ import annotations

from collections.abc import Callable

#: Told the share that is done, 0…1; what it raises ends the reading.
Report = Callable[[float], None]


def silent(_share: float) -> None:
    """Tells nobody."""


class Steps:
    """Counts: every call is one of `total` steps done."""

    def __init__(self, total: int, report: Report) -> None:
        self._total = max(total, 1)
        self._report = report
        self._done = 0
        report(0.0)

    def __call__(self) -> None:
        """One step more is done."""
        self._done += 1
        self._report(min(self._done / self._total, 1.0))
