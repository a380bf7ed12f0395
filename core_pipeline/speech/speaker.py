"""Typed sentence → Utterance: spoken by espeak-ng, else silently by the dictionary, which says why."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

from .dictionary import Dictionary, installed
from .espeak import Espeak, NoVoice
from .sentence import clean
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

    def speak(self, text: str, voice: str = "en-us", rate: int = 175) -> Utterance:
        """Sound, phones and words of a text of any number of sentences.

        voice  one of espeak.VOICES
        rate   words per minute, 80…450
        UserError when there is nothing to say, the text is too long, or voice or rate do not exist.
        """
        sentence = clean(text)
        try:
            return self._espeak.speak(sentence, voice, rate)
        except NoVoice as reason:
            silent = self._silent().speak(sentence, rate)
            return replace(silent, notes=(f"There is no sound: {reason}.", *silent.notes))

    def close(self) -> None:
        """End the voice's process, even in the middle of a sentence."""
        self._espeak.close()

    def _silent(self) -> Dictionary:
        return self._dictionary or installed()


@cache
def _shared() -> Speaker:
    return Speaker()


def speak(text: str, voice: str = "en-us", rate: int = 175) -> Utterance:
    """`Speaker.speak` with a process that stays warm until Python ends; for scripts and the command line."""
    return _shared().speak(text, voice, rate)
