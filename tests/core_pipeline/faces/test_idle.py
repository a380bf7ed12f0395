"""Quiet life: one blink a slot, the same every time, never a jump."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.faces.idle import FALL, LENGTH, SHUT, SLOT, blink, brow, enliven, next_blink
from tests.helpers.rigs import NAMES, head

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


@pytest.mark.parametrize(
    ("shapes", "lids"),
    [
        (["open", "blink", "browUp"], {"blink"}),
        (NAMES["arkit52"], {"eyeBlinkLeft", "eyeBlinkRight"}),
        ([f"head__{name}" for name in NAMES["arkit52"]], {"head__eyeBlinkLeft", "head__eyeBlinkRight"}),
        (NAMES["iclone_cc4"], {"Eye_Blink_L", "Eye_Blink_R"}),
        (["jawOpen", "eyeBlink", "eyesClosed"], {"eyeBlink"}),
        (["Fcl_MTH_A", "Fcl_EYE_Close", "Fcl_EYE_Close_R"], {"Fcl_EYE_Close"}),
        (NAMES["oculus15"], set()),
    ],
)
def test_a_rig_blinks_with_the_lids_its_convention_has(shapes, lids):
    face = replace(head(("a",)), shapes=tuple(shapes))
    amounts = np.zeros(len(shapes), np.float32)
    enliven(amounts, face, next_blink(0) + FALL + SHUT / 2, speaking=False)
    assert {shape for shape, amount in zip(shapes, amounts, strict=True) if amount} == lids
    assert not lids or amounts.max() == 1


def test_it_blinks_as_its_author_says():
    face = replace(head(("a",)), shapes=("x", "y", "blink"), expressions={"blink": {"x": 1.0, "y": 0.5}})
    amounts = np.float32([0, 0.7, 0])
    enliven(amounts, face, next_blink(0) + FALL + SHUT / 2, speaking=False)
    assert amounts.tolist() == pytest.approx([1, 0.7, 0])


def test_brows_move_while_speaking():
    face = replace(head(("a",)), shapes=tuple(NAMES["arkit52"]))
    time = max(np.arange(0, 20, 0.05), key=brow)
    amounts = np.zeros(52, np.float32)
    enliven(amounts, face, time, speaking=True)
    assert amounts[face.shapes.index("browInnerUp")] == pytest.approx(brow(time))
