"""Bigram curves from animation: the extension the paper names in section 5.1.

    occurrences ─→ mean, tapered ─→ smoothed ─→ refined against stitching ─→ leaning on the phones ─→ few keys

A bigram's neighbours show through at its ends, so the mean alone is too high there: it is tapered to 0. With enough
speech the curves are then corrected until the HIGHER of two overlapping ones is what was seen, which is what
stitching does. A pair that was seen once or twice is mostly its neighbours' doing; it leans on what its two phones do
in other pairs (ours). Pairs that were never seen are only offered, as suggest.py suggests them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..curve_set import Bigram, CurveSet
from ..curves import Curve
from ..errors import UserError
from ..methods.method import Progress, no_progress
from ..one_thread import one_thread
from ..phonemes import SILENCE, Pair
from ..simplify import simplified
from ..suggest import Suggestions
from .corpus import Corpus
from .occurrences import NODES, PLACES, Occurrences, occurrences_of
from .parts import Parts

Array = NDArray[np.float64]

#: What a bigram made here has as its source.
LEARNED = "learned"
#: The taper rises this steeply from both ends.
TAPER = np.minimum(1.0, 3.2 * np.minimum(PLACES, 1.0 - PLACES))
#: Bigrams heard (about 15 sentences) above which curves are refined, how often, and how much of the error is taken
#: back each time. With fewer, what is refined is chance.
ENOUGH, ROUNDS, STEP = 400, 8, 0.7
#: Two curves nearer than this share the blame for an error.
TIE = 1e-3
#: The phones' opinion of a pair counts as much as this many occurrences of it.
LEAN = 1.5
#: Keys are left out while the curve stays this near; a curve that stays below FLAT is none.
TOLERANCE, FLAT = 0.06, 0.03


@dataclass(frozen=True)
class LearnOptions:
    """tolerance  weight by which leaving out keys may change a curve
    lean       occurrences that the phones' opinion of a pair counts as; 0: every pair by itself
    refine     correct the curves against stitching; None: when there is enough speech
    """

    tolerance: float = TOLERANCE
    lean: float = LEAN
    refine: bool | None = None


@dataclass(frozen=True, eq=False)
class LearnedBigram:
    """A bigram, how often its pair was spoken, and the RMS of what its curves leave unexplained there."""

    bigram: Bigram
    occurrences: int
    residual: float


@dataclass(frozen=True, eq=False)
class Learned:
    """What a corpus taught.

    found    pairs that were spoken, most often first
    heard    every occurrence
    blind    poses that the corpus could not show
    """

    poses: tuple[str, ...]
    phonemes: tuple[str, ...]
    phoneme_map: Mapping[str, str]
    found: Mapping[Pair, LearnedBigram]
    heard: Occurrences
    blind: tuple[str, ...] = ()

    def curve_set(self, name: str = "Learned", like: CurveSet | None = None) -> CurveSet:
        """A set of the found bigrams alone; poses, settings and language of `like`, whose poses must include ours."""
        return CurveSet(
            name=name,
            language=like.language if like is not None else "en",
            phonemes=self.phonemes,
            poses=like.poses if like is not None else self.poses,
            bigrams={pair: learned.bigram for pair, learned in self.found.items()},
            phoneme_map=self.phoneme_map,
            settings=like.settings if like is not None else None,
        )

    @cached_property
    def offered(self) -> Mapping[Pair, Bigram]:
        """Pairs that were never spoken, those of silence too, each with a suggestion from those that were."""
        phones = (*self.phonemes, SILENCE)
        pairs = [(a, b) for a in phones for b in phones if (a, b) not in self.found and (a, b) != (SILENCE, SILENCE)]
        with one_thread():
            suggestions = Suggestions.of(self.curve_set()).prepared()
            return {pair: suggestions.bigram(pair) for pair in pairs}

    def beside(self, pair: Pair, old: Bigram | None) -> Bigram:
        """A learned bigram in the place of another, of which the note and poses nobody could see are kept."""
        found = self.found[pair].bigram
        if old is None:
            return found
        kept = {pose: curve for pose, curve in old.curves.items() if pose in self.blind}
        return replace(found, curves={**found.curves, **kept}, note=old.note, extra={**old.extra, **found.extra})

    def spoken(self, pair: Pair, pose: str) -> list[tuple[Array, Array]]:
        """(normalised times, weights) of the pose in every occurrence of a pair, where the face was seen."""
        if pair not in self.heard.pairs:
            return []
        rows = np.flatnonzero(self.heard.pair == self.heard.pairs.index(pair))
        p = self.poses.index(pose)
        seen = [self.heard.known[row] > 0 for row in rows]
        return [
            (PLACES[known], self.heard.motion[row, known, p].astype(np.float64))
            for row, known in zip(rows, seen, strict=True)
        ]


def learn_bigrams(corpus: Corpus, options: LearnOptions | None = None, progress: Progress = no_progress) -> Learned:
    """Learn. UserError when no pair of the corpus's phonemes was seen; whatever `progress` raises ends it."""
    with one_thread():
        return _learn(corpus, options or LearnOptions(), progress)


