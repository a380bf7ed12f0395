"""Bigrams learned from a folder of animation, on a thread that can be told to stop."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from core_pipeline.curve_set import CurveSet
from core_pipeline.learning.bigram_curves import Learned, learn_bigrams
from core_pipeline.methods.method import Cancelled

from .. import resources
from .aligner import aligner
from .latest import Latest


@dataclass(frozen=True, eq=False)
class Lesson:
    """What a folder taught: clips, seconds, notes on what was left out, mean share of motion left unexplained."""

    folder: Path
    clips: int
    seconds: float
    residual: float
    notes: tuple[str, ...]
    learned: Learned


class CorpusLearner(Latest):
    """`request((folder, curve_set))` is answered with a Lesson.

    progressed(share, what)  0…1
    """

    progressed = Signal(float, str)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__("corpus learner", self._learn, parent)

    def _learn(self, wish: tuple[Path, CurveSet], is_old: Callable[[], bool]) -> Lesson | None:
        from core_pipeline.faces.mapping_json import load_presets
        from core_pipeline.learning.corpus_folder import Reader

        folder, curve_set = wish

        def told(share: float, what: str) -> None:
            if is_old():
                raise Cancelled
            self.progressed.emit(share, what)

        try:
            with aligner() as align:
                reader = Reader(curve_set, load_presets(resources.retarget_presets()), align)
                corpus = reader.read(folder, lambda share, name: told(0.7 * share, name))
            learned = learn_bigrams(corpus, progress=lambda share, pose: told(0.7 + 0.3 * share, pose))
            _ = learned.offered
        except Cancelled:
            return None
        residuals = [clip.residual for clip in corpus]
        mean = sum(residuals) / len(residuals)
        return Lesson(folder, len(corpus), corpus.seconds, mean, corpus.notes, learned)
