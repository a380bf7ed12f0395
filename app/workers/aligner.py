"""Recording and text → schedule, for clips that come without labels."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from core_pipeline.schedule import Schedule
from core_pipeline.speech import sphinx
from core_pipeline.speech.align import align
from core_pipeline.speech.audio_file import read_audio
from core_pipeline.speech.espeak import Espeak

Align = Callable[[Path, str], Schedule]


@contextmanager
def aligner(voice: str = "en-us") -> Iterator[Align | None]:
    """A function that aligns, with processes that stay warm until the block ends; None where nothing can."""
    if not sphinx.is_installed():
        yield None
        return
    ear, mouth = sphinx.Sphinx(), Espeak()
    try:
        yield lambda sound, text: align(read_audio(sound), text, ear, mouth, voice=voice).schedule
    finally:
        ear.close()
        mouth.close()
