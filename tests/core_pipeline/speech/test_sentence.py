"""What users type, cleaned; and what cannot be spoken, told."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.errors import UserError
from core_pipeline.speech.sentence import LONGEST, clean, tokens


@pytest.mark.parametrize("text", ["", "  \n\t ", "…!?", "😀", "\x00\x07", "—", "🇩🇪 👍🏽"])
def test_nothing_to_say_is_told_in_one_sentence(text):
    with pytest.raises(UserError, match="type") as told:
        clean(text)
    assert "\n" not in str(told.value)


def test_too_long_a_text_names_the_limit():
    assert len(clean("a" * LONGEST).text) == LONGEST
    with pytest.raises(UserError, match="5,000"):
        clean("a" * (LONGEST + 1))


def test_lines_and_blanks_become_one_blank():
    assert clean("  Hello\r\n\tthere.  ").text == "Hello there."
    assert clean("  Hello\r\n\tthere.  ").notes == ()


def test_emoji_are_dropped_with_a_note_and_signs_stay():
    found = clean("I ❤️ 20 °C 👩‍🚀 and ©!")
    assert found.text == "I 20 °C and ©!"
    assert found.notes == ("Emoji and other pictures are not spoken.",)


def test_control_characters_are_dropped_with_a_note():
    found = clean("Hel\x07lo\x00 there\u202e.")
    assert found.text == "Hello there."
    assert found.notes == ("Control characters were removed from the text.",)


def test_another_alphabet_is_noted_accents_are_not():
    assert clean("naïve café").notes == ()
    assert "alphabet" in clean("Привет").notes[0]


@given(st.text())
def test_any_text_is_cleaned_once_or_told(text):
    try:
        found = clean(text)
    except UserError:
        return
    assert clean(found.text).text == found.text
    assert found.text.isprintable()


@given(st.text(min_size=1))
def test_tokens_lie_where_they_say(text):
    found = tokens(text)
    assert all(word in text[a:b] for word, a, b in found)
    assert "".join(text[a:b] for _, a, b in found) == "".join(text.split())


def test_tokens_lose_the_punctuation_around_them():
    assert [word for word, *_ in tokens("“Don't!” he said — $3.50, 40%.")] == [
        "Don't",
        "he",
        "said",
        "—",
        "$3.50",
        "40%",
    ]
