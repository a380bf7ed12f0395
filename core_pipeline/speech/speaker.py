"""Typed sentence → Utterance: spoken by espeak-ng, else silently by the dictionary, which says why."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

from . import mandarin
from .dictionary import Dictionary, installed
from .espeak import PITCH, Espeak, NoVoice, voice_named
from .sentence import FOREIGN, Sentence, clean
from .utterance import Utterance


class Speaker:
    """A voice that is always there. Any thread may call; `close` ends espeak's process.

    espeak, dictionary  other than those of this installation
    """

    def __init__(self, espeak: Espeak | None = None, dictionary: Dictionary | None = None) -> None:
        self._espeak = espeak or Espeak()
        self._dictionary = dictionary

    def warm_up(self) -> None:
        """Start the voice, so that the first sentence need not wait; without one, read the dictionary."""
        try:
            self._espeak.warm_up()
        except NoVoice:
            self._silent()

    @property
    def espeak(self) -> Espeak:
        """The voice itself."""
        return self._espeak

    def speak(self, text: str, voice: str = "en-us", rate: int = 175, pitch: int = PITCH) -> Utterance:
        """Sound, phones and words of a text of any number of sentences.

        voice  one of espeak.ALL_VOICES or NICKNAMES
        rate   words per minute, 80…450
        pitch  0…99
        UserError when there is nothing to say, the text is too long, or voice, rate or pitch do not exist.
        """
        sentence, voice = clean(text), voice_named(voice)
        chinese = voice == mandarin.VOICE
        if chinese:
            sentence = Sentence(sentence.text, tuple(note for note in sentence.notes if note != FOREIGN))
        try:
            return self._espeak.speak(sentence, voice, rate, pitch)
        except NoVoice as reason:
            silent = mandarin.silent(sentence.text, rate) if chinese else self._silent().speak(sentence, rate)
            return replace(silent, notes=(f"There is no sound: {reason}.", *silent.notes))

    def close(self) -> None:
        """End the voice's process, even in the middle of a sentence."""
        self._espeak.close()

    def _silent(self) -> Dictionary:
        return self._dictionary or installed()


@cache
def _shared() -> Speaker:
    return Speaker()


def speak(text: str, voice: str = "en-us", rate: int = 175, pitch: int = PITCH) -> Utterance:
    """`Speaker.speak` with a process that stays warm until Python ends; for scripts and the command line."""
    return _shared().speak(text, voice, rate, pitch)
