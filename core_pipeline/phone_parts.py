"""Phone parts: curves for every bigram from one row per phone, so that a new set talks from the start.

    recipe (.toml)  ─→  targets of each phone  ─→  curve of each pose  ─→  CurveSet (.json)

Animators' own sets are nearly such sums: the first phone's stroke early, the second's late, and few
exceptions (section 3.1.2 leaves the drawing to them). assets/curves/english.toml explains the recipe.

    python -m core_pipeline.phone_parts [recipe.toml …]    writes the .json beside each recipe
"""

from __future__ import annotations

import sys
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Literal

import msgspec

from .curve_set import Bigram, CurveSet
from .curves import Curve
from .errors import UserError
from .files.curve_set_json import save
from .phonemes import SILENCE, Pair

#: What a bigram made here has as its source.
SOURCE = "phone parts"

#: Of the keys' times and values.
DECIMALS = 3

Weight = Annotated[float, msgspec.Meta(ge=0, le=1)]
Time = Annotated[float, msgspec.Meta(ge=0, le=1)]
#: When a target peaks. "meeting" is where the two phones meet: targets that give way go there.
Moment = Literal["early", "mid", "late", "meeting"]
#: Pose → strength, or moment → strength for a phone that moves.
Row = dict[str, Weight | dict[Moment, Weight]]
Key = tuple[float, float]
#: Moment → strength of one pose.
Strengths = Mapping[Moment, float]
Targets = Mapping[str, Strengths]


class Moments(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """The time of each moment, in the bigram's normalised time."""

    early: Time
    mid: Time
    late: Time
    meeting: Time = 0.5

    def peaks(self, strengths: Strengths) -> list[Key]:
        """(time, strength) of every target, in order of time."""
        at = {"early": self.early, "mid": self.mid, "late": self.late, "meeting": self.meeting}
        return sorted((at[moment], strength) for moment, strength in strengths.items())


class Times(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """When targets peak, for the first phone of a pair and the second."""

    first: Moments
    second: Moments
    first_before_silence: Moments
    second_after_silence: Moments


class Reach(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """How long a slope takes from a peak to 0."""

    usual: Time
    silence: Time


class Closures(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """The plateau of poses whose lips touch: (time, fraction of the strength) as first phone."""

    poses: tuple[str, ...]
    first: tuple[tuple[Time, Weight], ...]
    first_before_silence: tuple[tuple[Time, Weight], ...]


class Recipe(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """One row per phone and the rules that turn rows into curves.

    phones  phone → its row
    beside  phone → pose → the most it allows its neighbour in their common pair
    borrow  phone → the share it takes of the other phone's row
    """

    name: str
    language: str
    phonemes: tuple[str, ...]
    poses: tuple[str, ...]
    times: Times
    reach: Reach
    closures: Closures
    phones: dict[str, Row]
    beside: dict[str, dict[str, Weight]] = {}
    borrow: dict[str, Weight] = {}


def read_recipe(path: Path) -> Recipe:
    """The recipe in a .toml file; UserError names file and place of what is wrong."""
    try:
        recipe = msgspec.convert(tomllib.loads(path.read_text("utf-8")), Recipe)
    except OSError as error:
        raise UserError(f"{path} cannot be read ({error.strerror}): check the path.") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError, msgspec.ValidationError) as error:
        raise UserError(f"{path} is not a recipe ({error}): correct that place.") from error
    for phone in recipe.phonemes:
        if phone not in recipe.phones:
            raise UserError(f"{path} has no row for {phone}: add [phones.{phone}].")
    for section, rows in (("phones", recipe.phones), ("beside", recipe.beside), ("borrow", recipe.borrow)):
        for phone in rows:
            if phone not in recipe.phonemes:
                raise UserError(f"{path}: [{section}] has {phone!r}, which is not among the phonemes: correct it.")
    named: list[tuple[str, Iterable[str]]] = [("closures", recipe.closures.poses)]
    for phone, poses in [*named, *recipe.phones.items(), *recipe.beside.items()]:
        for pose in poses:
            if pose not in recipe.poses:
                raise UserError(f"{path}: {phone} has the pose {pose!r}; choose among {', '.join(recipe.poses)}.")
    return recipe


def bigram_of(recipe: Recipe, pair: Pair, status: str = "draft") -> Bigram:
    """The curves of one pair; either phone may be silence. KeyError for a phone the recipe does not have."""
    first, second = _rows(recipe, pair)
    curves = {}
    for pose in recipe.poses:
        if pose in first or pose in second:
            before = _first_part(recipe, pose, first.get(pose, {}), alone=pair[1] == SILENCE)
            after = _second_part(recipe, pose, second.get(pose, {}), alone=pair[0] == SILENCE)
            curves[pose] = _joined(before, after)
    return Bigram(curves, status=status, source=SOURCE)


def curve_set_of(recipe: Recipe, status: str = "draft") -> CurveSet:
    """All pairs of the recipe's phonemes, and each phoneme after and before silence."""
    phones = recipe.phonemes
    pairs = [(a, b) for a in phones for b in phones]
    pairs += [(SILENCE, phone) for phone in phones] + [(phone, SILENCE) for phone in phones]
    return CurveSet(
        name=recipe.name,
        language=recipe.language,
        phonemes=phones,
        poses=recipe.poses,
        bigrams={pair: bigram_of(recipe, pair, status) for pair in pairs},
    )


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


def _first_part(recipe: Recipe, pose: str, strengths: Strengths, *, alone: bool) -> list[Key]:
    """Keys of the first phone, from its first peak to where it is 0 again; none without a target.

    alone  the other phone is silence
    """
    if not strengths:
        return []
    if pose in recipe.closures.poses:
        stroke = recipe.closures.first_before_silence if alone else recipe.closures.first
        return [(t, fraction * max(strengths.values())) for t, fraction in stroke]
    peaks = (recipe.times.first_before_silence if alone else recipe.times.first).peaks(strengths)
    return [*peaks, (peaks[-1][0] + (recipe.reach.silence if alone else recipe.reach.usual), 0.0)]


def _second_part(recipe: Recipe, pose: str, strengths: Strengths, *, alone: bool) -> list[Key]:
    """Keys of the second phone, from where it leaves 0 to its last peak; none without a target."""
    if not strengths:
        return []
    if pose in recipe.closures.poses:
        return [(1.0 - t, v) for t, v in reversed(_first_part(recipe, pose, strengths, alone=alone))]
    peaks = (recipe.times.second_after_silence if alone else recipe.times.second).peaks(strengths)
    return [(peaks[0][0] - (recipe.reach.silence if alone else recipe.reach.usual), 0.0), *peaks]


def _joined(before: Sequence[Key], after: Sequence[Key]) -> Curve:
    """One curve that begins at time 0 and ends at 1; where both parts have keys, straight from peak to peak."""
    keys = [*before[:-1], *after[1:]] if before and after else [*before, *after]
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
