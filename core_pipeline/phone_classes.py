"""Which phones look alike on a face, in what orders to show them, and which bigrams are similar."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from itertools import islice
from types import MappingProxyType

from .curve_set import CurveSet
from .phonemes import TABLE_1, VOWELS, Pair

#: Phones by what lips and tongue do, from open to closed.
CLASSES: tuple[tuple[str, ...], ...] = (
    ("aa", "ah"),
    ("eh", "ih"),
    ("ao", "ow", "w"),
    ("aw", "ay", "oy"),
    ("er", "r"),
    ("h", "kg"),
    ("d", "l", "th"),
    ("z", "sh"),
    ("f",),
    ("bmp",),
)

_CLASS: Mapping[str, int] = MappingProxyType({phone: i for i, group in enumerate(CLASSES) for phone in group})


def class_of(phone: str) -> int | None:
    """Number of the phone's class, a phone of English among them; None for one that is in no class."""
    return _CLASS.get(TABLE_1.get(phone, phone))


def by_class(phones: Sequence[str]) -> tuple[str, ...]:
    """The same phones, those that look alike beside one another; phones of no class last."""
    order = [phone for group in CLASSES for phone in group]
    return _sorted(phones, order)


def by_frequency(phones: Sequence[str], shares: Mapping[Pair, float]) -> tuple[str, ...]:
    """The same phones, the commonest first, counted by how often their pairs are spoken; those never heard last."""
    heard: dict[str, float] = {}
    for pair, share in shares.items():
        for phone in pair:
            heard[phone] = heard.get(phone, 0.0) + share
    return _sorted(phones, sorted(heard, key=lambda phone: -heard[phone]))


def _sorted(phones: Sequence[str], order: Sequence[str]) -> tuple[str, ...]:
    place = {phone: i for i, phone in enumerate(order)}
    return tuple(sorted(phones, key=lambda phone: place.get(TABLE_1.get(phone, phone), len(order))))


@lru_cache(4096)
def distance(one: str, other: str) -> int:
    """0 for the same phone, 1 for one that looks alike, 2 within vowels or within consonants, else 4."""
    if one == other:
        return 0
    if class_of(one) is not None and class_of(one) == class_of(other):
        return 1
    return 2 if (TABLE_1.get(one, one) in VOWELS) == (TABLE_1.get(other, other) in VOWELS) else 4


def similar_bigrams(curve_set: CurveSet, pair: Pair, most: int = 8) -> list[Pair]:
    """Bigrams of the set that have curves and whose phones are nearest to those of `pair`, the nearest first."""
    near = sorted(curve_set.bigrams, key=lambda p: distance(p[0], pair[0]) + distance(p[1], pair[1]))
    drawn = (p for p in near if p != pair and not curve_set.bigrams[p].is_empty)
    return list(islice(drawn, most))
