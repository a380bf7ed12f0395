"""Which bigrams are weak, where, and why: the reason for typing test sentences (section 3.1.2).

    CurveSet ─→ SetFindings ─┐
                             ├─→ findings of a sentence ─→ ranking, of one sentence or a whole corpus
    Stages ─→ played ────────┘

Each kind of weakness has one place that finds it: in what is drawn (set_findings.py) or in what the pipeline
makes of it in a sentence (played.py). How much each weighs stands in findings.py.
"""

from .findings import ERRORS, HINTS, KINDS, Finding, WeakBigram
from .ranking import Corpus, findings_of, weak_bigrams, weak_in_set
from .set_findings import FLAT, SetFindings

__all__ = [
    "ERRORS",
    "FLAT",
    "HINTS",
    "KINDS",
    "Corpus",
    "Finding",
    "SetFindings",
    "WeakBigram",
    "findings_of",
    "weak_bigrams",
    "weak_in_set",
]
