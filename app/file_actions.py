"""New, open, save, export, close: dialogs around the document. Every refusal is one sentence in a box."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QObject
from PySide6.QtGui import Qt
from PySide6.QtWidgets import QFileDialog, QMessageBox, QWidget

from core_pipeline.curve_set import CurveSet
from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json, weights_files
from core_pipeline.files.atomic import write_atomically
from core_pipeline.weights import bake

from . import resources
from .autosave import Autosave, Recovery, left_behind
from .document import Document
from .session import Session
from .settings import ViewState

_Button = QMessageBox.StandardButton
CURVE_SETS = "Curve sets (*.json)"
WEIGHTS = "Weights as JSON (*.json);;Weights as CSV (*.csv)"


class FileActions(QObject):
    """What the File menu does."""

    def __init__(self, window: QWidget, document: Document, session: Session, state: ViewState) -> None:
        super().__init__(window)
        self._window = window
        self._document = document
        self._session = session
        self._state = state
        self.autosave = Autosave(document, state.folder / "recovery", self)

    # ── open ─────────────────────────────────────────────────────────────────────────────────────

    def new(self) -> None:
        """Start from the shipped English set."""
        if self.may_discard():
            self.attempt(lambda: self._document.new(curve_set_json.load(resources.english_curves())))

    def new_empty(self, curve_set: CurveSet | None = None) -> None:
        """Start with nothing but the 21 phonemes and the nine poses, or with an empty set of other poses."""
        if self.may_discard():
            self._document.new(curve_set or CurveSet())

    def ask_open(self) -> None:
        """Choose a file and open it."""
        if not self.may_discard():
            return
        name, _ = QFileDialog.getOpenFileName(
            self._window, self.tr("Open a curve set"), self._state.text("folder"), CURVE_SETS
        )
        if name:
            self.open(Path(name))

    def open(self, path: Path) -> None:
        """Open a file; repairs and refusals are told."""
        repairs: tuple[str, ...] = ()

        def act() -> None:
            nonlocal repairs
            repairs = self._document.open(path)

        if self.attempt(act):
            self._state.put("folder", str(path.resolve().parent))
            if repairs:
                box = QMessageBox(
                    QMessageBox.Icon.Information,
                    self.tr("Repaired while opening"),
                    self.tr("%n curve(s) of this file had to be repaired. Save to keep the repairs.", "", len(repairs)),
                    _Button.Ok,
                    self._window,
                )
                box.setDetailedText("\n".join(repairs))
                box.exec()
            if self._document.read_only_reason:
                self.complain(self._document.read_only_reason)

    def offer_recovery(self) -> None:
        """After a crash: offer what the last session had not saved."""
        for recovery in left_behind(self._state.folder / "recovery"):
            if self._wants(recovery):
                self._document.recover(recovery.curve_set, recovery.path)
                self.autosave.write()
                self.autosave.finish()
                if recovery.copy != self.autosave.copy:  # in a container a crashed session may have had our number
                    recovery.discard()
                return
            recovery.discard()

    def _wants(self, recovery: Recovery) -> bool:
        when = time.strftime("%x %H:%M", time.localtime(recovery.when))
        name = recovery.path.name if recovery.path is not None else recovery.curve_set.name
        answer = QMessageBox.question(
            self._window,
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
        """Save to the document's file, or ask for one; whether it was saved."""
        return self.attempt(self._document.save) if self._document.path is not None else self.ask_save_as()

    def ask_save_as(self) -> bool:
        """Choose a file and save there; whether it was saved."""
        if self._document.read_only_reason:
            self.complain(self._document.read_only_reason)
            return False
        name = self._document.path.name if self._document.path is not None else "curves.json"
        path = self._ask_path(self.tr("Save the curve set"), CURVE_SETS, name)
        if path is None:
            return False
        saved = self.attempt(lambda: self._document.save(path))
        if saved:
            self._state.put("folder", str(path.resolve().parent))
        return saved

    def ask_export(self) -> None:
        """Write the set for other programs: small, with everything a runtime needs."""
        path = self._ask_path(
            self.tr("Export the curve set"),
            self.tr("Readable JSON (*.json);;Minified JSON (*.min.json)"),
            "curves.json",
        )
        if path is not None:
            self.export(path)

    def export(self, path: Path) -> bool:
        """Write the set as JSON, minified when the name ends in .min.json; the document keeps its own file."""
        text = curve_set_json.dumps(self._document.curve_set, minified=path.name.endswith(".min.json"))
        return self.attempt(lambda: write_atomically(path, text))

    def ask_export_weights(self) -> None:
        """Write the sentence's weights."""
        if self._session.stages is None:
            self.complain(self.tr("There is no sentence yet: type one first."))
            return
        path = self._ask_path(self.tr("Export weights at 60 frames per second"), WEIGHTS, "weights.json")
        if path is not None:
            self.export_weights(path)

    def export_weights(self, path: Path, fps: float = 60.0) -> bool:
        """Write the sentence's weights as JSON or CSV; whether it worked."""
        stages = self._session.stages
        if stages is None:
            return False
        spline = self._session.curve_set.effective_settings.spline
        return self.attempt(lambda: weights_files.save(bake(stages.magenta, spline, fps), path))

    def _ask_path(self, title: str, filters: str, name: str) -> Path | None:
        folder = Path(self._state.text("folder") or Path.home())
        start = self._document.path or folder / name
        chosen, kind = QFileDialog.getSaveFileName(self._window, title, str(start.with_name(name)), filters)
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
            self._window, self.tr("Replace the file?"), self.tr("{0} is already there. Replace it?").format(path)
        )
        return answer == _Button.Yes

    # ── close ────────────────────────────────────────────────────────────────────────────────────

    def may_discard(self) -> bool:
        """Whether the present set may go: saved, or the user said so."""
        if not self._document.is_dirty:
            return True
        answer = QMessageBox.question(
            self._window,
            self.tr("Save changes?"),
            _plain(self.tr("“{0}” has unsaved changes. Save them?").format(self._document.title)),
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

    def complain(self, sentence: str) -> None:
        """One sentence in a box."""
        QMessageBox.warning(self._window, self.tr("Lipstitch"), _plain(sentence))


def _plain(text: str) -> str:
    """Names from files are shown as they are, never read as markup."""
    normal = Qt.WhiteSpaceMode.WhiteSpaceNormal
    return Qt.convertFromPlainText(text, normal) if Qt.mightBeRichText(text) else text
