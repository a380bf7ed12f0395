"""A lock beside an open file, so that two windows do not save over each other. It says who, never prevents.

The lock of "hero.json" is ".hero.json.lock", with host and process number. It is stale when its owner on this
machine is dead.
"""

from __future__ import annotations

import contextlib
import os
import socket
from dataclasses import dataclass
from pathlib import Path

import msgspec

from .processes import birth, is_running


@dataclass(frozen=True)
class Owner:
    """Who has a file open."""

    host: str
    pid: int
    birth: str = ""

    @classmethod
    def me(cls) -> Owner:
        """This process."""
        return cls(socket.gethostname(), os.getpid(), birth(os.getpid()))

    @property
    def is_gone(self) -> bool:
        """Whether it was a process of this machine that no longer lives; another machine's are taken to live."""
        if self.host != socket.gethostname():
            return False
        return not is_running(self.pid) or (self.birth != "" and self.birth != birth(self.pid))


class Lock:
    """The lock of one file. A folder that cannot be written has no locks, and no saves to protect from."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._file = path.with_name(f".{path.name}.lock")

    def owner(self) -> Owner | None:
        """Who else has the file open now; a stale or damaged lock counts as none."""
        owner = self._read()
        return None if owner is None or owner.is_gone or owner == Owner.me() else owner

    def _read(self) -> Owner | None:
        try:
            with self._file.open("rb") as file:
                return msgspec.json.decode(file.read(10_000), type=Owner)
        except (OSError, ValueError, msgspec.MsgspecError, RecursionError):
            return None

    def take(self) -> bool:
        """Put our name on it, over any other; whether that could be written."""
        try:
            self._file.write_bytes(msgspec.json.encode(Owner.me()))
        except OSError:
            return False
        return True

    def release(self) -> None:
        """Remove it if it is ours."""
        if self._read() == Owner.me():
            with contextlib.suppress(OSError):
                self._file.unlink()
