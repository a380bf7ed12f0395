"""A recovery copy of unsaved work, at most two seconds behind, offered after a crash."""

from __future__ import annotations

import contextlib
import json
import os
import threading
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtCore import QObject, QTimer, Signal

from core_pipeline.curve_set import CurveSet
from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json
from core_pipeline.files.atomic import write_atomically

from .document import Document

#: From the first unsaved edit to its recovery copy; writing takes some milliseconds more.
DELAY_MS = 1000


@dataclass(frozen=True)
class Recovery:
    """Unsaved work of a session that did not end well. `path` is the file it belongs to, if any."""

    curve_set: CurveSet
    path: Path | None
    copy: Path
    when: float

    def discard(self) -> None:
        """Forget it."""
        for file in (self.copy, _origin(self.copy)):
            with contextlib.suppress(OSError):
                file.unlink()


class Autosave(QObject):
    """Watches a document. Writes in a thread of its own, the newest state only.

    failed(str)  why no copy can be written; said once until it works again
    saved()      a copy was written
    """

    failed = Signal(str)
    saved = Signal()

    def __init__(self, document: Document, folder: Path, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._document = document
        self.copy = folder / f"{os.getpid()}.json"
        self._complained = False
        self._writing: threading.Thread | None = None
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.setInterval(DELAY_MS)
        self._timer.timeout.connect(self.write)
        document.bigram_changed.connect(self._changed)
        document.bigrams_changed.connect(self._changed)
        document.settings_changed.connect(self._changed)
        document.file_changed.connect(self._changed)

    def _changed(self) -> None:
        if not self._document.is_dirty:
            self._timer.stop()
            self.clear()
        elif not self._timer.isActive():  # not restarted: a copy comes even while edits go on
            self._timer.start()

    def write(self) -> None:
        """Write the copy now, in the background."""
        if self._writing is not None and self._writing.is_alive():
            self._timer.start()
            return
        self._writing = threading.Thread(
            target=self._write, args=(self._document.curve_set, self._document.path), name="autosave"
        )
        self._writing.start()

    def _write(self, curve_set: CurveSet, path: Path | None) -> None:
        try:
            try:
                self.copy.parent.mkdir(parents=True, exist_ok=True)
            except OSError as error:
                raise UserError(f"cannot make {self.copy.parent}: {error.strerror}") from error
            origin = {"path": str(path) if path is not None else None, "pid": os.getpid()}
            write_atomically(_origin(self.copy), json.dumps(origin))
            write_atomically(self.copy, curve_set_json.dumps(curve_set))
        except UserError as error:
            if not self._complained:
                self._complained = True
                self.failed.emit(f"No recovery copy can be kept ({error}) Save often.")
            return
        self._complained = False
        self.saved.emit()

    def clear(self) -> None:
        """The work is saved or given up: no copy is needed."""
        self.finish()
        for file in (self.copy, _origin(self.copy)):
            with contextlib.suppress(OSError):
                file.unlink()

    def finish(self) -> None:
        """Wait for a copy that is being written."""
        self._timer.stop()
        if self._writing is not None:
            self._writing.join()
            self._writing = None


def left_behind(folder: Path) -> list[Recovery]:
    """Copies of sessions that no longer run, newest first; unreadable ones are passed over."""
    found = []
    for copy in folder.glob("*.json"):
        origin: dict[str, object] = {}
        with contextlib.suppress(OSError, ValueError):
            value = json.loads(_origin(copy).read_text("utf-8"))
            origin = value if isinstance(value, dict) else {}
        if copy.stem.isdigit() and _is_running(int(copy.stem)):
            continue
        with contextlib.suppress(OSError, UserError):
            path = origin.get("path")
            found.append(
                Recovery(
                    curve_set_json.load(copy), Path(path) if isinstance(path, str) else None, copy, copy.stat().st_mtime
                )
            )
    return sorted(found, key=lambda recovery: -recovery.when)


def _origin(copy: Path) -> Path:
    return copy.with_suffix(".origin")


def _is_running(pid: int) -> bool:
    """Whether a process of this number lives; this one does not count, its copy is from an earlier life."""
    if pid == os.getpid():
        return False
    if os.name == "nt":
        import ctypes

        kernel = ctypes.WinDLL("kernel32")  # type: ignore[attr-defined,unused-ignore]
        handle = kernel.OpenProcess(0x1000, False, pid)
        if handle:
            kernel.CloseHandle(handle)
        return bool(handle)
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        return True
    return True
