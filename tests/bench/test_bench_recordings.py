"""Recordings and the live microphone: python -m pytest tests/bench/test_bench_recordings.py --benchmark-only

Goals on two cores: alignment in a tenth of the recording's length, half of all boundaries within 15 ms and
nine tenths within 50 ms of those of the voice that spoke; live, a chunk of 40 ms within 16 ms, the lips
350 ms behind the sound at most.

What is compared: the starts of the phones that alignment and espeak-ng both have, espeak's as corrected
in espeak_phones.settled (a stop begins at its closure). Pauses are not compared.
"""

from itertools import count

import numpy as np
import pytest

from core_pipeline.files import curve_set_json
from core_pipeline.phonemes import SILENCE, TABLE_1
from core_pipeline.speech.align import align
from core_pipeline.speech.audio_file import resampled
from core_pipeline.speech.espeak import Espeak
from core_pipeline.speech.live import CHUNK, Live
from core_pipeline.speech.recognise import hear_phones, hear_words
from core_pipeline.speech.sentence import clean
from core_pipeline.speech.sphinx import RATE, Sphinx
from core_pipeline.speech.utterance import Audio
from tests.helpers.boundaries import boundary_errors
from tests.helpers.budget import within

SENTENCES = (
    "The quick brown fox jumps over the lazy dog.",
    "She had your dark suit in greasy wash water all year.",
    "Fat cats often find fish, but seven big dogs never ate them in the morning.",
    "The beige garage is thirty miles north of here.",
    "Don't ask me to carry an oily rag like that.",
    "Peter Piper picked a peck of pickled peppers.",
    "We were away a year ago.",
    "Those musicians harmonize marvelously.",
    "A big canoe slid on the smooth planks.",
    "Rice is often served in round bowls.",
    "The juice of lemons makes fine punch.",
    "Four hours of steady work faced us.",
)


@pytest.fixture(scope="module")
def voice():
    warm = Espeak()
    yield warm
    warm.close()


@pytest.fixture(scope="module")
def sphinx():
    ears = Sphinx()
    yield ears
    ears.close()


@pytest.mark.parametrize("name", ["en-us", "gmw/en"])
def test_alignment_of_known_speech(benchmark, voice, sphinx, name):
    spoken = [voice.speak(clean(text), name) for text in SENTENCES]
    align(spoken[0].audio, spoken[0].text, sphinx, voice)  # the model is loaded

    def all_of_them():
        return [align(u.audio, u.text, sphinx, voice, voice=name) for u in spoken]

    found = benchmark.pedantic(all_of_them, rounds=3)
    errors = np.concatenate([boundary_errors(u.schedule, f.schedule) for u, f in zip(spoken, found, strict=True)])
    phones = sum(phone != SILENCE for u in spoken for phone in u.schedule.phones)
    seconds = sum(u.audio.duration for u in spoken)
    benchmark.extra_info |= {
        "seconds of speech": round(seconds, 1),
        "phones compared": f"{errors.size} of {phones}",
        "median error ms": round(1000 * float(np.median(errors)), 1),
        "within 50 ms": round(float(np.mean(errors <= 0.05)), 3),
    }
    print(benchmark.extra_info)
    if name == "en-us":
        assert np.median(errors) <= 0.015
        assert np.mean(errors <= 0.05) >= 0.9
    within(benchmark, 0.1 * seconds)


def test_alignment_of_five_minutes(benchmark, voice, sphinx):
    spoken = [voice.speak(clean(text)) for text in SENTENCES * 8]
    audio = Audio(np.concatenate([u.audio.samples for u in spoken]), 22050)
    text = " ".join(u.text for u in spoken)
    found = benchmark.pedantic(lambda: align(audio, text, sphinx, voice), rounds=1)
    assert found.notes == ()
    benchmark.extra_info["seconds of speech"] = round(audio.duration)
    within(benchmark, 0.1 * audio.duration)


def test_recognition_is_reported_not_promised(benchmark, voice, sphinx):
    spoken = [voice.speak(clean(text)) for text in SENTENCES[:6]]
    heard = benchmark.pedantic(lambda: [hear_words(u.audio, sphinx) for u in spoken], rounds=1)
    right = sum(
        len(set(h.text.split()) & set(u.text.lower().strip(".").split())) for h, u in zip(heard, spoken, strict=True)
    )
    phones = [hear_phones(u.audio, sphinx) for u in spoken]
    same = [
        _at(u.schedule, t) == _at(p.schedule, t)
        for u, p in zip(spoken, phones, strict=True)
        for t in np.arange(0.1, u.audio.duration - 0.1, 0.01)
    ]
    benchmark.extra_info |= {
        "words right": f"{right} of {sum(len(u.text.split()) for u in spoken)}",
        "confidence": round(float(np.mean([h.confidence for h in heard])), 2),
        "frames with the right common phoneme": round(float(np.mean(same)), 2),
    }
    print(benchmark.extra_info)


def test_a_live_chunk(benchmark, voice, sphinx):
    curves = curve_set_json.load("assets/curves/english.json")
    sound = resampled(voice.speak(clean(" ".join(SENTENCES[:6]))).audio, RATE).samples
    live = Live(sphinx, curves)
    at = count()
    latencies = []

    def chunk():
        i = next(at) % (sound.size // CHUNK - 1) * CHUNK
        latencies.append(live.feed(sound[i : i + CHUNK]).latency)

    benchmark.pedantic(chunk, rounds=400)
    benchmark.extra_info |= {"latency ms": round(1000 * float(np.median(latencies)))}
    print(benchmark.extra_info)
    within(benchmark, 0.016)
    if benchmark.enabled:  # a single chunk is all silence
        assert np.median(latencies) <= 0.35


def _at(schedule, t):
    phone = schedule.phones[int(np.searchsorted(schedule.times, t, "right")) - 1]
    return TABLE_1.get(phone, phone)
