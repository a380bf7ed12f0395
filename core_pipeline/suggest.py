"""Suggestions: a first guess for a bigram nobody has drawn, from those that are drawn.

    drawn bigrams ─→ K over (first, second) ─→ curves of any pair ─→ few keys

Two-way Gaussian-process regression: a bigram is like the others of its row and column, the more so the
more alike their phones are, and phones are alike when their drawn rows are, or their articulation is.

    x_ab = mean + K* (K + s I)⁻¹ (Y − mean)        K((a,b), (a',b')) = Ka + Kb + 0.2·Ka·Kb
    Ka   = 0.3·(½·PSD(exp(−(d_a/median)²)) + ½·likeness(features)) + 0.7·I

d_a are RMS distances of rows over shared columns, drawn towards the median as if 2 more columns had it;
Kb likewise for columns. Before FEW bigrams are drawn, the mean is a prior set made from phone parts
instead, and what is drawn corrects it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from .curve_set import Bigram, CurveSet
from .phone_features import likeness
from .phonemes import SILENCE, Pair
from .simplify import simplified

Floats = NDArray[np.float64]
Ints = NDArray[np.intp]

#: Curves are compared at so many moments of normalised time.
SAMPLES = 21
#: With fewer drawn bigrams than this, the prior set is the mean.
FEW = 40
#: Pairs with silence are suggested too where so many are drawn on that side of it.
EDGES = 4
#: What the method adds to the diagonal: how far drawings scatter.
NOISE = 0.02
#: A suggested value below this is rest, a suggested curve that stays below PEAK is none.
REST = 0.03
PEAK = 0.08
#: How near few keys come to the suggested curve.
TOLERANCE = 0.05

_TIMES = np.linspace(0.0, 1.0, SAMPLES)
_PSEUDO_COUNTS = 2
_OWN, _ALIKE, _BOTH = 0.7, 0.3, 0.2
_LENGTH = 1.2


@dataclass(frozen=True, eq=False)
class Suggestions:
    """What the drawn bigrams of a set say about all pairs. Make one with `Suggestions.of`; read-only.

    phones  rows and columns: the set's phonemes, then `sil`
    pairs   (n, 2) numbers of the drawn pairs
    curves  (n, poses·SAMPLES) their curves, less the mean of each
    mean    (phones, phones, poses·SAMPLES), or (1, 1, …) where it is the same for all pairs
    prior   whether the mean comes from phone parts
    """

    poses: tuple[str, ...]
    phones: tuple[str, ...]
    pairs: Ints
    curves: Floats
    mean: Floats
    prior: bool

    @classmethod
    def of(cls, curve_set: CurveSet, prior: CurveSet | None = None) -> Suggestions:
        """Learn from every drawn bigram of a set; suggestions not yet reviewed teach nothing.

        prior  a full set with poses of the same names, see FEW; None: the mean of what is drawn, or rest
        """
        phones = (*curve_set.phonemes, SILENCE)
        number = {phone: i for i, phone in enumerate(phones)}
        drawn = {pair: b for pair, b in curve_set.bigrams.items() if is_drawn(b) and set(pair) <= number.keys()}
        pairs = np.array([(number[a], number[b]) for a, b in drawn], np.intp).reshape(-1, 2)
        width = len(curve_set.poses) * SAMPLES
        curves = np.array([sampled(b, curve_set.poses) for b in drawn.values()]).reshape(len(drawn), width)
        by_parts = prior is not None and len(drawn) < FEW
        if by_parts and prior is not None:
            mean = _prior_mean(phones, curve_set, prior)
            curves -= mean[pairs[:, 0], pairs[:, 1]]
        else:
            mean = (curves.mean(axis=0) if drawn else np.zeros(width)).reshape(1, 1, width)
            curves -= mean[0, 0]
        return cls(curve_set.poses, phones, pairs, curves, mean, by_parts)

    def bigram(self, pair: Pair) -> Bigram:
        """The suggestion for a pair of known phones, marked as one; the pair itself, if drawn, has its say."""
        a, b = (self.phones.index(phone) for phone in pair)
        values = self.mean[min(a, self.mean.shape[0] - 1), min(b, self.mean.shape[1] - 1)]
        if len(self.pairs):
            values = values + self._shares(a, b) @ self.curves
        curves = {}
        for pose, row in zip(self.poses, values.reshape(-1, SAMPLES), strict=True):
            if row.max() >= PEAK:
                curves[pose] = simplified(_TIMES, np.where(row < REST, 0.0, np.minimum(row, 1.0)), TOLERANCE)
        return Bigram(curves, "suggestion", self.source(pair))

    def source(self, pair: Pair) -> str:
        """Where the suggestion comes from, in words; never a claim of how good it is."""
        a, b = (self.phones.index(phone) for phone in pair)
        others = self.pairs[(self.pairs != (a, b)).any(axis=1)]
        text = f"suggested from {(others[:, 0] == a).sum()} in its row, {(others[:, 1] == b).sum()} in its column"
        return f"{text}, and phone parts" if self.prior else text

    @cached_property
    def astray(self) -> Mapping[Pair, float]:
        """Drawn pair → RMS distance to what all the others suggest for it (weight, over all poses)."""
        if len(self.pairs) < 3:
            return {}
        inverse = self._inverse
        away = (inverse @ self.curves) / np.diag(inverse)[:, None]  # leaving each out in turn, in closed form
        rms = np.sqrt((away**2).mean(axis=1)) if away.shape[1] else np.zeros(len(away))
        return {(self.phones[a], self.phones[b]): float(r) for (a, b), r in zip(self.pairs, rms, strict=True)}

    @cached_property
    def _phone_kernels(self) -> tuple[Floats, Floats]:
        """Ka (phones, phones) of first phones, Kb of second phones."""
        count = len(self.phones)
        table = np.zeros((count, count, self.curves.shape[1]))
        table[self.pairs[:, 0], self.pairs[:, 1]] = self.curves
        there = np.zeros((count, count), bool)
        there[self.pairs[:, 0], self.pairs[:, 1]] = True
        alike = likeness(self.phones, _LENGTH)
        eye = np.eye(count)

        def kernel(rows: Floats, there: NDArray[np.bool_]) -> Floats:
            drawn = np.exp(-_distances(rows, there))
            return _ALIKE * (0.5 * _positive(drawn) + 0.5 * alike) + _OWN * eye

        return kernel(table, there), kernel(table.swapaxes(0, 1), there.T)

    def _kernel(self, asked: Ints) -> Floats:
        """(asked, n) K between pairs asked for and the drawn ones."""
        first, second = self._phone_kernels
        ka = first[asked[:, 0]][:, self.pairs[:, 0]]
        kb = second[asked[:, 1]][:, self.pairs[:, 1]]
        return ka + kb + _BOTH * ka * kb

    @cached_property
    def _covariance(self) -> Floats:
        return self._kernel(self.pairs) + NOISE * np.eye(len(self.pairs))

    @cached_property
    def _inverse(self) -> Floats:
        return np.asarray(np.linalg.inv(self._covariance))

    def _shares(self, a: int, b: int) -> Floats:
        """(n,) what each drawn bigram gives to a pair; for a single pair one solution is less work than the inverse."""
        asked = self._kernel(np.array([[a, b]]))[0]
        if "_inverse" in self.__dict__:
            return np.asarray(asked @ self._inverse)
        return np.asarray(np.linalg.solve(self._covariance, asked))

    def prepared(self) -> Suggestions:
        """Itself, after the work that makes many pairs cheap."""
        if len(self.pairs):
            self._inverse  # noqa: B018
        return self


def is_drawn(bigram: Bigram) -> bool:
    """Whether somebody drew or accepted it: it moves, and is no mere suggestion."""
    return not bigram.is_empty and bigram.status != "suggestion"


def fill(curve_set: CurveSet, prior: CurveSet | None = None) -> dict[Pair, Bigram]:
    """A suggestion for every pair of the set's phonemes that is missing or empty. Notes and what is drawn stay.

    Also for pairs with silence before (or after), where the set draws EDGES of them.
    """
    suggestions = Suggestions.of(curve_set, prior).prepared()
    filled = {}
    for pair in _wanted(curve_set):
        old = curve_set.bigrams.get(pair)
        if old is None or old.is_empty:
            new = suggestions.bigram(pair)
            filled[pair] = new if old is None else replace(new, note=old.note, extra=old.extra)
    return filled


def _wanted(curve_set: CurveSet) -> list[Pair]:
    phonemes = curve_set.phonemes
    pairs = [(a, b) for a in phonemes for b in phonemes]
    for side in ([(SILENCE, phone) for phone in phonemes], [(phone, SILENCE) for phone in phonemes]):
        if sum(is_drawn(curve_set.bigrams.get(pair, Bigram())) for pair in side) >= EDGES:
            pairs += side
    return pairs


@lru_cache(maxsize=4096)
def sampled(bigram: Bigram, poses: tuple[str, ...]) -> Floats:
    """(poses·SAMPLES,) the control polygon's heights; cached because an edit changes one bigram of 441."""
    rows = np.zeros((len(poses), SAMPLES))
    for row, pose in zip(rows, poses, strict=True):
        if pose in bigram.curves:
            row[:] = bigram.curves[pose].at(_TIMES)
    flat = rows.ravel()
    flat.flags.writeable = False
    return flat


