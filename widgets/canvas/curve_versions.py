"""Other versions of the open bigram's curves: the one from when it was opened, and ones to slide to. No Qt."""

from __future__ import annotations

from collections.abc import Mapping

from core_pipeline.curves import Curve

Curves = Mapping[str, Curve]

#: Name of the version from before, to be shown.
PREVIOUS = "previous version"


def same(one: Curves, other: Curves) -> bool:
    """Whether both have the same poses with equal keys."""
    return one.keys() == other.keys() and all(
        curve is other[pose] or curve.same_as(other[pose]) for pose, curve in one.items()
    )


class CurveVersions:
    """Which version is "the other one", without a state that undo could leave behind.

    It is the snapshot, except while what the last swap led to is shown: then it is what that swap left.

    towards  the version that is slid to
    """

    def __init__(self) -> None:
        self.towards = PREVIOUS
        self._snapshot: Curves = {}
        self._left: Curves | None = None
        self._reached: Curves = {}
        self._others: dict[str, Curves] = {}
        self._neighbours: dict[str, Curves] = {}

    def set_snapshot(self, curves: Curves | None) -> None:
        """The version from before; what was left by a swap is forgotten."""
        self._snapshot, self._left = dict(curves or {}), None

    def set_other(self, name: str, curves: Curves | None) -> None:
        """One more version to slide to; None takes it away."""
        if curves is None:
            self._others.pop(name, None)
        else:
            self._others[name] = dict(curves)

    def set_neighbours(self, neighbours: Mapping[str, Curves]) -> None:
        """Name → curves of bigrams that are like this one, the most similar first."""
        self._neighbours = {name: dict(curves) for name, curves in neighbours.items()}

    def neighbours(self, now: Curves) -> list[str]:
        """Names of those that differ from `now`."""
        return [name for name, curves in self._neighbours.items() if not same(now, curves)]

    def other(self, now: Curves) -> Curves:
        """The other version while `now` is shown."""
        if self._left is not None and same(now, self._reached):
            return self._left
        return self._snapshot

    def keep(self, left: Curves, reached: Curves) -> None:
        """A swap has gone from one version to another."""
        if self._left is None or not same(left, self._reached):
            self._left, self._reached = dict(left), dict(reached)

    def names(self, now: Curves) -> list[str]:
        """Versions to slide to, the one from before first unless it is what is shown already."""
        others = [*self._others, *self.neighbours(now)]
        first = [] if same(now, self.other(now)) and others else [PREVIOUS]
        return first + others

    def target(self, name: str, now: Curves) -> Curves:
        """The curves of a version."""
        return self._others.get(name) or self._neighbours.get(name) or self.other(now)
