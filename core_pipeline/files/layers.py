"""The set that a character's curve set stands on (section 3.2.4): found by name, and by no circle."""

from __future__ import annotations

import os
import re
from pathlib import Path

from ..errors import UserError
from .json_text import shown

#: A base of a base of a base … ends somewhere.
MAX_LAYERS = 8


def built_in_folder() -> Path:
    """Where the curve sets that ship with Lipstitch are: beside the code in a checkout, inside the package else."""
    root = Path(__file__).resolve().parents[2]
    installed = root / "app" / "_assets" / "curves"
    return installed if installed.is_dir() else root / "assets" / "curves"


def built_in() -> list[str]:
    """The names of the sets that ship with Lipstitch."""
    return sorted(path.stem for path in built_in_folder().glob("*.json") if _is_name(path.stem))


def base_path(base: str, folder: Path | None, place: str) -> Path:
    """The file that a set's "base" means; UserError names `place`, the set's own file, and the cure.

    base    a built-in set's name, or the path of a .json file
    folder  what such a path is relative to: the folder of the set's own file; None when it has none
    """
    if _is_name(base):
        path = built_in_folder() / f"{base.lower()}.json"
        if not path.is_file():
            raise UserError(
                f'{place}: there is no built-in set “{shown(base)}” for its "base"; write one of '
                f"{', '.join(built_in())}, or the path of a .json file."
            )
        return path
    try:
        path = Path(base)
        if not path.is_absolute():
            if folder is None:
                raise UserError(
                    f"{place}: its base “{shown(base)}” is a file, looked for beside its own: save it first."
                )
            path = folder / path
        if path.suffix.lower() == ".json" and path.is_file():  # and no pipe, which might never end
            return path
    except (OSError, ValueError):
        pass
    raise UserError(
        f"{place}: its base “{shown(base, 200)}” is not there; put that .json file back, "
        f'or name another "base" ({", ".join(built_in())} are built in).'
    )


def refuse_circle(path: Path, above: tuple[Path, ...], place: str) -> None:
    """UserError when the base at `path` is one of the files `above` it, or there are too many."""
    if path in above:
        names = " → ".join(p.name for p in (*above[above.index(path) :], path))
        raise UserError(f'{place}: its base leads back to itself ({names}); give one of them another "base", or null.')
    if len(above) >= MAX_LAYERS:
        raise UserError(f"{place}: more than {MAX_LAYERS} sets stand on each other; let one name a lower base.")


def moved_base(base: str | None, old: Path | None, new: Path) -> str | None:
    """The same base, said from another folder: a path is rewritten when a set moves from `old` to `new`.

    old  None for a set that had no file yet; its base is then said relative to its first
    """
    if (
        base is None
        or _is_name(base)
        or (old is not None and (Path(base).is_absolute() or old.resolve() == new.resolve()))
    ):
        return base
    target = ((old or Path()) / base).resolve()
    try:
        return Path(os.path.relpath(target, new.resolve())).as_posix()
    except ValueError:  # on another drive
        return str(target)


def _is_name(base: str) -> bool:
    return re.fullmatch(r"\w{1,60}", base) is not None
