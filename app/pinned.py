"""Test sentences that are kept: a list of lines in the view state, in the user's order."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import QObject, Signal

from .settings import ViewState

#: A list longer than this is no list of test sentences; a line longer than this is no sentence.
MOST, LONGEST = 500, 400


class Pinned(QObject):
    """The pinned sentences.

    texts    from the top, each once
    changed()  they differ
    """

    changed = Signal()

    def __init__(self, state: ViewState, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._state = state
        self.texts: tuple[str, ...] = _tidy(state.texts("pinned sentences"))

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
            self._state.put("pinned sentences", list(tidy))
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
