"""Labels beside an animation → its schedule: Praat's TextGrid, or our own schedule JSON."""

from __future__ import annotations

import re
from pathlib import Path

from ..errors import UserError
from ..files import schedule_json
from ..files.atomic import read_bytes
from ..files.json_text import shown
from ..phonemes import SILENCE
from ..schedule import Schedule

MAX_BYTES = 64 * 2**20
#: Tiers of phones by their names, as aligners and annotators call them.
_TIERS = ("phones", "phone", "phonemes", "phoneme", "segments", "segment", "phon", "kan-mau", "mau", "ort-mau")
#: Labels of silence, breath and noise.
_SILENT = {"", "sil", "sp", "spn", "nsn", "<p>", "<p:>", "#", "_", "pau", "h#", "epi", "<sil>", "sp1", "brth", "ns"}
#: Seconds below which an interval is rounding.
ROUNDING = 0.002


def schedule_of(path: Path) -> Schedule:
    """The schedule in a .TextGrid or .json; UserError names file and cure."""
    if path.suffix.lower() == ".json":
        return schedule_json.load(path)
    return _text_grid(path)


def plain(label: str) -> str:
    """A label as our phones are written: lower case, no stress; silence, breath and noise are `sil`."""
    phone = re.sub(r"(?<=[a-z])[0-2]$", "", label.strip().casefold())
    return SILENCE if phone in _SILENT else phone


def _text_grid(path: Path) -> Schedule:
    from praatio import textgrid
    from praatio.utilities.errors import PraatioException

    data = read_bytes(path, MAX_BYTES, "TextGrid")
    if b"xmin" not in data.replace(b"\0", b"") and b"ooTextFile" not in data.replace(b"\0", b""):
        raise UserError(f"{path} is not a TextGrid: save it from Praat or an aligner again.")
    try:
        grid = textgrid.openTextgrid(str(path), includeEmptyIntervals=True, reportingMode="silence")
    except (PraatioException, ValueError, IndexError, KeyError, UnicodeError, AssertionError) as error:
        raise UserError(f"{path} is a damaged TextGrid ({shown(str(error), 80)}): save it from Praat again.") from error
    tiers = {name: grid.getTier(name) for name in grid.tierNames}
    spans = {name: tier.entries for name, tier in tiers.items() if isinstance(tier, textgrid.IntervalTier)}
    wanted = [name for known in _TIERS for name in spans if re.split(r"\s+-\s+", name)[-1].strip().casefold() == known]
    name = wanted[0] if wanted else max(spans, key=lambda n: len(spans[n]), default=None)
    if name is None or not spans[name]:
        raise UserError(f"{path} has no tier of intervals: label its phones in an interval tier named phones.")
    return _joined([(float(start), float(end), plain(label)) for start, end, label in spans[name]], path)


def _joined(spans: list[tuple[float, float, str]], path: Path) -> Schedule:
    """Gaps become silence, intervals without length go, neighbouring silences are one."""
    phones: list[str] = []
    times: list[float] = []
    end = spans[0][0]
    for begin, last, phone in sorted(spans):
        first = max(begin, end)
        if last - first < ROUNDING:
            continue
        if first - end >= ROUNDING:
            _add(phones, times, SILENCE, end)
        _add(phones, times, phone, first if first - end >= ROUNDING else end)
        end = last
    if not phones:
        raise UserError(f"{path} labels nothing that lasts: label its phones.")
    return Schedule(phones, [*times, end])


def _add(phones: list[str], times: list[float], phone: str, start: float) -> None:
    if not (phone == SILENCE and phones and phones[-1] == SILENCE):
        phones.append(phone)
        times.append(start)
