"""Every way in: a text, a recording with or without its words, a label file → Utterance."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from ..errors import UserError
from ..files.atomic import read_bytes
from ..files.labels.read import read as read_labels
from ..files.labels.text import decode
from .align import Progress, align
from .audio_file import read_audio
from .espeak import PITCH
from .labels import utterance_of
from .recognise import hear_words
from .speaker import Speaker
from .sphinx import Sphinx
from .utterance import Utterance


@dataclass(frozen=True)
class Source:
    """What is to be said, and how it is known. One of text, audio and labels at least.

    transcript  the words of `audio`, or the name of a .txt file with them
    rate        words per minute, for text
    label_rate  samples per second, for labels in samples
    assigned    phone names of the label file → ours
    """

    text: str = ""
    audio: Path | None = None
    transcript: str = ""
    labels: Path | None = None
    voice: str = "en-us"
    rate: int = 175
    pitch: int = PITCH
    label_rate: int | None = None
    assigned: Mapping[str, str] = field(default_factory=dict)


class Intake:
    """Voice and ears, started when first needed. `close` ends them."""

    def __init__(self, speaker: Speaker | None = None, sphinx: Sphinx | None = None) -> None:
        self.speaker = speaker or Speaker()
        self.sphinx = sphinx or Sphinx()

    def utter(self, source: Source, known: Iterable[str] = (), progress: Progress | None = None) -> Utterance:
        """The utterance; its notes say what is doubtful. UserError; `Cancelled` when `sphinx` was.

        known  phones of the curve set
        """
        check(source)
        if source.labels is not None:
            audio = read_audio(source.audio) if source.audio is not None else None
            rate = source.label_rate or (audio.rate if audio else None)
            found = utterance_of(read_labels(source.labels, rate), audio, source.assigned, known).utterance
            return replace(found, text=transcript_of(source.transcript) or found.text)
        if source.audio is None:
            return self.speaker.speak(source.text, source.voice, source.rate, source.pitch)
        audio = read_audio(source.audio)
        if text := transcript_of(source.transcript):
            return align(audio, text, self.sphinx, self.speaker.espeak, progress)
        heard = hear_words(audio, self.sphinx, progress and (lambda done: progress(done / 2)))
        found = align(
            audio, heard.text, self.sphinx, self.speaker.espeak, progress and (lambda x: progress(0.5 + x / 2))
        )
        return replace(found, notes=(f"Recognised: “{heard.text}”. {heard.sentence}", *found.notes))

    def close(self) -> None:
        """End the processes, even in the middle of their work."""
        self.speaker.close()
        self.sphinx.close()


def check(source: Source) -> None:
    """UserError when a source is none, or two."""
    if source.text and (source.audio or source.labels):
        raise UserError("A text is spoken by the voice; for a recording give its words as the transcript.")
    if not (source.text or source.audio or source.labels):
        raise UserError("There is nothing to say: give a text, a recording or a label file.")
    if source.transcript and not (source.audio or source.labels):
        raise UserError("A transcript needs its recording: name that too, or give the words as the text.")


def transcript_of(given: str) -> str:
    """The words themselves, or those in the .txt file of that name. UserError when it cannot be read."""
    if not given.lower().endswith(".txt") or "\n" in given:
        return given
    return decode(read_bytes(given, 2**20, "transcript"), given, "transcript")
