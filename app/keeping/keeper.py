"""Watches over a document's file: backups before it is saved over, a lock while open, merges with others' work."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from core_pipeline.curve_set import CurveSet
from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json
from core_pipeline.files.curve_set_merge import merge

from ..document import Document
from .backups import Backup, Backups
from .lock import Lock, Owner


class Keeper(QObject):
    """One for a document.

    failed(str)  why no backup can be kept; said once until it works again
    """

    failed = Signal(str)

    def __init__(self, document: Document, folder: Path, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._document = document
        self._folder = folder
        self._lock: Lock | None = None
        self._complained = False
        document.great_change.connect(self._great_change)
        document.file_changed.connect(self._file_changed)

    # ── backups ──────────────────────────────────────────────────────────────────────────────────

    def backups(self, path: Path | None = None) -> Backups:
        """Those of a file, else of the document's."""
        return Backups(self._folder, path if path is not None else self._document.path)

    def write(self, curve_set: CurveSet, path: Path) -> None:
        """Keep what the file holds, then save over it; UserError when the saving fails. Runs in any thread."""
        self._keep(lambda: self.backups(path).keep_file(path, datetime.now().astimezone()))
        curve_set_json.save(curve_set, path)

    def restore(self, backup: Backup) -> None:
        """The document becomes what the backup holds, as one undo step. UserError when it cannot be read."""
        own = self._document.path
        data = backup.path.read_bytes() if backup.path.is_file() else b""
        reading = curve_set_json.parse(data, str(backup.path), own.parent if own is not None else None)
        self._document.change_set(reading.curve_set, "Restore a backup")

    def _great_change(self, what: str) -> None:
        text = curve_set_json.dumps(self._document.curve_set)
        kind = "".join(c for c in f"before {what.lower()}" if c.isascii() and (c.isalpha() or c == " "))[:60]
        self._keep(lambda: self.backups().keep(text, kind, datetime.now().astimezone()))

    def _keep(self, act: Callable[[], None]) -> None:
        try:
            act()
        except UserError as error:
            if not self._complained:
                self._complained = True
                self.failed.emit(str(error))
        else:
            self._complained = False

    # ── other programs ───────────────────────────────────────────────────────────────────────────

    def merge_with_disk(self) -> tuple[str, ...]:
        """Bring the file's content and the document's together as one undo step; what clashed. UserError."""
        base, ours = self._document.on_disk, self._document.curve_set
        theirs = self._document.take_from_disk()
        if base is None:  # after a crash nobody knows what both started from: all that differs clashes
            base = CurveSet(phonemes=(), poses=(), phoneme_map={})
        merged = merge(base, ours, theirs)
        self._document.change_set(merged.curve_set, "Merge with the file")
        return merged.conflicts

    def other_owner(self, path: Path) -> Owner | None:
        """Who else has this file open."""
        return Lock(path).owner()

    def hold(self, path: Path) -> None:
        """Let others see that this file is open here."""
        if self._lock is None or self._lock.path != path:
            self.free()
            self._lock = Lock(path)
        self._lock.take()

    def free(self) -> None:
        """Nobody need wait for us any more."""
        if self._lock is not None:
            self._lock.release()
            self._lock = None

    def _file_changed(self) -> None:
        if self._lock is not None and self._document.path != self._lock.path:
            self.free()
