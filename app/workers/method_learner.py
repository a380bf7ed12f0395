"""Other methods for comparison, on a thread: read from a file, or learned from what the present curves say."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from core_pipeline.curve_set import CurveSet
from core_pipeline.errors import UserError
from core_pipeline.files import script_text
from core_pipeline.methods.method import Cancelled, Method
from core_pipeline.schedule import Schedule
from core_pipeline.speech.speaker import Speaker

from .. import resources
from .latest import Latest

#: Sentences of our corpus that a method is learned from, and the fewest words of one.
SENTENCES, WORDS = 60, 4


@dataclass(frozen=True, eq=False)
class Wish:
    """kind of core_pipeline.methods.kinds, with the curves to learn it from; or a file to read."""

    curve_set: CurveSet
    kind: str = ""
    selection: str = "priority"
    path: Path | None = None


class MethodLearner(Latest):
    """`request(Wish)` is answered with a Method whose poses include those of the wish's set.

    progressed(share, what)  0…1
    """

    progressed = Signal(float, str)

    def __init__(self, speaker: Speaker, parent: QObject | None = None) -> None:
        self._speaker = speaker
        self._schedules: list[Schedule] = []
        super().__init__("method learner", self._make, parent)

    def _make(self, wish: Wish, is_old: Callable[[], bool]) -> Method | None:
        try:
            return self._read(wish) if wish.path is not None else self._learn(wish, is_old)
        except Cancelled:
            return None

    def _read(self, wish: Wish) -> Method:
        from core_pipeline.files import curve_set_json, model_npz
        from core_pipeline.methods.bigram import BigramMethod

        assert wish.path is not None
        if wish.path.suffix.lower() == ".json":
            return BigramMethod(curve_set_json.load(wish.path))
        model = model_npz.load(wish.path)
        model_npz.check(model, wish.curve_set.poses, wish.curve_set.phonemes, wish.path.name)
        return model

    def _learn(self, wish: Wish, is_old: Callable[[], bool]) -> Method:
        from core_pipeline.learning.corpus import Clip, Corpus
        from core_pipeline.methods.bigram import BigramMethod
        from core_pipeline.methods.kinds import KINDS

        def told(share: float, what: str) -> None:
            if is_old():
                raise Cancelled
            self.progressed.emit(share, what)

        ours = BigramMethod(wish.curve_set)
        clips = [
            Clip.of(str(i), schedule, ours.synthesize(schedule, ours.poses, 60))
            for i, schedule in enumerate(self._spoken(told))
        ]
        corpus = Corpus.of(clips, wish.curve_set.phonemes, wish.curve_set.phoneme_map)
        return KINDS[wish.kind].fit(corpus, "kmeans", wish.selection, lambda share, what: told(0.5 + share / 2, what))

    def _spoken(self, told: Callable[[float, str], None]) -> list[Schedule]:
        """Our sentences' schedules; spoken once."""
        if not self._schedules:
            texts = [t for t in script_text.load(resources.corpus() / "utterances.txt") if len(t.split()) >= WORDS]
            schedules = []
            for i, text in enumerate(texts[:SENTENCES]):
                told(i / SENTENCES / 2, "sentences")
                schedules.append(self._speaker.speak(text).schedule)
            if not schedules:
                raise UserError("There is no sentence to learn from: install Lipstitch again.")
            self._schedules = schedules
        return self._schedules
