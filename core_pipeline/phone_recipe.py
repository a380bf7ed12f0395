"""Recipes: the readable source of the curve sets we ship. A row per phone, and the rules that turn rows into curves.

A recipe may name a base, another recipe in its folder: it then adds phones to it, and its set holds their bigrams
only (section 5.4: Mandarin is English and one phoneme more). assets/curves/english.toml explains the rest.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

import msgspec

from .errors import UserError
from .files.settings_json import decode_settings, unknown_fields
from .phonemes import SILENCE
from .settings import Settings

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
    base, below   the recipe that this one adds to: its name, and itself
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
    base: str | None = None
    below: Recipe | None = None

    @property
    def own_phonemes(self) -> tuple[str, ...]:
        """Those that the base does not have."""
        return tuple(phone for phone in self.phonemes if self.below is None or phone not in self.below.phonemes)


def read_recipe(path: Path) -> Recipe:
    """The recipe in a .toml file; UserError names file and place of what is wrong."""
    own, below = _read(path), None
    base = own.get("base")
    if base is not None:
        if not (isinstance(base, str) and base.isidentifier()):
            raise UserError(f"{path}: the base must be the name of a recipe in the same folder, without .toml.")
        lower = path.with_name(f"{base}.toml")
        below = read_recipe(lower) if lower != path else None
        if below is None or below.base is not None:
            raise UserError(f"{path}: {base} cannot be its base: name a recipe that stands alone.")
        own = _over(_read(lower), own)
    try:
        recipe = msgspec.convert({**own, "below": None}, Recipe)
    except msgspec.ValidationError as error:
        raise UserError(f"{path} is not a recipe ({error}): correct that place.") from error
    recipe = msgspec.structs.replace(recipe, below=below)
    _check_phones(recipe, path)
    _check_settings(recipe, path)
    return recipe


def _read(path: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(path.read_text("utf-8"))
    except OSError as error:
        raise UserError(f"{path} cannot be read ({error.strerror}): check the path.") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise UserError(f"{path} is not a recipe ({error}): correct that place.") from error


def _over(base: dict[str, Any], own: dict[str, Any]) -> dict[str, Any]:
    """A recipe's own fields over those of its base; tables are put together, phonemes added."""
    merged = {**base, **own}
    for name, value in own.items():
        if isinstance(value, dict) and isinstance(base.get(name), dict):
            merged[name] = {**base[name], **value}
    if isinstance(own.get("phonemes"), list):
        merged["phonemes"] = [*base["phonemes"], *own["phonemes"]]
    return merged


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
    settings = recipe_settings(recipe, str(path))
    if settings is None:
        return
    if odd := sorted(unknown_fields(recipe.settings or {})):
        raise UserError(f"{path}: [settings] has {odd[0]!r}, which is no setting: correct it.")
    pairs = [pose for constraint in settings.constraints for pose in (constraint.a, constraint.b)]
    for pose in (*settings.windows, *settings.priorities, *pairs):
        if pose not in recipe.poses:
            raise UserError(f"{path}: [settings] names the pose {pose!r}; name poses of the set, in every part.")


def recipe_settings(recipe: Recipe, place: str) -> Settings | None:
    """What the recipe's set is made for; None for the preset "Paper"."""
    return None if recipe.settings is None else decode_settings(recipe.settings, place)
