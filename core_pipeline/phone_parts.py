"""Phone parts: curves for every bigram from one row per phone, so that a new set talks from the start.

    recipe (.toml)  ─→  targets of each phone  ─→  curve of each pose  ─→  CurveSet (.json)

Animators' own sets are nearly such sums: the first phone's stroke early, the second's late, and few
exceptions (section 3.1.2 leaves the drawing to them). assets/curves/english.toml explains the recipe.

    python -m core_pipeline.phone_parts [recipe.toml …]    writes the .json beside each recipe
"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from .curve_set import Bigram, CurveSet
from .curves import Curve
from .errors import UserError
from .files.curve_set_json import save
from .phone_recipe import Key, Moment, Recipe, Strengths, Targets, read_recipe, recipe_settings
from .phonemes import SILENCE, TABLE_1, Pair

#: What a bigram made here has as its source.
SOURCE = "phone parts"

#: Of the keys' times and values.
DECIMALS = 3


class Part(NamedTuple):
    """One phone's keys for one pose in a pair: `held` at its peaks, `slope` towards the other phone, falling to 0."""

    held: list[Key]
    slope: list[Key]


def bigram_of(recipe: Recipe, pair: Pair, status: str = "draft") -> Bigram:
    """The curves of one pair; either phone may be silence. KeyError for a phone the recipe does not have."""
    first, second = _rows(recipe, pair)
    curves = {}
    for pose in recipe.poses:
        if pose in first or pose in second:
            before = _first_part(recipe, pose, first.get(pose, {}), pair[1])
            after = _second_part(recipe, pose, second.get(pose, {}), pair[0])
            curves[pose] = _joined(before, after)
    return Bigram(curves, status=status, source=SOURCE)


def curve_set_of(recipe: Recipe, status: str = "draft") -> CurveSet:
    """All pairs of the recipe's phonemes, and each phoneme after and before silence; its base's come from below."""
    phones, own = recipe.phonemes, recipe.own_phonemes
    pairs = [(a, b) for a in phones for b in phones if a in own or b in own]
    pairs += [(SILENCE, phone) for phone in own] + [(phone, SILENCE) for phone in own]
    curve_set = CurveSet(
        name=recipe.name,
        language=recipe.language,
        phonemes=phones,
        poses=recipe.poses,
        bigrams={pair: bigram_of(recipe, pair, status) for pair in pairs},
        phoneme_map=TABLE_1 if recipe.phoneme_map is None else recipe.phoneme_map,
        settings=recipe_settings(recipe, recipe.name),
    )
    if recipe.below is None or recipe.base is None:
        return curve_set
    return curve_set.on_base(recipe.base, curve_set_of(recipe.below, status))


def _rows(recipe: Recipe, pair: Pair) -> tuple[Targets, Targets]:
    """Both phones' targets in this pair, after borrowing and giving way."""
    first, second = (_targets(recipe, phone) for phone in pair)
    first = _borrow(recipe, first, second, recipe.borrow.get(pair[0], 0.0))
    return (
        _give_way(first, recipe.beside.get(pair[1], {}), far="early"),
        _give_way(second, recipe.beside.get(pair[0], {}), far="late"),
    )


def _targets(recipe: Recipe, phone: str) -> Targets:
    row = {} if phone == SILENCE else recipe.phones[phone]
    return {pose: dict(s) if isinstance(s, dict) else {"mid": s} for pose, s in row.items()}


def _borrow(recipe: Recipe, own: Targets, following: Targets, share: float) -> Targets:
    """The own row, or `share` of how the following phone begins where that is more. Closures are not lent."""
    taken = dict(own)
    for pose, strengths in following.items():
        onset = share * max((s for moment, s in strengths.items() if moment != "late"), default=0.0)
        if pose not in recipe.closures.poses and onset > max(own.get(pose, {}).values(), default=0.0):
            taken[pose] = {"mid": onset}
    return taken


def _give_way(row: Targets, limits: Mapping[str, float], far: Moment) -> Targets:
    """Targets above the limit of their pose sink to it, and peak where the phones meet.

    A peak there keeps smoothing from bridging the dip. Targets at the moment `far` from the neighbour stay.
    """
    given: dict[str, Strengths] = {}
    for pose, strengths in row.items():
        limit = limits.get(pose, 1.0)
        near = {moment for moment, s in strengths.items() if moment != far and s > limit}
        kept: dict[Moment, float] = {moment: s for moment, s in strengths.items() if moment not in near}
        given[pose] = {**kept, "meeting": limit} if near else kept
    return given


def _first_part(recipe: Recipe, pose: str, strengths: Strengths, second: str) -> Part:
    """The first phone's keys, before the phone `second`."""
    if not strengths:
        return Part([], [])
    if pose in recipe.closures.poses:
        stroke = recipe.closures.beside(second)
        keys = [(t, fraction * max(strengths.values())) for t, fraction in stroke]
        fall = 1 + max(i for i, (_, fraction) in enumerate(stroke) if fraction == 1)
        return Part(keys[:fall], keys[fall:])
    alone = second == SILENCE
    peaks = (recipe.times.first_before_silence if alone else recipe.times.first).peaks(strengths)
    return Part(peaks, [(peaks[-1][0] + (recipe.reach.silence if alone else recipe.reach.usual), 0.0)])


def _second_part(recipe: Recipe, pose: str, strengths: Strengths, first: str) -> Part:
    """The second phone's keys, after the phone `first`."""
    if not strengths:
        return Part([], [])
    if pose in recipe.closures.poses:
        mirror = _first_part(recipe, pose, strengths, first)
        return Part([(1.0 - t, v) for t, v in mirror.held[::-1]], [(1.0 - t, v) for t, v in mirror.slope[::-1]])
    alone = first == SILENCE
    peaks = (recipe.times.second_after_silence if alone else recipe.times.second).peaks(strengths)
    return Part(peaks, [(peaks[0][0] - (recipe.reach.silence if alone else recipe.reach.usual), 0.0)])


def _joined(first: Part, second: Part) -> Curve:
    """One curve from time 0 to 1; where both parts have keys, straight from peak to peak without their slopes."""
    if first.held and second.held:
        keys = [*first.held, *second.held]
    else:
        keys = [*first.held, *first.slope, *second.slope, *second.held]
    keys = [(round(t, DECIMALS), round(v, DECIMALS)) for t, v in keys if 0 <= t <= 1]
    if keys[0][0] > 0:
        keys.insert(0, (0.0, 0.0))
    if keys[-1][0] < 1:
        keys.append((1.0, 0.0))
    inner = [b for a, b, c in zip(keys, keys[1:], keys[2:], strict=False) if not a[1] == b[1] == c[1]]
    return Curve.of([keys[0], *inner, keys[-1]])


def write(recipe_path: Path) -> Path:
    """Make the curve set of a recipe and save it beside it, as .json; the path written."""
    path = recipe_path.with_suffix(".json")
    save(curve_set_of(read_recipe(recipe_path)), path)
    return path


def main(arguments: Sequence[str]) -> None:
    """Rewrite the curve sets of the recipes named, of all that we ship when none is named."""
    shipped = Path(__file__).parents[1] / "assets" / "curves"
    for path in map(Path, arguments) if arguments else sorted(shipped.glob("*.toml")):
        print(write(path))


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except UserError as error:
        sys.exit(str(error))
