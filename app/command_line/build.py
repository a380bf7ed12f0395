"""`lipstitch build-faces` and `build-curves`: the shipped files made anew from their sources."""

from __future__ import annotations

import argparse
from pathlib import Path

from core_pipeline.errors import UserError

from .. import resources
from .progress import Progress


def build_faces(options: argparse.Namespace) -> int:
    """Sculpt our characters, all or those named, into their folders."""
    from core_pipeline.faces.sculpt import CHARACTERS, build_all

    folder: Path = options.out or resources.assets() / "faces"
    with Progress(len(options.names) or len(CHARACTERS), "faces") as progress:
        written = build_all(folder, lambda done, _of, title: progress.step(done, f"faces: {title}"), options.names)
    _tell(written)
    return 0


def build_curves(options: argparse.Namespace) -> int:
    """Make curve sets from their recipes: all of ours and their JSON Schema, or those named by name or path."""
    from core_pipeline.files.curve_set_records import write_schema
    from core_pipeline.phone_parts import write

    ours = {path.stem: path for path in sorted((resources.assets() / "curves").glob("*.toml"))}
    recipes = [ours.get(name) or _recipe(name, list(ours)) for name in options.names] or list(ours.values())
    written = []
    with Progress(len(recipes), "curve sets") as progress:
        for done, recipe in enumerate(recipes, 1):
            written.append(write(recipe))
            progress.step(done, f"curve sets: {recipe.stem}")
    if not options.names:
        written.append(write_schema(resources.assets() / "curves"))
    _tell(written)
    return 0


def _recipe(name: str, ours: list[str]) -> Path:
    """A user's own recipe; another ending is refused, so that no .json is ever read as one and overwritten."""
    path = Path(name)
    if path.suffix.lower() != ".toml":
        raise UserError(f"There is no recipe “{name}”: name {', '.join(ours)}, or a file that ends in .toml.")
    return path


def _tell(written: list[Path]) -> None:
    for path in written:
        print(path)
