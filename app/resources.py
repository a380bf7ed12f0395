"""Where the files that ship with Lipstitch are: beside the code in a checkout, inside the package when installed."""

from __future__ import annotations

from pathlib import Path

from core_pipeline.errors import UserError

#: What the editor says first, and where there is no display.
DEMO_SENTENCE = "Fat cats often find fish."

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
