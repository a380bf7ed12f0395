"""Checked JSON values → the parts of a curve set. Every problem and every repair names its place."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

import msgspec
import numpy as np

from ..curve_set import STATUSES, Bigram
from ..curves import Curve
from ..errors import UserError
from ..phonemes import SILENCE, Pair
from .curve_set_records import MAX_DEPTH, MAX_KEYS, MAX_NAMES, MAX_TOLD, BigramRecord, HeadRecord
from .json_text import is_deeper, shown
from .keys import SLACK, mend
from .settings_json import unknown_fields


class Decoder:
    """Decodes the parts of one file.

    problems  one sentence each, naming bigram, pose and key; with any of them there is no set
    repairs   what was mended
    """

    def __init__(self, place: str) -> None:
        self.place = place
        self.problems: list[str] = []
        self.repairs: list[str] = []

    # ── the set's own fields ─────────────────────────────────────────────────────────────────────

    def head(self, top: dict[str, Any]) -> HeadRecord:
        """The fields of the set itself; UserError when one of them cannot be used."""
        place = self.place
        try:
            head = msgspec.convert(top, HeadRecord)
        except msgspec.ValidationError as error:
            raise UserError(f"{place}: {str(error)[:200].lower()}. Correct that value.") from error
        if head.phonemes is not None:
            self._check_names("phonemes", head.phonemes)
            if SILENCE in head.phonemes:
                raise UserError(f'{place}: "{SILENCE}" means silence and is no phoneme; remove it from "phonemes".')
        if head.poses is not None:
            self._check_names("poses", head.poses)
        return head

    def _check_names(self, what: str, names: list[str]) -> None:
        if not 1 <= len(names) <= MAX_NAMES:
            raise UserError(f'{self.place}: "{what}" has {len(names)} names; write 1 to {MAX_NAMES}.')
        odd = next((n for n in names if not is_usable_name(n) or ("-" in n and what == "phonemes")), None)
        if odd is not None:
            raise UserError(
                f'{self.place}: {odd[:60]!r} in "{what}" is not a usable name; write a short one without "-".'
            )
        if len(set(names)) < len(names):
            double = next(n for n in names if names.count(n) > 1)
            raise UserError(f'{self.place}: "{what}" names {double!r} twice; remove one.')

    def unknown(self, top: dict[str, Any]) -> dict[str, Any]:
        """What this version does not know, to be written again; that of the settings under "settings"."""
        known = {*HeadRecord.__struct_fields__, "schema", "settings", "bigrams", "aside"}
        extra = {name: value for name, value in top.items() if name not in known}
        if more := unknown_fields(top.get("settings") or {}):
            extra["settings"] = more
        if is_deeper(extra, MAX_DEPTH):
            raise UserError(f"{self.place} is nested too deeply to be one of our files: choose another.")
        return extra

    # ── bigrams ──────────────────────────────────────────────────────────────────────────────────

    def bigrams(
        self, value: Any, field: str, phonemes: Collection[str] | None, poses: Collection[str] | None
    ) -> dict[Pair, Bigram]:
        """The bigrams in a field of the file; without `phonemes` and `poses` any names will do."""
        if not isinstance(value, dict):
            self.problems.append(f'{self.place}: "{field}" is not an object; write {{"f-ah": {{…}}}}.')
            return {}
        found = {}
        for name, bigram_value in value.items():
            if len(self.problems) >= MAX_TOLD:
                self.problems.append(f"{self.place}: further problems are not listed.")
                break
            where = f"{self.place}, bigram {shown(name)}"
            first, dash, second = name.partition("-")
            if phonemes is None:
                known = is_usable_name(first) and is_usable_name(second) and "-" not in second
            else:
                known = first in phonemes and second in phonemes
            if not (dash and known):
                self.problems.append(f'{where}: not two phonemes of this set joined by "-"; correct or remove it.')
                continue
            bigram = self._bigram(bigram_value, where, poses)
            if bigram is not None:
                found[first, second] = bigram
        return found

    def _bigram(self, value: Any, where: str, poses: Collection[str] | None) -> Bigram | None:
        try:
            record = msgspec.convert(value, BigramRecord)
        except msgspec.ValidationError as error:
            self.problems.append(f"{where}: {str(error)[:200].lower()}. Correct that value.")
            return None
        if record.status not in STATUSES:
            self.problems.append(
                f"{where}: there is no status “{shown(record.status)}”; write one of {', '.join(STATUSES)}."
            )
            return None
        curves: dict[str, Curve] = {}
        for pose, keys in record.curves.items():
            if not (is_usable_name(pose) if poses is None else pose in poses):
                self.problems.append(
                    f'{where}: the pose “{shown(pose)}” is not in "poses"; correct the name or add it there.'
                )
            elif not keys:
                self.repairs.append(f"{where}, pose {pose}: a curve without keys was left out.")
            else:
                curve = self._curve(keys, f"{where}, pose {pose}")
                if curve is not None:
                    curves[pose] = curve
        extra = {k: v for k, v in value.items() if k not in BigramRecord.__struct_fields__}
        if is_deeper(extra, MAX_DEPTH):
            self.problems.append(f"{where}: an unknown field is nested too deeply; remove it.")
        return Bigram(curves, record.status, record.source, record.note, record.author, extra)

    def _curve(self, keys: list[Any], where: str) -> Curve | None:
        if len(keys) > MAX_KEYS:
            self.problems.append(f"{where}: {len(keys)} keys; at most {MAX_KEYS} are possible.")
            return None
        for i, key in enumerate(keys):
            if not (isinstance(key, list) and len(key) == 2 and all(type(x) in (int, float) for x in key)):
                self.problems.append(f"{where}, key {i}: not a pair of numbers [time, value].")
                return None
            if any(not -SLACK <= x <= 1 + SLACK for x in key):
                self.problems.append(
                    f"{where}, key {i}: {_short(key[0])}, {_short(key[1])} lies outside 0…1; correct it."
                )
                return None
        curve, mends = mend(np.array(keys, dtype=np.float64))
        if mends.clipped:
            self.repairs.append(f"{where}: {mends.clipped} keys a little outside 0…1 were clipped.")
        if mends.sorted:
            self.repairs.append(f"{where}: keys out of order were sorted.")
        if mends.merged:
            self.repairs.append(f"{where}: {mends.merged} keys at the time of another were merged, the highest kept.")
        return curve


def is_usable_name(name: str) -> bool:
    """Whether a phoneme or pose may be called so."""
    return 0 < len(name) <= 60 and name.isprintable()


def _short(number: float) -> str:
    """A number for a message; a file may hold integers of thousands of digits."""
    return f"{number:.4g}" if abs(number) < 1e300 else "a number of hundreds of digits"
