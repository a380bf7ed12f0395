"""Every change of data, as one undo step per gesture.

No child commands (they crash PySide6) and no mergeWith (it leaks wrappers): nudges are merged by the
document, which extends the newest command.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtGui import QUndoCommand

from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.phonemes import Pair
from core_pipeline.settings import Settings
from core_pipeline.speech.utterance import Utterance


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


class EditBigrams(QUndoCommand):
    """Many bigrams before and after; None means there was none."""

    def __init__(
        self,
        apply: Callable[[Mapping[Pair, Bigram | None]], None],
        before: Mapping[Pair, Bigram | None],
        after: Mapping[Pair, Bigram | None],
        label: str,
    ) -> None:
        super().__init__(label)
        self._apply = apply
        self.before = before
        self.after = after

    def redo(self) -> None:
        """Put the new bigrams in place."""
        self._apply(self.after)

    def undo(self) -> None:
        """Put the old bigrams back."""
        self._apply(self.before)


class ChangeSet(QUndoCommand):
    """The whole set before and after: a restored backup, a merge, another phoneme set."""

    def __init__(self, apply: Callable[[CurveSet], None], before: CurveSet, after: CurveSet, label: str) -> None:
        super().__init__(label)
        self._apply = apply
        self.before = before
        self.after = after

    def redo(self) -> None:
        """Put the new set in place."""
        self._apply(self.after)

    def undo(self) -> None:
        """Put the old set back."""
        self._apply(self.before)


class EditUtterance(QUndoCommand):
    """What is said, before and after. No part of the curve set: see Document.push_aside."""

    of_set = False

    def __init__(self, put: Callable[[Utterance], None], before: Utterance, after: Utterance, label: str) -> None:
        super().__init__(label)
        self._put = put
        self.before = before
        self.after = after

    def redo(self) -> None:
        """Say the new one."""
        self._put(self.after)

    def undo(self) -> None:
        """Say the old one again."""
        self._put(self.before)


class ChangeSettings(QUndoCommand):
    """The pipeline's settings before and after."""

    def __init__(
        self, apply: Callable[[Settings | None], None], before: Settings | None, after: Settings, label: str
    ) -> None:
        super().__init__(label)
        self._apply = apply
        self.before = before
        self.after = after

    def redo(self) -> None:
        """Use the new settings."""
        self._apply(self.after)

    def undo(self) -> None:
        """Use the old settings again."""
        self._apply(self.before)


class ChangeMapping(QUndoCommand):
    """What makes the poses of one face, before and after. No part of the curve set: see Document.push_aside."""

    of_set = False

    def __init__(
        self,
        apply: Callable[[Path, MappingOfFace], None],
        face: Path,
        before: MappingOfFace,
        after: MappingOfFace,
        label: str,
    ) -> None:
        super().__init__(label)
        self._apply = apply
        self.face = face
        self.before = before
        self.after = after

    def redo(self) -> None:
        """Use the new mixes."""
        self._apply(self.face, self.after)

    def undo(self) -> None:
        """Use the old mixes again."""
        self._apply(self.face, self.before)


@dataclass(frozen=True, eq=False)
class MappingOfFace:
    """preset: the naming convention the mixes began with; mixes: pose → shape → amount"""

    preset: str
    mixes: Mapping[str, Mapping[str, float]]
