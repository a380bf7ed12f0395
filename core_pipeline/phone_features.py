"""How phones are made, as numbers: two phones that are alike in the mouth are alike in their curves (for suggest.py).

From any table of English phonetics; the values say what a viewer sees, not what a listener hears.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from .phonemes import SILENCE, TABLE_1

Floats = NDArray[np.float64]

#: What each number of a row says, 0…1.
FEATURES = (
    "vowel", "jaw down", "corners out", "lips rounded", "lips shut", "lip to teeth", "teeth together",
    "tip on the ridge", "tip between the teeth", "back raised", "glides",
)  # fmt: skip

_ROWS = {
    #       vow  jaw corn roun shut f    hiss tip  dent back glide
    "ah":  (1.0, 0.6, 0.3, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    "aa":  (1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    "ao":  (1.0, 0.8, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    "eh":  (1.0, 0.5, 0.7, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    "er":  (1.0, 0.2, 0.0, 0.5, 0.0, 0.0, 0.2, 0.0, 0.0, 0.3, 0.0),
    "ih":  (1.0, 0.2, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    "w":   (0.6, 0.1, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.2, 0.3),
    "ow":  (1.0, 0.5, 0.0, 0.8, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.6),
    "aw":  (1.0, 0.8, 0.0, 0.6, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0),
    "oy":  (1.0, 0.5, 0.4, 0.7, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0),
    "ay":  (1.0, 0.8, 0.6, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0),
    "h":   (0.4, 0.4, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    "r":   (0.2, 0.2, 0.0, 0.6, 0.0, 0.0, 0.2, 0.0, 0.0, 0.3, 0.0),
    "l":   (0.2, 0.3, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0),
    "z":   (0.0, 0.1, 0.3, 0.0, 0.0, 0.0, 1.0, 0.4, 0.0, 0.0, 0.0),
    "sh":  (0.0, 0.1, 0.0, 0.6, 0.0, 0.0, 1.0, 0.2, 0.0, 0.0, 0.0),
    "th":  (0.0, 0.2, 0.0, 0.0, 0.0, 0.0, 0.0, 0.2, 1.0, 0.0, 0.0),
    "f":   (0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    "d":   (0.0, 0.2, 0.0, 0.0, 0.0, 0.0, 0.2, 1.0, 0.0, 0.0, 0.0),
    "kg":  (0.0, 0.3, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0),
    "bmp": (0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    # names of other sets
    "j":   (0.0, 0.1, 0.0, 0.6, 0.0, 0.0, 1.0, 0.2, 0.0, 0.0, 0.0),
    "oh":  (1.0, 0.6, 0.0, 0.7, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.2),
    "oo":  (1.0, 0.2, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.1, 0.0),
    "ü":   (1.0, 0.1, 0.4, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    SILENCE: (0.0,) * 11,
}  # fmt: skip

#: Phone → its row, for the common phonemes, English phones, and names other sets use.
ROWS: Mapping[str, tuple[float, ...]] = MappingProxyType(
    _ROWS | {phone: _ROWS[common] for phone, common in TABLE_1.items() if phone not in _ROWS}
)


def likeness(phones: Sequence[str], length: float) -> Floats:
    """(n, n) exp(−d²/2·length²) of the phones' rows; a phone without a row is like none but itself."""
    known = np.array([phone in ROWS for phone in phones])
    rows = np.array([ROWS.get(phone, ROWS[SILENCE]) for phone in phones]).reshape(len(phones), len(FEATURES))
    square = ((rows[:, None] - rows[None]) ** 2).sum(axis=2)
    alike = np.exp(-square / (2 * length**2)) * np.outer(known, known)
    np.fill_diagonal(alike, 1.0)
    return np.asarray(alike)
