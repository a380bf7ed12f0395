"""A set of a SmartBody diphone script → a curve set: mended where animators' tools were careless, and all of it told.

`_` is silence. Keys a little outside 0…1, out of order or at equal times are clipped, sorted and merged.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..curve_set import Bigram, CurveSet
from ..errors import UserError
from ..phonemes import COMMON, SILENCE, TABLE_1, Pair, pair_name
from ..poses import FACEFX
from .curve_set_records import MAX_NAMES
from .curve_set_text import in_order
from .json_text import shown
from .keys import SLACK, Mends, mend
from .smartbody_script import Keys, Script, ScriptSet, many


@dataclass(frozen=True)
class Import:
    """A set of a script as a curve set, and one sentence per kind of repair with its count and first place."""

    curve_set: CurveSet
    report: tuple[str, ...]


def import_set(script: Script, name: str | None = None) -> Import:
    """One set of a script as a curve set; without a name the largest. UserError when there is no such set.

    A phone outside the 21 becomes a phoneme of the set where it has curves with at least half of them, as a phone
    that was split off has; otherwise its bigrams are kept aside: in the file, but not played.
    """
    chosen = script.largest() if name is None else name
    if chosen not in script.sets:
        raise UserError(
            f"{script.place} has no set “{shown(chosen)}”: choose among {', '.join(map(shown, script.sets))}."
        )
    source = script.sets[chosen]
    report = _Report(script.place)
    report.notes += script.notes
    if len(script.sets) > 1 and name is None:
        rest = [s for s in script.sets.values() if s.name != chosen]
        others = ", ".join(f"{shown(s.name)} ({many(len(s.pairs), 'diphone')})" for s in rest[:10])
        report.notes.append(f"{script.place}: “{shown(chosen)}” was taken; there are other sets too: {others}.")
    pairs = _named_as_ours(source, report)
    bigrams = {pair: _bigram(pair, keys, report, script.place) for pair, keys in pairs.items()}
    if doubled := [pair for pair, times in source.made.items() if times > 1]:
        report.notes.append(
            f"{script.place}: {many(len(doubled), 'diphone')} made more than once: the keys were put together "
            f"({_names(doubled)})."
        )
    if empty := [pair for pair, bigram in bigrams.items() if not bigram.curves]:
        report.notes.append(
            f"{script.place}: {many(len(empty), 'diphone')} without keys: left empty ({_names(empty)})."
        )
    phonemes = _phonemes(bigrams)
    known = {*phonemes, SILENCE}
    aside = {pair: b for pair, b in bigrams.items() if not known.issuperset(pair)}
    if aside:
        odd = sorted({phone for pair in aside for phone in pair} - known)
        report.notes.append(
            f"{script.place}: {many(len(aside), 'diphone')} with phones outside the set ({' '.join(odd)}): kept in the "
            "file, under “aside”, and not played."
        )
    if more := [phone for phone in phonemes if phone not in COMMON]:
        report.notes.append(f"{script.place}: {' '.join(more)} became phonemes of the set, beside the 21.")
    poses = _poses(bigrams, phonemes)
    curve_set = CurveSet(
        name=chosen[:200],
        phonemes=phonemes,
        poses=poses,
        bigrams={pair: b for pair, b in bigrams.items() if pair not in aside},
        phoneme_map={p: p if p in phonemes else common for p, common in TABLE_1.items() if {p, common} & {*phonemes}},
        aside=aside,
        provenance=f"Imported from the diphone script {Path(script.place).name[:200]}.",
    )
    return Import(curve_set, tuple(report.lines()))


def _named_as_ours(source: ScriptSet, report: _Report) -> dict[Pair, Keys]:
    """The pairs with our names for silence and, where only capitals differ, for phones."""
    ours = {phone.lower(): phone for phone in (*COMMON, SILENCE)} | {"_": SILENCE}
    named: dict[Pair, Keys] = {}
    changed: set[str] = set()
    for pair, keys in source.pairs.items():
        first, second = (ours.get(phone.lower(), phone) for phone in pair)
        changed |= {phone for phone, new in zip(pair, (first, second), strict=True) if phone not in (new, "_")}
        there = named.setdefault((first, second), {})
        for pose, curve in keys.items():
            there.setdefault(pose, []).extend(curve)
    if changed:
        report.notes.append(f"{report.place}: phones were renamed to small letters: {' '.join(sorted(changed))}.")
    return named


def _bigram(pair: Pair, keys: Keys, report: _Report, place: str) -> Bigram:
    curves = {}
    for pose, rows in keys.items():
        array = np.array(rows, dtype=np.float64)
        if not np.isfinite(array).all():  # 1e999
            array = np.nan_to_num(array, posinf=2.0, neginf=-2.0)
        far = int((np.abs(array - 0.5) > 0.5 + SLACK).any(1).sum())
        curves[pose], mends = mend(array)
        report.add(pair, pose, mends, far)
    return Bigram(curves, status="approved" if curves else "empty", source=Path(place).name[:200])


def _phonemes(bigrams: Mapping[Pair, Bigram]) -> tuple[str, ...]:
    """The 21 where the script speaks of most of them, and further phones that have curves with half of those."""
    used, before = _appearing(bigrams), None
    for _ in range(10):  # until the order in which we would write the pairs tells the same order of phones
        if used == before:
            break
        used, before = _appearing(in_order(bigrams, used)), used
    common = [phone for phone in COMMON if phone in used]
    if 2 * len(common) < len(used) or len(used) < 2:  # another phoneme set
        phonemes = used
    else:
        further = [phone for phone in used if phone not in COMMON and _companions(phone, common, bigrams) >= 1.0]
        phonemes = (*COMMON, *further)
    if len(phonemes) > MAX_NAMES:
        raise UserError(f"The script has {len(phonemes)} phones; at most {MAX_NAMES} are possible.")
    return phonemes


def _appearing(pairs: Iterable[Pair]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(phone for pair in pairs for phone in pair if phone != SILENCE))


def _companions(phone: str, common: list[str], bigrams: Mapping[Pair, Bigram]) -> float:
    """1 where half of the pairs of `phone` with the common ones have curves."""
    pairs = [(phone, other) for other in common] + [(other, phone) for other in common]
    return sum(pair in bigrams and not bigrams[pair].is_empty for pair in pairs) / len(common)


def _poses(bigrams: Mapping[Pair, Bigram], phonemes: tuple[str, ...]) -> tuple[str, ...]:
    """The nine of FaceFX where any of them is used, then the others as they come in the set's own order."""
    used = dict.fromkeys(pose for pair in in_order(bigrams, phonemes) for pose in bigrams[pair].curves)
    usual = FACEFX if not used or any(pose in FACEFX for pose in used) else ()
    poses = tuple(dict.fromkeys((*usual, *used)))
    if len(poses) > MAX_NAMES:
        raise UserError(f"The script has {len(poses)} poses; at most {MAX_NAMES} are possible.")
    return poses


