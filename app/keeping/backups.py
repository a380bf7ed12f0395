"""Backups of a curve set: ten of the last saves, one a day for fourteen days, and one before every great change.

They lie in the program's own folder, a folder for each file that was saved, and are plain curve sets.
"""

from __future__ import annotations

import contextlib
import hashlib
import re
from dataclasses import dataclass
from datetime import datetime, timedelta
from pathlib import Path

from core_pipeline.errors import UserError
from core_pipeline.files.atomic import read_bytes, reason, write_atomically
from core_pipeline.files.curve_set_json import MAX_BYTES

SAVES = 10
DAYS = 14
#: Before merges, migrations, and operations on many bigrams.
BEFORE = 10

_NAME = re.compile(r"(\d{4}-\d\d-\d\d)T(\d\d)-(\d\d)-(\d\d)-(\d{6}) ([a-z ]{1,60})\.json", re.ASCII)


@dataclass(frozen=True)
class Backup:
    """One of them. `kind` is "save", "day", or "before …"."""

    path: Path
    when: datetime
    kind: str


class Backups:
    """The backups of one file, or of sets that have none yet."""

    def __init__(self, folder: Path, path: Path | None) -> None:
        name = "unnamed" if path is None else f"{path.stem[:40]}-{_mark(path)}"
        self._folder = folder / name

    def all(self) -> list[Backup]:
        """The newest first."""
        found = []
        with contextlib.suppress(OSError):
            for file in self._folder.iterdir():
                if match := _NAME.fullmatch(file.name):
                    when = datetime.fromisoformat(f"{match[1]}T{match[2]}:{match[3]}:{match[4]}.{match[5]}")
                    found.append(Backup(file, when, match[6]))
        return sorted(found, key=lambda backup: (backup.when, backup.kind), reverse=True)

    def keep_file(self, path: Path, now: datetime) -> None:
        """Before `path` is saved over: keep what it holds, for today too if it is the day's first. UserError."""
        if not path.is_file():
            return
        data = read_bytes(path, MAX_BYTES, "curve set")
        self._put(data, now, "save")
        if not any(backup.kind == "day" and backup.when.date() == now.date() for backup in self.all()):
            self._put(data, now, "day")
        self._thin(now)

    def keep(self, text: str, kind: str, now: datetime) -> None:
        """Before a great change: keep the set; `kind` begins with "before". UserError when that fails."""
        self._put(text.encode(), now, kind)
        self._thin(now)

    def _put(self, data: bytes, now: datetime, kind: str) -> None:
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise UserError(f"No backup can be kept in {self._folder}: {reason(error)}.") from error
        write_atomically(self._folder / f"{now:%Y-%m-%dT%H-%M-%S-%f} {kind}.json", data)

    def _thin(self, now: datetime) -> None:
        kept = self.all()
        gone = [b for b in kept if b.kind == "save"][SAVES:] + [b for b in kept if b.kind.startswith("before")][BEFORE:]
        gone += [b for b in kept if b.kind == "day" and b.when.date() <= (now - timedelta(days=DAYS)).date()]
        for backup in gone:
            with contextlib.suppress(OSError):
                backup.path.unlink()


def _mark(path: Path) -> str:
    return hashlib.sha256(str(path.resolve()).encode("utf-8", "surrogatepass")).hexdigest()[:8]
