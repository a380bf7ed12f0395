"""Our own characters, modelled in code: parameters in, a face with blendshapes out."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from core_pipeline.faces.face_folder import save
from core_pipeline.faces.sculpt.ada import ADA
from core_pipeline.faces.sculpt.build import sculpt
from core_pipeline.faces.sculpt.character import Character
from core_pipeline.faces.sculpt.crab import CRAB
from core_pipeline.faces.sculpt.man import MAN
from core_pipeline.faces.sculpt.toon import TOON
from core_pipeline.faces.sculpt.woman import WOMAN

HUMANS: tuple[Character, ...] = (TOON, ADA, WOMAN, MAN)
CHARACTERS: tuple[Character, ...] = (*HUMANS, CRAB)


def build_all(folder: str | Path, progress: Callable[[int, int, str], None] | None = None) -> list[Path]:
    """Sculpt every character into `folder`/<name>/face.glb and face.json; returns the folders written.

    progress  called with (how many are done, of how many, title of the one just done)
    """
    written = []
    for number, character in enumerate(CHARACTERS, 1):
        place = Path(folder) / character.name
        save(sculpt(character), place)
        written.append(place)
        if progress is not None:
            progress(number, len(CHARACTERS), character.title)
    return written
