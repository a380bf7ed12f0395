"""Another method beside ours: chosen in the method box, drawn grey and dashed, spoken by a second face."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QObject
from PySide6.QtWidgets import QFileDialog

from core_pipeline.errors import UserError
from core_pipeline.methods.compare import differences
from core_pipeline.methods.method import Method
from core_pipeline.phonemes import Pair
from core_pipeline.pipeline import Stages
from core_pipeline.weights import Weights, bake
from widgets.overlay.method_box import NONE

from ..workers.method_learner import MethodLearner, Wish
from .company import Company
from .parts import Parts

FPS = 60.0
FILE = "file"


@dataclass(frozen=True, eq=False)
class MethodSource:
    """Frames of a sentence as something a face can speak; there are no bigrams in it."""

    weights: Weights

    @property
    def poses(self) -> tuple[str, ...]:
        """Those of the frames."""
        return self.weights.poses

    def weights_at(self, seconds: float) -> NDArray[np.float64]:
        """(poses,) between the two nearest frames."""
        frames = self.weights.frames
        at = min(max((seconds - self.weights.start) * self.weights.fps, 0.0), len(frames) - 1.0)
        lower = int(at)
        upper = min(lower + 1, len(frames) - 1)
        return np.asarray(frames[lower] * (1 - (at - lower)) + frames[upper] * (at - lower), np.float64)

    def bigram_weights_at(self, pair: Pair, s: float) -> NDArray[np.float64] | None:
        """None."""
        return None


class OtherMethod(QObject):
    """Learns or reads the chosen method and shows what it makes of the present sentence."""

    def __init__(self, parts: Parts, company: Company, parent: QObject) -> None:
        super().__init__(parent)
        self._window, self._session, self._state = parts.window, parts.session, parts.state
        self._document = parts.document
        self._company = company
        self._is_beside = False
        self._key, self._path = NONE, Path()
        self.method: Method | None = None
        self.weights: Weights | None = None
        self._box = self._window.stage_panel.method_box
        self._box.set_methods(
            [
                (NONE, self.tr("No other method")),
                ("dam", self.tr("Dominated animemes")),
                ("cohen-massaro", self.tr("Cohen–Massaro")),
                ("animpho:priority", self.tr("AnimPho, live")),
                ("animpho:viterbi", self.tr("AnimPho, Viterbi")),
                ("visemes", self.tr("Viseme interpolation")),
                (FILE, self.tr("From a file…")),
            ]
        )
        self._learner = MethodLearner(parts.speaker, self)
        self._learner.answered.connect(self._made)
        self._learner.failed.connect(self._failed)
        self._learner.progressed.connect(self._progressed)
        self._box.chosen.connect(self.choose)
        self._box.beside_toggled.connect(self._show_faces)
        company.changed.connect(self._company_changed)
        self._session.stages_changed.connect(self._stages_changed)
        self._document.replaced.connect(lambda: self.choose(NONE))

    def choose(self, key: str) -> None:
        """Compare with this method; NONE ends it, FILE asks for a model or a curve set."""
        if key == FILE:
            name, _ = QFileDialog.getOpenFileName(
                self._window,
                self.tr("Another method or set"),
                self._state.text("folder"),
                self.tr("Models and curve sets (*.npz *.json)"),
            )
            if name:
                self.open(Path(name))
            else:
                self._box.set_chosen(self._key)
            return
        self._key = key
        self._box.set_chosen(key)
        kind, _, selection = key.partition(":")
        if key == NONE:
            self._learner.cancel()
            self._use(None)
        else:
            self._learn(Wish(self._session.curve_set, kind, selection or "priority"))

    def open(self, path: Path) -> None:
        """Compare with a learned model (.npz) or another set (.json)."""
        self._key, self._path = FILE, path
        self._box.set_chosen(FILE)
        self._learn(Wish(self._session.curve_set, path=path))

    def close(self) -> None:
        """End the thread."""
        self._learner.stop()

    def _learn(self, wish: Wish) -> None:
        self._use(None)
        self._box.set_busy(self.tr("learning…"))
        self._learner.request(wish)

    def _progressed(self, share: float, _what: str) -> None:
        if not self._box.box.isEnabled():
            self._box.set_busy(self.tr("learning {0} %").format(round(100 * share)))

    def _made(self, method: Method) -> None:
        self._box.set_busy("")
        self._use(method)

    def _failed(self, sentence: str) -> None:
        self._window.hint_label.setText(sentence)
        self._box.set_busy("")
        self._key = NONE
        self._box.set_chosen(NONE)
        self._use(None)

    def _use(self, method: Method | None) -> None:
        self.method = method
        if method is None:
            self._box.set_busy("")
        self._stages_changed(self._session.stages)

    def _stages_changed(self, stages: Stages | None) -> None:
        panel, self.weights = self._window.stage_panel, None
        if self.method is None or stages is None:
            panel.set_method(None)
            if self._box.box.isEnabled():
                self._box.set_differences(None)
            self._show_faces()
            return
        poses = tuple(pose for pose in stages.poses if pose in self.method.poses)
        if not poses:
            self._failed(self.tr("{0} has none of this set's poses: it cannot be compared").format(self.method.title))
            return
        try:
            self.weights = self.method.synthesize(stages.schedule, poses, FPS)
        except UserError as error:
            self._failed(str(error))
            return
        ours = bake(stages.magenta, self._session.curve_set.effective_settings.spline, FPS, snap=False)
        columns = [stages.poses.index(pose) for pose in poses]
        ours = Weights(poses, FPS, ours.start, ours.frames[:, columns])
        panel.set_method(self.weights)
        self._box.set_differences(differences(ours, self.weights))
        self._show_faces()

    def _company_changed(self) -> None:
        """The user may send the second face away."""
        if self._is_beside and not self._company.compares:
            self._is_beside = False
            self._box.beside.setChecked(False)

    def _show_faces(self, _: bool = False) -> None:
        was, self._is_beside = self._is_beside, self.weights is not None and self._box.beside.isChecked()
        if self._is_beside and self.weights is not None and self.method is not None:
            self._company.compare([(self.method.title, MethodSource(self.weights))], self.tr("These curves"))
        elif was:
            self._company.compare(())