def _prior_mean(phones: tuple[str, ...], curve_set: CurveSet, prior: CurveSet) -> Floats:
    """The prior's curves for every pair; a phone it does not know is looked up as a language phone."""
    names = [p if p in prior.phonemes or p == SILENCE else prior.phoneme_map.get(p, p) for p in phones]
    mean = np.zeros((len(phones), len(phones), len(curve_set.poses) * SAMPLES))
    nothing = Bigram()
    for i, a in enumerate(names):
        for j, b in enumerate(names):
            mean[i, j] = sampled(prior.bigrams.get((a, b), nothing), curve_set.poses)
    return mean


def _distances(rows: Floats, there: NDArray[np.bool_]) -> Floats:
    """(n, n) squared RMS distances of rows over their shared columns, in units of the median distance."""
    shared = there.astype(np.float64) @ there.T
    flat = rows.reshape(len(rows), -1)
    # Absent cells are 0 in `rows`, so each sum of squares is cut to the columns the other row has too.
    power = np.einsum("ijk,ijk->ij", rows, rows)
    mine = power @ there.T
    square = np.maximum(mine + mine.T - 2 * flat @ flat.T, 0.0) / max(rows.shape[2], 1)
    mean = square / np.maximum(shared, 1)
    others = (shared > 0) & ~np.eye(len(rows), dtype=bool)
    usual = float(np.median(mean[others])) if others.any() else 0.0
    if usual <= 0:
        return np.where(np.eye(len(rows), dtype=bool), 0.0, 1.0)
    shrunk = (square + _PSEUDO_COUNTS * usual) / (shared + _PSEUDO_COUNTS)
    np.fill_diagonal(shrunk, 0.0)
    return np.asarray(shrunk / usual)


def _positive(kernel: Floats) -> Floats:
    """The nearest matrix without negative eigenvalues."""
    values, vectors = np.linalg.eigh((kernel + kernel.T) / 2)
    return np.asarray((vectors * np.maximum(values, 0.0)) @ vectors.T)
