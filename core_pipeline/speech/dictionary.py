"""Typed sentence → Utterance without a voice: a pronouncing dictionary and mean durations; silent.

The dictionary is CMUdict, as it lies in the wheel of pocketsphinx (134,860 lines, BSD licence). Where
that is missing too, every word is spoken by spelling rules.
"""

from __future__ import annotations

import importlib.util
import re
import unicodedata
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from ..errors import UserError
from ..phonemes import SILENCE
from ..schedule import Schedule
from .letters import sound_out
from .numbers import in_words
from .sentence import Sentence, shortened, tokens
from .utterance import Utterance, Word

#: Mean length of each phone in milliseconds, in speech of 175 words per minute (Festival's public table).
MILLISECONDS = {
    "aa": 155, "ae": 120, "ah": 87, "ao": 138, "aw": 171, "ax": 46, "ay": 137, "eh": 92, "er": 147, "ey": 130,
    "ih": 58, "iy": 92, "ow": 134, "oy": 183, "uh": 67, "uw": 107, "b": 73, "ch": 128, "d": 48, "dh": 31, "f": 95,
    "g": 64, "h": 61, "jh": 94, "k": 89, "l": 56, "m": 63, "n": 59, "ng": 64, "p": 101, "r": 53, "s": 102,
    "sh": 108, "t": 70, "th": 93, "v": 51, "w": 54, "y": 48, "z": 72, "zh": 77,
}  # fmt: skip
_USUAL_RATE = 175
#: Milliseconds of silence: at both ends, after a comma, after a sentence.
_EDGE, _COMMA, _STOP = 100, 200, 350


def find_dictionary() -> Path | None:
    """CMUdict's file in the installed wheel of pocketsphinx, or None. Imports nothing."""
    spec = importlib.util.find_spec("pocketsphinx")
    for folder in (spec.submodule_search_locations or ()) if spec else ():
        path = Path(folder) / "model" / "en-us" / "cmudict-en-us.dict"
        if path.is_file():
            return path
    return None


class Dictionary:
    """Speaks silently. `path` is a file with lines such as "hello HH AH L OW"; None: spelling rules only."""

    def __init__(self, path: Path | None) -> None:
        try:  # searching the text takes less time than splitting it into 134,860 entries
            self._lines = "\n" + path.read_text("utf-8") if path else ""
        except (OSError, UnicodeDecodeError):
            self._lines = ""

    def look_up(self, word: str) -> tuple[str, ...]:
        """The first pronunciation of the word, () when it is not listed."""
        start = self._lines.find(f"\n{word} ")
        if start < 0:
            return ()
        start += len(word) + 2
        phones = self._lines[start : self._lines.index("\n", start)].lower().split()
        return tuple("h" if phone == "hh" else phone for phone in phones)

    def entries(self) -> Iterator[tuple[str, tuple[str, ...]]]:
        """Every listed word of letters alone with its first pronunciation."""
        for line in self._lines.splitlines():
            word, _, phones = line.partition(" ")
            if len(word) > 1 and word.isalpha():
                yield word, tuple("h" if phone == "HH" else phone.lower() for phone in phones.split())

    def speak(self, sentence: Sentence, rate: int = _USUAL_RATE) -> Utterance:
        """The sentence with mean durations, scaled to `rate` words per minute; notes name guessed words.

        UserError when no word of it can be spoken.
        """
        phones = [SILENCE]
        lengths = [float(_EDGE)]
        words: list[Word] = []
        guessed: dict[str, None] = {}
        scale = _USUAL_RATE / rate / 1000
        for word, first, last in tokens(sentence.text):
            start = len(phones)
            for part in spoken_parts(word):
                found = self.look_up(part)
                if not found:
                    found = sound_out(part)
                    guessed[part] = None
                phones += found
                lengths += [MILLISECONDS[phone] for phone in found]
            if len(phones) > start:
                words.append(Word(word, scale * sum(lengths[:start]), scale * sum(lengths)))
            pause = _pause(sentence.text[first:last])
            if pause and phones[-1] != SILENCE:
                phones.append(SILENCE)
                lengths.append(pause)
        if not words:
            raise UserError(f"Nothing in “{shortened(sentence.text)}” can be spoken: type at least one English word.")
        if phones[-1] != SILENCE:
            phones.append(SILENCE)
            lengths.append(_EDGE)
        times = [0.0]
        for length in lengths:
            times.append(times[-1] + scale * length)
        notes = sentence.notes
        if not self._lines:
            notes += ("The pronouncing dictionary (package pocketsphinx) is missing, so words follow spelling rules.",)
        elif guessed:
            names = ", ".join(list(guessed)[:5]) + (" and others" if len(guessed) > 5 else "")
            notes += (f"Not in the dictionary, so spoken by spelling rules: {names}.",)
        return Utterance(sentence.text, Schedule(phones, times), None, tuple(words), notes)


@cache
def installed() -> Dictionary:
    """The one of this Python, read once."""
    return Dictionary(find_dictionary())


def spoken_parts(word: str) -> list[str]:
    """ "Well-known" → well, known; "$42" → forty, two, dollars: lower case, without accents."""
    plain = unicodedata.normalize("NFKD", word.replace("’", "'").lower())
    plain = "".join(c for c in plain if not unicodedata.combining(c))
    plain = re.sub(r"\d[\d,]*(?:\.\d+)?", lambda number: f" {in_words(number[0])} ", plain)
    for sign, name in (("&", " and "), ("%", " percent "), ("@", " at "), ("+", " plus ")):
        plain = plain.replace(sign, name)
    for sign, name in (("$", " dollars"), ("£", " pounds"), ("€", " euros")):
        if sign in plain:
            plain = plain.replace(sign, " ") + name
    parts = (part.strip("'") for part in re.split("[^a-z']+", plain))
    return [part for part in parts if part]


def _pause(token: str) -> int:
    """Milliseconds after a word with its punctuation."""
    ending = re.search(r"[^\w]+$", token)
    if not ending:
        return 0
    if re.search("[.!?…:;]", ending[0]):
        return _STOP
    return _COMMA if re.search("[,–—)-]", ending[0]) else 0
