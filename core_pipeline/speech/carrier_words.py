"""For each bigram a short word to hear it in: the carrier of a phone pair (section 3.1.2: "typing words")."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from itertools import pairwise

from ..phonemes import Pair

#: So many words are kept for each pair: a voice may speak the first otherwise than the dictionary says.
CANDIDATES = 3
#: A word that nobody knows is chosen only where a known one is longer by more letters than this.
_UNKNOWN = 4


def carrier_words(
    entries: Iterable[tuple[str, Sequence[str]]],
    phonemes: Sequence[str],
    phoneme_map: Mapping[str, str],
    known: Collection[str] = (),
) -> dict[Pair, tuple[str, ...]]:
    """Pair → the shortest words that have it, the best first.

    entries  (word, its phones), as a pronouncing dictionary lists them
    known    words in lower case that people know; a dictionary is full of names
    """
    common = {phone: phone for phone in phonemes}
    common = {**{p: c for p, c in phoneme_map.items() if c in common}, **common}
    best: dict[Pair, list[tuple[int, str]]] = {}
    for word, phones in entries:
        cost = len(word) + (0 if word in known else _UNKNOWN)
        mapped = [common.get(phone, "") for phone in phones]
        for pair in set(pairwise(mapped)):
            if "" in pair:
                continue
            found = best.setdefault(pair, [])
            if len(found) < CANDIDATES or cost < found[-1][0]:
                found.append((cost, word))
                found.sort()
                del found[CANDIDATES:]
    return {pair: tuple(word for _, word in found) for pair, found in best.items()}


def words_of(text: str) -> set[str]:
    """The words of a text in lower case."""
    return set(re.findall(r"[a-z]{2,}", text.lower()))
