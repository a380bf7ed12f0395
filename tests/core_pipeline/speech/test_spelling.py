"""Which letters stand for which phones, and where a sentence has a bigram."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.phonemes import TABLE_1
from core_pipeline.schedule import Schedule
from core_pipeline.speech.spelling import in_words, letters_of
from core_pipeline.speech.utterance import Utterance, Word

CATS = Utterance(
    "Fat cats",
    Schedule(["sil", "f", "ae", "t", "k", "ae", "t", "s", "sil"], [0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9]),
    words=(Word("Fat", 0.1, 0.4), Word("cats", 0.4, 0.8)),
)


@pytest.mark.parametrize(
    ("word", "spelt"),
    [
        ("fat", "f:f ae:a t:t"),
        ("Knight", "n:Kn ay:igh t:t"),
        ("thoughts", "th:th ao:ough t:t s:s"),
        ("bought", "b:b ao:ough t:t"),
        ("blue", "b:b l:l uw:ue"),
        ("didn't", "d:d ih:i d:d n:n t:t"),
        ("psalms", "s:s aa:l m:m z:s"),
        ("quick", "k:qu w:qu ih:i k:ck"),
        ("thirty-one", "th:th er:ir t:t iy:y w: ah:o n:n"),
    ],
)
def test_letters_stand_where_a_reader_would_put_them(word, spelt):
    phones = [pair.partition(":")[0] for pair in spelt.split()]
    assert (
        " ".join(f"{p}:{word[a:b]}" for p, (a, b) in zip(phones, letters_of(word, tuple(phones)), strict=True)) == spelt
    )


@given(st.text(max_size=12), st.lists(st.sampled_from([*TABLE_1, "ü"]), max_size=10))
def test_any_word_and_any_phones_have_spans_in_order_within_the_word(word, phones):
    spans = letters_of(word, tuple(phones))
    assert len(spans) == len(phones)
    ends = [0]
    for start, end in spans:
        assert 0 <= start <= end <= len(word)
        assert end >= ends[-1]
        ends.append(end)


def test_every_bigram_is_found_in_its_word_or_between_two():
    found = [(text, text[start:end]) for text, (start, end) in in_words(CATS)]
    assert found == [
        ("Fat", "F"),
        ("Fat", "Fa"),
        ("Fat", "at"),
        ("Fat cats", "t c"),
        ("cats", "ca"),
        ("cats", "at"),
        ("cats", "ts"),
        ("cats", "s"),
    ]
    assert in_words(Utterance("", Schedule([], [0]))) == []
    assert in_words(Utterance("hm", Schedule(["sil", "m", "sil"], [0, 1, 2, 3]))) == [("", (0, 0))] * 2
