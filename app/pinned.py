"""Test sentences that are kept: a list of lines in the view state, in the user's order."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from core_pipeline.errors import UserError
from core_pipeline.files.atomic import reason

from .settings import ViewState

#: A list longer than this is no list of test sentences; a line longer than this is no sentence.
MOST, LONGEST = 500, 400

#: Bytes of a file of lines.
BIGGEST = 1_000_000

_KEY = "pinned sentences"


class Pinned(QObject):
    """The pinned sentences.

    texts    from the top, each once
    changed()  they differ
    """

    changed = Signal()

    def __init__(self, state: ViewState, first: Iterable[str] = (), parent: QObject | None = None) -> None:
        """`first`: what a user finds who has never pinned anything."""
        super().__init__(parent)
        self._state = state
        kept = state.texts(_KEY) if state.has(_KEY) else first
        self.texts: tuple[str, ...] = _tidy(kept)

    def __contains__(self, text: str) -> bool:
        return text in self.texts

    def add(self, texts: Iterable[str]) -> int:
        """Put sentences at the end; how many were new and found room."""
        before = len(self.texts)
        self.set([*self.texts, *texts])
        return len(self.texts) - before

    def remove(self, text: str) -> None:
        """Let one go."""
        self.set([kept for kept in self.texts if kept != text])

    def set(self, texts: Iterable[str]) -> None:
        """Another list, or the same in another order."""
        tidy = _tidy(texts)
        if tidy != self.texts:
            self.texts = tidy
            self._state.put(_KEY, list(tidy))
            self.changed.emit()

    def after(self, text: str, step: int = 1) -> str:
        """The sentence `step` places after one, round and round; the first when it is not in the list; "" if none."""
        if not self.texts:
            return ""
        at = self.texts.index(text) if text in self.texts else -1 if step > 0 else 0
        return self.texts[(at + step) % len(self.texts)]


def _tidy(texts: Iterable[str]) -> tuple[str, ...]:
    """Each sentence once, without line breaks, none too long, not too many."""
    lines = (" ".join(text.split())[:LONGEST] for text in texts)
    return tuple(dict.fromkeys(line for line in lines if line))[:MOST]


def read_lines(path: Path) -> list[str]:
    """The lines of a text file that say something; UserError when it cannot be read as text."""
    try:
        with path.open("rb") as file:
            data = file.read(BIGGEST + 1)
    except OSError as error:
        raise UserError(f"Cannot read {path}: {reason(error)}.") from error
    if len(data) > BIGGEST:
        raise UserError(f"{path} is longer than a million bytes: keep one sentence a line, {MOST} at most.")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise UserError(f"{path} is no text in UTF-8: save it as UTF-8 and try again.") from error
    lines = [line for line in text.splitlines() if line.strip()]
    if not lines or "\0" in text:
        raise UserError(f"{path} has no line of text: write one sentence a line.")
    return lines
