"""Typed sentence → Utterance with espeak-ng, which runs in a process of its own (espeak_process.py).

One process is kept warm. When it dies it is started again; when it hangs it is killed. Its times are
those of the sound, so picture and sound agree to the sample.
"""

from __future__ import annotations

import sys
import threading
import weakref
from collections import OrderedDict
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from ..errors import UserError
from ..files.json_text import shown
from ..phonemes import SILENCE
from ..schedule import Schedule
from . import mandarin
from .child_process import ChildProcess
from .espeak_phones import Mark, settled, to_phones
from .sentence import Sentence, shortened, tokens
from .utterance import Audio, Utterance, Word

#: Voice → what to call it.
VOICES: Mapping[str, str] = MappingProxyType(
    {
        "en-us": "American English",
        "gmw/en": "British English",
        "en-us+f3": "American English, higher voice",
        "gmw/en+f3": "British English, higher voice",
    }
)
#: All of them, with those of other languages.
ALL_VOICES: Mapping[str, str] = MappingProxyType({**VOICES, mandarin.VOICE: "Mandarin"})
#: What people and language tags call some of them.
NICKNAMES: Mapping[str, str] = MappingProxyType(
    {
        "american": "en-us",
        "british": "gmw/en",
        "en-gb": "gmw/en",
        "mandarin": mandarin.VOICE,
        "cmn": mandarin.VOICE,
        "zh": mandarin.VOICE,
    }
)
#: Words per minute that espeak can speak.
SLOWEST, FASTEST = 80, 450
#: espeak's own pitch; it goes from 0 to 99.
PITCH = 50
#: Silence added around the sound, in seconds: time for the lips to take the first shape and leave the last.
LEAD, TAIL = 0.1, 0.2
#: Samples kept in the cache, over all utterances: about eight minutes.
_CACHE = 10_000_000

_PROGRAM = Path(__file__).with_name("espeak_process.py")


class NoVoice(Exception):  # noqa: N818 - a state of the machine, no error of the user's
    """espeak-ng cannot speak here; str() says why, as a part of a sentence."""


def voice_named(name: str) -> str:
    """A voice by its own name or a nickname, capitals or not; UserError when there is none."""
    plain = name.strip().lower().replace("_", "-")
    voice = NICKNAMES.get(plain, plain)
    if voice not in ALL_VOICES:
        raise UserError(f"There is no voice “{shown(name)}”: choose one of {', '.join([*ALL_VOICES, *NICKNAMES])}.")
    return voice


class Espeak:
    """Speaks with a warm process. Any thread may call; one sentence at a time is spoken.

    library, data  the library and its folder of data; by default those of the package espeakng-loader
    timeout        seconds for one sentence, and for starting
    """

    def __init__(self, library: str = "", data: str = "", timeout: float = 15.0) -> None:
        self._command = [sys.executable, "-P", str(_PROGRAM), library, data]
        self._timeout = timeout
        self._lock = threading.Lock()
        self._process: ChildProcess | None = None
        self._missing = ""
        self._closed = False
        self._cache: OrderedDict[tuple[str, str, int, int], Utterance] = OrderedDict()

    @property
    def process_id(self) -> int | None:
        """Of the warm process; None before the first sentence and after its death."""
        process = self._process
        return process.id if process and process.alive else None

    def warm_up(self) -> None:
        """Start the process now, so that the first sentence need not wait. NoVoice when it cannot."""
        with self._lock:
            self._running()

    def close(self) -> None:
        """End the process, even in the middle of a sentence. Afterwards every sentence is NoVoice."""
        self._closed = True
        if process := self._process:
            process.stop()

    def speak(self, sentence: Sentence, voice: str = "en-us", rate: int = 175, pitch: int = PITCH) -> Utterance:
        """The sentence as sound and phones.

        rate   words per minute, 80…450
        pitch  0…99
        UserError for an unknown voice, an impossible rate or pitch, or when nothing is heard; NoVoice without espeak.
        """
        voice = voice_named(voice)
        if not SLOWEST <= rate <= FASTEST:
            raise UserError(f"A rate of {rate} words per minute cannot be spoken: choose {SLOWEST} to {FASTEST}.")
        if not 0 <= pitch <= 99:
            raise UserError(f"A pitch of {pitch} cannot be spoken: choose 0 to 99.")
        key = (sentence.text, voice, rate, pitch)
        with self._lock:
            if (found := self._cache.get(key)) is None:
                found = self._cache[key] = self._utter(*key)
                while sum(u.audio.samples.size for u in self._cache.values() if u.audio) > _CACHE:
                    self._cache.popitem(last=False)
            self._cache.move_to_end(key)
        if not sentence.notes:
            return found
        return Utterance(found.text, found.schedule, found.audio, found.words, sentence.notes + found.notes)

    def _utter(self, text: str, voice: str, rate: int, pitch: int) -> Utterance:
        request: dict[str, object] = {"text": text, "voice": voice, "rate": rate, "pitch": pitch}
        try:
            answer, sound = self._running().ask(request, self._timeout)
        except EOFError:  # it died, now or since the last sentence: once more with a new one
            if self._process:
                self._process.stop()  # it may be dying still
            try:
                answer, sound = self._running().ask(request, self._timeout)
            except EOFError as error:
                raise NoVoice(f"espeak-ng stopped while speaking ({error})") from None
        if problem := answer.get("error"):
            raise NoVoice(f"espeak-ng cannot speak this: {problem}")
        return _utterance(text, voice, answer, sound, self._rate)

    def _running(self) -> ChildProcess:
        """The process, started if need be."""
        if self._closed:
            raise NoVoice("the voice was closed")
        if self._process and self._process.alive:
            return self._process
        if self._missing:  # what failed to load once would fail again
            raise NoVoice(self._missing)
        if self._process:
            self._process.stop()
        try:
            self._process = ChildProcess(self._command)
            weakref.finalize(self, self._process.stop)  # at the latest when Python ends
            greeting, _ = self._process.receive(self._timeout)
        except (OSError, EOFError) as error:
            self._missing = f"espeak-ng does not start ({error})"
            raise NoVoice(self._missing) from None
        if problem := greeting.get("error"):
            self._process.stop()
            self._missing = f"espeak-ng does not start ({problem})"
            raise NoVoice(self._missing)
        self._rate = int(greeting["rate"])
        return self._process


