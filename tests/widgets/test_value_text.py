"""What may be typed into a field of values."""

import numpy as np
import pytest

from widgets.value_text import parse_typed


@pytest.mark.parametrize(
    ("text", "result"),
    [
        ("0.3", [0.3, 0.3]),
        (".3", [0.3, 0.3]),
        ("=.3", [0.3, 0.3]),
        (" = 0,3 ", [0.3, 0.3]),
        ("30%", [0.3, 0.3]),
        ("*0.5", [0.1, 0.4]),
        ("×2", [0.4, 1.6]),
        ("/2", [0.1, 0.4]),
        ("*50 %", [0.1, 0.4]),
        ("+0.1", [0.3, 0.9]),
        ("-.1", [0.1, 0.7]),
        ("−0.1", [0.1, 0.7]),
        ("1.", [1, 1]),
    ],
)
def test_a_number_sets_and_an_operator_acts_on_each(text, result):
    np.testing.assert_allclose(parse_typed(text).of(np.array([0.2, 0.8])), result)


@pytest.mark.parametrize("text", ["", " ", "x", "*", "/0", "1e999", "nan", "inf", "0.1.2", "++1", "0.3 0.4", "9" * 400])
def test_anything_else_is_no_value(text):
    assert parse_typed(text) is None
