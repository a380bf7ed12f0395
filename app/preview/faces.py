"""Which face is shown: one of ours or a user's rig, read in a thread so that the window never waits."""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Callable, Sequence
from pathlib import Path

from PySide6.QtCore import QObject, Qt, Signal, Slot

from core_pipeline.errors import UserError
from core_pipeline.faces.mapping_json import load_presets
from core_pipeline.faces.open_face import Opened, open_face
from core_pipeline.faces.rigs import rig_cache

from .. import resources

#: Seconds between two reports of how far the reading is.
QUIET = 0.25


class Faces(QObject):
    """Opens faces; only the latest wish counts, and a newer one ends the reading of an older.

    opened(Opened)  the face is ready
    failed(str)     why it is not; the face before stays
    reading(str)    how far it is, when that takes a while: "head.glb: 40 % read"

    `path` is where the face comes from that is read or, once that has ended, the one that is there.
    """

    opened = Signal(object)
    failed = Signal(str)
    reading = Signal(str)
    _done = Signal(int, object)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.path = self._there = resources.face_folder()
        self._poses: tuple[str, ...] = ()
        self._poses_there: tuple[str, ...] | None = None  # of the face that is there; None: there is none
        self._number = 0
        self._reads = False
        self._threads: list[threading.Thread] = []
        self._done.connect(self._deliver, Qt.ConnectionType.QueuedConnection)

    @property
    def reads(self) -> bool:
        """Whether a face is being read."""
        return self._reads

    def open(self, path: Path, poses: Sequence[str]) -> None:
        """Read the face at `path` for a pose set; `opened` or `failed` follows."""
        self._number += 1
        self.path, self._poses, self._reads = path, tuple(poses), True
        self._threads = [thread for thread in self._threads if thread.is_alive()]
        thread = threading.Thread(target=self._read, args=(self._number, path, tuple(poses)), name="face reader")
        self._threads.append(thread)
        thread.start()

    def cancel(self) -> None:
        """Read no further; the face before stays, and nothing is emitted."""
        if self._reads:
            self._number += 1
            self._stay()

    def close(self) -> None:
        """End what is being read; nothing is emitted afterwards."""
        self._number += 1
        for thread in self._threads:
            thread.join()

    def _read(self, number: int, path: Path, poses: tuple[str, ...]) -> None:
        result: Opened | Exception
        try:
            presets = load_presets(resources.retarget_presets())
            result = open_face(
                path, presets, poses, rig_cache.user_cache(), lambda: number != self._number, self._told(number, path)
            )
        except Exception as error:  # noqa: BLE001 - told or raised on the thread of the interface
            result = error
        self._done.emit(number, result)

    def _told(self, number: int, path: Path) -> Callable[[float], None]:
        """Says how far the reading is, a few times a second and not in the first half of one."""
        said = time.monotonic() + QUIET

        def told(share: float) -> None:
            nonlocal said
            if time.monotonic() - said >= QUIET and number == self._number:
                said = time.monotonic()
                self.reading.emit(self.tr("{0}: {1} % read").format(path.name, round(100 * share)))

        return told

    @Slot(int, object)
    def _deliver(self, number: int, result: Opened | Exception) -> None:
        if number != self._number:
            return
        if isinstance(result, Exception):
            folder = f"{self.path.parent}{os.sep}"
            self._stay()
            if not isinstance(result, UserError):
                raise result
            self.failed.emit(str(result).replace(folder, ""))  # it was chosen there just now
        else:
            self._there, self._poses_there, self._reads = self.path, self._poses, False
            self.opened.emit(result)

    def _stay(self) -> None:
        """With the face before; it is read again where the wish was for another pose set, too."""
        wished, self.path, self._reads = self.path, self._there, False
        if self._poses_there not in (None, self._poses) and wished != self._there:
            self.open(self._there, self._poses)