def _learn(corpus: Corpus, options: LearnOptions, progress: Progress) -> Learned:
    heard = occurrences_of(corpus)
    phones = {*corpus.phonemes, SILENCE}
    silent = (SILENCE, SILENCE)
    counted = zip(heard.pairs, heard.counts.tolist(), strict=True)
    if not any(count and set(pair) <= phones and pair != silent for pair, count in counted):
        raise UserError("The corpus shows no pair of phones: check that labels and animation belong together.")
    refine = options.refine if options.refine is not None else heard.pair.size >= ENOUGH
    parts = Parts(heard.pairs, heard.counts)
    curves = np.empty((len(heard.pairs), NODES, len(corpus.poses)))
    errors = np.zeros(heard.pair.size)
    for p, pose in enumerate(corpus.poses):
        progress(p / len(corpus.poses), pose)
        made = _pose_curves(heard, heard.motion[:, :, p].astype(np.float64), parts, options.lean, refine)
        curves[:, :, p] = made
        gap = heard.motion[:, :, p] - np.maximum(made[heard.pair], heard.rivals(made))
        errors += (gap**2 * heard.known).sum(1)
    return _learned(corpus, heard, curves, errors, options.tolerance)


def _pose_curves(heard: Occurrences, motion: Array, parts: Parts, lean: float, refine: bool) -> Array:
    """One pose: (pairs, NODES)."""
    total = heard.summed(heard.known)
    mean = _bridged(heard.summed(heard.known * motion), total)
    curves = parts.steadied(_smoothed(mean * TAPER), lean)
    for _ in range(ROUNDS if refine else 0):
        own, rival = curves[heard.pair], heard.rivals(curves)
        blamed = heard.known * (own >= rival - TIE)
        error = heard.summed(blamed * (motion - np.maximum(own, rival)))
        curves = curves + STEP * error / np.maximum(heard.summed(blamed), 1.0)
        curves = np.clip(curves, 0.0, 1.0)
        curves[:, [0, -1]] = 0.0
        curves = parts.steadied(_smoothed(curves), lean)
    return curves


def _bridged(total: Array, count: Array) -> Array:
    """Means, with straight lines over the nodes at which nobody looked."""
    mean = total / np.maximum(count, 1.0)
    for row in np.flatnonzero((count == 0).any(1) & (count > 0).any(1)):
        seen = count[row] > 0
        mean[row] = np.interp(PLACES, PLACES[seen], mean[row, seen])
    return mean


def _smoothed(curves: Array) -> Array:
    """Three taps, 1 2 1."""
    wide = np.concatenate([curves[:, :1], curves, curves[:, -1:]], axis=1)
    return np.asarray((wide[:, :-2] + 2 * wide[:, 1:-1] + wide[:, 2:]) / 4)


def _learned(corpus: Corpus, heard: Occurrences, curves: Array, errors: Array, tolerance: float) -> Learned:
    phones = {*corpus.phonemes, SILENCE}
    looked = heard.known.sum(1)
    squares, weight = np.bincount(heard.pair, errors), np.bincount(heard.pair, looked) * max(len(corpus.poses), 1)
    found: dict[Pair, LearnedBigram] = {}
    for row in np.argsort(-heard.counts, kind="stable"):
        pair, count = heard.pairs[row], int(heard.counts[row])
        if not count or not set(pair) <= phones or pair == (SILENCE, SILENCE):
            continue
        residual = float(np.sqrt(squares[row] / weight[row]))
        about = {"learned": {"occurrences": count, "residual": round(residual, 4)}}
        made = _curves(curves[row], corpus.poses, tolerance)
        found[pair] = LearnedBigram(Bigram(made, "draft", LEARNED, extra=about), count, residual)
    return Learned(corpus.poses, corpus.phonemes, corpus.phoneme_map, found, heard, corpus.blind)


def _curves(nodes: Array, poses: tuple[str, ...], tolerance: float) -> dict[str, Curve]:
    """Keys for every pose that moves, from (NODES, poses); 0 at both ends."""
    made = {}
    for p, pose in enumerate(poses):
        v: Array = np.round(np.clip(nodes[:, p], 0.0, 1.0), 3).astype(np.float64)
        v[[0, -1]] = 0.0
        if v.max() >= FLAT:
            made[pose] = simplified(PLACES, v, tolerance)
    return made
