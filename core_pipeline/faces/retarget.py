"""Which of a rig's shapes make up each viseme pose: names are compared, and the preset that fits best is taken.

The paper's poses are FaceFX's (section 3.1.2, figure 4); rigs come with other shapes. A preset says how to mix
a pose from the shapes of one naming convention; presets are files, see assets/retarget.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType

from core_pipeline.faces.affixes import bare_names
from core_pipeline.poses import FACEFX

Mix = Mapping[str, float]

#: A pose can be made when the rig has the shapes that carry this much of it.
ENOUGH = 0.5
#: Name of the mapping in which every pose is the shape of the same name.
OWN_NAMES = "own names"

_NONE: Mapping[str, Mix] = MappingProxyType({})
_SIDE = re.compile(r"(left|right)$")
_ONE_SIDE = re.compile(r"_?(Left|Right|[UD]?[LR])$")
_PREFIX = re.compile(r"^(ctrlexpressions|.*(?=fcl(mth|eye|brw|all|ha)))")
_COPY = re.compile(r"\.\d+$")
_SCENE = re.compile(r"^.*[.:|](?=.)")


@dataclass(frozen=True)
class Preset:
    """How one naming convention makes the poses.

    poses    pose → {shape: amount}, both sides written out
    aliases  shape → other names it goes by
    names    shapes by which a rig of this convention is recognised
    """

    name: str
    title: str
    poses: Mapping[str, Mix]
    aliases: Mapping[str, Sequence[str]] = field(default_factory=dict)
    names: frozenset[str] = frozenset()


@dataclass(frozen=True)
class Retarget:
    """A preset met a rig: what each pose is made of, which poses cannot be made, and what is worth knowing.

    preset  the preset's name, or OWN_NAMES
    title   the same for people
    poses   pose → {shape of the rig: amount}
    notes   one sentence each
    """

    preset: str
    title: str
    poses: Mapping[str, Mix]
    missing: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()


def normalised(name: str) -> str:
    """A shape's name as it is compared: no prefix, no case, no separators, sides as l and r.

    "Head.mouthSmile_L" and "mouth smile left" are one; the ".001" some programs append is no name, and neither
    is MetaHuman's "CTRL_expressions" or what VRoid writes before "Fcl_".
    """
    plain = _last(name).casefold()
    plain = plain.replace("_", "").replace(" ", "").replace("-", "")
    return _SIDE.sub(lambda side: side[0][0], _PREFIX.sub("", plain))


def _last(name: str) -> str:
    """A name without what a scene puts before it: "Head.", "Face:", "Group|"."""
    return _SCENE.sub("", _COPY.sub("", name))


class Rig:
    """The shapes of a rig, to be found by any spelling; failing that, by what is left without common affixes."""

    def __init__(self, shapes: Iterable[str]) -> None:
        self._found: dict[str, list[str]] = {}
        last: dict[str, list[str]] = {}
        for shape in shapes:
            self._found.setdefault(normalised(shape), []).append(shape)
            last.setdefault(_last(shape), []).append(shape)
        self._bare: dict[str, list[str]] = {}
        for name, bare in bare_names(last).items():
            self._bare.setdefault(normalised(bare), []).extend(last[name])

    def shapes(self, wanted: str, preset: Preset) -> list[str]:
        """The rig's shapes for a preset's one: by its name or an alias, else both sides in one (mouthSmile)."""
        names = [wanted, *preset.aliases.get(wanted, ())]
        names += [_ONE_SIDE.sub("", name) for name in names]
        keys = [normalised(name) for name in names]
        return next((found for by in (self._found, self._bare) for key in keys if (found := by.get(key))), [])

    def overlap(self, preset: Preset) -> int:
        """How many of the rig's shapes the preset knows; one that stands for several of its names counts once."""
        return len({shape for name in preset.names for shape in self.shapes(name, preset)})


