"""A recording without a text: words and phones, and how honestly their doubt is told."""

import numpy as np
import pytest

from core_pipeline.errors import UserError
from core_pipeline.phonemes import SILENCE, TABLE_1
from core_pipeline.speech.recognise import Heard, hear_phones, hear_words
from core_pipeline.speech.sentence import clean
from core_pipeline.speech.sphinx import Span
from core_pipeline.speech.utterance import Audio


@pytest.fixture(scope="module")
def spoken(voice):
    return voice.speak(clean("She had your dark suit in greasy wash water all year."), rate=140)


def test_some_words_are_right_and_the_doubt_is_told(spoken, sphinx):
    heard = hear_words(spoken.audio, sphinx)
    assert {"dark", "in", "all", "year", "water", "wash", "suit"} & set(heard.text.split())
    assert 0 < heard.confidence < 1
    assert f"{len(heard.words)} words heard" in heard.sentence
    assert all(0 <= w.start < w.end <= spoken.audio.duration + 0.2 for w in heard.words)


def test_doubtful_words_are_named():
    heard = Heard((Span("fat", 0, 1, 0.9), Span("greek", 1, 2, 0.1)))
    assert "50% sure" in heard.sentence
    assert "doubtful: greek." in heard.sentence


def test_phones_fill_the_recording_and_say_that_they_are_rough(spoken, sphinx):
    found = hear_phones(spoken.audio, sphinx)
    assert (found.schedule.start, found.schedule.end) == (0, spoken.audio.duration)
    assert set(found.schedule.phones) <= {*TABLE_1, SILENCE}
    assert len(found.schedule) > 20
    assert "guessed" in found.notes[0]
    middles = np.arange(0.1, spoken.audio.duration - 0.1, 0.01)
    same = [_common_at(spoken.schedule, t) == _common_at(found.schedule, t) for t in middles]
    assert np.mean(same) > 0.35  # measured 0.5; chance is below 0.1


@pytest.mark.parametrize("hear", [hear_words, hear_phones])
def test_silence_and_nothing_are_refused(hear, sphinx):
    for samples in (np.zeros(16000, np.float32), np.zeros(0, np.float32)):
        with pytest.raises(UserError, match="silent"):
            hear(Audio(samples, 16000), sphinx)


def test_a_long_recording_is_heard_in_pieces(spoken, sphinx):
    audio = Audio(np.concatenate([spoken.audio.samples] * 7), spoken.audio.rate)
    heard = []
    found = hear_phones(audio, sphinx, heard.append)
    assert len(heard) == 3
    assert heard[-1] == 1
    assert found.schedule.end == audio.duration


def _common_at(schedule, t):
    phone = schedule.phones[int(np.searchsorted(schedule.times, t, "right")) - 1]
    return TABLE_1.get(phone, phone)
