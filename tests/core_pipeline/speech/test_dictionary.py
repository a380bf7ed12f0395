"""Speech without a voice: the dictionary, numbers, spelling rules; and the speaker that falls back on them."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.errors import UserError
from core_pipeline.phonemes import SILENCE, TABLE_1
from core_pipeline.speech.dictionary import MILLISECONDS, Dictionary, find_dictionary, installed
from core_pipeline.speech.espeak import Espeak
from core_pipeline.speech.letters import sound_out
from core_pipeline.speech.numbers import in_words
from core_pipeline.speech.sentence import clean
from core_pipeline.speech.speaker import Speaker

NOWHERE = "/nowhere/libespeak-ng.so"


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    """Three words: independent of what is installed."""
    path = tmp_path_factory.mktemp("dictionary") / "small.dict"
    path.write_text("hello HH AH L OW\nhello(2) HH EH L OW\nworld W ER L D\nfish F IH SH\n", "utf-8")
    return Dictionary(path)


def test_every_phone_has_a_duration():
    assert MILLISECONDS.keys() == TABLE_1.keys() - {"hh"}


def test_words_are_spoken_with_mean_durations(small):
    u = small.speak(clean("Hello, world!"))
    assert u.schedule.phones == (SILENCE, "h", "ah", "l", "ow", SILENCE, "w", "er", "l", "d", SILENCE)
    np.testing.assert_allclose(np.diff(u.schedule.times)[1:5], [0.061, 0.087, 0.056, 0.134])
    assert [w.text for w in u.words] == ["Hello", "world"]
    assert u.words[0].start == u.schedule.times[1]
    assert u.words[0].end == pytest.approx(u.schedule.times[5])
    assert u.audio is None
    assert u.notes == ()


def test_the_rate_scales_every_time(small):
    slow, fast = (small.speak(clean("Hello world."), rate).schedule.times for rate in (100, 200))
    np.testing.assert_allclose(slow, 2 * fast)


def test_guessed_words_are_named(small):
    u = small.speak(clean("hello splinky fish"))
    assert u.notes == ("Not in the dictionary, so spoken by spelling rules: splinky.",)
    assert {"s", "p", "l", "ng", "k"} <= set(u.schedule.phones)


def test_a_word_beside_the_first_pronunciation_is_not_a_prefix(small):
    assert small.look_up("hell") == ()
    assert small.look_up("hello") == ("h", "ah", "l", "ow")


def test_without_any_dictionary_rules_speak_and_say_so(tmp_path):
    for dictionary in (Dictionary(None), Dictionary(tmp_path / "missing.dict")):
        u = dictionary.speak(clean("The fish swims in 20 m of water."))
        assert set(u.schedule.phones) <= {*TABLE_1, SILENCE}
        assert "dictionary" in u.notes[0]


def test_nothing_english_to_say_is_told(small):
    with pytest.raises(UserError, match="English"):
        small.speak(clean("日本"))


def test_a_speaker_without_espeak_says_why_and_stays_silent(small):
    speaker = Speaker(Espeak(library=NOWHERE), small)
    u = speaker.speak("Hello world 😀")
    assert u.audio is None
    assert u.notes[0].startswith("There is no sound: espeak-ng does not start")
    assert "Emoji" in u.notes[1]
    speaker.close()


def test_a_speaker_without_espeak_finds_what_is_installed():
    speaker = Speaker(Espeak(library=NOWHERE))
    speaker.warm_up()
    u = speaker.speak("The quick brown fox, 3% of $42, and José's café!")
    assert set(u.schedule.phones) <= {*TABLE_1, SILENCE}
    assert 3 < u.schedule.duration < 9
    speaker.close()


def test_the_installed_dictionary_is_read_where_it_exists():
    """pocketsphinx has no wheel for every Python; then spelling rules speak."""
    path = find_dictionary()
    looked_up = installed().look_up("thought")
    assert looked_up == (("th", "ao", "t") if path else ())


@pytest.mark.parametrize(
    ("number", "words"),
    [
        ("0", "zero"), ("17", "seventeen"), ("40", "forty"), ("101", "one hundred one"),
        ("1,250.5", "one thousand two hundred fifty point five"), ("007", "zero zero seven"),
        ("2000000", "two million"), ("1234567890", "one two three four five six seven eight nine zero"),
    ],
)  # fmt: skip
def test_numbers_are_words(number, words):
    assert in_words(number) == words


@pytest.mark.parametrize(
    ("word", "phones"),
    [("nation", "n ae sh ah n"), ("cake", "k ey k"), ("bbc", "b iy b iy s iy"), ("fishing", "f ih sh ih ng"),
     ("yellow", "y eh l ow"), ("liked", "l ay k d"), ("the", "dh ah"), ("knight", "n ay t")],
)  # fmt: skip
def test_spelling_rules(word, phones):
    assert " ".join(sound_out(word)) == phones


@given(st.text("abcdefghijklmnopqrstuvwxyz'", min_size=1))
def test_any_spelling_has_known_phones(word):
    phones = sound_out(word)
    assert set(phones) <= MILLISECONDS.keys()
    assert phones or not word.strip("'")
