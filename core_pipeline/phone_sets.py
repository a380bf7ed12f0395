"""Changes of a set's phonemes: one added, split off, renamed or removed (sections 3.1.1 and 5.4). Nothing is lost.

Phone sets are data: 441 is 21². Splitting b from bmp copies the curves of bmp, so that everything looks as before
until the first edit. The bigrams of a phone that is removed are put aside, and come back when it is added again.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from .curve_set import CurveSet
from .errors import UserError
from .phonemes import SILENCE, Pair, pair_name

MAX_PHONEMES = 400


@dataclass(frozen=True)
class PhoneSetChange:
    """What one set has and another has not, for a preview.

    added, gone   phonemes
    copied, blank, returned   new bigrams: with the curves of others, without curves, and back from aside
    moved   bigrams that go by another name
    aside         bigrams that are kept, but no longer played
    spoken        language phones that play another phoneme than before: (phone, before or "", after or "")
    """

    added: tuple[str, ...]
    gone: tuple[str, ...]
    copied: tuple[Pair, ...]
    blank: tuple[Pair, ...]
    returned: tuple[Pair, ...]
    moved: tuple[Pair, ...]
    aside: tuple[Pair, ...]
    spoken: tuple[tuple[str, str, str], ...]


def added(curve_set: CurveSet, phone: str, like: str | None = None, spoken: Sequence[str] = ()) -> CurveSet:
    """With one more phoneme; UserError when its name will not do.

    like    the phoneme whose curves it begins with; None for empty bigrams
    spoken  the language phones that it stands for from now on
    """
    _check_new(curve_set, phone)
    if like is not None:
        _check_known(curve_set, like)
    phonemes = (*curve_set.phonemes, phone)
    bigrams, aside = dict(curve_set.bigrams), dict(curve_set.aside)
    for pair in _pairs_of(phone, phonemes):
        kept = aside.pop(pair, None)
        if kept is not None:
            bigrams[pair] = kept
        elif like is not None:
            model = tuple(like if p == phone else p for p in pair)
            copy = curve_set.bigrams.get((model[0], model[1]))
            if copy is not None:
                bigrams[pair] = replace(copy, source=f"copy of {pair_name((model[0], model[1]))}")
    phoneme_map = {**curve_set.phoneme_map, **dict.fromkeys(spoken, phone)}
    return replace(curve_set, phonemes=phonemes, bigrams=bigrams, aside=aside, phoneme_map=phoneme_map)


def removed(curve_set: CurveSet, phone: str, into: str) -> CurveSet:
    """Without `phone`: its bigrams are put aside, and what it stood for plays `into`. UserError when it is the last."""
    _check_known(curve_set, phone)
    _check_known(curve_set, into)
    if into == phone:
        raise UserError(f"{phone} cannot stand in for itself: choose another phoneme.")
    own = {pair: bigram for pair, bigram in curve_set.bigrams.items() if phone in pair}
    phoneme_map = {p: into if common == phone else common for p, common in curve_set.phoneme_map.items()}
    return replace(
        curve_set,
        phonemes=tuple(p for p in curve_set.phonemes if p != phone),
        bigrams={pair: bigram for pair, bigram in curve_set.bigrams.items() if pair not in own},
        aside={**curve_set.aside, **own},
        phoneme_map=phoneme_map,
    )


def renamed(curve_set: CurveSet, old: str, new: str) -> CurveSet:
    """With another name for a phoneme; UserError when the name will not do."""
    _check_known(curve_set, old)
    _check_new(curve_set, new)

    def name(pair: Pair) -> Pair:
        return (new if pair[0] == old else pair[0], new if pair[1] == old else pair[1])

    return replace(
        curve_set,
        phonemes=tuple(new if p == old else p for p in curve_set.phonemes),
        bigrams={name(pair): bigram for pair, bigram in curve_set.bigrams.items()},
        aside={name(pair): bigram for pair, bigram in curve_set.aside.items()},
        phoneme_map={p: new if common == old else common for p, common in curve_set.phoneme_map.items()},
    )


def change_of(before: CurveSet, after: CurveSet) -> PhoneSetChange:
    """What is different between the phoneme sets of two curve sets, in canonical order."""
    fresh = [p for p in after.phonemes if p not in before.phonemes]
    new = [pair for phone in fresh for pair in _pairs_of(phone, after.phonemes) if pair not in before.bigrams]
    new = list(dict.fromkeys(new))
    back = {pair for pair in new if pair in before.aside and pair in after.bigrams}
    gone = {id(bigram) for pair, bigram in before.bigrams.items() if pair not in after.bigrams}
    moved = {pair for pair in new if id(after.bigrams.get(pair)) in gone}
    spoken = [
        (phone, before.phoneme_map.get(phone, ""), after.phoneme_map.get(phone, ""))
        for phone in dict.fromkeys((*before.phoneme_map, *after.phoneme_map))
    ]
    return PhoneSetChange(
        added=tuple(fresh),
        gone=tuple(p for p in before.phonemes if p not in after.phonemes),
        copied=tuple(pair for pair in new if pair in after.bigrams and pair not in back and pair not in moved),
        blank=tuple(pair for pair in new if pair not in after.bigrams and SILENCE not in pair),
        returned=tuple(pair for pair in new if pair in back),
        moved=tuple(pair for pair in new if pair in moved),
        aside=tuple(pair for pair in after.aside if pair not in before.aside),
        spoken=tuple(row for row in spoken if row[1] != row[2]),
    )


def _pairs_of(phone: str, phonemes: Sequence[str]) -> list[Pair]:
    """All pairs that `phone` can be part of, with silence."""
    others = (*phonemes, SILENCE)
    return [(phone, other) for other in others] + [(other, phone) for other in others if other != phone]


def _check_known(curve_set: CurveSet, phone: str) -> None:
    if phone not in curve_set.phonemes:
        raise UserError(f"{phone} is no phoneme of this set: choose among {' '.join(curve_set.phonemes)}.")


def _check_new(curve_set: CurveSet, phone: str) -> None:
    if not (0 < len(phone) <= 60 and phone.isprintable()) or "-" in phone or phone != phone.strip():
        raise UserError("That cannot be the name of a phoneme: choose a short one without “-”.")
    if phone == SILENCE:
        raise UserError(f"“{SILENCE}” means silence: choose another name.")
    if phone in curve_set.phonemes:
        raise UserError(f"There is a phoneme {phone} already: choose another name.")
    if len(curve_set.phonemes) >= MAX_PHONEMES:
        raise UserError(f"A set can have {MAX_PHONEMES} phonemes at most: remove one first.")
