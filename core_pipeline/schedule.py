"""A schedule: which phone sounds when (the paper's phoneme scheduler, section 3.2, figure 5)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import UserError
from .phonemes import SILENCE, Pair

#: No phone may be shorter; far below any real one, far above rounding.
SHORTEST = 1e-5


@dataclass(frozen=True, eq=False)
class Schedule:
    """n phones and n+1 rising times in seconds: phone i lasts from times[i] to times[i+1].

    `sil` is silence. UserError names the phone at which the rule is broken.
    """

    phones: tuple[str, ...]
    times: NDArray[np.float64]

    def __init__(self, phones: Sequence[str], times: ArrayLike) -> None:
        values = np.array(times, dtype=np.float64)
        object.__setattr__(self, "phones", tuple(phones))
        object.__setattr__(self, "times", values)
        if values.ndim != 1 or values.size != len(self.phones) + 1:
            if values.size == 0 and not self.phones:
                object.__setattr__(self, "times", np.zeros(1))
            else:
                raise UserError(
                    f"A schedule of {len(self.phones)} phones needs {len(self.phones) + 1} times, "
                    f"this one has {values.size}: give the start of each phone and the end of the last."
                )
        self._check_times()
        self.times.flags.writeable = False

    def _check_times(self) -> None:
        times = self.times
        odd = np.flatnonzero(~np.isfinite(times))
        if odd.size:
            raise UserError(f"Time {odd[0]} of the schedule is not a number: write seconds, such as 0.25.")
        if np.abs(times).max() > 1e6:
            raise UserError("A time of the schedule lies more than 11 days from 0: write times in seconds.")
        short = np.flatnonzero(np.diff(times) < SHORTEST)
        if short.size:
            i = int(short[0])
            raise UserError(
                f"Times must rise: phone {i} ({self.phones[i]!r}) starts at {times[i]:g} s and ends at "
                f"{times[i + 1]:g} s. Correct that time or remove the phone."
            )

    def __len__(self) -> int:
        return len(self.phones)

    @property
    def start(self) -> float:
        """Start of the first phone, in seconds."""
        return float(self.times[0])

    @property
    def end(self) -> float:
        """End of the last phone, in seconds."""
        return float(self.times[-1])

    @property
    def duration(self) -> float:
        """Seconds from start to end."""
        return self.end - self.start

    def pairs(self) -> list[Pair]:
        """The n−1 bigrams; bigram i spans times[i] to times[i+2]."""
        return list(zip(self.phones[:-1], self.phones[1:], strict=True))

    def mapped(self, phonemes: Sequence[str], phoneme_map: Mapping[str, str]) -> Schedule:
        """With each phone replaced by its common phoneme; a phone of the set itself stays as it is.

        Unknown phones stay too; `unknown` lists them.
        """
        known = set(phonemes)
        if known.issuperset(self.phones):
            return self
        common = {p: phoneme_map.get(p, p) for p in set(self.phones) - known}
        return Schedule([common.get(p, p) for p in self.phones], self.times)

    def unknown(self, phonemes: Sequence[str]) -> list[str]:
        """Phones that are neither silence nor in `phonemes`, each once, in order of appearance."""
        strange = set(self.phones) - {*phonemes, SILENCE}
        return [p for p in dict.fromkeys(self.phones) if p in strange] if strange else []
