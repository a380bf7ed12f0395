"""A curve set: the curves of every bigram, the thing an animator edits (sections 3.1.1, 3.1.2 and 3.2.4)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType
from typing import Any

from .curves import Curve
from .packed import PackedSet
from .phonemes import COMMON, SILENCE, TABLE_1, Pair
from .poses import FACEFX
from .settings import Settings

#: How far the work on a bigram has come.
STATUSES = ("empty", "suggestion", "draft", "review", "approved")


@dataclass(frozen=True, eq=False)
class Bigram:
    """The curves of one phone pair, pose → curve, and what is known of them. Read-only.

    source  where the curves come from: "authored", "phone parts", a file's name
    author  who drew them last, "" when nobody said
    extra   fields of the file that this version does not know; they survive saving
    """

    curves: Mapping[str, Curve] = field(default_factory=dict)
    status: str = "draft"
    source: str = "authored"
    note: str = ""
    author: str = ""
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
    bigrams       all that play: this layer's own and, where it has none, those of the set below
    phoneme_map   language phone → common phoneme
    settings      what this layer was made for; None means those of the set below, or the preset "Paper"
    base, below   a character's set stores only what differs from its base (section 3.2.4): the base's name, as the
                  file says it, and the set of that name; both None for a set that stands alone
    aside         bigrams of phones that are not among `phonemes`: kept in the file, never played
    authors, provenance   who made the set, and from what
    extra         fields of the file that this version does not know; they survive saving
    """

    name: str = "Untitled"
    language: str = "en"
    phonemes: tuple[str, ...] = COMMON
    poses: tuple[str, ...] = FACEFX
    bigrams: Mapping[Pair, Bigram] = field(default_factory=dict)
    phoneme_map: Mapping[str, str] = field(default_factory=lambda: TABLE_1)
    settings: Settings | None = None
    base: str | None = None
    below: CurveSet | None = None
    aside: Mapping[Pair, Bigram] = field(default_factory=dict)
    authors: tuple[str, ...] = ()
    provenance: str = ""
    extra: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "bigrams", MappingProxyType(dict(self.bigrams)))
        object.__setattr__(self, "aside", MappingProxyType(dict(self.aside)))

    @property
    def effective_settings(self) -> Settings:
        """The set's own settings, or those of its base, or the preset "Paper"."""
        if self.settings is not None:
            return self.settings
        return self.below.effective_settings if self.below is not None else Settings.paper()

    def with_bigram(self, pair: Pair, bigram: Bigram | None) -> CurveSet:
        """With another bigram at `pair` in this layer; None removes this layer's, so that the base's is back."""
        return self.with_bigrams({pair: bigram})

    def with_bigrams(self, changes: Mapping[Pair, Bigram | None]) -> CurveSet:
        """With other bigrams in this layer; None removes this layer's, so that the base's is back."""
        bigrams = dict(self.bigrams)
        for pair, bigram in changes.items():
            plays = self.below.bigrams.get(pair) if bigram is None and self.below is not None else bigram
            if plays is None:
                bigrams.pop(pair, None)
            else:
                bigrams[pair] = plays
        changed, packed = replace(self, bigrams=bigrams), self.__dict__.get("packed")
        if packed is not None and len(changes) == 1:
            (pair,) = changes
            quick = packed.with_bigram(pair, bigrams[pair]) if pair in self.bigrams and pair in bigrams else None
            if quick is not None:
                changed.__dict__["packed"] = quick  # what cached_property would make, without packing all anew
        return changed

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

    # ── layers ───────────────────────────────────────────────────────────────────────────────────

    @cached_property
    def own(self) -> Mapping[Pair, Bigram]:
        """What this layer itself holds: everything, unless there is a set below. It is all that is saved."""
        if self.below is None:
            return self.bigrams
        below = self.below.bigrams
        return {pair: bigram for pair, bigram in self.bigrams.items() if below.get(pair) is not bigram}

    def layer_of(self, pair: Pair) -> str:
        """The name of the set, this one or one below, whose bigram plays; "" where there is none."""
        bigram, layer, found = self.bigrams.get(pair), self, ""
        while bigram is not None and layer.bigrams.get(pair) is bigram:
            found = layer.name
            if layer.below is None:
                break
            layer = layer.below
        return found

    def on_base(self, base: str, below: CurveSet) -> CurveSet:
        """This layer's own bigrams over those of `below`, as far as this set has their phones."""
        inherited = {pair: bigram for pair, bigram in below.bigrams.items() if self.has_pair(pair)}
        return replace(self, base=base, below=below, bigrams={**inherited, **self.own})

    def flattened(self) -> CurveSet:
        """All layers in one set that stands alone, as game engines want it."""
        return replace(self, base=None, below=None, settings=self.effective_settings)

    # ── for the pipeline ─────────────────────────────────────────────────────────────────────────

    @cached_property
    def packed(self) -> PackedSet:
        """All keys in flat arrays, made once per set, for the time-warp."""
        return PackedSet.of(self)
