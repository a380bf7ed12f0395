"""What the command palette offers, and in which order for a few typed letters. No Qt."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from .fuzzy import fit

#: At most so many are offered: nobody scrolls further.
MOST = 60

#: What an exact name is worth, the beginning of one, a piece of a sentence, and having been used lately: the
#: newest most.
_EXACT, _BEGINNING, _PIECES, _RECENT = 100.0, 14.0, 4.0, 6.0
#: A choice found by its group first, "view layout", is worth less than one found by its title alone.
_BY_GROUP = -6.0
#: … unless a good part of the group's name is all that was typed: "compare" means those, not the word's bigrams.
_GROUP, _GOOD_PART = 20.0, 4
#: A phone's whole name is worth, per letter and once: more than letters scattered over a title, less than the
#: beginning of one. One letter alone may be the beginning of anything.
_PHONE_LETTER, _PHONE = 9.0, 3.0

_BETWEEN = re.compile(r"[\s\-–—_,>→]+")


@dataclass(frozen=True)
class Choice:
    """Something to choose.

    id       what is handed back
    title    what it is called
    group    where it is from, shown small: "View", "Bigram · draft"
    keys     its key as this system writes it
    name     the very thing to type for it, "f ah"; then it is found by the beginning of that and nothing else,
             and not listed before anything is typed
    prose    a sentence: found by pieces of it, not by single letters
    enabled  whether it can be done now
    on       a switch that is on
    """

    id: str
    title: str
    group: str = ""
    keys: str = ""
    name: str = ""
    prose: bool = False
    enabled: bool = True
    on: bool = False


@dataclass(frozen=True)
class Offer:
    """A choice and the letters of its title that were typed."""

    choice: Choice
    places: tuple[int, ...] = ()


def ranked(query: str, choices: Sequence[Choice], recent: Sequence[str], found: Sequence[Choice] = ()) -> list[Offer]:
    """The best first; without a query the recent ones first.

    recent  ids, the newest first
    found   what somebody else found for this very query: after what fits well, before what fits badly
    """
    age = {name: i for i, name in enumerate(recent)}
    if not query.strip():
        old = sorted((c for c in choices if c.id in age), key=lambda c: age[c.id])
        return [Offer(c) for c in (*old, *(c for c in choices if c.id not in age and not c.name))][:MOST]
    scored: list[tuple[float, int, Offer]] = []
    taken = {choice.id for choice in found}
    for choice in choices:
        if choice.id in taken:
            continue
        by = _by_name if choice.name else _by_pieces if choice.prose else _by_title
        hit = by(query, choice)
        if hit is not None:
            score, places = hit
            score += _RECENT / (1 + age[choice.id]) if choice.id in age else 0.0
            scored.append((score - (0 if choice.enabled else 20), -len(scored), Offer(choice, places)))
    scored += [(_BEGINNING - i, 0, Offer(choice)) for i, choice in enumerate(found)]
    scored.sort(key=lambda one: one[:2], reverse=True)
    return [offer for _, _, offer in scored[:MOST]]


def _by_title(query: str, choice: Choice) -> tuple[float, tuple[int, ...]] | None:
    if (own := fit(query, choice.title)) is not None:
        whole = query.strip().casefold() == choice.title.casefold()
        return own.score + (_EXACT if whole else 0.0), own.places
    first, _, rest = query.strip().partition(" ")
    if not any(word.startswith(first.casefold()) for word in choice.group.casefold().split()):
        return None
    if not rest and len(first) >= _GOOD_PART:
        return _GROUP, ()
    inner = fit(rest, choice.title)
    return None if inner is None else (inner.score + _BY_GROUP, inner.places)


def _by_pieces(query: str, choice: Choice) -> tuple[float, tuple[int, ...]] | None:
    low, places = choice.title.lower(), set[int]()
    for piece in query.lower().split():
        at = low.find(piece)
        if at < 0:
            return None
        places.update(range(at, at + len(piece)))
    return _PIECES + len(places), tuple(sorted(places))


def _by_name(query: str, choice: Choice) -> tuple[float, tuple[int, ...]] | None:
    typed, name = _BETWEEN.split(query.strip().casefold()), _BETWEEN.split(choice.name.casefold())
    if "".join(typed) == "".join(name):
        return _EXACT, tuple(range(len(choice.title)))
    if typed[:-1] == name[: len(typed) - 1] and len(typed) <= len(name) and name[len(typed) - 1].startswith(typed[-1]):
        if len(name) > len(typed) == 1 < len(typed[0]) and typed == name[:1]:
            return _PHONE_LETTER * len(typed[0]) + _PHONE, ()
        return _BEGINNING * (len(typed) - 1), ()
    return None
