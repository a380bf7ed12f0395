"""What every stage did to one pose, as plain lines; the geometry behind the stage overlay. No Qt.

Tracks are straight between knots, so "where did this stage change something" is answered exactly at
the knots of both, without sampling.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from core_pipeline.pipeline import STAGES, Stages
from core_pipeline.weights import Weights

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

#: A difference (weight) that nobody can see.
INVISIBLE = 1e-4


@dataclass(frozen=True, eq=False)
class Line:
    """t (m,) rising seconds, v (m,) weights; straight between knots."""

    t: Array
    v: Array

    def same_as(self, other: Line) -> bool:
        """Whether both look the same."""
        if self.t.size != other.t.size:
            return False
        return not self.t.size or (
            float(np.abs(self.t - other.t).max()) < INVISIBLE and float(np.abs(self.v - other.v).max()) < INVISIBLE
        )

    def at(self, t: float) -> float:
        """Weight at a time; 0 outside."""
        return float(np.interp(t, self.t, self.v, left=0.0, right=0.0)) if self.t.size else 0.0

    def seen(self, left: float, right: float) -> Line:
        """Only the knots from the last before `left` to the first after `right`."""
        a = max(int(self.t.searchsorted(left, "right")) - 1, 0)
        b = int(self.t.searchsorted(right, "left")) + 1
        return self if a == 0 and b >= self.t.size else Line(self.t[a:b], self.v[a:b])

    def thinned(self, left: float, column: float) -> Line:
        """At most two knots per column of `column` seconds: its lowest and its highest, for long utterances."""
        if self.t.size < 8:
            return self
        columns = np.floor((self.t - left) / column)
        begins = np.flatnonzero(np.concatenate(([True], columns[1:] != columns[:-1])))
        if 3 * begins.size > self.t.size:
            return self
        v = np.empty(2 * begins.size)
        v[0::2] = np.minimum.reduceat(self.v, begins)
        v[1::2] = np.maximum.reduceat(self.v, begins)
        return Line(np.repeat(self.t[begins], 2), v)

    def rising(self) -> Mask:
        """(m−1,) which segments leave 0; the others lie on the base line and are not drawn."""
        active = self.v > 0
        return np.asarray(active[:-1] | active[1:])


NOTHING = Line(np.zeros(0), np.zeros(0))


@dataclass(frozen=True, eq=False)
class PoseLines:
    """One pose at every stage.

    red    the curves of the even bigrams and of the odd ones: within each, no two overlap
    stage  "blue", "yellow", "cyan", "magenta" → line
    """

    pose: str
    red: tuple[Line, Line]
    stage: Mapping[str, Line]

    @property
    def peak(self) -> float:
        """The highest weight at any stage; 0 for a pose that this utterance does not move."""
        lines = (*self.red, *self.stage.values())
        return max((float(line.v.max()) for line in lines if line.v.size), default=0.0)

    def same_as(self, other: PoseLines | None) -> bool:
        """Whether both look the same at every stage."""
        return other is not None and all(
            a.same_as(b)
            for a, b in zip((*self.red, *self.stage.values()), (*other.red, *other.stage.values()), strict=True)
        )


def pose_lines(stages: Stages) -> dict[str, PoseLines]:
    """Every pose's lines, views of the pipeline's arrays as far as possible."""
    result = {}
    tracks = [stages.stage(colour) for colour in STAGES]
    for p, pose in enumerate(stages.poses):
        lines = {}
        for colour, track in zip(STAGES, tracks, strict=True):
            x, v = track.lane(p)
            lines[colour] = Line(x - (p * track.stride - track.start), v)
        result[pose] = PoseLines(pose, _red(stages, p), lines)
    return result


def weights_lines(weights: Weights) -> dict[str, Line]:
    """Every pose's frames, joined by straight lines."""
    times = weights.start + np.arange(len(weights.frames)) / weights.fps
    return {pose: Line(times, weights.frames[:, p].astype(np.float64)) for p, pose in enumerate(weights.poses)}


def _red(stages: Stages, p: int) -> tuple[Line, Line]:
    # In Warped, a pose's even bigrams stand side by side, and so do its odd ones.
    warped = stages.warped
    poses = len(warped.poses)
    half = warped.ends.size // (2 * poses)
    if not half:
        return NOTHING, NOTHING
    shift = p * (warped.duration + 1.0) - warped.start
    halves = []
    for parity in (0, 1):
        first = (parity * poses + p) * half
        a = int(warped.ends[first - 1]) if first else 0
        b = int(warped.ends[first + half - 1])
        halves.append(Line(warped.x[a:b] - shift, warped.v[a:b]))
    return halves[0], halves[1]


@dataclass(frozen=True, eq=False)
class Change:
    """Where two stages differ: both at the knots of both, t (m,), and which segments (m−1,) differ."""

    t: Array
    before: Array
    after: Array
    differs: Mask

    def __bool__(self) -> bool:
        return bool(self.differs.any())


def change(before: Line, after: Line) -> Change:
    """Exactly where `after` left `before`."""
    t = np.union1d(before.t, after.t)
    if t.size < 2:
        return Change(t, np.zeros(t.size), np.zeros(t.size), np.zeros(0, bool))
    b = _values(before, t)
    a = _values(after, t)
    apart = np.abs(a - b) > INVISIBLE
    return Change(t, b, a, apart[:-1] | apart[1:])


def _values(line: Line, t: Array) -> Array:
    if not line.t.size:
        return np.zeros(t.size)
    return np.asarray(np.interp(t, line.t, line.v, left=0.0, right=0.0))
