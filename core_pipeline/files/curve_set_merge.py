"""Three-way merge of curve sets: what each of two people changed since a common state, per bigram and pose.

Where both changed the same thing differently, ours stays and theirs is kept beside it, in the field "conflicts" of
the bigram or of the set: the file remains a sound curve set, opens in the editor, and `check` names what is left.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, TypeVar

from ..curve_set import STATUSES, Bigram, CurveSet
from ..curves import Curve
from ..phonemes import SILENCE, Pair, pair_name
from ..settings import Settings
from .curve_set_text import in_order, keys_text
from .settings_json import decode_settings, encode_settings

T = TypeVar("T")

#: The field of a bigram, or of the set, that holds what the other side wanted.
CONFLICTS = "conflicts"


@dataclass(frozen=True)
class Merged:
    """The merged set, and one line per thing that both sides changed differently."""

    curve_set: CurveSet
    conflicts: tuple[str, ...]


def open_conflicts(curve_set: CurveSet) -> list[str]:
    """What merges have left undecided in a set, one line each: "f-ah open"."""
    lines = [f"the set's {name}" for name in _marks(curve_set.extra)]
    for pair in in_order(curve_set.bigrams, curve_set.phonemes):
        lines += [f"{pair_name(pair)} {pose}" for pose in _marks(curve_set.bigrams[pair].extra)]
    return lines


def decided(bigram: Bigram, poses: set[str] | None = None) -> Bigram:
    """Without the marks of conflicts on `poses`, or on any; the same object where there are none."""
    marks = _marks(bigram.extra)
    left = {} if poses is None else {pose: mark for pose, mark in marks.items() if pose not in poses}
    if len(left) == len(marks):
        return bigram
    extra = {name: value for name, value in bigram.extra.items() if name != CONFLICTS}
    return replace(bigram, extra={**extra, CONFLICTS: left} if left else extra)


def with_theirs(bigram: Bigram) -> Bigram:
    """With the other side's curves wherever a merge left it undecided, ours kept beside them; again: back to ours.

    The same object where nothing is undecided.
    """
    swapped, marks = bigram, {}
    for pose, mark in _marks(bigram.extra).items():
        try:
            keys = mark["theirs"]
            theirs = Curve.of(keys) if keys is not None else None
        except (ValueError, TypeError, IndexError, KeyError):  # the file may hold anything there
            continue
        mine = bigram.curves.get(pose)
        swapped = swapped.with_curve(pose, theirs)
        marks[pose] = {**mark, "theirs": None if mine is None else json.loads(keys_text(mine))}
    return replace(swapped, extra={**bigram.extra, CONFLICTS: marks}) if marks else bigram


def merge(base: CurveSet, ours: CurveSet, theirs: CurveSet) -> Merged:
    """What became of `base`: both sides' changes; UserError never, every file stays usable."""
    told: list[str] = []
    marks: dict[str, Any] = {}

    def field(name: str, b: Any, o: Any, t: Any) -> Any:
        value, clash = _three(b, o, t)
        if clash:
            told.append(f"the set's {name}: {_said(o)} (ours) or {_said(t)} (theirs)")
            marks[name] = t
        return value

    name, language, base_name, provenance = (
        field(what, *(getattr(s, what) for s in (base, ours, theirs)))
        for what in ("name", "language", "base", "provenance")
    )
    phonemes = _list(base.phonemes, ours.phonemes, theirs.phonemes)
    everything = [{**s.aside, **s.own} for s in (base, ours, theirs)]  # a phone may have been removed on one side
    bigrams = _bigrams(everything[0], everything[1], everything[2], told)
    known = {*phonemes, SILENCE}
    aside = {pair: bigram for pair, bigram in bigrams.items() if not known.issuperset(pair)}
    bigrams = {pair: bigram for pair, bigram in bigrams.items() if pair not in aside}
    below = next((s.below for s in (ours, theirs, base) if s.base == base_name), None)
    used = [pose for bigram in bigrams.values() for pose in bigram.curves]
    poses = _list(base.poses, ours.poses, theirs.poses)
    poses = tuple(dict.fromkeys((*poses, *used, *(below.poses if below is not None else ()))))
    phoneme_map = _mapping(
        base.phoneme_map,
        ours.phoneme_map,
        theirs.phoneme_map,
        lambda phone, *values: field(f"phoneme_map {phone}", *values),
    )
    extras = [{k: v for k, v in s.extra.items() if k != CONFLICTS} for s in (base, ours, theirs)]
    extra = _mapping(extras[0], extras[1], extras[2], field)
    settings = _settings(base, ours, theirs, field)
    marks = {**_marks(ours.extra), **_marks(theirs.extra), **marks}
    merged = replace(
        ours,
        name=name,
        language=language,
        provenance=provenance,
        phonemes=phonemes,
        poses=poses,
        bigrams=bigrams,
        phoneme_map=phoneme_map,
        settings=settings,
        base=None,
        below=None,
        aside=aside,
        authors=_list(base.authors, ours.authors, theirs.authors),
        extra={**extra, CONFLICTS: marks} if marks else extra,
    )
    if below is not None:
        merged = merged.on_base(base_name, below)
    return Merged(merged, tuple(told))


