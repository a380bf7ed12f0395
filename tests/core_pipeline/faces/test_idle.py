"""Quiet life: one blink a slot, the same every time, never a jump."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.faces.idle import LENGTH, SLOT, blink, brow, next_blink

moments = st.floats(0, 1e5)


@given(moments)
def test_a_blink_shuts_and_opens_the_lids_once_in_every_slot(time):
    start = next_blink(time)
    assert time < start < time + 2 * SLOT
    shut = [blink(start + LENGTH * i / 200) for i in range(201)]
    assert shut[0] == shut[-1] == 0.0
    assert max(shut) == 1.0
    assert np.count_nonzero(np.diff(np.sign(np.diff(shut)[np.diff(shut) != 0]))) == 1


@given(moments)
def test_nothing_jumps_and_everything_stays_a_weight(time):
    for life in (blink, brow):
        here, there = life(time), life(time + 1e-4)
        assert 0.0 <= here <= 1.0
        assert abs(here - there) < 0.01


def test_the_eyes_are_open_most_of_the_time():
    times = np.arange(0, 600, 0.01)
    assert 0.01 < np.mean([blink(t) > 0.5 for t in times]) < 0.08
