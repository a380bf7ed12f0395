"""A blind comparison of two contenders, as the paper's study (section 4), for a small team.

    sentences × faces ─→ trials, each contender on a random side ─→ which is better, how strongly (1…5) ─→ results

Two things to choose from leave one degree of freedom; the paper prints two, with the same meaning.
"""

from __future__ import annotations

import csv
import io
import random
from collections.abc import Sequence
from dataclasses import dataclass, replace

from .errors import UserError

STRENGTHS = (1, 2, 3, 4, 5)
LEFT, RIGHT = "left", "right"


@dataclass(frozen=True)
class Trial:
    """One pair of clips: what is said, by which face, and which contender (0 or 1) stands on the left."""

    text: str
    face: str
    left: int

    def contender(self, side: str) -> int:
        """Which contender is on a side."""
        return self.left if side == LEFT else 1 - self.left


@dataclass(frozen=True)
class Answer:
    """What an observer said about a trial: a side, and how strongly."""

    trial: int
    observer: str
    side: str
    strength: int


@dataclass(frozen=True)
class Study:
    """Read-only; `with_answer` returns a new one. contenders: the two names, which no observer is shown."""

    contenders: tuple[str, str]
    trials: tuple[Trial, ...]
    answers: tuple[Answer, ...] = ()

    @classmethod
    def of(cls, contenders: tuple[str, str], texts: Sequence[str], faces: Sequence[str], seed: int) -> Study:
        """Every sentence by every face, in random order on random sides; each contender is left half of the time."""
        chance = random.Random(seed)
        pairs = [(text, face) for text in texts for face in faces]
        if not pairs:
            raise UserError("A study needs at least one sentence and one face.")
        sides = [i % 2 for i in range(len(pairs))]
        chance.shuffle(pairs)
        chance.shuffle(sides)
        return cls(contenders, tuple(Trial(*pair, side) for pair, side in zip(pairs, sides, strict=True)))

    def with_answer(self, answer: Answer) -> Study:
        """With one more answer; an earlier one of the same observer to the same trial is replaced.

        ValueError when there is no such trial, side or strength.
        """
        if not 0 <= answer.trial < len(self.trials) or answer.side not in (LEFT, RIGHT):
            raise ValueError(f"no trial {answer.trial} with a {answer.side}")
        if answer.strength not in STRENGTHS:
            raise ValueError(f"strength {answer.strength}: 1 to 5")
        others = tuple(a for a in self.answers if (a.trial, a.observer) != (answer.trial, answer.observer))
        return replace(self, answers=(*others, answer))

    def waiting(self, observer: str) -> list[int]:
        """The trials an observer has not answered yet, in order."""
        done = {answer.trial for answer in self.answers if answer.observer == observer}
        return [i for i in range(len(self.trials)) if i not in done]


@dataclass(frozen=True)
class Result:
    """Of one face, or of all: choices and mean strength of each contender, and how likely chance alone would do this.

    chosen     (first, second) how often each was preferred
    strength   mean strength of each one's preferences; 0 where there are none
    chi2, p    χ² goodness of fit against an even choice, 1 degree of freedom; 0 and 1 without an answer
    """

    face: str
    chosen: tuple[int, int]
    strength: tuple[float, float]
    chi2: float
    p: float

    @property
    def percent(self) -> tuple[float, float]:
        """Preference in per cent; 0 and 0 without an answer."""
        total = sum(self.chosen)
        first, second = (100.0 * n / total if total else 0.0 for n in self.chosen)
        return first, second


def results(study: Study) -> list[Result]:
    """One result a face, in order of appearance, and at the end one for all, named ""."""
    faces = list(dict.fromkeys(trial.face for trial in study.trials))
    return [_result(study, face) for face in (*faces, "")]


def _result(study: Study, face: str) -> Result:
    from scipy.stats import chisquare

    strengths: tuple[list[int], list[int]] = ([], [])
    for answer in study.answers:
        trial = study.trials[answer.trial]
        if face in ("", trial.face):
            strengths[trial.contender(answer.side)].append(answer.strength)
    chosen = len(strengths[0]), len(strengths[1])
    means = tuple(sum(s) / len(s) if s else 0.0 for s in strengths)
    chi2, p = (0.0, 1.0) if not sum(chosen) else map(float, chisquare(chosen))
    return Result(face, chosen, (means[0], means[1]), chi2, p)


def to_csv(study: Study) -> str:
    """One line an answer: observer, sentence, face, what was on the left, the preferred contender, strength."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["observer", "trial", "sentence", "face", "left", "side", "preferred", "strength"])
    for answer in study.answers:
        trial = study.trials[answer.trial]
        left, preferred = study.contenders[trial.left], study.contenders[trial.contender(answer.side)]
        row: list[str | int] = [
            answer.observer,
            answer.trial + 1,
            trial.text,
            trial.face,
            left,
            answer.side,
            preferred,
            answer.strength,
        ]
        writer.writerow([_harmless(cell) for cell in row])
    return out.getvalue()


def told(study: Study) -> list[str]:
    """The results as lines for people."""
    first, second = study.contenders
    lines = []
    for result in results(study):
        a, b = result.percent
        lines.append(
            f"{result.face or 'all'}: {first} {a:.0f} %, {second} {b:.0f} % of {sum(result.chosen)} answers; "
            f"χ² = {result.chi2:.2f}, p = {result.p:.3g}; mean strength {result.strength[0]:.2f} and "
            f"{result.strength[1]:.2f}"
        )
    return lines


def _harmless(cell: str | int) -> str | int:
    """A text that a spreadsheet would take for a formula is kept one."""
    return f"'{cell}" if isinstance(cell, str) and cell[:1] in ("=", "+", "-", "@") else cell
