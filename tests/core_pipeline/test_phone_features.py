"""Likeness of phones: symmetric, 1 with itself, and as a phonetician would say."""

import numpy as np

from core_pipeline.phone_features import FEATURES, ROWS, likeness
from core_pipeline.phonemes import COMMON, SILENCE, TABLE_1


def test_every_phone_has_a_row_of_shares() -> None:
    assert {*COMMON, *TABLE_1, SILENCE} <= ROWS.keys()
    for row in ROWS.values():
        assert len(row) == len(FEATURES)
        assert all(0 <= share <= 1 for share in row)


def test_it_is_a_kernel() -> None:
    alike = likeness([*COMMON, "?", SILENCE], 1.2)
    assert np.allclose(alike, alike.T)
    assert np.allclose(np.diag(alike), 1)
    assert np.linalg.eigvalsh(alike).min() > 0
    assert alike[len(COMMON), 0] == 0  # an unknown phone is like none


def test_phones_are_as_alike_as_they_are_made() -> None:
    names = ["d", "l", "aa", "bmp", "ow", "w", "m"]
    alike = dict(zip(names, likeness(names, 1.2), strict=True))
    at = names.index
    assert alike["d"][at("l")] > 0.8
    assert alike["d"][at("bmp")] < 0.5
    assert alike["ow"][at("w")] > alike["aa"][at("w")]
    assert alike["m"][at("bmp")] == 1