def best(
    shapes: Sequence[str],
    presets: Iterable[Preset],
    poses: Sequence[str] = FACEFX,
    expressions: Mapping[str, Mix] = _NONE,
) -> Retarget:
    """The preset that knows most of the rig's names, applied; the rig's own names where they are the poses.

    poses        the pose set of the curves that shall play; poses no preset knows are looked for by name
    expressions  what the rig's author made of its shapes: names that count as much as shapes do
    """
    rig = Rig((*shapes, *expressions))
    own = Preset(OWN_NAMES, "its own pose names", {pose: {pose: 1.0} for pose in poses}, names=frozenset(poses))
    overlaps = [(rig.overlap(preset), preset) for preset in (*presets, own)]
    most, chosen = max(overlaps, key=lambda found: found[0])
    if not most:
        told = f"No naming convention fits these shapes ({_listed(shapes)}): say yourself what makes each pose."
        return Retarget(OWN_NAMES, own.title, MappingProxyType({}), tuple(poses), (told,))
    return apply(chosen, shapes, poses, expressions)


def apply(
    preset: Preset, shapes: Sequence[str], poses: Sequence[str] = FACEFX, expressions: Mapping[str, Mix] = _NONE
) -> Retarget:
    """The poses as this rig can make them by `preset`."""
    made_of = {name: mix for name, mix in expressions.items() if name not in shapes}
    rig = Rig((*made_of, *shapes))
    made: dict[str, Mix] = {}
    notes: list[str] = []
    for pose in poses:
        wanted = preset.poses.get(pose, {pose: 1.0})
        mix, lacking = _mixed(rig, preset, wanted)
        if not mix or _share(wanted, lacking) > ENOUGH * _share(wanted, wanted):
            continue
        made[pose] = MappingProxyType(_in_shapes(mix, made_of))
        if lacking:
            notes.append(f"{pose} is made without {', '.join(lacking)}: the rig has no such shape.")
    missing = tuple(pose for pose in poses if pose not in made)
    if missing:
        notes.append(f"Not available on this face: {', '.join(missing)}.")
    return Retarget(preset.name, preset.title, MappingProxyType(made), missing, tuple(notes))


def _in_shapes(mix: Mix, expressions: Mapping[str, Mix]) -> dict[str, float]:
    """A mix of shapes and expressions as one of shapes alone."""
    amounts: dict[str, float] = {}
    for name, amount in mix.items():
        for shape, part in expressions.get(name, {name: 1.0}).items():
            amounts[shape] = max(amounts.get(shape, 0.0), amount * part)
    return amounts


def _share(wanted: Mix, names: Iterable[str]) -> float:
    """How much of a pose some of its shapes carry; a shape of one side carries half."""
    return sum(abs(wanted[name]) * (0.5 if _ONE_SIDE.search(name) else 1.0) for name in names)


def _mixed(rig: Rig, preset: Preset, wanted: Mix) -> tuple[dict[str, float], list[str]]:
    """The rig's shapes for a mix, and the names it lacks; a shape asked for twice (both sides in one) counts once."""
    mix: dict[str, float] = {}
    lacking: list[str] = []
    found = {name: rig.shapes(name, preset) for name in wanted}
    for name, amount in wanted.items():
        if not found[name]:
            lacking.append(name)
        for shape in found[name]:
            mix[shape] = max(mix.get(shape, 0.0), amount)
    return _closed_no_wider_than_open(mix), lacking


def _closed_no_wider_than_open(mix: dict[str, float]) -> dict[str, float]:
    """mouthClose takes back what jawOpen does to the lips; with more of it than of jawOpen they pass each other."""
    opened = max((amount for shape, amount in mix.items() if "jawopen" in normalised(shape)), default=0.0)
    kept = {
        shape: min(amount, opened) if "mouthclose" in normalised(shape) else amount for shape, amount in mix.items()
    }
    return {shape: amount for shape, amount in kept.items() if amount}


def _listed(shapes: Sequence[str], most: int = 4) -> str:
    return ", ".join(shapes[:most]) + (" …" if len(shapes) > most else "")
