"""The document: one curve set, its file and its undo stack. Commands change it, views hear of it."""

from __future__ import annotations

import contextlib
import hashlib
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QUndoStack

from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json
from core_pipeline.files.atomic import read_bytes
from core_pipeline.files.curve_set_merge import decided
from core_pipeline.phonemes import Pair
from core_pipeline.settings import Settings

from .commands import Change, EditBigram

NUDGE = "Nudge keys"

#: Steps that can be undone; a bigram more or less in each, two kilobytes.
UNDO_STEPS = 5000


class Document(QObject):
    """A curve set being edited.

    bigram_changed(pair)  one bigram has other curves
    bigrams_changed(pairs)  many bigrams have other curves or another status
    settings_changed()    the pipeline's settings differ
    replaced()            another set was opened, or the whole set differs
    great_change(what)    many bigrams are about to change at once: time for a backup of `curve_set`
    file_changed()        path or "has unsaved changes" differs

    author   who edits, "" when nobody said; edited bigrams bear it
    digest   of the file as it was last read or written, "" without a file
    on_disk  the set as its file was last read or written, None without a file: what a merge starts from
    """

    bigram_changed = Signal(object)
    bigrams_changed = Signal(object)
    settings_changed = Signal()
    replaced = Signal()
    great_change = Signal(str)
    file_changed = Signal()

    def __init__(self, curve_set: CurveSet, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.curve_set = curve_set
        self.path: Path | None = None
        self.read_only_reason = ""
        self.author = ""
        self.on_disk: CurveSet | None = None
        self.digest = ""
        self.undo_stack = QUndoStack(self)
        self.undo_stack.setUndoLimit(UNDO_STEPS)
        self.undo_stack.indexChanged.connect(self._index_changed)
        self._recovered = False
        self._was_dirty = False
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
        after = replace(decided(after, set(curves)), source="authored", author=self.author or after.author)
        if label == NUDGE and self._extend_nudge(pair, after):
            return
        self._last = EditBigram(self._put_bigram, pair, before, after, label)
        self.undo_stack.push(self._last)

    def put_bigram(self, pair: Pair, bigram: Bigram, label: str) -> None:
        """One bigram as a whole, its status too, in one step; UserError when the document cannot be edited."""
        self._check_editable()
        if not self.curve_set.has_pair(pair):
            raise UserError(f"{pair[0]}-{pair[1]} is not a bigram of this set: choose another.")
        if bigram.status == "approved":
            bigram = decided(bigram)
        self.undo_stack.push(EditBigram(self._put_bigram, pair, self.curve_set.bigrams.get(pair), bigram, label))

    def put_bigrams(self, bigrams: Mapping[Pair, Bigram], label: str) -> None:
        """Many bigrams in one step; UserError when the document cannot be edited."""
        self._check_editable()
        if bigrams:
            self.great_change.emit(label)
            before = {pair: self.curve_set.own.get(pair) for pair in bigrams}
            self.undo_stack.push(Change(self._put_bigrams, before, dict(bigrams), label))

    def change_settings(self, settings: Settings, label: str) -> None:
        """Use other settings; UserError when the document cannot be edited."""
        self._check_editable()
        if settings != self.curve_set.effective_settings:
            self.undo_stack.push(Change(self._put_settings, self.curve_set.settings, settings, label))

    def revert(self, pair: Pair, label: str) -> None:
        """One bigram as the set below has it; nothing where it is so already. UserError when there is none below."""
        self._check_editable()
        if self.curve_set.below is None:
            raise UserError("This set has no base to go back to: it stands alone.")
        if pair in self.curve_set.own:
            self.undo_stack.push(EditBigram(self._put_bigram, pair, self.curve_set.own[pair], None, label))

    def change_set(self, after: CurveSet, label: str) -> None:
        """The whole set at once, as one undo step; UserError when the document cannot be edited."""
        self._check_editable()
        self.great_change.emit(label)
        self.undo_stack.push(Change(self._put_set, self.curve_set, after, label))

    def push_aside(self, change: Change) -> None:
        """An undo step that changes something else than this set, which stays as clean as it is."""
        change.of_set = False
        self._last = None
        self.undo_stack.push(change)

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
        self.curve_set = self.curve_set.with_bigrams(changes)
        self.bigrams_changed.emit(tuple(changes))

    def _put_settings(self, settings: Settings | None) -> None:
        self.curve_set = replace(self.curve_set, settings=settings)
        self.settings_changed.emit()

    def _put_set(self, curve_set: CurveSet) -> None:
        self.curve_set = curve_set
        self.replaced.emit()

    def _check_editable(self) -> None:
        if self.read_only_reason:
            raise UserError(self.read_only_reason)

    # ── the file ─────────────────────────────────────────────────────────────────────────────────

    @property
    def is_dirty(self) -> bool:
        """Whether closing now would lose something."""
        return self._recovered or self._changed_since_clean()

    def _changed_since_clean(self) -> bool:
        """Whether a step that lies between the saved state and now changed the set."""
        stack = self.undo_stack
        clean, now = stack.cleanIndex(), stack.index()
        steps = range(min(clean, now), max(clean, now))
        return clean < 0 or any(getattr(stack.command(i), "of_set", True) for i in steps)

    @property
    def title(self) -> str:
        """The file's name, or that it has none yet."""
        return self.path.name if self.path is not None else f"{self.curve_set.name} (not saved yet)"

    @property
    def file_name(self) -> str:
        """What its file is called, or should be called: by the set's name."""
        named = "".join(c for c in self.curve_set.name if c.isalnum() or c in " -_").strip()[:60]
        return self.path.name if self.path is not None else f"{named or 'curves'}.json"

    def open(self, path: Path) -> tuple[str, ...]:
        """Open a file; the repairs made, one sentence each. UserError leaves the present set untouched."""
        data = read_bytes(path, curve_set_json.MAX_BYTES, "curve set")
        reading = curve_set_json.parse(data, str(path), path.parent)
        reason = ""
        if reading.newer:
            reason = f"{path.name} was written by a newer Lipstitch and opens read-only here: update to edit it."
        self._replace(reading.curve_set, path, reason, unsaved=bool(reading.repairs))  # what is shown is not the file
        self.on_disk, self.digest = reading.curve_set, _digest(data)
        return reading.repairs

    def new(self, curve_set: CurveSet, *, unsaved: bool = False) -> None:
        """Start from `curve_set` without a file; `unsaved` when it came from elsewhere and would be lost."""
        self._replace(curve_set, None, "", unsaved=unsaved)

    def recover(self, curve_set: CurveSet, path: Path | None, digest: str = "") -> None:
        """Go on with what a crashed session left: unsaved, but knowing its file and, by `digest`, what that held."""
        self._replace(curve_set, path, "", unsaved=True)
        self.digest = digest
        with contextlib.suppress(UserError):
            if path is not None and not self.changed_outside():
                self.take_from_disk()

    def open_read_only(self, reason: str) -> None:
        """Refuse edits from now on, with this reason."""
        self.read_only_reason = reason
        self.file_changed.emit()

    def changed_outside(self) -> bool:
        """Whether the file holds something else than was last read or written here; a file that is gone does not."""
        if self.path is None or not self.path.is_file():
            return False
        return _digest(read_bytes(self.path, curve_set_json.MAX_BYTES, "curve set")) != self.digest

    def save(self, path: Path | None = None, write: Callable[[CurveSet, Path], object] = curve_set_json.save) -> None:
        """Write to `path` or to the document's own file; UserError when that fails, nothing is lost then.

        write  puts a set into a file, and returns when it is there
        """
        self._check_editable()
        target = path if path is not None else self.path
        if target is None:
            raise UserError("This set has no file yet: choose a place with Save As.")
        placed = curve_set_json.moved(
            self.curve_set, self.path.parent if self.path is not None else None, target.parent
        )
        write(placed, target)
        self.curve_set = self.on_disk = placed
        self.digest = _digest(curve_set_json.dumps(placed).encode())
        self.path = target
        self._recovered = False
        self.undo_stack.setClean()
        self._was_dirty = False
        self.file_changed.emit()

    def take_from_disk(self) -> CurveSet:
        """What another program put into the file: read, and no longer news. UserError when it cannot be used."""
        assert self.path is not None
        data = read_bytes(self.path, curve_set_json.MAX_BYTES, "curve set")
        reading = curve_set_json.parse(data, str(self.path), self.path.parent)
        self.on_disk, self.digest = reading.curve_set, _digest(data)
        return reading.curve_set

    def _replace(self, curve_set: CurveSet, path: Path | None, read_only_reason: str, *, unsaved: bool) -> None:
        self.curve_set = curve_set
        self.path = path
        self.read_only_reason = read_only_reason
        self.on_disk, self.digest = None, ""
        self._recovered = unsaved
        self._last = None
        self.undo_stack.clear()
        self._was_dirty = unsaved
        self.replaced.emit()
        self.file_changed.emit()

    def _index_changed(self) -> None:
        if self.is_dirty != self._was_dirty:
            self._was_dirty = not self._was_dirty
            self.file_changed.emit()


def _digest(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()