def _bigrams(
    base: Mapping[Pair, Bigram], ours: Mapping[Pair, Bigram], theirs: Mapping[Pair, Bigram], told: list[str]
) -> dict[Pair, Bigram]:
    merged = {}
    for pair in dict.fromkeys((*ours, *theirs)):
        bigram = _bigram(pair_name(pair), base.get(pair), ours.get(pair), theirs.get(pair), told)
        if bigram is not None:
            merged[pair] = bigram
    return merged


def _bigram(
    name: str, base: Bigram | None, ours: Bigram | None, theirs: Bigram | None, told: list[str]
) -> Bigram | None:
    if _same(base, theirs) or _same(ours, theirs):
        return ours
    if _same(base, ours):
        return theirs
    b, o, t = (side if side is not None else Bigram() for side in (base, ours, theirs))
    curves: dict[str, Curve] = {}
    marks: dict[str, Any] = {**_marks(o.extra), **_marks(t.extra)}
    touched = [False, False]
    for pose in dict.fromkeys((*o.curves, *t.curves, *b.curves)):
        old, mine, other = (side.curves.get(pose) for side in (b, o, t))
        curve, clash = _three(old, mine, other, _same_curve)
        if curve is not None:
            curves[pose] = curve
        touched[0] |= not _same_curve(old, mine)
        touched[1] |= not _same_curve(old, other)
        if clash:
            told.append(f"{name} {pose}: both sides changed it")
            marks[pose] = {
                side: None if value is None else json.loads(keys_text(value))
                for side, value in (("base", old), ("theirs", other))
            }
    extra, clashes = {}, []
    for key in dict.fromkeys((*o.extra, *t.extra)):
        if key != CONFLICTS:
            extra[key], clash = _three(b.extra.get(key), o.extra.get(key), t.extra.get(key))
            clashes += [key] if clash else []
    told += [f"{name} {key}: both sides changed it; ours stays" for key in clashes]
    status, unsure = _three(b.status, o.status, t.status)
    if unsure:
        status = min(o.status, t.status, key=STATUSES.index)
    if marks or all(touched):  # nobody has seen these curves together
        status = min(status, "review", key=STATUSES.index)
    note, unsure = _three(b.note, o.note, t.note)
    return Bigram(
        curves,
        status,
        _three(b.source, o.source, t.source)[0],
        " / ".join(dict.fromkeys(filter(None, (o.note, t.note))))[:10_000] if unsure else note,
        _three(b.author, o.author, t.author)[0],
        {**{key: value for key, value in extra.items() if value is not None}, **({CONFLICTS: marks} if marks else {})},
    )


def _three(base: T, ours: T, theirs: T, same: Callable[[T, T], bool] = lambda a, b: a == b) -> tuple[T, bool]:
    """The value that a three-way merge gives, ours in a clash; and whether it is one."""
    if same(ours, theirs) or same(base, theirs):
        return ours, False
    return (theirs, False) if same(base, ours) else (ours, True)


def _mapping(
    base: Mapping[str, Any], ours: Mapping[str, Any], theirs: Mapping[str, Any], field: Callable[..., Any]
) -> dict[str, Any]:
    """Entry by entry; None means there is none."""
    merged = {}
    for name in dict.fromkeys((*ours, *theirs)):
        value = field(name, base.get(name), ours.get(name), theirs.get(name))
        if value is not None:
            merged[name] = value
    return merged


def _list(base: tuple[str, ...], ours: tuple[str, ...], theirs: tuple[str, ...]) -> tuple[str, ...]:
    """Ours in our order, without what they removed, then what they added."""
    kept = [name for name in ours if name in theirs or name not in base]
    return tuple(dict.fromkeys((*kept, *(name for name in theirs if name not in base))))


def _settings(base: CurveSet, ours: CurveSet, theirs: CurveSet, field: Callable[..., Any]) -> Settings | None:
    if theirs.settings in (ours.settings, base.settings):
        return ours.settings
    if base.settings == ours.settings:
        return theirs.settings
    old, mine, other = (json.loads(encode_settings(s.effective_settings, {})) for s in (base, ours, theirs))
    return decode_settings(_mapping(old, mine, other, lambda name, *v: field(f"settings {name}", *v)), "the merged set")


def _marks(extra: Mapping[str, Any]) -> dict[str, Any]:
    marks = extra.get(CONFLICTS)
    return marks if isinstance(marks, dict) else {}


def _same_curve(a: Curve | None, b: Curve | None) -> bool:
    return a is b or (a is not None and a.same_as(b))


def _same(a: Bigram | None, b: Bigram | None) -> bool:
    if a is None or b is None:
        return a is b
    fields = ("status", "source", "note", "author", "extra")
    return (
        all(getattr(a, what) == getattr(b, what) for what in fields)
        and a.curves.keys() == b.curves.keys()
        and all(curve.same_as(b.curves[pose]) for pose, curve in a.curves.items())
    )


def _said(value: Any) -> str:
    text = json.dumps(value, ensure_ascii=False)
    return text if len(text) <= 40 else text[:39] + "…"