def _names(pairs: Iterable[Pair]) -> str:
    names = [shown(pair_name(pair), 20) for pair in pairs]
    return ", ".join(names[:5]) + (", …" if len(names) > 5 else "")


class _Report:
    """Counts repairs of one kind, and keeps the first place of each."""

    def __init__(self, place: str) -> None:
        self.place = place
        self.notes: list[str] = []
        self._kinds: dict[str, tuple[int, int, str]] = {}  # kind → keys, curves, first place

    def add(self, pair: Pair, pose: str, mends: Mends, far: int) -> None:
        """What was done to one curve."""
        for kind, count in (
            ("clipped", mends.clipped),
            ("far", far),
            ("sorted", int(mends.sorted)),
            ("merged", mends.merged),
        ):
            if count:
                keys, curves, first = self._kinds.get(kind, (0, 0, f"{pair_name(pair)} {pose}"))
                self._kinds[kind] = keys + count, curves + 1, first

    def lines(self) -> list[str]:
        """All notes and counts, one sentence each."""
        told = list(self.notes)
        for kind, (keys, curves, first) in self._kinds.items():
            what = {
                "clipped": f"{many(keys, 'key')} outside 0…1 clipped",
                "far": f"{many(keys, 'key')} of these lay more than {SLACK:g} outside",
                "sorted": "keys out of order sorted",
                "merged": f"{many(keys, 'key')} at the time of another merged, the highest kept",
            }[kind]
            told.append(f"{self.place}: {what}, in {many(curves, 'curve')} (first: {shown(first)}).")
        return told
