"""A curve set: the curves of every bigram, the thing an animator edits (sections 3.1.1 and 3.1.2)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from .curves import Curve
from .phonemes import COMMON, SILENCE, TABLE_1, Pair
from .poses import FACEFX
from .settings import Settings

if TYPE_CHECKING:
    from .packed import PackedSet

#: How far the work on a bigram has come.
STATUSES = ("empty", "suggestion", "draft", "review", "approved")


@dataclass(frozen=True, eq=False)
class Bigram:
    """The curves of one phone pair, pose → curve, and what is known of them. Read-only.

    extra  fields of the file that this version does not know; they survive saving
    """

    curves: Mapping[str, Curve] = field(default_factory=dict)
    status: str = "draft"
    source: str = "authored"
    note: str = ""
    extra: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "curves", MappingProxyType(dict(self.curves)))

    def with_curve(self, pose: str, curve: Curve | None) -> Bigram:
        """With another curve for `pose`; None removes it."""
        curves = {p: c for p, c in self.curves.items() if p != pose}
        if curve is not None:
            curves[pose] = curve
        return replace(self, curves=curves)

    @property
    def is_empty(self) -> bool:
        """Whether no curve ever leaves 0."""
        return not any(curve.v.any() for curve in self.curves.values())


@dataclass(frozen=True, eq=False)
class CurveSet:
    """(first, second) → bigram, over a phoneme set and a pose set. Read-only; edits return new sets.

    phonemes      the set's common phonemes; their square is the number of bigrams; `sil` is not listed,
                  though pairs with `sil` may be present
    phoneme_map   language phone → common phoneme
    settings      what the set was made for; None means the preset "Paper"
    base, extra   kept as read, see core_pipeline/files/curve_set_json.py
    """

    name: str = "Untitled"
    language: str = "en"
    phonemes: tuple[str, ...] = COMMON
    poses: tuple[str, ...] = FACEFX
    bigrams: Mapping[Pair, Bigram] = field(default_factory=dict)
    phoneme_map: Mapping[str, str] = field(default_factory=lambda: TABLE_1)
    settings: Settings | None = None
    base: str | None = None
    extra: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "bigrams", MappingProxyType(dict(self.bigrams)))

    @property
    def effective_settings(self) -> Settings:
        """The set's own settings, or the preset "Paper"."""
        return self.settings if self.settings is not None else Settings.paper()

    def with_bigram(self, pair: Pair, bigram: Bigram | None) -> CurveSet:
        """With another bigram at `pair`; None removes it."""
        bigrams = dict(self.bigrams)
        if bigram is None:
            bigrams.pop(pair, None)
        else:
            bigrams[pair] = bigram
        return replace(self, bigrams=bigrams)

    def with_settings(self, settings: Settings) -> CurveSet:
        """The same curves with other settings."""
        return replace(self, settings=settings)

    def has_pair(self, pair: Pair) -> bool:
        """Whether `pair` is a bigram this set could hold: both phones known, or `sil`."""
        known = {*self.phonemes, SILENCE}
        return pair[0] in known and pair[1] in known

    def missing(self) -> list[Pair]:
        """Pairs of the phoneme set that have no bigram, in canonical order; `sil` never counts."""
        return [(a, b) for a in self.phonemes for b in self.phonemes if (a, b) not in self.bigrams]

    def status_of(self, pair: Pair) -> str:
        """The bigram's status; "empty" where there is none or it has no curve."""
        bigram = self.bigrams.get(pair)
        return "empty" if bigram is None or bigram.is_empty else bigram.status

    @cached_property
    def packed(self) -> PackedSet:
        """All keys in flat arrays, made once per set, for the time-warp."""
        from .packed import PackedSet

        return PackedSet.of(self)
