"""espeak-ng in its own process: real speech, and what happens when the process, the library or the time is gone."""

import os
import shutil
import signal
import subprocess
import sys
import threading
from pathlib import Path

import espeakng_loader
import numpy as np
import pytest

from core_pipeline.errors import UserError
from core_pipeline.phonemes import SILENCE, TABLE_1
from core_pipeline.speech.espeak import ALL_VOICES, NICKNAMES, VOICES, Espeak, NoVoice, voice_named
from core_pipeline.speech.sentence import clean

SENTENCES = (
    "The quick brown fox jumps over the lazy dog.",
    "Hello there. How are you, my friend? I have 42 apples.",
    "She had your dark suit in greasy wash water all year.",
    "Peter Piper picked a peck of pickled peppers.",
    "Fat frogs flying past fast.",
    "Dr. Smith paid $3.50 at 10:30!",
    "We were away a year ago.",
    "The beige garage is thirty miles north of here.",
    "Don't ask me to carry an oily rag like that.",
    "Boys' toys: joy, noise, and the occasional church bell…",
)


@pytest.fixture(scope="module")
def espeak():
    with_process = Espeak()
    yield with_process
    with_process.close()


@pytest.mark.parametrize("voice", VOICES)
@pytest.mark.parametrize("text", SENTENCES)
def test_a_sentence_becomes_phones_that_fill_its_sound(espeak, text, voice):
    u = espeak.speak(clean(text), voice)
    s = u.schedule
    assert set(s.phones) <= {*TABLE_1, SILENCE}
    assert (s.start, s.end) == (0, u.audio.duration)
    assert (SILENCE, SILENCE) not in s.pairs()
    lengths = [t for phone, t in zip(s.phones, np.diff(s.times), strict=True) if phone != SILENCE]
    assert min(lengths) > 0.010
    assert max(lengths) < 0.45
    assert 0.05 < np.median(lengths) < 0.12
    assert u.notes == ()


@pytest.mark.parametrize("text", SENTENCES)
def test_the_sound_is_speech_neither_faint_nor_clipped_and_quiet_in_the_pauses(espeak, text):
    u = espeak.speak(clean(text))
    x = u.audio.samples
    assert x.dtype == np.float32
    assert u.audio.rate == 22050
    assert 0.3 < np.abs(x).max() < 1
    assert 0.03 < np.sqrt(np.mean(x**2)) < 0.3
    pauses = [
        x[round(a * 22050) : round(b * 22050)]
        for phone, a, b in zip(u.schedule.phones, u.schedule.times, u.schedule.times[1:], strict=False)
        if phone == SILENCE
    ]
    assert np.abs(np.concatenate(pauses)).max() < 0.01


@pytest.mark.parametrize("text", SENTENCES)
def test_words_stand_in_order_and_begin_and_end_with_a_phone(espeak, text):
    u = espeak.speak(clean(text))
    times = set(u.schedule.times)
    assert all(w.start in times and w.end in times and w.start < w.end for w in u.words)
    assert all(a.end <= b.start for a, b in zip(u.words, u.words[1:], strict=False))
    written = " ".join(w.text for w in u.words)
    assert [c for c in written if c.isalnum()] == [c for c in text if c.isalnum()]


def test_a_stop_begins_with_its_closure(espeak):
    """The lips close before the burst: the first 25 ms of the p in "a puppy" are silent, then it bursts."""
    u = espeak.speak(clean("a puppy"))
    i = u.schedule.phones.index("p")
    start, end = (round(t * 22050) for t in u.schedule.times[i : i + 2])
    p = np.abs(u.audio.samples[start:end])
    assert p[: round(0.025 * 22050)].max() < 0.001
    assert p.max() > 0.02


@pytest.mark.parametrize("text", ["help", "film", "well known", "world"])
def test_an_l_that_sounds_within_its_vowel_is_a_phone(espeak, text):
    s = espeak.speak(clean(text)).schedule
    i = s.phones.index("l")
    assert s.times[i + 1] - s.times[i] > 0.03


def test_several_sentences_are_one_utterance_with_pauses(espeak):
    u = espeak.speak(clean("One apple. Two pears! Three?"))
    assert [w.text for w in u.words] == ["One", "apple", "Two", "pears", "Three"]
    gaps = [round(b.start - a.end, 3) for a, b in zip(u.words, u.words[1:], strict=False)]
    assert gaps[0] == gaps[2] == 0
    assert gaps[1] > 0.15
    assert gaps[3] > 0.15


def test_a_long_text_keeps_picture_and_sound_together(espeak):
    u = espeak.speak(clean("We hope to see you again. " * 150))
    assert u.schedule.end == u.audio.duration
    assert len(u.words) == 150 * 6
    assert np.diff(u.schedule.times).min() > 0.004


def test_words_read_as_one_are_one(espeak):
    assert [w.text for w in espeak.speak(clean("one of the best")).words] == ["one", "of the", "best"]


def test_voices_differ(espeak):
    american, british = (espeak.speak(clean("park"), voice).schedule.phones for voice in ("en-us", "gmw/en"))
    assert "r" in american
    assert "r" not in british


