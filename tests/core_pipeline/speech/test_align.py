"""Forced alignment against espeak-ng, which knows when it said what: real sound, real recogniser."""

import re
import threading

import numpy as np
import pytest

from core_pipeline.errors import UserError
from core_pipeline.phonemes import SILENCE
from core_pipeline.speech.align import align
from core_pipeline.speech.sentence import clean
from core_pipeline.speech.sphinx import Cancelled, Sphinx
from core_pipeline.speech.utterance import Audio
from tests.helpers.boundaries import boundary_errors
from tests.helpers.outcome import outcome

SENTENCES = (
    "Fat cats often find fish, but seven big dogs never ate them in the morning.",
    "She had your dark suit in greasy wash water all year.",
    "The beige garage is thirty miles north of here.",
)


@pytest.fixture(scope="module")
def spoken(voice):
    return [voice.speak(clean(text)) for text in SENTENCES]


def test_boundaries_lie_where_the_voice_says(spoken, sphinx, voice):
    """The truth are espeak's times as espeak_phones.settled corrects them, with which the curves are played too."""
    found = [align(u.audio, u.text, sphinx, voice) for u in spoken]
    errors = np.concatenate([boundary_errors(u.schedule, f.schedule) for u, f in zip(spoken, found, strict=True)])
    phones = sum(p != SILENCE for u in spoken for p in u.schedule.phones)
    assert errors.size > 0.85 * phones
    assert np.median(errors) <= 0.015
    assert np.mean(errors <= 0.05) >= 0.9
    assert all(f.notes == () for f in found)


def test_the_utterance_fills_its_recording_and_has_every_word(spoken, sphinx, voice):
    u = spoken[0]
    found = align(u.audio, u.text, sphinx, voice)
    assert found.audio is u.audio
    assert (found.schedule.start, found.schedule.end) == (0, u.audio.duration)
    assert [w.text for w in found.words] == re.findall(r"\w+", u.text)
    starts = {w.text: w.start for w in found.words}
    # espeak reads "in the" as one word, and after a pause its stops begin late
    assert all(abs(w.start - starts[w.text.split()[0]]) < 0.2 for w in u.words)
    assert (SILENCE, SILENCE) not in found.schedule.pairs()


def test_words_no_dictionary_lists_and_numbers_are_found(sphinx, voice):
    u = voice.speak(clean("Mr Glumbork owns 42 zaxophones."))
    found = align(u.audio, u.text, sphinx, voice)
    assert [w.text for w in found.words] == ["Mr", "Glumbork", "owns", "42", "zaxophones"]
    assert "glumbork, zaxophones" in found.notes[0]
    assert np.median(boundary_errors(u.schedule, found.schedule)) < 0.03


def test_a_long_recording_is_taken_in_windows_that_agree_with_the_whole(spoken, sphinx, voice):
    many = [*spoken, *spoken, *spoken, *spoken]
    audio = Audio(np.concatenate([u.audio.samples for u in many]), 22050)
    assert audio.duration > 40
    heard = []
    found = align(audio, "\n".join(u.text for u in many), sphinx, voice, heard.append)
    assert heard == sorted(heard)
    assert heard[-1] == 1
    assert len(heard) >= 3
    starts = np.cumsum([0, *(u.audio.duration for u in many[:-1])])
    truth = np.array([start + w.start for start, u in zip(starts, many, strict=True) for w in u.words])
    words = np.array([w.start for w in found.words])
    assert [w.text for w in found.words] == [word for u in many for word in re.findall(r"\w+", u.text)]
    errors = np.abs(words[:, None] - truth).min(axis=0)
    assert np.median(errors) < 0.02
    assert errors.max() < 0.15
    assert found.notes == ()


@pytest.mark.parametrize(
    "text", ["We hold these truths to be self evident, that all men are created equal.", "Fat cats."]
)
def test_a_wrong_transcript_is_refused_or_doubted(spoken, sphinx, voice, text):
    found, refusal = outcome(lambda: align(spoken[0].audio, text, sphinx, voice))
    assert "check the transcript" in found.notes[0] if found else "transcript" in refusal


def test_half_a_transcript_is_doubted_and_a_whole_one_is_not(spoken, sphinx, voice):
    half = align(spoken[0].audio, "Fat cats often find fish, but seven", sphinx, voice)
    assert "check the transcript" in half.notes[0]


def test_a_faint_recording_is_aligned_as_a_loud_one(spoken, sphinx, voice):
    u = spoken[2]
    found = align(Audio(u.audio.samples * np.float32(0.01), u.audio.rate), u.text, sphinx, voice)
    assert np.median(boundary_errors(u.schedule, found.schedule)) <= 0.015


@pytest.mark.parametrize(
    ("sound", "text", "says"),
    [
        (np.zeros(32000), "hello there", "silent"),
        (np.zeros(1600), "hello there", "silent"),
        (np.random.default_rng(1).normal(0, 0.1, 1600), "hello there how are you", "too short"),
        (np.random.default_rng(1).normal(0, 0.1, 48000), "hello there how are you", "do not fit"),
        (np.random.default_rng(1).normal(0, 0.1, 48000), "…", "no English word"),
        (np.random.default_rng(1).normal(0, 0.1, 48000), "你好", "no English word"),
        (np.random.default_rng(1).normal(0, 0.1, 48000), "a " * 60_000, "characters"),
    ],
)
def test_what_cannot_be_aligned_is_one_sentence(sphinx, voice, sound, text, says):
    with pytest.raises(UserError, match=says):
        align(Audio(sound.astype(np.float32), 16000), text, sphinx, voice)


def test_cancel_ends_the_work_at_once_and_the_next_one_runs(spoken, sphinx, voice):
    mine = Sphinx()
    audio = Audio(np.concatenate([u.audio.samples for u in spoken * 10]), 22050)
    begun = threading.Event()
    outcome = []

    def work():
        try:
            align(audio, " ".join(u.text for u in spoken * 10), mine, voice, lambda _: begun.set())
        except Cancelled:
            outcome.append("cancelled")

    thread = threading.Thread(target=work)
    thread.start()
    assert begun.wait(30)
    mine.cancel()
    thread.join(10)
    assert outcome == ["cancelled"]
    assert mine.process_id is None
    mine.begin()
    assert align(spoken[2].audio, spoken[2].text, mine, voice).words
    mine.close()
    with pytest.raises(Cancelled):
        mine.phones(spoken[2].audio.samples)
