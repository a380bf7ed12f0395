"""What the program remembers between starts: places, layout, sentence, loop, speed. Never data of the document."""

from __future__ import annotations

import math
from pathlib import Path

from PySide6.QtCore import QByteArray, QSettings, QStandardPaths


class ViewState:
    """A small ini file; a missing or broken one gives the defaults."""

    def __init__(self, folder: Path | None = None) -> None:
        self.folder = folder if folder is not None else default_folder()
        self._values = QSettings(str(self.folder / "lipstitch.ini"), QSettings.Format.IniFormat)

    def has(self, name: str) -> bool:
        """Whether anything of this name was ever remembered."""
        return self._values.contains(name)

    def text(self, name: str, default: str = "") -> str:
        """A remembered text."""
        value = self._values.value(name)
        return value if isinstance(value, str) else default

    def number(self, name: str, default: float) -> float:
        """A remembered number, always finite."""
        try:
            value = float(self.text(name, str(default)))
        except ValueError:
            return default
        return value if math.isfinite(value) else default

    def flag(self, name: str, default: bool) -> bool:
        """A remembered yes or no."""
        return self.text(name, "yes" if default else "no") == "yes"

    def texts(self, name: str) -> list[str]:
        """Remembered lines."""
        return [line for line in self.text(name).split("\n") if line]

    def layout(self, name: str) -> QByteArray:
        """A remembered window geometry or state."""
        value = self._values.value(name)
        return value if isinstance(value, QByteArray) else QByteArray()

    def put(self, name: str, value: str | float | bool | list[str] | QByteArray) -> None:
        """Remember something."""
        if isinstance(value, bool):
            value = "yes" if value else "no"
        elif isinstance(value, list):
            value = "\n".join(value)
        elif isinstance(value, float | int):
            value = str(value)
        self._values.setValue(name, value)

    def remove(self, name: str) -> None:
        """Remember it no more."""
        self._values.remove(name)

    def write(self) -> None:
        """Put it on disk; a read-only home is no reason to complain."""
        self._values.sync()


def default_folder() -> Path:
    """Where the system wants a program's own files."""
    return Path(QStandardPaths.writableLocation(QStandardPaths.StandardLocation.AppConfigLocation))