def test_voices_are_known_by_what_people_call_them():
    assert [voice_named(n) for n in ("en-GB", "en_gb", "British", "gmw/en", "en-US")] == ["gmw/en"] * 4 + ["en-us"]
    assert {voice_named(name) for name in (*NICKNAMES, *ALL_VOICES)} == {*ALL_VOICES}
    with pytest.raises(UserError, match="no voice “klingon”"):
        voice_named("klingon")


def test_a_higher_rate_is_shorter(espeak):
    slow, fast = (espeak.speak(clean("We hope to see you again."), rate=rate) for rate in (100, 300))
    assert slow.schedule.duration > 2 * fast.schedule.duration


def test_the_same_sentence_is_spoken_once(espeak):
    first = espeak.speak(clean("Once only."))
    assert espeak.speak(clean("Once only.")) is first
    assert espeak.speak(clean("Once only."), rate=150) is not first


def test_other_alphabets_are_survived_and_noted(espeak):
    u = espeak.speak(clean("Привет, 日本!"))
    assert set(u.schedule.phones) <= {*TABLE_1, SILENCE}
    assert "alphabet" in " ".join(u.notes)


@pytest.mark.parametrize(
    ("voice", "rate", "told"), [("klingon", 175, "klingon"), ("en-us", 5, "80"), ("en-us", 999, "450")]
)
def test_an_impossible_voice_or_rate_is_told(espeak, voice, rate, told):
    with pytest.raises(UserError, match=told):
        espeak.speak(clean("Hello"), voice, rate)


def test_a_killed_process_is_replaced():
    espeak = Espeak()
    before = espeak.speak(clean("Before."))
    first = espeak.process_id
    os.kill(first, signal.SIGTERM)
    after = espeak.speak(clean("Before, and after."))
    assert espeak.process_id not in (None, first)
    assert len(after.schedule) > len(before.schedule)
    espeak.close()
    assert espeak.process_id is None


if hasattr(signal, "SIGSTOP"):  # Windows cannot freeze a process

    def test_a_frozen_process_is_replaced():
        espeak = Espeak(timeout=0.5)
        espeak.warm_up()
        frozen = espeak.process_id
        os.kill(frozen, signal.SIGSTOP)
        assert espeak.speak(clean("Still here.")).audio.duration > 0.5
        assert espeak.process_id != frozen
        espeak.close()

    def test_the_process_ends_with_python():
        program = "from core_pipeline.speech import espeak as e; v = e.Espeak(); v.warm_up(); print(v.process_id)"
        root = Path(__file__).parents[3]
        done = subprocess.run(
            [sys.executable, "-W", "error", "-c", program], cwd=root, capture_output=True, text=True, check=True
        )
        assert done.stderr == ""
        with pytest.raises(ProcessLookupError):
            os.kill(int(done.stdout), 0)


def test_without_the_library_it_says_so():
    espeak = Espeak(library="/nowhere/libespeak-ng.so")
    with pytest.raises(NoVoice, match="does not start"):
        espeak.speak(clean("Hello"))
    assert espeak.process_id is None


def test_without_data_it_says_so(tmp_path):
    with pytest.raises(NoVoice, match="no data"):
        Espeak(data=str(tmp_path / "empty")).warm_up()


def test_a_start_that_takes_too_long_is_given_up():
    with pytest.raises(NoVoice, match="does not start"):
        Espeak(timeout=0.0001).warm_up()


def test_data_in_a_very_deep_folder_is_found(tmp_path):
    """The library itself holds no more than 158 characters of path."""
    deep = tmp_path.joinpath(*["a_rather_long_folder_name"] * 6) / "espeak-ng-data"
    other = [f"{f.name}" for f in Path(espeakng_loader.get_data_path()).glob("*_dict") if f.name != "en_dict"]
    shutil.copytree(espeakng_loader.get_data_path(), deep, ignore=shutil.ignore_patterns(*other))
    assert len(str(deep)) > 158
    espeak = Espeak(data=str(deep))
    assert espeak.speak(clean("Deep down.")).schedule.phones[-2:] == ("n", SILENCE)
    espeak.close()


def test_after_closing_it_is_silent():
    espeak = Espeak()
    espeak.warm_up()
    espeak.close()
    with pytest.raises(NoVoice, match="closed"):
        espeak.speak(clean("Hello"))


def test_many_threads_get_their_own_sentences(espeak):
    texts = [f"Number {i} of twelve." for i in range(12)]
    found = {}
    threads = [threading.Thread(target=lambda t=t: found.update({t: espeak.speak(clean(t))})) for t in texts]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    other = Espeak()
    assert [found[t].schedule.phones for t in texts] == [other.speak(clean(t)).schedule.phones for t in texts]
    other.close()


def test_the_editor_never_loads_what_belongs_to_the_process():
    program = (
        "import sys; from core_pipeline.speech.speaker import speak; speak('Hello');"
        "print([m for m in ('espeakng_loader', 'pocketsphinx', 'PySide6', 'scipy') if m in sys.modules])"
    )
    root = Path(__file__).parents[3]
    done = subprocess.run([sys.executable, "-c", program], cwd=root, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
