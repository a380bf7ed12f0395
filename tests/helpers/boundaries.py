"""How far the boundaries of one schedule lie from another's, where both have the same phones."""

import difflib

import numpy as np

from core_pipeline.phonemes import SILENCE
from core_pipeline.schedule import Schedule

#: CMUdict has no schwa.
_SAME = {"ax": "ah"}


def boundary_errors(truth: Schedule, found: Schedule) -> np.ndarray:
    """Seconds between the starts of the phones that both have, in order; pauses are not compared."""
    a, b = ([_SAME.get(p, p) for p in s.phones] for s in (truth, found))
    blocks = difflib.SequenceMatcher(None, a, b, autojunk=False).get_matching_blocks()
    return np.array(
        [
            abs(truth.times[block.a + k] - found.times[block.b + k])
            for block in blocks
            for k in range(block.size)
            if a[block.a + k] != SILENCE
        ]
    )
