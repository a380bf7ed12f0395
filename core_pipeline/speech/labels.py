"""Label file → Utterance: other programs' phone names become ours, closures join their stops, gaps become silence."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from ..errors import UserError
from ..files.json_text import shown
from ..files.labels.label_file import Interval, LabelFile
from ..phonemes import SILENCE
from .espeak_phones import FIRST
from .phone_names import CLOSURES, is_silence, translated
from .spans import ROUNDING, PhoneSpan, to_schedule
from .utterance import Audio, Utterance, Word


@dataclass(frozen=True)
class Named:
    """An utterance, and the names nobody knows, which became silence until somebody assigns them."""

    utterance: Utterance
    unknown: tuple[str, ...]


def utterance_of(
    labels: LabelFile, audio: Audio | None = None, assigned: Mapping[str, str] | None = None, known: Iterable[str] = ()
) -> Named:
    """The utterance a label file describes; with its recording it lasts as long as that, from 0 on.

    assigned  name → phone, as the user decided earlier
    known     phones of the curve set
    UserError when there is no sound of speech in it at all.
    """
    names, unknown = translated((i.name for i in labels.phones), assigned or {}, known)
    start, end = (0.0, audio.duration) if audio else (labels.start, labels.end)
    spans: list[PhoneSpan] = []
    for interval in _closed(labels.phones):
        spans += _parts(interval, names[interval.name])
    if all(phone == SILENCE for phone, _, _ in spans) and not unknown:
        raise UserError("The label file holds nothing but silence: choose another.")
    notes = list(labels.notes)
    overlaps = sum(a.end - b.start > 2 * ROUNDING for a, b in zip(labels.phones, labels.phones[1:], strict=False))
    if overlaps:
        notes.append(f"{overlaps} labels overlap the next one: they were cut at its start.")
    if audio and labels.end > audio.duration + 0.25:
        notes.append(f"The labels last {labels.end:.1f} s, the recording {audio.duration:.1f} s: is it the right one?")
    if unknown:
        names_ = ", ".join(shown(name, 12) for name in unknown[:8]) + (" …" if len(unknown) > 8 else "")
        notes.append(f"Unknown phone names became silence: {names_}.")
    if any(i.name.strip().lower() == "spn" for i in labels.phones):
        notes.append("Where the labels say “spn” (words the aligner did not know), the mouth rests.")
    words = tuple(
        Word(i.name, max(i.start, start), min(i.end, end))
        for i in labels.words
        if not is_silence(i.name) and min(i.end, end) > max(i.start, start)
    )
    text = " ".join(word.text for word in words)
    return Named(Utterance(text, to_schedule(spans, start, end), audio, words, tuple(notes)), tuple(unknown))


def _closed(intervals: Sequence[Interval]) -> list[Interval]:
    """TIMIT writes a stop as closure and burst: they are one phone here."""
    joined: list[Interval] = []
    for interval in intervals:
        before = joined[-1] if joined else None
        if (
            before is not None
            and interval.name.lower() in CLOSURES.get(before.name.lower(), ())
            and abs(interval.start - before.end) <= ROUNDING
        ):
            joined[-1] = Interval(before.start, interval.end, interval.name)
        else:
            joined.append(interval)
    return joined


def _parts(interval: Interval, phones: Sequence[str]) -> list[PhoneSpan]:
    """One or two phones in an interval; the first takes FIRST of the time."""
    start, end, _ = interval
    if len(phones) != 2:
        return [(phones[0] if phones else SILENCE, start, end)]
    middle = start + FIRST * (end - start)
    return [(phones[0], start, middle), (phones[1], middle, end)]
