"""A program of ours in a process of its own: what may crash, hang or be cancelled by killing it."""

from __future__ import annotations

import contextlib
import json
import subprocess
import threading
from typing import Any


class ChildProcess:
    """A running program and its pipes. EOFError when it ended before its answer was complete.

    request   length (4 bytes, little endian), JSON, then the bytes of `data`
    answer    length (4 bytes), JSON, then 2·"samples" bytes
    """

    def __init__(self, command: list[str]) -> None:
        self._popen = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
        )
        self._ending = threading.Lock()

    @property
    def id(self) -> int:
        """Its number."""
        return self._popen.pid

    @property
    def alive(self) -> bool:
        """Whether it still runs."""
        return self._popen.poll() is None

    def ask(self, request: dict[str, object], timeout: float, data: bytes = b"") -> tuple[dict[str, Any], bytes]:
        """One answer to one request; `timeout` in seconds, after which the process is killed."""
        stdin = self._popen.stdin
        assert stdin is not None
        body = json.dumps(request).encode()
        try:
            stdin.write(len(body).to_bytes(4, "little") + body + data)
            stdin.flush()
        except (OSError, ValueError) as error:  # the pipe is broken, or closed by stop()
            raise EOFError(str(error)) from None
        return self.receive(timeout)

    def receive(self, timeout: float) -> tuple[dict[str, Any], bytes]:
        """The next answer."""
        watch = threading.Timer(timeout, self._popen.kill)  # works for pipes of every system
        watch.daemon = True
        watch.start()
        try:
            size = int.from_bytes(self._read(4), "little")
            answer: dict[str, Any] = json.loads(self._read(size))
            return answer, self._read(2 * answer.get("samples", 0))
        finally:
            watch.cancel()

    def _read(self, size: int) -> bytes:
        stdout = self._popen.stdout
        assert stdout is not None
        try:
            data = stdout.read(size)
        except (OSError, ValueError) as error:
            raise EOFError(str(error)) from None
        if len(data) < size:
            raise EOFError("its process ended")
        return data

    def stop(self) -> None:
        """End it and close the pipes; again does nothing. Never waits for a sentence."""
        with self._ending:
            self._popen.kill()
            self._popen.wait()
            for pipe in (self._popen.stdin, self._popen.stdout):
                assert pipe is not None
                with contextlib.suppress(OSError):  # unsent bytes for a dead process
                    pipe.close()
