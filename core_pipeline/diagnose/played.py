"""What is weak in a sentence as the pipeline plays it, and which bigram is to blame."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import pairwise

import numpy as np

from ..phonemes import SILENCE, Pair
from ..pipeline import Stages
from ..settings import Settings
from ..timewarp import WarpedCurve
from ..tracks import Array, Track
from .findings import Finding

#: A curve that stays below this weight can lose nothing worth telling.
SMALL = 0.1
#: A closure below this share of its full height is not reached.
CLOSED = 0.9
#: Losing more than this share of a peak to the speed limit is worth a look.
SLOWED = 0.20
#: Losing more than this share of its area to constraints; nearly every closure takes a little of `open`.
CLIPPED = 0.6
#: A pose that turns more often than this inside one bigram trembles; smaller moves than MOVE do not count.
TURNS = 2
MOVE = 0.05
#: A pose that comes and goes within less than this (seconds) pops.
HOLD = 0.1
#: Within a phrase every pose below REST for longer than this (seconds) is a hole.
HOLE = 0.04
REST = 0.05

_POINTS = np.linspace(0.0, 1.0, 41)
_STEP = 0.004


def played(stages: Stages, settings: Settings, closures: Mapping[str, tuple[str, float]]) -> Iterator[Finding]:
    """Every weakness of every bigram of the sentence; pairs with silence are never to blame.

    closures  phone → its closing pose and that pose's full weight, see SetFindings
    """
    tracks = {pose: stages.magenta[pose] for pose in stages.poses}
    yield from _closures(stages, tracks, closures)
    yield from _losses(stages, tracks, settings)
    yield from _restless(stages, tracks)
    yield from _holes(stages, tracks)


def _pairs(stages: Stages) -> list[Pair | None]:
    """The bigrams, None for one with silence or an unknown phone."""
    strange = {SILENCE, *stages.unknown}
    return [None if strange & set(pair) else pair for pair in stages.schedule.pairs()]


def _closures(
    stages: Stages, tracks: Mapping[str, Track], closures: Mapping[str, tuple[str, float]]
) -> Iterator[Finding]:
    """Phones that must close and do not; the neighbour pair that draws less of it is to blame."""
    phones, times, pairs = stages.schedule.phones, stages.schedule.times, _pairs(stages)
    drawn = {(curve.index, curve.pose): float(curve.v.max()) for curve in stages.red}
    i = 0
    while i < len(phones):
        last = i
        while last + 1 < len(phones) and phones[last + 1] == phones[i]:
            last += 1
        first, i = i, last + 1
        if phones[first] not in closures:
            continue
        pose, full = closures[phones[first]]
        start = times[first] - 0.5 * (times[first + 1] - times[first])
        end = times[last + 1] + 0.5 * (times[last + 1] - times[last])
        top, when = _highest(tracks[pose], start, end)
        near = [k for k in range(first - 1, last + 1) if 0 <= k < len(pairs) and pairs[k] is not None]
        if top >= CLOSED * full or not near:
            continue
        blamed = pairs[min(near, key=lambda k: drawn.get((k, pose), 0.0))]
        share = top / full
        middle = when if top > 0 else float(times[first] + times[last + 1]) / 2
        if blamed is not None:
            time = min(max(middle, stages.schedule.start), stages.schedule.end)
            yield Finding(blamed, "closure", 0.4 + 0.5 * (1 - share), time, pose, share)


def _losses(stages: Stages, tracks: Mapping[str, Track], settings: Settings) -> Iterator[Finding]:
    """Red curves cut by a constraint, and peaks cut by the speed limit."""
    pairs = _pairs(stages)
    cyan = {pose: stages.cyan[pose] for pose in stages.poses}
    for curve in stages.red:
        top = int(curve.v.argmax())
        when, height = float(curve.t[top]), float(curve.v[top])
        pair = pairs[curve.index]
        if height < SMALL or pair is None:
            continue
        if curve.pose in settings.clashes:
            share, worst = _clipped(curve, cyan[curve.pose])
            if share > CLIPPED:
                other = _upper(stages, settings, curve.pose, worst)
                yield Finding(pair, "clipped", 0.5 * share * min(1.0, 2 * height), worst, curve.pose, share, other)
        if cyan[curve.pose].at(np.array([when]))[0] < height - 1e-6:
            continue  # a constraint decides here
        share = 1 - _highest(tracks[curve.pose], curve.t[0], curve.t[-1])[0] / height
        if share > SLOWED:
            yield Finding(pair, "slowed", 0.3 + 0.5 * share, when, curve.pose, share)


def _clipped(curve: WarpedCurve, cyan: Track) -> tuple[float, float]:
    """Share of the area of a red curve that lies above the cyan track, and where most of it does."""
    t = curve.t[0] + _POINTS * (curve.t[-1] - curve.t[0])
    red = np.interp(t, curve.t, curve.v)
    lost = np.maximum(red - np.interp(t, cyan.t, cyan.v), 0.0)
    area = float(red.sum())
    return (min(float(lost.sum()) / area, 1.0) if area > 0 else 0.0), float(t[lost.argmax()])


def _upper(stages: Stages, settings: Settings, pose: str, when: float) -> str:
    """The pose before which `pose` gives way most at this time."""
    excess = {
        upper: float(stages.cyan[upper].at(np.array([when]))[0]) - limit
        for upper, limit in settings.clashes[pose]
        if upper in stages.poses
    }
    return max(excess, key=lambda upper: excess[upper], default="")


def _restless(stages: Stages, tracks: Mapping[str, Track]) -> Iterator[Finding]:
    """Poses that turn too often inside one bigram, and poses that come and go too fast."""
    times, pairs = stages.schedule.times, _pairs(stages)
    for pose, track in tracks.items():
        if not track.v.any():
            continue
        turns = _turns(track)
        counts = turns.searchsorted(times[2:]) - turns.searchsorted(times[:-2], side="right")
        for i in (counts > TURNS).nonzero()[0]:
            pair, count = pairs[i], int(counts[i])
            if pair is not None:
                yield Finding(pair, "jitter", min(0.2 + 0.05 * count, 0.6), float(times[i + 1]), pose, float(count))
        for start, end, when, top in _supports(track):
            blamed = _blamed(stages, pairs, pose, when)
            if end - start < HOLD and top >= SMALL and blamed is not None:
                yield Finding(blamed, "short", 0.15, when, pose, end - start)


def _turns(track: Track) -> Array:
    """Times at which a pose changes direction, moves up to MOVE left out."""
    turns: list[float] = []
    extreme, when, way = 0.0, float(track.t[0]), 1
    for t, v in zip(track.t.tolist(), track.v.tolist(), strict=True):
        if way * (v - extreme) >= 0:
            extreme, when = v, t
        elif way * (extreme - v) > MOVE:
            turns.append(when)
            extreme, when, way = v, t, -way
    return np.array(turns)


def _supports(track: Track) -> Iterator[tuple[float, float, float, float]]:
    """(start, end, time of the top, top) of every time in which a pose is above 0."""
    above = np.concatenate(([False], track.v > 0, [False]))
    edges = np.flatnonzero(above[1:] != above[:-1])
    for a, b in zip(edges[::2], edges[1::2], strict=True):
        top = a + int(track.v[a:b].argmax())
        start, end = max(a - 1, 0), min(b, track.t.size - 1)
        yield float(track.t[start]), float(track.t[end]), float(track.t[top]), float(track.v[top])


def _holes(stages: Stages, tracks: Mapping[str, Track]) -> Iterator[Finding]:
    """Times within a phrase at which every pose rests; the bigram whose middle is nearest is to blame."""
    schedule, pairs = stages.schedule, _pairs(stages)
    for start, end in _phrases(stages):
        if end - start < HOLE:
            continue
        t = np.linspace(start, end, int((end - start) / _STEP) + 2)
        rest = np.ones(t.size, bool)
        for track in tracks.values():
            rest &= np.interp(t, track.t, track.v) < REST
        edges = np.flatnonzero(np.diff(np.concatenate(([False], rest, [False])).astype(int)))
        for a, b in zip(edges[::2], edges[1::2] - 1, strict=True):
            length, middle = float(t[b] - t[a]), float(t[a] + t[b]) / 2
            near = [k for k, pair in enumerate(pairs) if pair is not None]
            if length > HOLE and near:
                k = min(near, key=lambda k: abs(schedule.times[k + 1] - middle))
                pair = pairs[k]
                if pair is not None:
                    yield Finding(pair, "hole", min(0.3 + 2 * length, 0.8), middle, amount=length)


def _phrases(stages: Stages) -> Iterator[tuple[float, float]]:
    """(start, end) of every run of phones between silences."""
    times = stages.schedule.times
    sound = [False, *(phone != SILENCE for phone in stages.schedule.phones), False]
    edges = [i for i, (a, b) in enumerate(pairwise(sound)) if a != b]
    for a, b in zip(edges[::2], edges[1::2], strict=True):
        yield float(times[a]), float(times[b])


def _blamed(stages: Stages, pairs: list[Pair | None], pose: str, when: float) -> Pair | None:
    index = stages.winner(pose, when)
    return None if index is None else pairs[index]


def _highest(track: Track, start: float, end: float) -> tuple[float, float]:
    """The highest weight between two times, and when."""
    a, b = track.t.searchsorted([start, end])
    t = np.concatenate(([start], track.t[a:b], [end]))
    v = track.at(t)
    top = int(v.argmax())
    return float(v[top]), float(t[top])
