"""How well a curve set speaks, by number: closures, holes, jitter, and what the speed limit takes away."""

import json
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from core_pipeline.curve_set import CurveSet
from core_pipeline.phonemes import SILENCE
from core_pipeline.pipeline import Stages, run
from core_pipeline.schedule import Schedule
from core_pipeline.settings import Settings
from core_pipeline.tracks import Track
from core_pipeline.weights import bake, peaks, sample

SENTENCES = Path(__file__).parents[1] / "data" / "sentences.json"

#: Phone → the pose that closes the lips for it.
CLOSURES = {"bmp": "PBM", "f": "FV"}
#: From these weights on a face's lips are sealed, or the lower lip is tucked in.
SEALED = 0.65
#: Phone → poses that would pull its closed lips apart, and how much of each they stand.
PULLING = {"bmp": {"open": 0.0, "wide": 0.3, "ShCh": 0.3, "W": 0.3}, "f": {"open": 0.0}}


def sentences() -> list[tuple[str, Schedule]]:
    """Our fifty sentences, as espeak-ng speaks them."""
    rows = json.loads(SENTENCES.read_text("utf-8"))
    return [(row["text"], Schedule(row["phones"], row["times"])) for row in rows]


def spoken(curve_set: CurveSet, schedules: Sequence[Schedule], settings: Settings) -> list[Stages]:
    """Every schedule through the pipeline."""
    return [run(schedule, curve_set, settings) for schedule in schedules]


def full(curve_set: CurveSet, pose: str) -> float:
    """The set's own median peak of a pose, over the bigrams that use it."""
    return float(np.median([b.curves[pose].v.max() for b in curve_set.bigrams.values() if pose in b.curves]))


def instances(stages: Stages, phone: str) -> list[tuple[float, float]]:
    """When a phone sounds; neighbours that are the same phone count as one (start, end), widened by half a phone."""
    times = stages.schedule.times
    found: list[tuple[float, float]] = []
    for i, name in enumerate(stages.schedule.phones):
        if name != phone:
            continue
        reach = 0.5 * (times[i + 1] - times[i])
        start, end = times[i] - reach, times[i + 1] + reach
        if found and i and stages.schedule.phones[i - 1] == phone:
            found[-1] = (found[-1][0], end)
        else:
            found.append((start, end))
    return found


def reached(results: Sequence[Stages], curve_set: CurveSet, phone: str) -> float:
    """Share of a closing phone's instances at which its pose gets to 90 % of full."""
    pose = CLOSURES[phone]
    enough = 0.9 * full(curve_set, pose)
    hits = [
        highest(stages.magenta[pose], start, end) >= enough
        for stages in results
        for start, end in instances(stages, phone)
    ]
    return float(np.mean(hits))


def sealed(results: Sequence[Stages], phone: str, fps: float = 30.0) -> float:
    """Share of a closing phone's instances with a frame in which lips are sealed (bmp) or tucked (f)."""
    hits = []
    for stages in results:
        weights = bake(stages.magenta, "pchip", fps, snap=False)
        frames = dict(zip(weights.poses, weights.frames.T, strict=True))
        shut = frames[CLOSURES[phone]] >= SEALED
        for pose, most in PULLING[phone].items():
            shut &= frames[pose] <= most + 1e-3
        times = weights.start + np.arange(shut.size) / fps
        hits += [bool(shut[(times >= a) & (times <= b)].any()) for a, b in instances(stages, phone)]
    return float(np.mean(hits))


def longest_hole(results: Sequence[Stages], least: float = 0.05) -> float:
    """Longest time in seconds, within a phrase, in which every pose is below `least`."""
    longest = 0.0
    for stages in results:
        for start, end in phrases(stages.schedule):
            times = np.arange(start, end, 0.001)
            empty = (sample(stages.magenta, "pchip", times) < least).all(axis=1)
            edges = np.flatnonzero(np.diff(np.concatenate(([False], empty, [False])).astype(int)))
            longest = max([longest, *((edges[1::2] - edges[::2]) * 0.001)])
    return float(longest)


def phrases(schedule: Schedule) -> list[tuple[float, float]]:
    """(start, end) of every run of phones between silences."""
    found: list[tuple[float, float]] = []
    for phone, start, end in zip(schedule.phones, schedule.times[:-1], schedule.times[1:], strict=True):
        if phone == SILENCE:
            continue
        if found and found[-1][1] == start:
            found[-1] = (found[-1][0], float(end))
        else:
            found.append((float(start), float(end)))
    return found


def turns(results: Sequence[Stages], pose: str) -> float:
    """Changes of direction per phone; a plateau counts once."""
    count = 0
    for stages in results:
        steps = np.diff(stages.magenta[pose].v)
        signs = np.sign(steps[np.abs(steps) > 1e-6])
        count += int((signs[1:] != signs[:-1]).sum())
    return count / sum(sum(p != SILENCE for p in stages.schedule.phones) for stages in results)


def slowed(results: Sequence[Stages], pose: str, loss: float = 0.2) -> float:
    """Share of a pose's peaks that lose more than `loss` of their height to the speed limit."""
    lost = [
        float(after) < (1 - loss) * before
        for stages in results
        for time, before in _tops(stages.cyan[pose])
        for after in stages.magenta[pose].at(np.array([time]))
    ]
    return float(np.mean(lost)) if lost else 0.0


def highest(track: Track, start: float, end: float) -> float:
    """The largest weight between two times."""
    inside = track.v[(track.t >= start) & (track.t <= end)]
    return float(max([*inside, *track.at(np.array([start, end]))]))


def _tops(track: Track) -> list[tuple[float, float]]:
    """(time, weight) of every peak; the middle of a plateau."""
    top = peaks(track.v)
    groups: list[NDArray[np.intp]] = np.split(top, np.flatnonzero(np.diff(top) > 1) + 1) if top.size else []
    return [(float(track.t[g].mean()), float(track.v[g].max())) for g in groups]
