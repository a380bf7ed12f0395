"""Findings of a sentence, a corpus or a set, added up by bigram: severity × frequency."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import replace

from ..curve_set import CurveSet
from ..phonemes import SILENCE, Pair
from ..pipeline import Stages
from ..settings import Settings
from .findings import Finding, WeakBigram
from .played import played
from .set_findings import SetFindings

#: How often a pair is taken to be said that the frequencies do not name.
_RARE = 1e-6


class Corpus:
    """Adds up sentence after sentence; `ranking` at any time."""

    def __init__(self) -> None:
        self._uses: Counter[Pair] = Counter()
        self._scores: Counter[Pair] = Counter()
        self._worst: dict[Pair, dict[tuple[str, str], Finding]] = {}
        self.sentences = 0

    def add(self, stages: Stages, findings: Iterable[Finding]) -> None:
        """One more sentence, and what was found in it."""
        self._uses.update(stages.schedule.pairs())
        for finding in findings:
            self._scores[finding.pair] += finding.severity  # type: ignore[assignment]
            kept = self._worst.setdefault(finding.pair, {})
            old = kept.get((finding.kind, finding.pose))
            if old is None or finding.severity > old.severity:
                kept[finding.kind, finding.pose] = replace(finding, sentence=self.sentences)
        self.sentences += 1

    def ranking(self) -> list[WeakBigram]:
        """The weak bigrams, worst first, one entry a bigram."""
        return _ranked(WeakBigram(p, self._uses[p], float(self._scores[p]), _worst_first(f)) for p, f in self._found())

    def _found(self) -> Iterable[tuple[Pair, Iterable[Finding]]]:
        return ((pair, kept.values()) for pair, kept in self._worst.items())


def findings_of(
    stages: Stages, curve_set: CurveSet, checks: SetFindings, settings: Settings | None = None
) -> list[Finding]:
    """All findings of one sentence, one for every place.

    settings  with which it was played; the set's own by default
    """
    settings = curve_set.effective_settings if settings is None else settings
    times, known = stages.schedule.times, {*curve_set.phonemes}
    found = []
    for i, pair in enumerate(stages.schedule.pairs()):
        time = float(times[i + 1])
        if SILENCE in pair or not known.issuperset(pair):
            continue
        if pair not in curve_set.bigrams:
            found.append(Finding(pair, "missing", 1.0, time))
        else:
            found += [replace(finding, time=time) for finding in checks.findings.get(pair, ())]
    # What is missing is told so, and not for all that comes of it.
    return found + [f for f in played(stages, settings, checks.closures) if f.pair in curve_set.bigrams]


def weak_bigrams(stages: Stages, curve_set: CurveSet, checks: SetFindings | None = None) -> list[WeakBigram]:
    """The weak bigrams of one sentence, worst first, one entry a bigram."""
    corpus = Corpus()
    corpus.add(stages, findings_of(stages, curve_set, SetFindings.of(curve_set) if checks is None else checks))
    return corpus.ranking()


def weak_in_set(
    curve_set: CurveSet, frequency: Mapping[Pair, float], checks: SetFindings | None = None
) -> list[WeakBigram]:
    """The weak bigrams of a whole set without a sentence, worst first by severity × frequency.

    frequency  pair → its share of running speech, 0…1; a pair not named counts as rarer than any
    """
    checks = SetFindings.of(curve_set) if checks is None else checks
    found = {pair: list(findings) for pair, findings in checks.findings.items()}
    found |= {pair: [Finding(pair, "missing", 1.0)] for pair in curve_set.missing()}

    def score(pair: Pair) -> float:
        return sum(f.severity for f in found[pair]) * (frequency.get(pair, 0.0) + _RARE)

    return _ranked(WeakBigram(pair, 0, score(pair), _worst_first(findings)) for pair, findings in found.items())


def _worst_first(findings: Iterable[Finding]) -> tuple[Finding, ...]:
    return tuple(sorted(findings, key=lambda f: -f.severity))


def _ranked(weak: Iterable[WeakBigram]) -> list[WeakBigram]:
    return sorted(weak, key=lambda w: (-w.score, w.worst.time or 0.0, w.pair))
