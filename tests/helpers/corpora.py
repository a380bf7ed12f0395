"""Small corpora: our own baked sentences, and weights by a generator that knows nothing of bigrams."""

from __future__ import annotations

import json
from collections.abc import Iterable
from functools import cache
from pathlib import Path

import numpy as np

from core_pipeline.curve_set import CurveSet
from core_pipeline.files import curve_set_json
from core_pipeline.learning.corpus import Clip, Corpus
from core_pipeline.methods.bigram import BigramMethod
from core_pipeline.methods.method import frame_times
from core_pipeline.schedule import Schedule
from core_pipeline.weights import Weights

ROOT = Path(__file__).resolve().parents[2]


@cache
def english() -> CurveSet:
    return curve_set_json.load(ROOT / "assets" / "curves" / "english.json")


@cache
def schedules() -> tuple[Schedule, ...]:
    """The fifty test sentences as espeak-ng spoke them."""
    sentences = json.loads((ROOT / "tests" / "data" / "sentences.json").read_text("utf-8"))
    return tuple(Schedule(s["phones"], s["times"]) for s in sentences)


@cache
def baked() -> tuple[Clip, ...]:
    """Every test sentence by our own pipeline."""
    return by_bigrams(schedules())


@cache
def damped() -> tuple[Clip, ...]:
    """Every test sentence by springs."""
    return by_springs(schedules())


def by_bigrams(said: Iterable[Schedule], fps: float = 60.0) -> tuple[Clip, ...]:
    """By our own pipeline with our English set."""
    method = BigramMethod(english())
    return tuple(Clip.of(f"sentence {i}", s, method.synthesize(s, english().poses, fps)) for i, s in enumerate(said))


def by_springs(said: Iterable[Schedule], fps: float = 60.0) -> tuple[Clip, ...]:
    """By critically damped springs: each pose is pulled towards its phone's target, 90 ms ahead of the sound."""
    rng = np.random.default_rng(7)
    poses = english().poses
    phones = sorted(
        {phone for s in schedules() for phone in s.mapped(english().phonemes, english().phoneme_map).phones}
    )
    targets = {phone: np.where(rng.random(len(poses)) < 0.4, rng.uniform(0.3, 1, len(poses)), 0.0) for phone in phones}
    targets["sil"] = np.zeros(len(poses))
    speed = dict(zip(phones, rng.uniform(18, 45, len(phones)), strict=True))
    clips = []
    for i, schedule in enumerate(said):
        common = schedule.mapped(english().phonemes, english().phoneme_map)
        frames = _springs(common, targets, speed, fps, len(poses))
        clips.append(Clip.of(f"damped {i}", schedule, Weights(poses, fps, schedule.start, frames)))
    return tuple(clips)


def _springs(schedule: Schedule, targets: dict, speed: dict, fps: float, poses: int) -> np.ndarray:
    fine = 16
    step = 1 / (fps * fine)
    x, v = np.zeros(poses), np.zeros(poses)
    frames = np.zeros((frame_times(schedule, fps).size, poses), np.float32)
    for i in range(len(frames) * fine):
        if i % fine == 0:
            frames[i // fine] = np.clip(x, 0, 1)
        t = schedule.start + i * step + 0.09
        phone = schedule.phones[min(int(schedule.times.searchsorted(t, side="right")) - 1, len(schedule) - 1)]
        w = speed[phone]
        v = v + step * (w * w * (targets[phone] - x) - 2 * w * v)
        x = x + step * v
    return frames


def corpus(clips: tuple[Clip, ...]) -> Corpus:
    return Corpus.of(clips, english().phonemes, english().phoneme_map)


def only(clip: Clip, poses: tuple[str, ...]) -> Clip:
    """A clip of some of its poses."""
    columns = [clip.weights.poses.index(pose) for pose in poses]
    weights = Weights(poses, clip.weights.fps, clip.weights.start, clip.weights.frames[:, columns])
    return Clip(clip.name, clip.schedule, weights, clip.known)
