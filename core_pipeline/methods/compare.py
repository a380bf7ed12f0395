"""How far two methods' weights of the same sentence lie apart, pose by pose."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..learning.corpus import Clip
from ..weights import Weights
from .method import Method


@dataclass(frozen=True)
class Difference:
    """Of one pose: root mean square of the difference, and the second's highest peak less the first's."""

    pose: str
    rmse: float
    peak: float


def differences(first: Weights, second: Weights) -> list[Difference]:
    """One entry a pose of `first`. ValueError unless both have the same poses and as many frames."""
    if first.poses != second.poses or first.frames.shape != second.frames.shape:
        raise ValueError("weights of different poses or lengths cannot be compared")
    a, b = first.frames.astype(np.float64), second.frames.astype(np.float64)
    rmse = np.sqrt(((b - a) ** 2).mean(0))
    peaks = b.max(0) - a.max(0)
    return [Difference(*row) for row in zip(first.poses, rmse.tolist(), peaks.tolist(), strict=True)]


def held_out_error(method: Method, clips: Sequence[Clip]) -> float:
    """RMSE of a method over all known frames and poses of clips it has not seen; 0 without a frame."""
    total, count = 0.0, 0
    for clip in clips:
        made = method.synthesize(clip.schedule, clip.weights.poses, clip.weights.fps)
        at = clip.frame_times
        use = clip.usable()
        for p in range(len(clip.weights.poses)):
            times = made.start + np.arange(len(made.frames)) / made.fps
            gap = np.interp(at[use], times, made.frames[:, p]) - clip.weights.frames[use, p]
            total += float((gap**2).sum())
            count += gap.size
    return (total / count) ** 0.5 if count else 0.0
