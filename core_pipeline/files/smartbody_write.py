"""A curve set → a SmartBody diphone script, as text that SmartBody's Python reads."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ..curve_set import Bigram, CurveSet
from ..errors import UserError
from ..phonemes import SILENCE, Pair
from .atomic import write_atomically
from .curve_set_text import in_order


def save_script(curve_set: CurveSet, path: Path | str) -> None:
    """Write the script atomically; UserError when that fails or a name cannot stand in it."""
    write_atomically(path, script(curve_set))


def script(curve_set: CurveSet) -> str:
    """The script's text: all layers, and what was kept aside. UserError when a name has a quote or a backslash.

    Statuses, notes and settings have no place in such a script.
    """
    everything: Mapping[Pair, Bigram] = {**curve_set.aside, **curve_set.bigrams}
    blocks = [_diphone(pair, everything[pair], curve_set) for pair in in_order(everything, curve_set.phonemes)]
    return "diphoneManager = scene.getDiphoneManager()\n\n" + "\n".join(blocks)


def _diphone(pair: Pair, bigram: Bigram, curve_set: CurveSet) -> str:
    first, second = ("_" if phone == SILENCE else _checked(phone) for phone in pair)
    lines = [f'diphone = diphoneManager.createDiphone("{first}", "{second}", "{_checked(curve_set.name)}")\n']
    order = dict.fromkeys((*curve_set.poses, *bigram.curves))
    for pose in order:
        if pose in bigram.curves:
            name = _checked(pose)
            keys = bigram.curves[pose].keys()
            lines.append("".join(f'diphone.addKey("{name}", {_number(t)}, {_number(v)})\n' for t, v in keys))
    return "\n".join(lines) if len(lines) > 1 else lines[0]


def _checked(name: str) -> str:
    if '"' in name or "\\" in name or not name.isprintable():
        raise UserError(f"The name {name!r} cannot stand in a script: rename it first, without quotes and backslashes.")
    return name


def _number(value: float) -> str:
    """Short, and the same number again when read."""
    text = f"{value:.6g}"
    return text if float(text) == value else repr(value)
