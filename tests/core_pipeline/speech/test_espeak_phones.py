"""espeak's names and marks → ARPAbet and a schedule."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.phonemes import SILENCE, TABLE_1
from core_pipeline.schedule import SHORTEST
from core_pipeline.speech.espeak_phones import AMERICAN, BRITISH, phones_of, settled, to_phones


def test_every_phone_of_the_tables_is_in_table_1():
    assert {p for phones in (*AMERICAN.values(), *BRITISH.values()) for p in phones} <= TABLE_1.keys()


def test_every_english_phone_can_be_spoken():
    missing = TABLE_1.keys() - {p for phones in AMERICAN.values() for p in phones}
    assert missing == {"hh"}  # another name of h


@pytest.mark.parametrize(
    ("mnemonic", "american", "british"),
    [
        ("'eI", ("ey",), ("ey",)), (",3", ("er",), ("ax",)), ("A@", ("aa", "r"), ("aa",)), ("0", ("aa",), ("ao",)),
        ("i@3", ("ih", "r"), ("ih", "ax")), ("@L", ("ax", "l"), ("ax", "l")), ("_:", (SILENCE,), (SILENCE,)),
        (";", (), ()), ("(en)", (), ()), ("&&", None, None),
    ],
)  # fmt: skip
def test_names_are_translated(mnemonic, american, british):
    assert phones_of(mnemonic) == american
    assert phones_of(mnemonic, british=True) == british


def test_two_phones_of_one_mark_share_its_time_sixty_to_forty():
    s = to_phones([("k", 0.0), ("A@", 0.1), ("_:", 0.3)], 0.4).schedule
    assert s.phones == ("k", "aa", "r", SILENCE)
    np.testing.assert_allclose(s.times, [0, 0.1, 0.22, 0.3, 0.4])


def test_an_r_is_not_said_twice():
    s = to_phones([("o@", 0.0), ("r", 0.2), ("i", 0.3)], 0.4).schedule
    assert s.phones == ("ao", "r", "iy")


def test_an_unknown_name_is_silence_and_named_once():
    found = to_phones([("p", 0.0), ("#q", 0.1), ("'#q", 0.2), ("t", 0.3)], 0.4)
    assert found.schedule.phones == ("p", SILENCE, "t")
    assert found.unknown == ("#q",)


def test_what_is_no_sound_leaves_no_gap():
    s = to_phones([("n", 0.0), (";", 0.1), ("i", 0.1), ("_", 0.2)], 0.2).schedule
    assert s.phones == ("n", "iy")


@given(
    st.lists(st.tuples(st.sampled_from([*AMERICAN, "_:", "_", ";", "??"]), st.integers(0, 3000)), max_size=30),
    st.integers(1, 3000),
    st.booleans(),
)
def test_any_rising_marks_become_a_whole_schedule(steps, tail, british):
    at, marks = 0, []
    for name, samples in steps:
        at += samples
        marks.append((name, at / 22050))
    end = (at + tail) / 22050
    s = to_phones(marks, end, british).schedule
    assert (s.start, s.end) == (0, end)
    assert (np.diff(s.times) >= SHORTEST).all()
    assert set(s.phones) <= {*TABLE_1, SILENCE}
    assert (SILENCE, SILENCE) not in s.pairs()


def _sound(*parts: tuple[float, int]) -> np.ndarray:
    return np.concatenate([np.full(round(seconds * 1000), level, np.int16) for seconds, level in parts])


def test_a_phone_begins_with_the_silence_before_its_mark():
    sound = _sound((0.1, 5000), (0.04, 3), (0.05, 2000))
    assert settled([("a", 0.0), ("p", 0.14)], sound, 1000) == [("a", 0.0), ("p", pytest.approx(0.1))]


def test_a_pause_keeps_its_silence():
    sound = _sound((0.1, 5000), (0.1, 0), (0.1, 5000))
    marks = [("a", 0.0), ("_:", 0.1), ("p", 0.2)]
    assert settled(marks, sound, 1000) == marks


def test_a_silent_l_takes_the_end_of_its_vowel_and_leaves_the_closure_to_the_stop():
    sound = _sound((0.2, 5000), (0.04, 0), (0.05, 2000))
    found = settled([("E", 0.0), ("l", 0.2), ("p", 0.24)], sound, 1000)
    assert [(name, round(t, 3)) for name, t in found] == [("E", 0.0), ("l", 0.12), ("p", 0.2)]
