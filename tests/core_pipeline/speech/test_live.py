"""A recording replayed as if live: phones in order, late but final, and weights that follow the sound."""

import numpy as np
import pytest

from core_pipeline.files import curve_set_json
from core_pipeline.phonemes import SILENCE
from core_pipeline.speech.audio_file import resampled
from core_pipeline.speech.live import CHUNK, Live
from core_pipeline.speech.sentence import clean
from core_pipeline.speech.sphinx import RATE


@pytest.fixture(scope="module")
def curves():
    return curve_set_json.load("assets/curves/english.json")


@pytest.fixture(scope="module")
def moments(voice, sphinx, curves):
    sound = resampled(voice.speak(clean("Five big moths above my map, and a big blue ball.")).audio, RATE).samples
    sound = np.pad(sound, RATE // 2)
    live = Live(sphinx, curves)
    found = [live.feed(sound[i : i + CHUNK]) for i in range(0, sound.size - CHUNK, CHUNK)]
    return live, found, sound


def test_weights_follow_and_stay_in_bounds(moments, curves):
    _, found, _ = moments
    weights = np.array([m.weights for m in found])
    assert weights.shape == (len(found), len(curves.poses))
    assert weights.min() >= 0
    assert weights.max() <= 1
    assert weights.max() > 0.5
    assert not weights[:8].any()  # half a second of silence first


def test_the_lips_are_never_later_than_promised_plus_computing(moments):
    _, found, _ = moments
    assert all(m.latency - m.cost <= 0.33 for m in found)
    assert [m.shown for m in found] == sorted(m.shown for m in found)


def test_what_was_said_can_be_recorded(moments):
    live, found, sound = moments
    u = live.recorded()
    assert u.audio.samples.size == len(found) * CHUNK
    assert np.abs(u.audio.samples - sound[: u.audio.samples.size]).max() < 0.002
    assert u.schedule.end == u.audio.duration
    assert sum(p != SILENCE for p in u.schedule.phones) > 15


def test_silence_moves_nothing_and_records_nothing(sphinx, curves):
    live = Live(sphinx, curves)
    for _ in range(30):
        assert not live.feed(np.zeros(CHUNK, np.float32)).weights.any()
    assert live.recorded() is None


def test_a_new_stream_forgets_the_one_before(moments, sphinx, curves):
    live = Live(sphinx, curves, keep=False)
    first = live.feed(moments[2][:CHUNK])
    assert first.phone == SILENCE
    assert live.seconds == CHUNK / RATE
    assert live.recorded() is None
