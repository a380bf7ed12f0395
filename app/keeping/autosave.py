"""Unsaved work is in a journal within a second, and offered after a crash."""

from __future__ import annotations

import contextlib
import os
import threading
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtCore import QObject, QTimer, Signal

from core_pipeline.errors import UserError
from core_pipeline.files.atomic import reason
from core_pipeline.phonemes import Pair

from ..document import Document
from . import journal
from .journal import Kept
from .processes import is_running

#: From a gesture to its line in the journal; writing takes some milliseconds more.
DELAY_MS = 300


@dataclass(frozen=True)
class Recovery:
    """Unsaved work of a session that did not end well."""

    kept: Kept
    journal: Path
    when: float

    def discard(self) -> None:
        """Forget it."""
        with contextlib.suppress(OSError):
            self.journal.unlink()


class Autosave(QObject):
    """Watches a document and keeps its journal. Writes in a thread, one at a time.

    failed(str)  why no journal can be kept; said once until it works again
    saved()      everything up to now is in the journal, on disk
    """

    failed = Signal(str)
    saved = Signal()

    def __init__(self, document: Document, folder: Path, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._document = document
        self.journal = folder / f"{os.getpid()}.journal"
        self._begun = False
        self._pairs: dict[Pair, None] = {}
        self._complained = False
        self._writing: threading.Thread | None = None
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.setInterval(DELAY_MS)
        self._timer.timeout.connect(self.write)
        document.bigram_changed.connect(self._bigram_changed)
        document.bigrams_changed.connect(self._bigrams_changed)
        document.settings_changed.connect(self._changed)
        document.replaced.connect(self._replaced)
        document.file_changed.connect(self._changed)

    def _bigram_changed(self, pair: Pair) -> None:
        self._bigrams_changed((pair,))

    def _bigrams_changed(self, pairs: Sequence[Pair]) -> None:
        self._pairs |= dict.fromkeys(pairs)
        self._changed()

    def _replaced(self) -> None:
        self.finish()
        self._begun = False
        self._changed()

    def _changed(self) -> None:
        if not self._document.is_dirty:
            self.clear()
        elif not self._timer.isActive():  # not restarted: a line comes even while edits go on
            self._timer.start()

    def write(self) -> None:
        """Write what has changed now, in the background."""
        if self._writing is not None and self._writing.is_alive():
            self._timer.start()
            return
        document = self._document
        pairs, self._pairs = tuple(self._pairs), {}
        self._writing = threading.Thread(
            target=self._write, args=(Kept(document.curve_set, document.path, document.digest), pairs), name="journal"
        )
        self._writing.start()

    def _write(self, kept: Kept, pairs: tuple[Pair, ...]) -> None:
        try:
            if self._begun and self.journal.exists() and self.journal.stat().st_size < journal.LONG:
                journal.add(self.journal, kept.curve_set, pairs)
            else:
                self.journal.parent.mkdir(parents=True, exist_ok=True)
                journal.begin(self.journal, kept)
                self._begun = True
        except (OSError, UserError) as error:
            self._begun = False  # the next line would lack this one
            if not self._complained:
                self._complained = True
                why = f"cannot make {self.journal.parent}: {reason(error)}" if isinstance(error, OSError) else error
                self.failed.emit(f"No recovery copy can be kept ({why}) Save often.")
            return
        self._complained = False
        self.saved.emit()

    def clear(self) -> None:
        """The work is saved or given up: no journal is needed."""
        self.finish()
        self._begun = False
        self._pairs.clear()
        with contextlib.suppress(OSError):
            self.journal.unlink()

    def finish(self) -> None:
        """Wait for a line that is being written."""
        self._timer.stop()
        if self._writing is not None:
            self._writing.join()
            self._writing = None


def left_behind(folder: Path) -> list[Recovery]:
    """Journals of sessions that no longer run, newest first; unreadable ones are passed over."""
    found = []
    for file in folder.glob("*.journal"):
        if file.stem.isdigit() and int(file.stem) != os.getpid() and is_running(int(file.stem)):
            continue
        with contextlib.suppress(OSError, UserError):
            found.append(Recovery(journal.read(file), file, file.stat().st_mtime))
    return sorted(found, key=lambda recovery: -recovery.when)
