"""A saved utterance comes back; its recording is named, never copied."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.errors import UserError
from core_pipeline.files import utterance_json
from core_pipeline.schedule import Schedule
from core_pipeline.speech.utterance import Utterance, Word
from tests.helpers.strategies import schedules


@given(schedules(), st.text(st.characters(codec="utf-8")), st.sampled_from(["", "a b.wav", "ü.mp3"]))
def test_it_comes_back(schedule, text, recording):
    words = (Word("hi", 0.25, 0.5),)
    found = utterance_json.parse(utterance_json.dumps(Utterance(text, schedule, None, words), recording).encode(), "u")
    assert found.text == text
    assert found.schedule.phones == schedule.phones
    assert abs(found.schedule.times - schedule.times).max() < 1e-6
    assert found.words == words
    assert found.recording == recording


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"schema": "x"}, "not an utterance"),
        ({"times": [0, 1]}, "needs 3 times"),
        ({"times": [0, 2, 1]}, "Times must rise"),
        ({"words": [["a", "b", 1]]}, "expected `float`"),
        ({"phones": None}, "expected `array`"),
    ],
)
def test_what_is_wrong_is_named(change, says):
    whole = json.loads(utterance_json.dumps(Utterance("hi", Schedule(["f", "ah"], [0, 1, 2]))))
    with pytest.raises(UserError, match=says):
        utterance_json.parse(json.dumps(whole | change).encode(), "u.json")


def test_a_recording_elsewhere_is_not_followed():
    text = utterance_json.dumps(Utterance("hi", Schedule(["f"], [0, 1])), "../../etc/passwd")
    assert utterance_json.parse(text.encode(), "u").recording == ""
