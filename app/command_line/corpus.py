"""A text file spoken sentence by sentence, with a bar on the terminal."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from core_pipeline.errors import UserError
from core_pipeline.files import script_text
from core_pipeline.files.json_text import shown
from core_pipeline.schedule import Schedule
from core_pipeline.speech.speaker import speak

from .progress import Progress
from .steps import tell


def spoken(path: Path, voice: str) -> Iterator[tuple[str, Schedule]]:
    """Every sentence of the file with its schedule. What cannot be spoken is told and left out.

    UserError when the file cannot be read, the voice does not exist, or nothing can be spoken.
    """
    sentences = script_text.load(path)
    silent: list[str] = []
    notes: dict[str, None] = {}
    with Progress(len(sentences), "sentences") as progress:
        for done, text in enumerate(sentences, 1):
            try:
                utterance = speak(text, voice)
            except UserError:
                silent.append(text)
                if done == len(silent) == min(len(sentences), 3):
                    raise  # not one so far: the fault is not with the text
                continue
            notes.update(dict.fromkeys(utterance.notes))
            yield text, utterance.schedule
            progress.step(done)
    for note in list(notes)[:5]:
        tell(note)
    if silent:
        tell(f"{len(silent)} of {len(sentences)} sentences cannot be spoken, such as “{shown(silent[0])}”.")
