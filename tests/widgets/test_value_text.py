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
        ("*0.5 +0.1", [0.2, 0.5]),
        ("*2-.1", [0.3, 1.5]),
        (".5 *50% /2", [0.125, 0.125]),
        ("+0.1=.3", [0.3, 0.3]),
    ],
)
def test_a_number_sets_an_operator_acts_on_each_and_several_act_in_turn(text, result):
    np.testing.assert_allclose(parse_typed(text).of(np.array([0.2, 0.8])), result)


NO_VALUES = ("", " ", "x", "*", "/0", "1e999", "nan", "inf", "0.1.2", "++1", "0.3 0.4", "9" * 400)


@pytest.mark.parametrize("text", [*NO_VALUES, "*2 0.4", "*2 +", "*2 +x", "*2 /0"])
def test_anything_else_is_no_value(text):
    assert parse_typed(text) is None
