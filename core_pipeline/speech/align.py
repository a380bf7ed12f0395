"""Recording + transcript → Utterance: forced alignment with pocketsphinx, in pieces of bounded size.

A short recording is aligned at once. A long one is taken window by window: as many of the next words
as fit are found with an open end, those up to a pause are kept, and the next window begins there. So
time grows with the length and memory does not.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..errors import UserError
from . import cut
from .audio_file import resampled
from .espeak import Espeak
from .spans import PhoneSpan, to_schedule
from .sphinx import RATE, AlignedWord, Sphinx
from .transcript import Transcript, our_name, parse, pronounced
from .utterance import Audio, Utterance, Word

#: Fraction done, 0…1.
Progress = Callable[[float], None]

#: Seconds of sound in one window; what is left at the end may be a little longer.
WINDOW, LAST_WINDOW = 24.0, 30.0
#: Nobody says more words in a second.
FASTEST_WORDS = 7.0
#: Mean score of a frame below which words are not those of the recording (right ones: −9 to −35, wrong ones below −58).
BAD_FIT = -50.0
#: Part of the loud sound that may lie outside all words.
LEFT_OVER = 0.15


def align(
    audio: Audio, text: str, sphinx: Sphinx, espeak: Espeak, progress: Progress | None = None, voice: str = "en-us"
) -> Utterance:
    """When each word and phone of `text` sounds in the recording; notes say what is doubtful.

    UserError when the recording is silent, or the words cannot be those of the recording; `Cancelled`
    after `sphinx.cancel()`.
    """
    transcript = parse(text)
    cut.refuse_silence(audio.samples, audio.rate)
    if audio.duration < 0.06 * len(transcript.words):
        raise UserError(
            f"The recording lasts {audio.duration:.2g} s, too short for {len(transcript.words)} words: "
            "check that text and recording belong together."
        )
    sound = levelled(resampled(audio, RATE).samples)
    unknown = sphinx.unknown(sorted(set(transcript.words)))
    work = _Work(sound, transcript, sphinx, pronounced(unknown, espeak, voice), progress or (lambda _: None))
    work.run()
    return _utterance(audio, transcript, work, unknown)


def levelled(sound: NDArray[np.float32]) -> NDArray[np.float32]:
    """At a usual loudness, so that a faint recording is not lost in 16 bits."""
    peak = float(np.abs(sound).max(initial=0))
    return sound * np.float32(min(0.5 / peak, 100)) if 0 < peak < 0.25 else sound


@dataclass
class _Work:
    """One alignment on its way through the recording."""

    sound: NDArray[np.float32]
    transcript: Transcript
    sphinx: Sphinx
    spoken: dict[str, str]
    progress: Progress
    words: list[AlignedWord] = field(default_factory=list)
    doubtful: list[tuple[float, float]] = field(default_factory=list)
    wide: bool = False

    def run(self) -> None:
        self.levels = cut.loudness(self.sound, RATE)
        self.level = cut.speech_level(self.levels)
        total, start = self.sound.size / RATE, 0.0
        while (count := sum(map(_is_word, self.words))) < len(self.transcript.words):
            self.progress(start / total)
            rest = self.transcript.words[count:]
            if total - start <= LAST_WINDOW:
                self._keep(self._found(start, total, rest, open_end=False), start, total)
                break
            end = cut.quietest(self.levels, start + WINDOW - 6, start + WINDOW)
            if self._seconds_of_speech(start, end) < 0.15:
                start = end
                continue
            start = self._next(start, end, rest)
        self.progress(1.0)

    def _next(self, start: float, end: float, rest: Sequence[str]) -> float:
        """Keep the words of a window up to a safe place; that place."""
        most = round((end - start) * FASTEST_WORDS)
        found = self._found(start, end, rest[:most], open_end=True)
        if sum(map(_is_word, found)) == len(rest):
            self._keep(found, start, end)
            return end
        pauses = [w for w in found if not _is_word(w) and w.end - w.start > 0.12]
        safe = [w.start + (w.end - w.start) / 2 for w in pauses if (end - start) / 3 < w.start < end - start - 1.5]
        last = start + (safe[-1] if safe else max(w.end for w in found if w.end < end - start - 1.5 or w is found[0]))
        self._keep([w for w in found if start + w.start < last - 0.01], start, last)
        return max(last, start + 0.5)

    def _found(self, start: float, end: float, words: Sequence[str], *, open_end: bool) -> list[AlignedWord]:
        """The words in a window, in seconds of the window. A wider search when they do not fit."""
        part = self.sound[round(start * RATE) : round(end * RATE)]
        for wide in (False, True):
            found = self.sphinx.align(part, words, self.spoken, wide=wide, open_end=open_end)
            if found:
                self.wide |= wide
                return found
        if start > 0 and not open_end:  # the text goes on after the speech has ended, or lost its way
            raise UserError(
                f"From {_clock(start)} on the remaining {len(words)} words (“{' '.join(words[:6])} …”) do not fit the "
                "recording: check that the transcript is complete and says nothing else."
            )
        raise UserError(
            f"The words do not fit the recording{f' at {_clock(start)}' if start else ''}: "
            "check that the transcript says what is spoken, in English."
        )

    def _keep(self, found: list[AlignedWord], start: float, end: float) -> None:
        scores = [p.score for w in found if _is_word(w) for p in w.phones]
        if scores and (float(np.mean(scores)) < BAD_FIT or self._is_left_over(found, start, end)):
            self.doubtful.append((start, end))
        self.words += [
            AlignedWord(
                w.name,
                start + w.start,
                min(start + w.end, end),
                tuple(p._replace(start=start + p.start, end=min(start + p.end, end)) for p in w.phones),
            )
            for w in found
        ]

    def _is_left_over(self, found: Sequence[AlignedWord], start: float, end: float) -> bool:
        """Whether much of what is loud enough for speech lies outside all words."""
        loud = self.levels[round(start / cut.STEP) : round(end / cut.STEP)] > self.level
        outside = loud.copy()
        for word in filter(_is_word, found):
            outside[max(0, int((word.start - 0.03) / cut.STEP)) : round((word.end + 0.03) / cut.STEP)] = False
        return bool(np.count_nonzero(outside) > max(0.4 / cut.STEP, LEFT_OVER * np.count_nonzero(loud)))

    def _seconds_of_speech(self, start: float, end: float) -> float:
        part = self.levels[max(0, round(start / cut.STEP)) : round(end / cut.STEP)]
        return float(np.count_nonzero(part > self.level)) * cut.STEP


def _utterance(audio: Audio, transcript: Transcript, work: _Work, unknown: Sequence[str]) -> Utterance:
    phones: list[PhoneSpan] = [(our_name(p.name), p.start, p.end) for w in work.words for p in w.phones]
    spoken = [w for w in work.words if _is_word(w)]
    words = _words(transcript, spoken, audio.duration)
    notes = []
    if work.doubtful:
        places = ", ".join(f"{_clock(a)}–{_clock(b)}" for a, b in _joined(work.doubtful)[:4])
        where = "" if len(work.words) and work.doubtful == [(0.0, work.sound.size / RATE)] else f" at {places}"
        notes.append(f"The words fit the recording badly{where}: check the transcript.")
    elif work.wide:
        notes.append("The words fit the recording only loosely: check the transcript.")
    if unknown:
        names = ", ".join(unknown[:5]) + (" and others" if len(unknown) > 5 else "")
        notes.append(f"Not in the dictionary, so pronounced as espeak-ng would: {names}.")
    return Utterance(transcript.text, to_schedule(phones, 0.0, audio.duration), audio, words, tuple(notes))


def _words(transcript: Transcript, spoken: Sequence[AlignedWord], end: float) -> tuple[Word, ...]:
    """A token of several parts, such as a number, lasts from the first to the last of them."""
    spans: dict[int, tuple[float, float]] = {}
    for word, owner in zip(spoken, transcript.owners, strict=False):
        first = spans.get(owner, (max(0.0, word.start), 0.0))[0]
        spans[owner] = (first, min(word.end, end))
    return tuple(Word(transcript.tokens[i], a, b) for i, (a, b) in spans.items() if b > a)


def _joined(spans: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    joined: list[tuple[float, float]] = []
    for a, b in spans:
        if joined and a <= joined[-1][1] + 0.01:
            joined[-1] = (joined[-1][0], b)
        else:
            joined.append((a, b))
    return joined


def _is_word(word: AlignedWord) -> bool:
    return word.name[:1] not in "<["


def _clock(seconds: float) -> str:
    """ "2:05"."""
    return f"{int(seconds) // 60}:{int(seconds) % 60:02d}"
