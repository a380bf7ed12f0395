"""SmartBody's diphone scripts, line by line. They look like Python; they are read as text and never run.

    diphone = diphoneManager.createDiphone("ao", "er", "default")
    diphone.addKey("W", 0.0574413, -0.00291545)

One line a statement. `createDiphone` on a pair that is there goes on with it; one script may fill several sets.
Lines of any other kind are passed over, and counted.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from ..errors import UserError
from ..phonemes import Pair
from .atomic import read_bytes
from .curve_set_decode import is_usable_name
from .curve_set_records import MAX_KEYS
from .json_text import decode_text, shown

#: The set of 441 that came with SmartBody takes one megabyte.
MAX_BYTES = 8 * 2**20
#: Lines that are neither ours nor comments; a file with more is something else.
MAX_OTHER_LINES = 5000

_TEXT = r"""(?:"([^"\\]*+)"|'([^'\\]*+)')"""
_NUMBER = r"([-+]?+(?:\d++\.?+\d*+|\.\d++)(?:[eE][-+]?+\d++)?+)"
_CREATE = re.compile(
    rf"(?:(\w++)\s*+=\s*+)?+(?:\w++\s*+\.\s*+)*+createDiphone\s*+\(\s*+{_TEXT}\s*+,\s*+{_TEXT}\s*+(?:,\s*+{_TEXT}\s*+)?+\)"
)
_ADD = re.compile(rf"(\w++)\s*+\.\s*+addKey\s*+\(\s*+{_TEXT}\s*+,\s*+{_NUMBER}\s*+,\s*+{_NUMBER}\s*+\)")
_MANAGER = re.compile(r"\w++\s*+=\s*+(?:\w++\s*+\.\s*+)*+getDiphoneManager\s*+\(\s*+\)")
_END = re.compile(r"\s*+;?+\s*+(?:#.*+)?+")
#: Triple quotes, a comment, or what stands in a line before either.
_PIECE = re.compile(r'''("""|\'{3})|(#[^\r\n]*+)|(?:(?!"""|\'{3})[^\r\n#])++''')

#: Pose → (time, value) in the order of the lines.
Keys = dict[str, list[tuple[float, float]]]


@dataclass
class ScriptSet:
    """One set of a script as it stands there: pair → pose → keys in the order of the lines, and how often made."""

    name: str
    pairs: dict[Pair, Keys] = field(default_factory=dict)
    made: Counter[Pair] = field(default_factory=Counter)


@dataclass(frozen=True)
class Script:
    """What a script says. `notes` are about the whole file: lines passed over, odd names."""

    place: str
    sets: Mapping[str, ScriptSet]
    notes: tuple[str, ...]

    def largest(self) -> str:
        """The name of the set with the most pairs, the first of several."""
        return max(self.sets, key=lambda name: len(self.sets[name].pairs))


def read_script(path: Path | str) -> Script:
    """The script in a file; UserError when it cannot be read or is none."""
    return parse_script(read_bytes(path, MAX_BYTES, "diphone script"), str(path))


def parse_script(data: bytes, place: str) -> Script:
    """As `read_script`, from bytes; `place` names the file in messages."""
    notes = []
    try:
        text = decode_text(data, place)
    except UserError:
        if b"createDiphone" not in data:
            raise
        text = data.decode("latin-1")
        notes.append(f"{place} is not UTF-8: it was read as Latin-1.")
    if "createDiphone" not in text:
        raise UserError(f'{place} is no diphone script: it has no line with createDiphone("…", "…"). Choose another.')
    reader = _Reader(place)
    for line, statement in _lines(text, place):
        reader.read(line, statement)
    if not reader.sets:
        raise UserError(f"{place} is no diphone script that can be read: no createDiphone line is whole.")
    return Script(place, reader.sets, (*notes, *reader.notes()))


def _lines(text: str, place: str) -> Iterable[tuple[int, str]]:
    """(line number, statement) of every line that has one. Comments and strings over several lines are none."""
    line, last, position = 1, 0, 0
    while piece := _PIECE.search(text, position):
        line += _line_ends(text, last, piece.start())
        last, position = piece.start(), piece.end()
        if piece[1]:
            end = text.find(piece[1], position)
            if end < 0:
                raise UserError(f"{place}, line {line}: a string begins with {piece[1]} and never ends; end it.")
            position = end + 3
        elif piece[2] is None and (statement := piece[0].strip()):
            yield line, statement


def _line_ends(text: str, start: int, end: int) -> int:
    return text.count("\n", start, end) or text.count("\r", start, end)


class _Reader:
    """Takes a script line by line."""

    def __init__(self, place: str) -> None:
        self.place = place
        self.sets: dict[str, ScriptSet] = {}
        self._current: dict[str, Keys] = {}  # variable → the keys it adds to
        self._others: list[tuple[int, str]] = []
        self._homeless: list[int] = []
        self._keys = 0

    def read(self, line: int, statement: str) -> None:
        """One line that is not empty."""
        match = None if len(statement) > 1000 else _ADD.match(statement)
        if match is not None and _END.fullmatch(statement, match.end()):
            keys = self._current.get(match[1])
            pose = match[2] if match[2] is not None else match[3]
            if keys is None or not is_usable_name(pose):
                self._homeless.append(line)
                return
            curve = keys.setdefault(pose, [])
            curve.append((float(match[4]), float(match[5])))
            if len(curve) > MAX_KEYS:
                raise UserError(f"{self.place}, line {line}: a curve of more than {MAX_KEYS} keys; remove some.")
            return
        match = None if len(statement) > 1000 else _CREATE.match(statement)
        if match is not None and _END.fullmatch(statement, match.end()):
            first, second = match[2] or match[3] or "", match[4] or match[5] or ""
            if all(is_usable_name(phone) and "-" not in phone for phone in (first, second)):
                self._create(match[1] or "", (first, second), match[6] or match[7] or "default")
                return
            self._current.pop(match[1] or "", None)
        match = _MANAGER.match(statement)
        if match is not None and _END.fullmatch(statement, match.end()):
            return
        self._others.append((line, statement))
        if len(self._others) > MAX_OTHER_LINES:
            raise UserError(f"{self.place} holds thousands of lines that no diphone script has: choose another file.")

    def _create(self, variable: str, pair: Pair, name: str) -> None:
        script_set = self.sets.setdefault(name, ScriptSet(name))
        script_set.made[pair] += 1
        self._current[variable] = script_set.pairs.setdefault(pair, {})

    def notes(self) -> list[str]:
        """What was passed over."""
        told = []
        if self._others:
            line, text = self._others[0]
            told.append(
                f"{self.place}: {many(len(self._others), 'line')} not understood and passed over "
                f"(the first is line {line}: {shown(text, 60)})."
            )
        if self._homeless:
            told.append(
                f"{self.place}: {many(len(self._homeless), 'key')} of no diphone or no usable pose left out "
                f"(the first is in line {self._homeless[0]})."
            )
        return told


def many(count: int, noun: str) -> str:
    """ "1 key", "2 keys"."""
    return f"{count} {noun}{'' if count == 1 else 's'}"
