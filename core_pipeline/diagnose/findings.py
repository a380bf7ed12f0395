"""One thing that is weak about a bigram, in words, and a bigram with all that is weak about it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from ..phonemes import Pair

#: Every kind of weakness, from the gravest to a mere hint.
KINDS = (
    "missing", "flat", "closure", "hole", "slowed", "clipped", "jitter", "short", "far", "unreviewed", "mirror",
)  # fmt: skip
#: With one of these the bigram says nothing at all.
ERRORS = frozenset({"missing", "flat"})
#: These may be as they should be: worth a look, no more.
HINTS = frozenset({"unreviewed", "mirror"})


@dataclass(frozen=True)
class Finding:
    """One weakness at one place.

    kind      one of KINDS
    severity  0…1
    time      where in its sentence, seconds; None for what is no matter of a sentence
    pose      the pose in question, if one is
    amount    missing, flat, unreviewed: 0 · closure: share of full that is reached · hole, short: seconds ·
              slowed, clipped: share that is lost · jitter: turns · far: RMS weight · mirror: 1 for a pose that only
              this one of the two has, −1 for one that only the mirror pair has
    other     clipped: the pose it gives way to
    sentence  number of the sentence in its corpus
    """

    pair: Pair
    kind: str
    severity: float
    time: float | None = None
    pose: str = ""
    amount: float = 0.0
    other: str = ""
    sentence: int = 0

    @property
    def reason(self) -> str:
        """Why, in a few plain words."""
        pose, share, other = self.pose, f"{100 * self.amount:.0f} %", self.other
        mirror = f"{self.pair[1]} – {self.pair[0]}"
        match self.kind:
            case "missing":
                return "missing"
            case "flat":
                return "empty: nothing moves"
            case "closure":
                return f"not closed: {pose} reaches {share} of its usual height"
            case "hole":
                return f"hole: {1000 * self.amount:.0f} ms without any pose"
            case "slowed":
                return f"speed limit takes {share} of {pose}"
            case "clipped":
                return f"{other or 'a constraint'} takes {share} of {pose}"
            case "jitter":
                return f"jitter: {pose} turns {self.amount:.0f}×"
            case "short":
                return f"pops: {pose} for {1000 * self.amount:.0f} ms"
            case "far":
                return f"unlike its row and column, by {self.amount:.2f}"
            case "mirror":
                return f"{pose}, which {mirror} lacks" if self.amount > 0 else f"no {pose}, which {mirror} has"
        return "suggestion, not reviewed"


@dataclass(frozen=True)
class WeakBigram:
    """A bigram and everything found about it, in a sentence, a corpus or the set.

    uses      how often the sentence or corpus has it
    score     Σ severity over all places where something was found; of a set, Σ severity × frequency
    findings  the worst of each kind and pose, worst first
    """

    pair: Pair
    uses: int
    score: float
    findings: tuple[Finding, ...]

    @property
    def worst(self) -> Finding:
        """What weighs most."""
        return self.findings[0]

    @cached_property
    def reason(self) -> str:
        """All reasons, worst first."""
        return "; ".join(dict.fromkeys(finding.reason for finding in self.findings))

    @property
    def is_error(self) -> bool:
        """Whether it says nothing at all."""
        return self.worst.kind in ERRORS

    @property
    def is_hint(self) -> bool:
        """Whether there are hints only."""
        return all(finding.kind in HINTS for finding in self.findings)