def _utterance(text: str, voice: str, answer: Mapping[str, Any], sound: bytes, rate: int) -> Utterance:
    lead = round(LEAD * rate)
    samples = np.pad(np.frombuffer(sound, "<i2"), (lead, round(TAIL * rate)))
    end = samples.size / rate
    marks: list[Mark] = [(str(name), (at + lead) / rate) for name, at in answer["phones"]]
    spoken = [(int(position), (at + lead) / rate) for position, _, at in answer["words"]]
    chinese = voice == mandarin.VOICE
    if chinese:
        marks = [mark for mark in marks if mark[0] != mandarin.SYLLABLE_END]
    marks = settled(marks, samples, rate)
    if chinese:
        phones = mandarin.to_mandarin(marks, end, spoken, text)
    else:
        phones = to_phones(marks, end, british=not voice.startswith("en-us"))
    if all(phone == SILENCE for phone in phones.schedule.phones):
        raise UserError(f"Nothing in “{shortened(text)}” can be spoken: type at least one word.")
    notes = [f"The sound {name!r} of the voice is unknown and became silence." for name in phones.unknown]
    audio = Audio(samples.astype(np.float32) / np.float32(32768), rate)
    audio.samples.flags.writeable = False
    words = (mandarin.words if chinese else _words)(text, spoken, phones.schedule)
    return Utterance(text, phones.schedule, audio, words, tuple(notes))


def _words(text: str, spoken: list[tuple[int, float]], schedule: Schedule) -> tuple[Word, ...]:
    """Each word between blanks from its first phone to its last.

    spoken  where espeak began a word: the character, the second. A number has several; two words it
            reads as one ("of the") have one, and are one word here.
    """
    phones, times = schedule.phones, schedule.times
    onsets = [float(t) for t, phone in zip(times[:-1], phones, strict=True) if phone != SILENCE]
    starts: list[tuple[str, float]] = []
    for word, first, last in tokens(text):
        at = next((second for position, second in spoken if first <= position < last), None)
        if at is not None:
            starts.append((word, min(onsets, key=lambda t: abs(t - at))))
        elif starts and any(c.isalnum() for c in word):
            starts[-1] = (f"{starts[-1][0]} {word}", starts[-1][1])
    words = []
    for i, (word, start) in enumerate(starts):
        stop = starts[i + 1][1] if i + 1 < len(starts) else float(times[-1])
        last = int(np.searchsorted(times, stop - 1e-9)) - 1
        end = float(times[last]) if phones[last] == SILENCE else stop
        if end > start:
            words.append(Word(word, start, end))
    return tuple(words)
