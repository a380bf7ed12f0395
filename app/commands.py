"""Every change of data, as one undo step per gesture.

No child commands (they crash PySide6) and no mergeWith (it leaks wrappers): nudges are merged by the
document, which extends the newest command.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from PySide6.QtGui import QUndoCommand

from core_pipeline.curve_set import Bigram
from core_pipeline.phonemes import Pair


class EditBigram(QUndoCommand):
    """One bigram before and after; undo brings the very same object back. None means there was none."""

    def __init__(
        self,
        apply: Callable[[Pair, Bigram | None], None],
        pair: Pair,
        before: Bigram | None,
        after: Bigram | None,
        label: str,
    ) -> None:
        super().__init__(label)
        self._apply = apply
        self.pair = pair
        self.before = before
        self.after = after
        self.label = label

    def redo(self) -> None:
        """Put the new bigram in place."""
        self._apply(self.pair, self.after)

    def undo(self) -> None:
        """Put the old bigram back."""
        self._apply(self.pair, self.before)


class Change(QUndoCommand):
    """A value before and after, and who puts it in place; undo brings the very same object back.

    of_set  whether it is a part of the curve set, see Document.push_aside
    """

    def __init__(self, apply: Callable[[Any], None], before: Any, after: Any, label: str) -> None:
        super().__init__(label)
        self._apply = apply
        self.before = before
        self.after = after
        self.of_set = True

    def redo(self) -> None:
        """Put the new value in place."""
        self._apply(self.after)

    def undo(self) -> None:
        """Put the old value back."""
        self._apply(self.before)


@dataclass(frozen=True, eq=False)
class MappingOfFace:
    """preset: the naming convention the mixes began with; mixes: pose → shape → amount"""

    preset: str
    mixes: Mapping[str, Mapping[str, float]]
