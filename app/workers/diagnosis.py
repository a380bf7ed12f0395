"""What is weak in the present sentence or in a whole corpus, and what could be suggested: found on threads."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from core_pipeline import pipeline
from core_pipeline.curve_set import CurveSet
from core_pipeline.diagnose import Corpus, Finding, SetFindings, WeakBigram, findings_of
from core_pipeline.errors import UserError
from core_pipeline.files import script_text
from core_pipeline.phonemes import Pair
from core_pipeline.pipeline import Stages
from core_pipeline.schedule import Schedule
from core_pipeline.speech.speaker import Speaker
from core_pipeline.statistics import Frequencies
from core_pipeline.suggest import Suggestions

from ..priors import prior_for
from .latest import Latest


@dataclass(frozen=True, eq=False)
class Diagnosis:
    """Of one curve set and the sentence as it plays it.

    findings  all of them, each with its place
    weak      the same, added up by bigram
    drawn     what is weak in the drawing of any pair, whether the sentence has it or not
    """

    curve_set: CurveSet
    stages: Stages | None
    suggestions: Suggestions
    findings: tuple[Finding, ...]
    weak: tuple[WeakBigram, ...]
    drawn: SetFindings


class Diagnoser(Latest):
    """`request((curve_set, stages))` is answered with a Diagnosis."""

    def __init__(self, parent: QObject | None = None) -> None:
        self._known: tuple[CurveSet, Suggestions, SetFindings] | None = None
        super().__init__("diagnosis", self._diagnose, parent)

    def _diagnose(self, wish: tuple[CurveSet, Stages | None], _is_old: Callable[[], bool]) -> Diagnosis:
        curve_set, stages = wish
        if self._known is None or self._known[0].bigrams is not curve_set.bigrams:
            suggestions = Suggestions.of(curve_set, prior_for(curve_set))
            self._known = curve_set, suggestions, SetFindings.of(curve_set, suggestions)
        _, suggestions, checks = self._known
        corpus = Corpus()
        found: list[Finding] = []
        if stages is not None:
            found = findings_of(stages, curve_set, checks)
            corpus.add(stages, found)
        return Diagnosis(curve_set, stages, suggestions, tuple(found), tuple(corpus.ranking()), checks)


@dataclass(frozen=True, eq=False)
class CorpusReport:
    """A text, spoken, and what a curve set makes of it."""

    name: str
    sentences: tuple[str, ...]
    schedules: tuple[Schedule, ...]
    weak: tuple[WeakBigram, ...]
    frequencies: Frequencies

    def sentence_of(self, finding: Finding) -> str:
        """The text in which something was found."""
        return self.sentences[finding.sentence]


class CorpusReader(QObject):
    """Speaks a text file and looks for what is weak in it; later again, when curves have changed.

    progressed(done, total)   sentences; while it works
    reported(CorpusReport)    at the end
    failed(sentence)
    """

    progressed = Signal(int, int)
    reported = Signal(object)
    failed = Signal(str)

    def __init__(self, speaker: Speaker, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._speaker = speaker
        self._worker = Latest("corpus", self._work, self)
        self._worker.answered.connect(self.reported)
        self._worker.failed.connect(self.failed)

    def read(self, path: Path, curve_set: CurveSet) -> None:
        """Begin with another text."""
        self._worker.request((path, None, curve_set))

    def look_again(self, report: CorpusReport, curve_set: CurveSet) -> None:
        """The same text with other curves."""
        self._worker.request((None, report, curve_set))

    def cancel(self) -> None:
        """Give up."""
        self._worker.cancel()

    def stop(self) -> None:
        """End the thread."""
        self._worker.stop()

    def _work(self, wish: tuple[Path, CorpusReport | None, CurveSet], is_old: Callable[[], bool]) -> object:
        path, report, curve_set = wish
        if report is None:
            spoken = self._speak(script_text.load(path), is_old)
            name = path.name
        else:
            spoken = list(zip(report.sentences, report.schedules, strict=True))
            name = report.name
        checks, corpus = SetFindings.of(curve_set, Suggestions.of(curve_set, prior_for(curve_set))), Corpus()
        for _, schedule in spoken:
            if is_old():
                return None
            stages = pipeline.run(schedule, curve_set)
            corpus.add(stages, findings_of(stages, curve_set, checks))
        schedules = tuple(schedule for _, schedule in spoken)
        return CorpusReport(
            name,
            tuple(text for text, _ in spoken),
            schedules,
            tuple(corpus.ranking()),
            Frequencies.of(schedules, curve_set.phonemes, curve_set.phoneme_map),
        )

    def _speak(self, texts: list[str], is_old: Callable[[], bool]) -> list[tuple[str, Schedule]]:
        spoken = []
        refused = ""
        for done, text in enumerate(texts):
            if is_old():
                return []
            self.progressed.emit(done, len(texts))
            try:
                spoken.append((text, self._speaker.speak(text).schedule))
            except UserError as error:  # a line of signs only, or in an alphabet no voice here reads
                refused = str(error)
        if not spoken:
            raise UserError(refused)
        return spoken


def frequency_of(frequencies: Frequencies, phonemes: tuple[str, ...]) -> dict[Pair, float]:
    """The shares of pairs of these phonemes alone."""
    known = set(phonemes)
    return {pair: share for pair, share in frequencies.shares.items() if known.issuperset(pair)}
