"""How often each phone pair is spoken: table 2 and figure 2 of the paper, for any corpus (section 3.1.1)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from .curve_set import CurveSet
from .phonemes import SILENCE, Pair
from .schedule import Schedule

Floats = NDArray[np.float64]

#: Table 2: the 21 most frequent of about 200 utterances by a Microsoft voice, percent of all pairs.
TABLE_2: Mapping[Pair, float] = MappingProxyType(
    {
        ("ah", "d"): 4.62, ("d", "ih"): 3.44, ("ih", "d"): 2.68, ("d", "d"): 2.64, ("d", "ah"): 2.40,
        ("eh", "d"): 1.83, ("d", "w"): 1.66, ("ah", "r"): 1.58, ("ih", "w"): 1.50, ("d", "z"): 1.43,
        ("ih", "z"): 1.37, ("ih", "kg"): 1.32, ("aa", "d"): 1.27, ("z", "ih"): 1.22, ("r", "ih"): 1.21,
        ("th", "ah"): 1.19, ("z", "d"): 1.16, ("kg", "ah"): 1.15, ("ah", "l"): 1.10, ("z", "ah"): 1.04,
        ("ah", "bmp"): 0.98,
    }
)  # fmt: skip

#: Said of figure 2: of 441 pairs 104 never appeared, and the 283 most frequent were 99.1 % of all.
PAPER_NEVER, PAPER_FIRST, PAPER_COVER = 104, 283, 0.991


@dataclass(frozen=True, eq=False)
class Frequencies:
    """How often a corpus has each pair of phonemes; pairs with silence are left out. Read-only.

    phonemes    the set the corpus was counted with
    counts      pair → times; pairs that never appeared are not listed
    utterances  how many texts were counted
    """

    phonemes: tuple[str, ...]
    counts: Mapping[Pair, int]
    utterances: int = 0

    def __post_init__(self) -> None:
        order = sorted(self.counts.items(), key=lambda item: (-item[1], item[0]))
        object.__setattr__(self, "counts", MappingProxyType({pair: n for pair, n in order if n > 0}))

    @classmethod
    def of(cls, schedules: Iterable[Schedule], phonemes: Sequence[str], phoneme_map: Mapping[str, str]) -> Frequencies:
        """Count the bigrams of every schedule after the map; phones that are not in the set count for nothing."""
        counts: Counter[Pair] = Counter()
        known, utterances = set(phonemes), 0
        for schedule in schedules:
            pairs = schedule.mapped(phonemes, phoneme_map).pairs()
            counts.update(pair for pair in pairs if known.issuperset(pair))
            utterances += 1
        return cls(tuple(phonemes), counts, utterances)

    @cached_property
    def total(self) -> int:
        """All pairs that were said."""
        return sum(self.counts.values())

    @cached_property
    def shares(self) -> Mapping[Pair, float]:
        """Pair → share of running speech, 0…1, most frequent first."""
        return MappingProxyType({pair: n / self.total for pair, n in self.counts.items()})

    @property
    def possible(self) -> int:
        """How many pairs the phoneme set has."""
        return len(self.phonemes) ** 2

    @property
    def never(self) -> int:
        """How many of them never appeared."""
        return self.possible - len(self.counts)

    def top(self, count: int = len(TABLE_2)) -> tuple[Pair, ...]:
        """The most frequent pairs."""
        return tuple(self.counts)[:count]

    @cached_property
    def cumulative(self) -> Floats:
        """(possible,) share of running speech that the 1, 2, 3 … most frequent pairs cover: figure 2."""
        shares = np.zeros(self.possible)
        shares[: len(self.counts)] = list(self.shares.values())
        return np.asarray(np.minimum(shares.cumsum(), 1.0))

    def first(self, cover: float) -> int:
        """How many of the most frequent pairs cover this share of running speech; 0 when nothing was said."""
        return int((self.cumulative < cover - 1e-9).sum()) + 1 if self.total else 0

    def covered(self, pairs: Iterable[Pair]) -> float:
        """The share of running speech that these pairs make up."""
        return sum(self.shares.get(pair, 0.0) for pair in set(pairs))

    def shared_with_paper(self) -> int:
        """How many of the top 21 pairs are among the paper's."""
        return len(TABLE_2.keys() & set(self.top()))


@dataclass(frozen=True)
class Progress:
    """How far the work on a set has come.

    drawn, approved          how many of `possible` bigrams move and are no mere suggestion; how many are approved
    speech, approved_speech  the share of running speech these make up, 0…1
    """

    possible: int
    drawn: int
    approved: int
    speech: float
    approved_speech: float


def progress(curve_set: CurveSet, frequencies: Frequencies) -> Progress:
    """Counts and shares over the set's own phonemes."""
    status = {pair: curve_set.status_of(pair) for pair in curve_set.bigrams if SILENCE not in pair}
    drawn = {pair for pair, s in status.items() if s not in ("empty", "suggestion")}
    approved = {pair for pair, s in status.items() if s == "approved"}
    return Progress(
        len(curve_set.phonemes) ** 2,
        len(drawn),
        len(approved),
        frequencies.covered(drawn),
        frequencies.covered(approved),
    )
