"""The document: one curve set, its file and its undo stack. Commands change it, views hear of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QUndoStack

from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json
from core_pipeline.phonemes import Pair
from core_pipeline.settings import Settings

from .commands import ChangeSettings, EditBigram, EditBigrams

NUDGE = "Nudge keys"


class Document(QObject):
    """A curve set being edited.

    bigram_changed(pair)  one bigram has other curves
    bigrams_changed()     many bigrams have other curves or another status
    settings_changed()    the pipeline's settings differ
    replaced()            another set was opened
    file_changed()        path or "has unsaved changes" differs
    """

    bigram_changed = Signal(object)
    bigrams_changed = Signal()
    settings_changed = Signal()
    replaced = Signal()
    file_changed = Signal()

    def __init__(self, curve_set: CurveSet, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.curve_set = curve_set
        self.path: Path | None = None
        self.read_only_reason = ""
        self.undo_stack = QUndoStack(self)
        self.undo_stack.cleanChanged.connect(self._clean_changed)
        self._recovered = False
        self._last: EditBigram | None = None

    # ── edits ────────────────────────────────────────────────────────────────────────────────────

    def edit_curves(self, pair: Pair, curves: Mapping[str, Curve | None], label: str) -> None:
        """One gesture's result: some poses of one bigram get other curves (None: no curve any more).

        UserError when the document cannot be edited or the set has no such pair.
        """
        self._check_editable()
        if not self.curve_set.has_pair(pair):
            raise UserError(f"{pair[0]}-{pair[1]} is not a bigram of this set: choose another.")
        unknown = [pose for pose in curves if pose not in self.curve_set.poses]
        if unknown:
            raise UserError(f"This set has no pose {unknown[0]}: choose one of {', '.join(self.curve_set.poses)}.")
        before = self.curve_set.bigrams.get(pair)
        after = before if before is not None else Bigram()
        for pose, curve in curves.items():
            after = after.with_curve(pose, curve)
        if after.status in ("empty", "suggestion"):
            after = replace(after, status="draft")
        after = replace(after, source="authored")
        if label == NUDGE and self._extend_nudge(pair, after):
            return
        self._last = EditBigram(self._put_bigram, pair, before, after, label)
        self.undo_stack.push(self._last)

    def put_bigram(self, pair: Pair, bigram: Bigram, label: str) -> None:
        """One bigram as a whole, its status too, in one step; UserError when the document cannot be edited."""
        self._check_editable()
        if not self.curve_set.has_pair(pair):
            raise UserError(f"{pair[0]}-{pair[1]} is not a bigram of this set: choose another.")
        self.undo_stack.push(EditBigram(self._put_bigram, pair, self.curve_set.bigrams.get(pair), bigram, label))

    def put_bigrams(self, bigrams: Mapping[Pair, Bigram], label: str) -> None:
        """Many bigrams in one step; UserError when the document cannot be edited."""
        self._check_editable()
        if bigrams:
            before = {pair: self.curve_set.bigrams.get(pair) for pair in bigrams}
            self.undo_stack.push(EditBigrams(self._put_bigrams, before, dict(bigrams), label))

    def change_settings(self, settings: Settings, label: str) -> None:
        """Use other settings; UserError when the document cannot be edited."""
        self._check_editable()
        if settings != self.curve_set.effective_settings:
            self.undo_stack.push(ChangeSettings(self._put_settings, self.curve_set.settings, settings, label))

    def _extend_nudge(self, pair: Pair, after: Bigram) -> bool:
        """Several presses of an arrow key are one step: give the newest command a new end."""
        last, stack = self._last, self.undo_stack
        at_top = stack.index() > 0 and stack.index() == stack.count() and not stack.isClean()
        if last is None or not at_top or last.label != NUDGE or last.pair != pair:
            return False
        if self.curve_set.bigrams.get(pair) is not last.after:
            return False
        last.after = after
        self._put_bigram(pair, after)
        return True

    def _put_bigram(self, pair: Pair, bigram: Bigram | None) -> None:
        self.curve_set = self.curve_set.with_bigram(pair, bigram)
        self.bigram_changed.emit(pair)

    def _put_bigrams(self, changes: Mapping[Pair, Bigram | None]) -> None:
        changed = {**self.curve_set.bigrams, **changes}
        kept = {pair: bigram for pair, bigram in changed.items() if bigram is not None}
        self.curve_set = replace(self.curve_set, bigrams=kept)
        self.bigrams_changed.emit()

    def _put_settings(self, settings: Settings | None) -> None:
        self.curve_set = replace(self.curve_set, settings=settings)
        self.settings_changed.emit()

    def _check_editable(self) -> None:
        if self.read_only_reason:
            raise UserError(self.read_only_reason)

    # ── the file ─────────────────────────────────────────────────────────────────────────────────

    @property
    def is_dirty(self) -> bool:
        """Whether closing now would lose something."""
        return self._recovered or not self.undo_stack.isClean()

    @property
    def title(self) -> str:
        """The file's name, or that it has none yet."""
        return self.path.name if self.path is not None else f"{self.curve_set.name} (not saved yet)"

    def open(self, path: Path) -> tuple[str, ...]:
        """Open a file; the repairs made, one sentence each. UserError leaves the present set untouched."""
        reading = curve_set_json.read(path)
        reason = ""
        if reading.newer:
            reason = f"{path.name} was written by a newer Lipstitch and opens read-only here: update to edit it."
        self._replace(reading.curve_set, path, reason)
        if reading.repairs:
            self._recovered = True  # what is shown differs from the file
            self.file_changed.emit()
        return reading.repairs

    def new(self, curve_set: CurveSet) -> None:
        """Start from `curve_set` without a file."""
        self._replace(curve_set, None, "")

    def recover(self, curve_set: CurveSet, path: Path | None) -> None:
        """Go on with what a crashed session left: unsaved, but knowing its file."""
        self._replace(curve_set, path, "")
        self._recovered = True
        self.file_changed.emit()

    def save(self, path: Path | None = None) -> None:
        """Write to `path` or to the document's own file; UserError when that fails, nothing is lost then."""
        self._check_editable()
        target = path if path is not None else self.path
        if target is None:
            raise UserError("This set has no file yet: choose a place with Save As.")
        curve_set_json.save(self.curve_set, target)
        self.path = target
        self._recovered = False
        self.undo_stack.setClean()
        self.file_changed.emit()

    def _replace(self, curve_set: CurveSet, path: Path | None, read_only_reason: str) -> None:
        self.curve_set = curve_set
        self.path = path
        self.read_only_reason = read_only_reason
        self._recovered = False
        self._last = None
        self.undo_stack.clear()
        self.replaced.emit()
        self.file_changed.emit()

    def _clean_changed(self) -> None:
        self.file_changed.emit()
