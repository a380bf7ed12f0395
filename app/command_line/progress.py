"""How far a long command has come: a bar on the terminal, nothing where nobody watches."""

from __future__ import annotations

import sys
from types import TracebackType
from typing import Self

_WIDTH = 30


def bar(done: int, total: int, what: str) -> str:
    """ "[###......] 3 of 9 frames", in letters every terminal has."""
    filled = _WIDTH * done // max(total, 1)
    return f"[{'#' * filled}{'.' * (_WIDTH - filled)}] {done:{len(str(total))}} of {total} {what}"


class Progress:
    """A bar on stderr while a `with` block runs; the line is ended, so that what is said next has one of its own."""

    def __init__(self, total: int, what: str) -> None:
        self._total = total
        self._what = what
        self._shown = ""

    def __enter__(self) -> Self:
        self.step(0)
        return self

    def step(self, done: int, what: str = "") -> None:
        """`done` of the total are finished; `what` is said in place of the usual word."""
        if sys.stderr is None or not sys.stderr.isatty():
            return
        line = bar(done, self._total, what or self._what)
        print(f"\r{line:{len(self._shown)}}", end="", file=sys.stderr, flush=True)
        self._shown = line

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._shown:
            print(file=sys.stderr, flush=True)
