"""Where the files that ship with Lipstitch are: beside the code in a checkout, inside the package when installed."""

from __future__ import annotations

from pathlib import Path

from core_pipeline.errors import UserError

#: What the editor says first, and where there is no display.
DEMO_SENTENCE = "Fat cats often find fish."

#: What is pinned at first: every lip closure, rounding, spread and tongue is in one of them.
TEST_SENTENCES = (
    DEMO_SENTENCE,
    "My mother bought five blue shoes above the big shop.",
    "A dill-lover feared rye.",
    "Few voices ever wave at thirsty fishes.",
    "She chose a cheap orange jumper for the voyage.",
    "Go quickly, the yellow goat is waking up now.",
)

_HERE = Path(__file__).resolve().parent


def assets() -> Path:
    """The assets folder; UserError when the installation is incomplete."""
    for folder in (_HERE / "_assets", _HERE.parent / "assets"):
        if folder.is_dir():
            return folder
    raise UserError(f"The assets folder is missing beside {_HERE}: install Lipstitch again.")


def english_curves() -> Path:
    """The shipped English curve set."""
    return assets() / "curves" / "english.json"


def corpus() -> Path:
    """The folder of our corpus and the table of how often it has each pair."""
    return assets() / "corpus"


def retarget_presets() -> Path:
    """The naming conventions of rigs we know."""
    return assets() / "retarget"


def characters() -> list[Path]:
    """The folders of our own characters, by name; the first is the one shown first."""
    folders = [face.parent for face in (assets() / "faces").glob("*/face.glb")]
    return sorted(folders, key=lambda folder: (folder.name != "toon", folder.name))


def face_folder(name: str = "toon") -> Path:
    """One of our own characters."""
    return assets() / "faces" / name


def phoneme_maps() -> list[Path]:
    """Our phoneme maps; the default comes first."""
    paths = (assets() / "phoneme_maps").glob("*.json")
    return sorted(paths, key=lambda path: (path.stem != "table-1", path.stem))


def phoneme_map(name: str) -> Path:
    """One of our maps by its name, or the file of that name. UserError when there is neither."""
    for path in phoneme_maps():
        if path.stem == name.lower():
            return path
    if Path(name).suffix.lower() == ".json":
        return Path(name)
    names = ", ".join(path.stem for path in phoneme_maps())
    raise UserError(f"There is no phoneme map {name!r}: choose one of {names}, or name a .json file.")
