"""Schedules: n phones, n+1 rising times; a broken rule is told by phone."""

import numpy as np
import pytest

from core_pipeline.errors import UserError
from core_pipeline.schedule import SHORTEST, Schedule


@pytest.mark.parametrize(
    ("phones", "times", "why"),
    [
        (["a"], [0], "1 phones needs 2 times, this one has 1"),
        (["a"], [], "needs 2 times, this one has 0"),
        (["a"], [[0, 1]], "needs 2 times"),
        (["a", "b"], [0, 1, np.nan], "Time 2 .* not a number"),
        (["a"], [0, np.inf], "Time 1 .* not a number"),
        (["a"], [0, 2e6], "11 days"),
        (["a", "b"], [0, 1, 1], "phone 1 .'b'. starts at 1 s and ends at 1 s"),
        (["a", "b"], [0, -1, 1], "phone 0 .'a'."),
        (["a"], [0, SHORTEST / 2], "phone 0"),
    ],
)
def test_a_broken_rule_names_the_place(phones, times, why):
    with pytest.raises(UserError, match=why):
        Schedule(phones, times)


def test_no_phones_at_all():
    for empty in (Schedule([], []), Schedule([], [3.0])):
        assert len(empty) == 0
        assert empty.pairs() == []
        assert empty.duration == 0
    assert Schedule([], [3.0]).start == 3.0


def test_bigrams_and_ends():
    schedule = Schedule(["a", "b", "c"], [1, 1.5, 2, 4])
    assert schedule.pairs() == [("a", "b"), ("b", "c")]
    assert (schedule.start, schedule.end, schedule.duration) == (1, 4, 3)
    assert Schedule(["a"], [0, 1]).pairs() == []


def test_times_are_read_only_and_a_copy():
    times = np.array([0.0, 1.0])
    schedule = Schedule(["a"], times)
    times[1] = 9
    assert schedule.end == 1
    with pytest.raises(ValueError, match="read-only"):
        schedule.times[0] = 1


def test_phones_of_a_language_become_the_sets_phonemes():
    schedule = Schedule(["iy", "ih", "q", "sil", "q"], range(6))
    mapped = schedule.mapped(["ih"], {"iy": "ih", "ih": "never"})
    assert mapped.phones == ("ih", "ih", "q", "sil", "q")
    assert mapped.unknown(["ih"]) == ["q"]
    assert schedule.phones[0] == "iy"
