"""Weights: the tracks sampled, ready for blendshapes (section 3.1.2).

A file baked to frames snaps peaks: at 24 to 30 frames a second plain sampling loses more than a tenth
of the peak of two closures in five; putting each peak on its nearest frame loses none.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .spline import interpolate, pchip_slopes
from .tracks import Array, Tracks


@dataclass(frozen=True, eq=False)
class Weights:
    """frames (f, poses) float32 in [0, 1]; frame i is at start + i / fps seconds."""

    poses: tuple[str, ...]
    fps: float
    start: float
    frames: NDArray[np.float32]


def sample(tracks: Tracks, spline: str, times: ArrayLike) -> Array:
    """(m, poses) weights at rising times (m,) in seconds; 0 outside the utterance."""
    t = np.atleast_1d(np.asarray(times, dtype=np.float64))
    if spline == "pchip" and tracks.x.size:
        return _sample_pchip(tracks, t)
    out = np.zeros((t.size, len(tracks.poses)))
    for p, pose in enumerate(tracks.poses):
        track = tracks[pose]
        inside = (t >= track.t[0]) & (t <= track.t[-1])
        out[inside, p] = interpolate(track.t, track.v, spline, t[inside])
    return np.clip(out, 0.0, 1.0)


def _sample_pchip(tracks: Tracks, t: Array) -> Array:
    """All poses at once: the long axis is one curve of many pieces, 0 between them.

    Both knots and samples rise along the long axis, so instead of searching the knots for each of many
    samples we search the samples for each of few knots, and repeat each segment as often as needed.
    """
    x = tracks.x
    first, last = tracks.cuts[:-1], tracks.cuts[1:] - 1
    used = last > first
    slopes = pchip_slopes(x, tracks.v, first[used], last[used]) if used.any() else np.zeros(x.size)
    cubic = _segments(x, tracks.v, slopes, last[used])
    lanes = np.arange(len(tracks.poses))[:, None] * tracks.stride
    at = (np.clip(t - tracks.start, -0.4, tracks.duration + 0.4) + lanes).ravel()
    reached = at.searchsorted(x, side="left")
    segment = np.repeat(np.arange(x.size + 1), np.diff(reached, prepend=0, append=at.size))
    at -= np.concatenate(([0.0], x)).take(segment)
    values = cubic[3].take(segment)
    for coefficient in cubic[2::-1]:
        values *= at
        values += coefficient.take(segment)
    np.clip(values, 0.0, 1.0, out=values)
    weights: Array = values.reshape(len(tracks.poses), t.size).T
    return weights


def _segments(x: Array, v: Array, slopes: Array, last: NDArray[np.intp]) -> Array:
    """(4, knots+1) polynomial of each segment, from its left knot on; 0 before the first knot and between poses."""
    h = x[1:] - x[:-1]
    secant = (v[1:] - v[:-1]) / h
    d0, d1 = slopes[:-1], slopes[1:]
    cubic = np.zeros((4, x.size + 1))
    inner = cubic[:, 1:-1]
    inner[0], inner[1] = v[:-1], d0
    inner[2] = (3 * secant - 2 * d0 - d1) / h
    inner[3] = (d0 + d1 - 2 * secant) / (h * h)
    cubic[:, last + 1] = 0.0
    return cubic


def bake(tracks: Tracks, spline: str, fps: float, *, snap: bool = True) -> Weights:
    """Weights at even frames from the start to (at least) the end of the utterance.

    fps   frames per second, 1…1000 (ValueError otherwise)
    snap  put each peak of each pose on its nearest frame, so that no closure is lost between two
    """
    if not 1 <= fps <= 1000:
        raise ValueError(f"{fps:g} frames per second: choose 1 to 1000")
    count = int(np.ceil(tracks.duration * fps - 1e-6)) + 1
    frames = sample(tracks, spline, tracks.start + np.arange(count) / fps)
    if snap:
        for p, pose in enumerate(tracks.poses):
            track = tracks[pose]
            top = peaks(track.v)
            values = np.clip(interpolate(track.t, track.v, spline, track.t[top]), 0.0, 1.0)
            nearest = np.rint((track.t[top] - tracks.start) * fps).astype(np.intp)
            np.maximum.at(frames[:, p], np.minimum(nearest, count - 1), values)
    return Weights(tracks.poses, float(fps), tracks.start, frames.astype(np.float32))


def peaks(v: Array) -> NDArray[np.intp]:
    """Indices of knots above 0 with no higher neighbour; of a plateau, every knot."""
    if v.size < 3:
        return np.zeros(0, np.intp)
    inner = v[1:-1]
    return ((inner > 0) & (inner >= v[:-2]) & (inner >= v[2:])).nonzero()[0] + 1
