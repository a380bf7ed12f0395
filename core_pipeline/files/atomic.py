"""Reading with a limit and writing all or nothing."""

from __future__ import annotations

import contextlib
import errno
import os
import stat
import tempfile
from pathlib import Path
from typing import BinaryIO

from ..errors import UserError


def open_to_read(path: Path) -> BinaryIO:
    """Like `path.open("rb")`; OSError for a named pipe, too: one that nobody writes to would be waited for for ever.

    What a shell puts at /dev/stdin and /dev/fd has somebody who writes.
    """
    if stat.S_ISFIFO(path.stat().st_mode) and not str(path).startswith(("/dev/", "/proc/")):
        raise OSError(errno.ESPIPE, "it is a pipe, not a file; keep what comes through it in a file", str(path))
    return path.open("rb")


def read_bytes(path: Path | str, limit: int, what: str) -> bytes:
    """The file's bytes; UserError when it is missing, unreadable, a folder, or larger than `limit` bytes."""
    path = Path(path)
    try:
        if path.is_dir():
            raise UserError(f"{path} is a folder: choose the {what} file in it.")
        with open_to_read(path) as file:
            data = file.read(limit + 1)
    except (OSError, ValueError) as error:
        raise UserError(f"Cannot read {path}: {reason(error)}.") from error
    if len(data) > limit:
        raise UserError(f"{path} is larger than {limit // 2**20} MB, too large for a {what}: choose another file.")
    return data


def write_atomically(path: Path | str, data: bytes | str) -> None:
    """Write beside the target, flush to disk, then rename: the old file stays whole whatever happens.

    Text is written as UTF-8 with LF. A device or a pipe is written directly: it must not be replaced.
    UserError names the path and the reason.
    """
    path = Path(path)
    raw = data.encode("utf-8") if isinstance(data, str) else data
    temporary = ""
    try:
        if path.exists() and not path.is_file() and not path.is_dir():
            path.write_bytes(raw)
            return
        target = path.resolve() if path.is_symlink() else path  # a link stays a link
        if target.exists() and not os.access(target, os.W_OK, effective_ids=os.access in os.supports_effective_ids):
            told = "the file is read-only; make it writable (check it out) or choose another place"
            raise OSError(errno.ENOTSUP, told)  # a rename would not mind
        handle, temporary = tempfile.mkstemp(prefix=f".{target.name[:40]}.", suffix=".tmp", dir=target.parent)
        with os.fdopen(handle, "wb") as file:
            file.write(raw)
            file.flush()
            os.fsync(file.fileno())
        _keep_mode(target, Path(temporary))
        Path(temporary).replace(target)
        temporary = ""
        _sync_folder(target.parent)
    except (OSError, ValueError, RuntimeError) as error:  # a NUL in the path; a link that leads to itself
        raise UserError(f"Cannot write {path}: {reason(error)}. Nothing was changed there.") from error
    finally:
        if temporary:
            with contextlib.suppress(OSError):
                Path(temporary).unlink()


def reason(error: Exception) -> str:
    """What went wrong, and what to do, without errno's jargon."""
    if not isinstance(error, OSError):
        return "that is no possible path; check it"
    known = {
        errno.ENOENT: "there is no such file or folder; check the path",
        errno.EACCES: "you have no permission there; choose another place",
        errno.EPERM: "you have no permission there; choose another place",
        errno.EROFS: "that place is read-only; choose another",
        errno.ENOSPC: "the disk is full; free some space or choose another place",
        errno.EDQUOT: "your disk quota is used up; free some space or choose another place",
        errno.ENOTDIR: "part of the path is a file, not a folder; check the path",
        errno.EISDIR: "it is a folder; name a file",
        errno.ENAMETOOLONG: "the name is too long; choose a shorter one",
        errno.EFBIG: "the file would be larger than is allowed there; choose another place",
        errno.EEXIST: "there is a file of that name; choose another name",
        errno.ELOOP: "that link leads to itself; choose another path",
    }
    return known.get(error.errno or 0, (error.strerror or str(error)).lower())


def _keep_mode(old: Path, new: Path) -> None:
    """Give the new file the old one's permissions, or those a new file would have (mkstemp gives 600)."""
    if os.name != "posix":
        return
    try:
        mode = old.stat().st_mode & 0o777
    except FileNotFoundError:
        umask = os.umask(0)
        os.umask(umask)
        mode = 0o666 & ~umask
    new.chmod(mode)


def _sync_folder(folder: Path) -> None:
    """Make the rename itself durable, where the system can."""
    if os.name != "posix":
        return
    with contextlib.suppress(OSError):  # some network file systems refuse, some folders cannot be listed
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)
