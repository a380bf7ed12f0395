"""New, open, save, close: dialogs around the document. Every refusal is one sentence in a box.

Imports and exports are in exchange.py.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from pathlib import Path

from PySide6.QtCore import QObject
from PySide6.QtGui import Qt
from PySide6.QtWidgets import QFileDialog, QInputDialog, QMessageBox, QWidget

from core_pipeline.curve_set import CurveSet
from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json

from . import resources
from .document import Document
from .keeping.autosave import Autosave, Recovery, left_behind
from .keeping.background import in_background
from .keeping.keeper import Keeper
from .settings import ViewState

_Button = QMessageBox.StandardButton
CURVE_SETS = "Curve sets (*.json)"


class FileActions(QObject):
    """What the File menu does."""

    def __init__(self, window: QWidget, document: Document, state: ViewState) -> None:
        super().__init__(window)
        self.window = window
        self.document = document
        self._state = state
        self.autosave = Autosave(document, state.folder / "recovery", self)
        self.keeper = Keeper(document, state.folder / "backups", self)
        document.author = state.text("author")[:200]

    @property
    def folder(self) -> str:
        """Where dialogs begin."""
        return self._state.text("folder")

    def close(self) -> None:
        """The program ends: what is being written is finished, the file is free for others."""
        self.autosave.finish()
        self.keeper.free()

    # ── open ─────────────────────────────────────────────────────────────────────────────────────

    def new(self) -> None:
        """Start from the shipped English set."""
        if self.may_discard():
            self.attempt(lambda: self.document.new(curve_set_json.load(resources.english_curves())))

    def new_empty(self, curve_set: CurveSet | None = None) -> None:
        """Start with nothing but the 21 phonemes and the nine poses, or with an empty set of other poses."""
        if self.may_discard():
            self.document.new(curve_set or CurveSet())

    def ask_open(self) -> None:
        """Choose a file and open it."""
        if not self.may_discard():
            return
        name, _ = QFileDialog.getOpenFileName(
            self.window, self.tr("Open a curve set"), self._state.text("folder"), CURVE_SETS
        )
        if name:
            self.open(Path(name))

    def open(self, path: Path) -> None:
        """Open a file; repairs and refusals are told."""
        other = self.keeper.other_owner(path)
        read_only = False
        if other is not None:
            answer = self._ask_shared(path, other.host, other.pid)
            if answer is None:
                return
            read_only = answer
        repairs: tuple[str, ...] = ()

        def act() -> None:
            nonlocal repairs
            repairs = self.document.open(path)

        if not self.attempt(act):
            return
        self._state.put("folder", str(path.resolve().parent))
        if read_only:
            self.document.open_read_only(self.tr("{0} is open elsewhere, and read-only here.").format(path.name))
        else:
            self.keeper.hold(path)
        if repairs:
            self.inform(
                self.tr("Repaired while opening"),
                self.tr("%n curve(s) of this file had to be repaired. Save to keep the repairs.", "", len(repairs)),
                repairs,
            )
        if self.document.read_only_reason and not read_only:
            self.complain(self.document.read_only_reason)

    def _ask_shared(self, path: Path, host: str, pid: int) -> bool | None:
        """Whether to open a file read-only that somebody else has open; None not to open it."""
        box = QMessageBox(
            QMessageBox.Icon.Warning,
            self.tr("Open elsewhere"),
            _plain(
                self.tr(
                    "“{0}” is open in another Lipstitch (process {1} on {2}). Who saves last wins, unless you merge."
                ).format(path.name, pid, host)
            ),
            parent=self.window,
        )
        look = box.addButton(self.tr("Open Read-Only"), QMessageBox.ButtonRole.AcceptRole)
        edit = box.addButton(self.tr("Edit Anyway"), QMessageBox.ButtonRole.DestructiveRole)
        box.addButton(_Button.Cancel)
        box.setDefaultButton(look)
        box.exec()
        chosen = box.clickedButton()
        return None if chosen not in (look, edit) else chosen is look

    def offer_recovery(self) -> None:
        """After a crash: offer what the last session had not saved."""
        for recovery in left_behind(self._state.folder / "recovery"):
            if self._wants(recovery):
                self.document.recover(recovery.kept.curve_set, recovery.kept.path, recovery.kept.digest)
                if recovery.kept.path is not None:
                    self.keeper.hold(recovery.kept.path)
                self.autosave.write()
                self.autosave.finish()
                if (
                    recovery.journal != self.autosave.journal
                ):  # in a container a crashed session may have had our number
                    recovery.discard()
                return
            recovery.discard()

    def _wants(self, recovery: Recovery) -> bool:
        when = time.strftime("%x %H:%M", time.localtime(recovery.when))
        path = recovery.kept.path
        name = path.name if path is not None else recovery.kept.curve_set.name
        answer = QMessageBox.question(
            self.window,
            self.tr("Unsaved work found"),
            _plain(
                self.tr(
                    "Lipstitch did not close properly. Unsaved work on “{0}” from {1} was kept. Go on with it?"
                ).format(name, when)
            ),
            _Button.Yes | _Button.Discard,
            _Button.Yes,
        )
        return answer == _Button.Yes

    # ── save ─────────────────────────────────────────────────────────────────────────────────────

    def save(self) -> bool:
        """Save to the document's file, or ask for one; whether it was saved.

        What another program has put there meanwhile is never saved over unasked.
        """
        path = self.document.path
        if path is None:
            return self.ask_save_as()
        changed = False

        def look() -> None:
            nonlocal changed
            changed = self.document.changed_outside()

        if not self.attempt(look):
            return False
        return self._settle(path) if changed else self._write(path, else_elsewhere=True)

    def _write(self, path: Path, *, else_elsewhere: bool = False) -> bool:
        """Backup and write, beside the window; where that fails another place may be offered."""

        def write(curve_set: CurveSet, target: Path) -> None:
            in_background(lambda: self.keeper.write(curve_set, target))

        try:
            self.document.save(path, write)
        except UserError as error:
            if else_elsewhere:
                return self._offer_elsewhere(str(error))
            self.complain(str(error))
            return False
        self.keeper.hold(path)
        return True

    def _offer_elsewhere(self, sentence: str) -> bool:
        """It could not be saved there: say why, and ask for another place. Whether it was saved there."""
        box = QMessageBox(QMessageBox.Icon.Warning, self.tr("Not saved"), _plain(sentence), parent=self.window)
        other = box.addButton(self.tr("Save As…"), QMessageBox.ButtonRole.AcceptRole)
        box.addButton(_Button.Cancel)
        box.exec()
        return box.clickedButton() is other and self.ask_save_as()

    def _settle(self, path: Path) -> bool:
        """The file holds what another program wrote: ask what becomes of both. Whether our work is saved now."""
        box = QMessageBox(
            QMessageBox.Icon.Warning,
            self.tr("Changed by another program"),
            _plain(
                self.tr(
                    "“{0}” was changed by another program since you opened it. Merge brings both sides' work together, "
                    "bigram by bigram; Reload gives up yours (a backup is kept)."
                ).format(path.name)
            ),
            parent=self.window,
        )
        merge = box.addButton(self.tr("Merge"), QMessageBox.ButtonRole.AcceptRole)
        reload = box.addButton(self.tr("Reload"), QMessageBox.ButtonRole.DestructiveRole)
        copy = box.addButton(self.tr("Save a Copy…"), QMessageBox.ButtonRole.ActionRole)
        box.addButton(_Button.Cancel)
        box.setDefaultButton(merge)
        box.exec()
        chosen = box.clickedButton()
        if chosen is merge:
            return self.attempt(self._merge) and self._write(path)
        if chosen is reload:
            self.document.great_change.emit("reload")
            self.open(path)
        return self.ask_save_as() if chosen is copy else False

    def _merge(self) -> None:
        clashes = self.keeper.merge_with_disk()
        if clashes:
            self.inform(
                self.tr("Merged"),
                self.tr(
                    "%n curve(s) were changed on both sides: yours stay, theirs are kept beside them.", "", len(clashes)
                ),
                clashes,
            )

    def ask_save_as(self) -> bool:
        """Choose a file and save there; whether it was saved."""
        if self.document.read_only_reason:
            self.complain(self.document.read_only_reason)
            return False
        path = self.ask_path(self.tr("Save the curve set"), CURVE_SETS, self.document.file_name)
        if path is None:
            return False
        saved = self._write(path)
        if saved:
            self._state.put("folder", str(path.resolve().parent))
        return saved

    def ask_path(self, title: str, filters: str, name: str) -> Path | None:
        """Choose a place to write to; the ending of the chosen kind is added where there is none."""
        folder = Path(self._state.text("folder") or Path.home())
        start = self.document.path or folder / name
        chosen, kind = QFileDialog.getSaveFileName(self.window, title, str(start.with_name(name)), filters)
        if not chosen:
            return None
        path = Path(chosen)
        if path.suffix:
            return path
        path = path.with_name(path.name + kind[kind.rfind("(*") + 2 : -1])
        return path if not path.exists() or self._may_replace(path) else None

    def _may_replace(self, path: Path) -> bool:
        """The dialog has asked for the name without its ending only."""
        answer = QMessageBox.question(
            self.window, self.tr("Replace the file?"), self.tr("{0} is already there. Replace it?").format(path)
        )
        return answer == _Button.Yes

    # ── backups ──────────────────────────────────────────────────────────────────────────────────

    def ask_restore(self) -> None:
        """Choose a backup and take it as one undo step."""
        backups = self.keeper.backups().all()
        if not backups:
            self.complain(self.tr("There is no backup yet: the first is made by the first save over a file."))
            return
        rows = [f"{backup.when:%x %X} · {backup.kind}" for backup in backups]
        row, chosen = QInputDialog.getItem(
            self.window, self.tr("Restore a Backup"), self.tr("Undo brings the present state back."), rows, 0, False
        )
        if chosen:
            self.attempt(lambda: self.keeper.restore(backups[rows.index(row)]))

    def ask_author(self) -> None:
        """Whose name edited bigrams bear from now on; none for nobody's."""
        name, chosen = QInputDialog.getText(
            self.window, self.tr("Author"), self.tr("Bigrams you edit bear this name:"), text=self.document.author
        )
        if chosen:
            self.document.author = name.strip()[:200]
            self._state.put("author", self.document.author)

    # ── close ────────────────────────────────────────────────────────────────────────────────────

    def may_discard(self) -> bool:
        """Whether the present set may go: saved, or the user said so."""
        if not self.document.is_dirty:
            return True
        answer = QMessageBox.question(
            self.window,
            self.tr("Save changes?"),
            _plain(self.tr("“{0}” has unsaved changes. Save them?").format(self.document.title)),
            _Button.Save | _Button.Discard | _Button.Cancel,
            _Button.Save,
        )
        if answer == _Button.Save:
            return self.save()
        return answer == _Button.Discard

    def attempt(self, act: Callable[[], object]) -> bool:
        """Do it; when it fails say why. Whether it worked."""
        try:
            act()
        except UserError as error:
            self.complain(str(error))
            return False
        return True

    def inform(self, title: str, sentence: str, details: Sequence[str]) -> None:
        """Something was done that is worth knowing; the details are there to unfold."""
        box = QMessageBox(QMessageBox.Icon.Information, title, _plain(sentence), _Button.Ok, self.window)
        box.setDetailedText("\n".join(details))
        box.exec()

    def complain(self, sentence: str) -> None:
        """One sentence in a box."""
        QMessageBox.warning(self.window, self.tr("Lipstitch"), _plain(sentence))


def _plain(text: str) -> str:
    """Names from files are shown as they are, never read as markup."""
    normal = Qt.WhiteSpaceMode.WhiteSpaceNormal
    return Qt.convertFromPlainText(text, normal) if Qt.mightBeRichText(text) else text
