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
from typing import Annotated, Any, Literal, NamedTuple

import msgspec

from .curve_set import Bigram, CurveSet
from .curves import Curve
from .errors import UserError
from .files.curve_set_json import save
from .files.settings_json import decode_settings, unknown_fields
from .phonemes import SILENCE, TABLE_1, Pair
from .settings import Settings

#: What a bigram made here has as its source.
SOURCE = "phone parts"

#: Of the keys' times and values.
DECIMALS = 3

Weight = Annotated[float, msgspec.Meta(ge=0, le=1)]
Time = Annotated[float, msgspec.Meta(ge=0, le=1)]
#: When a target peaks. "meeting" is where the two phones meet: targets that give way to the neighbour go there.
Moment = Literal["early", "mid", "late", "meeting"]
#: Pose → strength, or moment → strength for a phone that moves.
Row = dict[str, Weight | dict[Moment, Weight]]
Key = tuple[float, float]
Stroke = tuple[tuple[Time, Weight], ...]
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


class Part(NamedTuple):
    """One phone's keys for one pose in a pair: `held` at its peaks, `slope` towards the other phone, falling to 0."""

    held: list[Key]
    slope: list[Key]


class Reach(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """How long a slope takes from a peak to 0."""

    usual: Time
    silence: Time


class Closures(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """Poses whose lips touch have a plateau: (time, fraction of the strength) as first phone, somewhere 1.

    The stroke depends on the other phone: silence, one of the `long` phones, or any other.
    """

    poses: tuple[str, ...]
    long: tuple[str, ...]
    first: Stroke
    first_before_long: Stroke
    first_before_silence: Stroke

    def beside(self, other: str) -> Stroke:
        """The stroke before `other`; after it, the mirror image."""
        if other == SILENCE:
            return self.first_before_silence
        return self.first_before_long if other in self.long else self.first


class Recipe(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    """One row per phone and the rules that turn rows into curves.

    phones        phone → its row
    beside        phone → pose → the most it allows its neighbour in their common pair
    borrow        phone → the share it takes of the other phone's row
    settings      what the set is made for, as in a curve set's file; without, the preset "Paper"
    phoneme_map   language phone → one of `phonemes`; without, table 1
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
    settings: dict[str, Any] | None = None
    phoneme_map: dict[str, str] | None = None


def read_recipe(path: Path) -> Recipe:
    """The recipe in a .toml file; UserError names file and place of what is wrong."""
    try:
        recipe = msgspec.convert(tomllib.loads(path.read_text("utf-8")), Recipe)
    except OSError as error:
        raise UserError(f"{path} cannot be read ({error.strerror}): check the path.") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError, msgspec.ValidationError) as error:
        raise UserError(f"{path} is not a recipe ({error}): correct that place.") from error
    _check_phones(recipe, path)
    _check_settings(recipe, path)
    return recipe


def _check_phones(recipe: Recipe, path: Path) -> None:
    """UserError unless every phoneme has a row and all names are known."""
    for phone in recipe.phonemes:
        if phone not in recipe.phones:
            raise UserError(f"{path} has no row for {phone}: add [phones.{phone}].")
    sections: dict[str, Iterable[str]] = {
        "phones": recipe.phones,
        "beside": recipe.beside,
        "borrow": recipe.borrow,
        "closures": recipe.closures.long,
    }
    for section, phones in sections.items():
        for phone in phones:
            if phone not in recipe.phonemes:
                raise UserError(f"{path}: [{section}] has {phone!r}, which is not among the phonemes: correct it.")
    for stroke in (recipe.closures.beside(phone) for phone in (*recipe.phonemes, SILENCE)):
        if not any(fraction == 1 for _, fraction in stroke):
            raise UserError(f"{path}: a stroke in [closures] never reaches 1: give it a key at 1.")
    named: list[tuple[str, Iterable[str]]] = [("closures", recipe.closures.poses)]
    for phone, poses in [*named, *recipe.phones.items(), *recipe.beside.items()]:
        for pose in poses:
            if pose not in recipe.poses:
                raise UserError(f"{path}: {phone} has the pose {pose!r}; choose among {', '.join(recipe.poses)}.")
    for name, phone in (recipe.phoneme_map or {}).items():
        if phone not in recipe.phonemes:
            raise UserError(f"{path}: [phoneme_map] takes {name} to {phone!r}, which is no phoneme: correct it.")


def _check_settings(recipe: Recipe, path: Path) -> None:
    """UserError unless the settings are possible and about the recipe's own poses."""
    settings = _settings(recipe, str(path))
    if settings is None:
        return
    if odd := sorted(unknown_fields(recipe.settings or {})):
        raise UserError(f"{path}: [settings] has {odd[0]!r}, which is no setting: correct it.")
    pairs = [pose for constraint in settings.constraints for pose in (constraint.a, constraint.b)]
    for pose in (*settings.windows, *settings.priorities, *pairs):
        if pose not in recipe.poses:
            raise UserError(f"{path}: [settings] names the pose {pose!r}; name poses of the set, in every part.")


def _settings(recipe: Recipe, place: str) -> Settings | None:
    return None if recipe.settings is None else decode_settings(recipe.settings, place)


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
        phoneme_map=TABLE_1 if recipe.phoneme_map is None else recipe.phoneme_map,
        settings=_settings(recipe, recipe.name),
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
