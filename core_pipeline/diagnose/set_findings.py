"""What is weak in the drawing itself, whatever is said with it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ..curve_set import Bigram, CurveSet
from ..phonemes import SILENCE, Pair
from ..suggest import FEW, PEAK, Suggestions
from .findings import Finding

#: A bigram that stays below this is as good as none.
FLAT = 0.02
#: Further than this (RMS weight over all poses) from what row and column suggest is worth a look.
FAR = 0.06

#: Poses and phones of closures, where a set has them; others are found by what is drawn.
_CLOSURES = {"PBM": ("bmp", "b", "m", "p"), "FV": ("f", "v")}


@dataclass(frozen=True, eq=False)
class SetFindings:
    """The findings of one curve set. Make one with `SetFindings.of`; read-only.

    findings  pair → what is weak about it, wherever it is said; missing pairs are not listed
    closures  phone → the pose that must close for it and the weight that is full: the set's own median peak
    """

    findings: Mapping[Pair, tuple[Finding, ...]]
    closures: Mapping[str, tuple[str, float]]

    @classmethod
    def of(cls, curve_set: CurveSet, suggestions: Suggestions | None = None) -> SetFindings:
        """Look at every bigram. `suggestions` of the same set, when they exist already, save learning them again."""
        suggestions = Suggestions.of(curve_set) if suggestions is None else suggestions
        astray = suggestions.astray if len(suggestions.pairs) >= FEW else {}
        poses = {pair: _moving(bigram) for pair, bigram in curve_set.bigrams.items()}
        findings = {}
        for pair, bigram in curve_set.bigrams.items():
            if SILENCE not in pair:
                found = [*_own(pair, bigram, astray.get(pair, 0.0)), *_mirror(pair, poses)]
                if found:
                    findings[pair] = tuple(found)
        return cls(findings, _closures(curve_set))


def _own(pair: Pair, bigram: Bigram, astray: float) -> list[Finding]:
    if max((float(c.v.max()) for c in bigram.curves.values()), default=0.0) < FLAT:
        return [Finding(pair, "flat", 0.9)]
    found = []
    if astray > FAR:
        found.append(Finding(pair, "far", min(0.1 + 2 * astray, 0.5), amount=astray))
    if bigram.status in ("empty", "suggestion"):
        found.append(Finding(pair, "unreviewed", 0.1))
    return found


def _moving(bigram: Bigram) -> frozenset[str]:
    """The poses that matter in it."""
    return frozenset(pose for pose, curve in bigram.curves.items() if curve.v.max() >= PEAK)


def _mirror(pair: Pair, poses: Mapping[Pair, frozenset[str]]) -> list[Finding]:
    mine, theirs = poses[pair], poses.get((pair[1], pair[0]))
    if not mine or not theirs:
        return []
    return [Finding(pair, "mirror", 0.02, pose=p, amount=1.0) for p in sorted(mine - theirs)] + [
        Finding(pair, "mirror", 0.02, pose=p, amount=-1.0) for p in sorted(theirs - mine)
    ]


def _closures(curve_set: CurveSet) -> dict[str, tuple[str, float]]:
    """Phone → its closing pose and that pose's full weight.

    A pose closes when it has a smoothing window narrower than the others, so that two closures do not merge; and
    the phones it closes for are those that use it fully in more than half of their pairs.
    """
    settings = curve_set.effective_settings
    found: dict[str, tuple[str, float]] = {}
    for pose in curve_set.poses:
        if settings.window_of(pose) >= settings.window and pose not in _CLOSURES:
            continue
        tops = {
            pair: float(b.curves[pose].v.max()) if pose in b.curves else 0.0
            for pair, b in curve_set.bigrams.items()
            if not b.is_empty
        }
        used = [top for top in tops.values() if top > 0]
        if not used:
            continue
        full = float(np.median(used))
        if pose not in _CLOSURES and full < 0.5:
            continue  # it may touch, but is not what the phone is about
        for phone in curve_set.phonemes:
            own = [top >= 0.9 * full for pair, top in tops.items() if phone in pair]
            if own and (phone in _CLOSURES.get(pose, ()) or np.mean(own) > 0.5):
                found.setdefault(phone, (pose, full))
    return found
