"""The session: sentence, curves and settings in; stages and weights out, once per turn of the event loop."""

from __future__ import annotations

import time
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QObject, Qt, Signal

from core_pipeline import pipeline
from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.phonemes import Pair
from core_pipeline.pipeline import Stages
from core_pipeline.speech.utterance import Utterance
from core_pipeline.spline import interpolate
from core_pipeline.weights import sample


class Session(QObject):
    """What the pipeline makes of the present sentence with the present curves.

    stages_changed(Stages | None)  recomputed, after any number of changes in one turn
    """

    stages_changed = Signal(object)
    _wanted = Signal()

    def __init__(self, curve_set: CurveSet, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._curve_set = curve_set
        self._shown = curve_set  # the same, or with the gesture that is under way
        self._other: CurveSet | None = None
        self._preview: Pair | None = None
        self.utterance: Utterance | None = None
        self.stages: Stages | None = None
        self.pipeline_ms = 0.0
        self._waiting = False
        # Not a timer: what is posted runs before windows are painted, so that one painting shows everything.
        self._wanted.connect(self._turn, Qt.ConnectionType.QueuedConnection)

    @property
    def curve_set(self) -> CurveSet:
        """The set as it sounds now: with the gesture that is under way, if any."""
        return self._shown

    @property
    def poses(self) -> tuple[str, ...]:
        """The poses of the set, in the order of all weights."""
        return self._shown.poses

    @property
    def in_gesture(self) -> bool:
        """Whether a gesture is being shown that the document does not have yet."""
        return self._preview is not None

    def set_curve_set(self, curve_set: CurveSet) -> None:
        """Use another set, or the same with an edit; a gesture's preview ends."""
        self._curve_set = self._shown = curve_set
        self._preview = self._other = None
        self._want()

    @property
    def shows_other(self) -> bool:
        """Whether another set is shown in place of the document's."""
        return self._other is not None

    def show_other(self, curve_set: CurveSet | None) -> None:
        """Let another set speak, of the same poses, until None brings the document's back."""
        self._other = curve_set
        self._preview, self._shown = None, curve_set if curve_set is not None else self._curve_set
        self._want()

    def set_preview(self, pair: Pair, curves: Mapping[str, Curve | None] | None) -> None:
        """Show a gesture while it lasts, without touching the document; None ends it.

        curves  those that changed since the last call; earlier ones of the same gesture stay
        """
        if curves is None:
            self._preview, self._shown = None, self._curve_set
        else:
            before = self._shown if self._preview == pair else self._curve_set
            bigram = before.bigrams.get(pair, Bigram())
            for pose, curve in curves.items():
                bigram = bigram.with_curve(pose, curve)
            self._preview, self._shown = pair, self._curve_set.with_bigram(pair, bigram)
        self._want()

    def set_utterance(self, utterance: Utterance | None) -> None:
        """Say something else."""
        self.utterance = utterance
        self._want()

    def _want(self) -> None:
        if not self._waiting:
            self._waiting = True
            self._wanted.emit()

    def _turn(self) -> None:
        if self._waiting:
            self.recompute()

    def recompute(self) -> None:
        """Run the pipeline now; otherwise it runs by itself at the next turn of the event loop."""
        self._waiting = False
        if self.utterance is None:
            self.stages = None
        else:
            curve_set = self.curve_set
            _ = curve_set.packed  # not the pipeline's cost
            start = time.perf_counter()
            self.stages = pipeline.run(self.utterance.schedule, curve_set)
            self.pipeline_ms = (time.perf_counter() - start) * 1e3
        self.stages_changed.emit(self.stages)

    def weights_at(self, seconds: float) -> NDArray[np.float64]:
        """(poses,) weights of the sentence at a moment; zeros without a sentence."""
        if self.stages is None:
            return np.zeros(len(self._curve_set.poses))
        spline = self._curve_set.effective_settings.spline
        weights: NDArray[np.float64] = sample(self.stages.magenta, spline, seconds)[0]
        return weights

    def bigram_weights_at(self, pair: Pair, s: float) -> NDArray[np.float64]:
        """(poses,) weights of one bigram alone at normalised time s."""
        curve_set = self.curve_set
        spline = curve_set.effective_settings.spline
        weights = np.zeros(len(curve_set.poses))
        bigram = curve_set.bigrams.get(pair)
        if bigram is not None:
            for pose, curve in bigram.curves.items():
                weights[curve_set.poses.index(pose)] = interpolate(curve.t, curve.v, spline, s)
        return np.clip(weights, 0.0, 1.0)

    def used(self) -> dict[Pair, int]:
        """Bigram → how often the sentence has it."""
        counts: dict[Pair, int] = {}
        for pair in self.stages.schedule.pairs() if self.stages is not None else []:
            counts[pair] = counts.get(pair, 0) + 1
        return counts
