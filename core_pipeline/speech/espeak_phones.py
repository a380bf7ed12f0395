"""espeak-ng's phoneme names → ARPAbet, the phones of table 1 (section 3.1.1).

Measured over the 117,493 plain words of CMUdict: no name of the American or British voice is missing.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..phonemes import SILENCE
from ..schedule import SHORTEST, Schedule

#: The mnemonic's mark and the second at which it stands.
Mark = tuple[str, float]
Find = Callable[[str], tuple[str, ...] | None]

_ONE = """
ax @ @2 @5 @- @# a# a#2 0#
er 3 3: IR VR
ae a a2 aa
aa A: A# 0 A~
ao O O2 O: O~
ah V 02
uh U
uw u: u
ow oU oU# o o:
aw aU
ay aI
oy OI
ey eI e:
eh E E2 E# e# e
ih I I2 I# I2#
iy i i:
p p
b b
t t t2 t# ?
d d d#
k k x
g g
f f
v v
th T
dh D
s s
z z z# z/2
sh S C
zh Z
ch tS
jh dZ
h h
m m m-
n n n-
ng N
l l l# l/2
r r r-
w w w#
y j
"""

#: One sound of espeak's, two of ours; the first takes FIRST of the time.
_TWO = """
aa,r A@
ao,r O@ o@
eh,r e@
ih,r i@3
uh,r U@
iy,ax i@
ay,ax aI@
ay,er aI3
aw,er aU@
ax,l @L
"""

_BRITISH = """
ax 3
ao 0
aa A@
ao O@ o@
eh e@
ih,ax i@3
uh,ax U@
ay,ax aI3
aw,ax aU@
"""

FIRST = 0.6


def table(text: str) -> dict[str, tuple[str, ...]]:
    """Lines "ours theirs theirs …" → theirs: ours; "aa,r" is two phones."""
    rows = (line.split() for line in text.split("\n") if line)
    return {name: tuple(row[0].split(",")) for row in rows for name in row[1:]}


#: espeak mnemonic → one or two phones.
AMERICAN = table(_ONE + _TWO)
BRITISH = AMERICAN | table(_BRITISH)

_STRESS = "',"
_LIQUIDS = (("l",), ("r",))
_PAUSES = frozenset(["_", "_:", "_!", "_|", "_::", "_^_"])


@dataclass(frozen=True)
class Phones:
    """A schedule, and the names nobody knows, each once; they became silence."""

    schedule: Schedule
    unknown: tuple[str, ...]


def phones_of(mnemonic: str, british: bool = False) -> tuple[str, ...] | None:
    """One or two phones, ("sil",) for a pause, () for a mark that is no sound, None when unknown."""
    name = mnemonic.strip(_STRESS)
    if name in _PAUSES:
        return (SILENCE,)
    if name in ("", ";") or name.startswith("("):  # palatalised; language switch, such as (en)
        return ()
    return (BRITISH if british else AMERICAN).get(name)


def settled(
    marks: Sequence[Mark], samples: NDArray[np.int16], rate: int, quiet: int = 16, shortest: float = 0.003
) -> list[Mark]:
    """The marks, moved to where the phones can be heard and seen to begin. Two habits of espeak's:

    A stop is marked at its burst, after 30 to 50 ms of closure, though the lips are closed by then: every
    phone begins with the silence right before its mark. An l before a consonant sounds within the vowel
    and its own stretch is silent: it takes the end of the vowel.

    samples   (n,) int16; at most `quiet` counts as silence
    shortest  seconds; a shorter silence is a wave crossing zero
    """
    moved = list(marks)
    for i in range(1, len(marks)):
        (before, start), (name, time) = marks[i - 1], marks[i]
        if _is_pause(before):
            continue
        sound = samples[round(start * rate) : round(time * rate)]
        loud = np.flatnonzero((sound > quiet) | (sound < -quiet))
        if loud.size == 0:
            if i > 1 and phones_of(before) in _LIQUIDS and not _is_pause(marks[i - 2][0]):
                onset = moved[i - 2][1]
                moved[i - 1] = (before, onset + FIRST * (start - onset))
                if not _is_pause(name):
                    moved[i] = (name, start)
        elif not _is_pause(name) and (silence := (sound.size - 1 - int(loud[-1])) / rate) >= shortest:
            moved[i] = (name, time - silence)
    return moved


def _is_pause(mnemonic: str) -> bool:
    return mnemonic.strip(_STRESS) in _PAUSES


def to_phones(marks: Sequence[Mark], end: float, british: bool = False, find: Find | None = None) -> Phones:
    """Marks with rising times → a schedule from 0 to `end` seconds, where every phone has a length.

    What comes before the first mark is silence; neighbouring silences are one.

    find  another language's `phones_of`
    """
    find = find or (lambda name: phones_of(name, british))
    phones: list[str] = []
    starts: list[float] = []
    unknown: dict[str, None] = {}

    def add(phone: str, start: float) -> None:
        if phones and start - starts[-1] < SHORTEST:  # the one before has no length
            phones.pop()
            start = starts.pop()
        if not (phone == SILENCE and phones and phones[-1] == SILENCE):
            phones.append(phone)
            starts.append(start)

    add(SILENCE, 0.0)
    sounding = [(name, time) for name, time in marks if find(name) != ()]
    for i, (name, time) in enumerate(sounding):
        found = find(name)
        if not found:
            unknown[name.strip(_STRESS)] = None
            found = (SILENCE,)
        following, stop = sounding[i + 1] if i + 1 < len(sounding) else ("", end)
        if found[-1] == "r" and find(following) == ("r",):
            found = found[:1]
        add(found[0], time)
        if len(found) == 2:
            add(found[1], time + FIRST * (stop - time))
    if len(phones) > 1 and end - starts[-1] < SHORTEST:
        phones.pop()
        starts.pop()
    return Phones(Schedule(phones, [*starts, end]), tuple(unknown))
