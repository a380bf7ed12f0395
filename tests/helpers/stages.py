"""Small utterances whose stages can be read off by hand, for the tests of the stage overlay."""

import numpy as np

from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.phonemes import COMMON
from core_pipeline.pipeline import Stages, run
from core_pipeline.schedule import Schedule

#: A peak in the middle: bigram i peaks where phone i+1 begins, if both phones last equally long.
PEAK = [(0, 0), (0.5, 1), (1, 0)]

#: Poses that each phone moves; the rest of the phonemes move `open`.
_MOVES = {"f": "FV", "bmp": "PBM", "w": "W", "sh": "ShCh", "th": "tTeeth", "kg": "tBack", "d": "tRoof", "l": "tRoof"}


def curve_set(*, height: float = 0.8) -> CurveSet:
    """All 441 bigrams, each with a hump for its first and one for its second phone."""
    bigrams = {}
    for first in COMMON:
        for second in COMMON:
            humps = {
                _MOVES.get(second, "open"): [(0.3, 0), (0.6, height), (1, 0)],
                _MOVES.get(first, "open"): [(0, 0), (0.3, 0.9 * height), (0.8, 0)],
            }
            bigrams[first, second] = Bigram({pose: Curve.of(keys) for pose, keys in humps.items()})
    return CurveSet(bigrams=bigrams)


def schedule(phones: str, *, each: float = 0.1) -> Schedule:
    """Phones parted by spaces, each lasting `each` seconds."""
    names = phones.split()
    return Schedule(names, np.arange(len(names) + 1) * each)


def sentence(
    phones: str = "sil ah f ah bmp d l ow sil", *, curves: CurveSet | None = None, each: float = 0.1
) -> Stages:
    """The stages of a short utterance."""
    return run(schedule(phones, each=each), curve_set() if curves is None else curves)
