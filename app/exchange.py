"""Curve sets and weights for other programs, and diphone scripts from them: the File menu's imports and exports."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QFileDialog, QInputDialog

from core_pipeline.curve_set import CurveSet
from core_pipeline.files import curve_set_json, weights_files
from core_pipeline.files.atomic import write_atomically
from core_pipeline.files.layers import built_in, built_in_folder
from core_pipeline.files.smartbody_read import import_set
from core_pipeline.files.smartbody_script import Script, many, read_script
from core_pipeline.files.smartbody_write import script as script_of
from core_pipeline.weights import bake

from . import resources
from .file_actions import FileActions
from .session import Session

SCRIPTS = "Diphone scripts (*.py);;All files (*)"
WEIGHTS = "Weights as JSON (*.json);;Weights as CSV (*.csv)"


class Exchange(QObject):
    """What the File menu does with files of other programs."""

    def __init__(self, files: FileActions, session: Session) -> None:
        super().__init__(files)
        self._files = files
        self._document = files.document
        self._session = session

    # ── in ───────────────────────────────────────────────────────────────────────────────────────

    def ask_import(self) -> None:
        """Choose a diphone script and one of its sets."""
        name, _ = QFileDialog.getOpenFileName(
            self._files.window, self.tr("Import a SmartBody diphone script"), self._files.folder, SCRIPTS
        )
        if name:
            self.import_script(Path(name))

    def import_script(self, path: Path) -> None:
        """A set of the script becomes the document, unsaved; repairs and refusals are told."""
        if not self._files.may_discard():
            return

        def act() -> None:
            script = read_script(path)
            name = self._choose(script)
            if name is None:
                return
            done = import_set(script, name)
            self._document.new(done.curve_set, unsaved=True)
            if done.report:
                self._files.inform(
                    self.tr("Imported"),
                    self.tr("{0} was imported with repairs and notes.").format(
                        many(len(done.curve_set.bigrams), "bigram")
                    ),
                    done.report,
                )

        self._files.attempt(act)

    def _choose(self, script: Script) -> str | None:
        """The only set, or the one that the user chooses; None when they change their mind."""
        if len(script.sets) == 1:
            return script.largest()
        names = list(script.sets)
        rows = [f"{name[:80]} ({many(len(script.sets[name].pairs), 'diphone')})" for name in names]
        row, chosen = QInputDialog.getItem(
            self._files.window,
            self.tr("Import"),
            self.tr("The script has several sets. Which one?"),
            rows,
            names.index(script.largest()),
            False,
        )
        return names[rows.index(row)] if chosen else None

    # ── a set on another ─────────────────────────────────────────────────────────────────────────

    def ask_new_on_base(self) -> None:
        """A character's set: choose the set that it stands on, and a name."""
        if not self._files.may_discard():
            return
        rows = [path for path in (self._document.path,) if path is not None]
        names = [*(str(path) for path in rows), *built_in()]
        likely = 0 if rows else names.index(resources.english_curves().stem)
        title = self.tr("New Character Set")
        base, chosen = QInputDialog.getItem(
            self._files.window, title, self.tr("Only what differs from this set is stored:"), names, likely, False
        )
        if not chosen:
            return
        name, chosen = QInputDialog.getText(self._files.window, title, self.tr("Name of the character:"))
        if chosen:
            self._files.attempt(lambda: self.new_on_base(base, name.strip() or title))

    def new_on_base(self, base: str, name: str) -> None:
        """Start a set on a built-in one or on a file; UserError when that cannot be used."""
        below = curve_set_json.load(built_in_folder() / f"{base}.json" if base in built_in() else base)
        upper = CurveSet(
            name=name[:200],
            language=below.language,
            phonemes=below.phonemes,
            poses=below.poses,
            phoneme_map=below.phoneme_map,
        )
        self._document.new(upper.on_base(base, below))

    # ── out ──────────────────────────────────────────────────────────────────────────────────────

    def ask_export(self) -> None:
        """Write the set for other programs: all layers, with everything a runtime needs."""
        path = self._files.ask_path(
            self.tr("Export the curve set"),
            self.tr("Readable JSON (*.json);;Minified JSON (*.min.json);;SmartBody diphone script (*.py)"),
            "curves.json",
        )
        if path is not None:
            self.export(path)

    def export(self, path: Path) -> bool:
        """Write the set as a diphone script or as JSON, minified when the name ends in .min.json."""
        alone = self._document.curve_set.flattened()

        def act() -> None:
            if path.suffix.lower() == ".py":
                write_atomically(path, script_of(alone))
            else:
                write_atomically(path, curve_set_json.dumps(alone, minified=path.name.endswith(".min.json")))

        return self._files.attempt(act)

    def ask_export_weights(self) -> None:
        """Write the sentence's weights."""
        if self._session.stages is None:
            self._files.complain(self.tr("There is no sentence yet: type one first."))
            return
        path = self._files.ask_path(self.tr("Export weights at 60 frames per second"), WEIGHTS, "weights.json")
        if path is not None:
            self.export_weights(path)

    def export_weights(self, path: Path, fps: float = 60.0) -> bool:
        """Write the sentence's weights as JSON or CSV; whether it worked."""
        stages = self._session.stages
        if stages is None:
            return False
        spline = self._session.curve_set.effective_settings.spline
        return self._files.attempt(lambda: weights_files.save(bake(stages.magenta, spline, fps), path))
