"""Our own characters, modelled in code: parameters in, a face with blendshapes out."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from core_pipeline.errors import UserError
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


def build_all(
    folder: str | Path, progress: Callable[[int, int, str], None] | None = None, names: Sequence[str] = ()
) -> list[Path]:
    """Sculpt every character into `folder`/<name>/face.glb and face.json; returns the folders written.

    progress  called with (how many are done, of how many, title of the one just done)
    names     only these characters; all when empty. UserError for a name that is none of ours.
    """
    known = {character.name: character for character in CHARACTERS}
    for name in names:
        if name not in known:
            raise UserError(f"“{name}” is none of our characters; choose from {', '.join(known)}.")
    chosen = [known[name] for name in names] or CHARACTERS
    try:
        Path(folder).mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UserError(f"{folder}: cannot be written ({error.strerror}); choose another place.") from None
    written = []
    for number, character in enumerate(chosen, 1):
        place = Path(folder) / character.name
        save(sculpt(character), place)
        written.append(place)
        if progress is not None:
            progress(number, len(chosen), character.title)
    return written
