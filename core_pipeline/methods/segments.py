"""Motion segments: what the poses do during one phone, as five frames (Wei and Deng, "Motion Segmentation").

Neighbouring segments share the frame at which they meet. Pose weights are few already, so the principal components
of the paper are left out: they would only turn the axes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..learning.corpus import Clip, Corpus

Array = NDArray[np.float64]
Ints = NDArray[np.intp]

#: Frames that stand for a segment, evenly over the phone, both ends included.
SAMPLES = 5
#: A segment counts when at least this share of its frames was seen.
SEEN = 0.5
NOTHING_SEEN = "No phone of the corpus lies within its animation: check that labels and animation belong together."


@dataclass(frozen=True, eq=False)
class Segments:
    """Every phone of a corpus that was seen well enough.

    motion   (n, SAMPLES, poses)
    phone    (n,) number in `Corpus.phones`
    before, after  (n,) numbers of its neighbours in the clip, −1 at its ends
    follows  (n,) whether segment i−1 is the phone before it, in the same clip
    clip, index  (n,) where it comes from
    """

    motion: Array
    phone: Ints
    before: Ints
    after: Ints
    follows: NDArray[np.bool_]
    clip: Ints
    index: Ints


def segments_of(corpus: Corpus) -> Segments:
    """The segments in the order of the clips."""
    number = {phone: i for i, phone in enumerate(corpus.phones)}
    motion: list[Array] = []
    rows: list[tuple[int, int, int, bool, int, int]] = []
    for c, clip in enumerate(corpus):
        phones = [number[phone] for phone in clip.schedule.phones]
        around = [-1, *phones, -1]
        seen, sampled = _sampled(clip)
        last = -2
        for i in seen.nonzero()[0].tolist():
            motion.append(sampled[i])
            rows.append((phones[i], around[i], around[i + 2], last == i - 1, c, i))
            last = i
    table = np.array(rows, np.intp).reshape(-1, 6)
    stacked = np.array(motion).reshape(-1, SAMPLES, len(corpus.poses))
    phone, before, after, follows, of_clip, index = table.T
    return Segments(stacked, phone, before, after, follows.astype(bool), of_clip, index)


def _sampled(clip: Clip) -> tuple[NDArray[np.bool_], Array]:
    """(n,) which phones were seen, and (n, SAMPLES, poses) their frames; between known frames, straight lines."""
    n = len(clip.schedule)
    empty = np.zeros((n, SAMPLES, len(clip.weights.poses)))
    known = clip.known.nonzero()[0]
    if not known.size or not n:
        return np.zeros(n, bool), empty
    times = clip.frame_times
    starts, ends = clip.schedule.times[:-1], clip.schedule.times[1:]
    at = starts[:, None] + (ends - starts)[:, None] * np.linspace(0, 1, SAMPLES)
    frames = clip.weights.frames[known].astype(np.float64)
    for p in range(frames.shape[1]):
        empty[:, :, p] = np.interp(at, times[known], frames[:, p])
    first, last = times.searchsorted(starts), times.searchsorted(ends)
    total = np.concatenate(([0], np.cumsum(clip.known)))
    share = (total[last] - total[first]) / np.maximum(last - first, 1)
    step = 1.0 / clip.weights.fps
    covered = (starts >= times[0] - step) & (ends <= times[-1] + step)
    return covered & ((share >= SEEN) | (last == first)), empty
