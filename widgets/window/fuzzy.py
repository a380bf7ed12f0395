"""How well a few typed letters fit a text: "exw" fits "Export Weights". No Qt."""

from __future__ import annotations

from dataclasses import dataclass

#: A letter that fits counts 1; more when it begins a word, follows the one before, or begins the text.
_WORD, _NEXT, _FIRST = 8.0, 8.0, 4.0
#: Each letter of the text that is left over costs a little, so that the shorter of two texts wins.
_LEFT_OVER = 0.05


@dataclass(frozen=True)
class Fit:
    """score  higher is better; places  indices of the text's letters that were typed"""

    score: float
    places: tuple[int, ...]


def fit(query: str, text: str) -> Fit | None:
    """The best way in which the letters of `query` stand in `text` in their order; None when they do not.

    Spaces of the query stand for nothing. Case never matters.
    """
    letters = [c.casefold()[:1] for c in query if not c.isspace()]
    low = [c.casefold()[:1] for c in text]
    if not letters:
        return Fit(0.0, ())
    # best[j]: (score, places) of the letters so far, the last of them standing at j
    best: dict[int, tuple[float, tuple[int, ...]]] = {}
    for count, letter in enumerate(letters):
        step: dict[int, tuple[float, tuple[int, ...]]] = {}
        before: tuple[float, tuple[int, ...]] | None = (0.0, ()) if count == 0 else None
        for j, c in enumerate(low):
            if c == letter and (before is not None or j - 1 in best):
                here = 1.0 + (_WORD if _begins(text, j) else 0.0) + (_FIRST if j == 0 else 0.0)
                ways = [before] if before is not None else []
                if j - 1 in best:
                    ways.append((best[j - 1][0] + _NEXT, best[j - 1][1]))
                score, places = max(ways, key=lambda way: way[0])
                step[j] = (score + here, (*places, j))
            if count and j in best and (before is None or best[j][0] > before[0]):
                before = best[j]
        best = step
        if not best:
            return None
    score, places = max(best.values(), key=lambda way: way[0])
    return Fit(score - _LEFT_OVER * (len(text) - len(letters)), places)


def _begins(text: str, j: int) -> bool:
    return j == 0 or (text[j].isalnum() and not text[j - 1].isalnum()) or (text[j].isupper() and text[j - 1].islower())
