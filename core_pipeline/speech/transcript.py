"""A transcript → the words a recogniser looks up, each with the token it came from."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from ..errors import UserError
from ..phonemes import SILENCE
from .dictionary import MILLISECONDS, spoken_parts
from .espeak import Espeak, NoVoice
from .letters import sound_out
from .sentence import clean as clean_sentence
from .sentence import shortened, tokens

#: Characters; more than is said in an hour.
LONGEST = 100_000


@dataclass(frozen=True)
class Transcript:
    """words as the dictionary writes them; owners: the index in `tokens` of each, rising."""

    text: str
    tokens: tuple[str, ...]
    words: tuple[str, ...]
    owners: tuple[int, ...]


def parse(text: str) -> Transcript:
    """Any text on any number of lines. UserError when it is too long or has no English word."""
    text = re.sub(r"\s+", " ", text.lstrip("\ufeff").replace("\0", " ")).strip()
    if len(text) > LONGEST:
        raise UserError(f"The transcript has {len(text):,} characters, more than {LONGEST:,}: cut recording and text.")
    found: list[str] = []
    words: list[str] = []
    owners: list[int] = []
    for token, _, _ in tokens(text):
        if parts := spoken_parts(token):
            words += parts
            owners += [len(found)] * len(parts)
            found.append(token)
    if not words:
        raise UserError(f"“{shortened(text)}” has no English word: type what is said in the recording.")
    return Transcript(text, tuple(found), tuple(words), tuple(owners))


def pronounced(words: Iterable[str], espeak: Espeak, voice: str = "en-us") -> dict[str, str]:
    """Word → phones in pocketsphinx's capitals, as espeak says it; without espeak by spelling rules."""
    spoken = {}
    for word in words:
        try:
            phones: Sequence[str] = espeak.speak(clean_sentence(word), voice).schedule.phones
        except (NoVoice, UserError):
            phones = sound_out(word)
        known = [sphinx_name(phone) for phone in phones if phone in MILLISECONDS]
        spoken[word] = " ".join(known or [sphinx_name(phone) for phone in sound_out("uh")])
    return spoken


def sphinx_name(phone: str) -> str:
    """Our phone → CMUdict's, which has no schwa of its own and doubles the h."""
    return {"ax": "AH", "h": "HH"}.get(phone, phone.upper())


def our_name(phone: str) -> str:
    """CMUdict's phone → ours; noises are silence."""
    if phone == "HH":
        return "h"
    return phone.lower() if phone.lower() in MILLISECONDS else SILENCE
