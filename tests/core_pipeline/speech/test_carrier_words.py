"""Carrier words: they have their bigram, they are short, and people know them."""

from itertools import pairwise

from core_pipeline.phonemes import COMMON, TABLE_1
from core_pipeline.speech.carrier_words import CANDIDATES, carrier_words, words_of
from core_pipeline.speech.dictionary import Dictionary, find_dictionary

ENTRIES = [
    ("fatten", ("f", "ae", "t", "ax", "n")),
    ("fat", ("f", "ae", "t")),
    ("fah", ("f", "aa")),
    ("cat", ("k", "ae", "t")),
    ("zat", ("z", "ae", "t")),
    ("qa", ("?", "ae")),
]


def test_the_shortest_come_first_and_known_ones_before_names() -> None:
    words = carrier_words(ENTRIES, COMMON, TABLE_1, {"fatten", "cat"})
    assert words["f", "ah"] == ("fatten", "fat")
    assert words["ah", "d"] == ("cat", "fatten", "fat")
    assert len(words["ah", "d"]) == CANDIDATES
    assert ("oy", "oy") not in words
    assert all("" not in pair for pair in words)


def test_the_words_of_a_text() -> None:
    assert words_of("Fat cats, often; I don't FIND a 2nd.") == {"fat", "cats", "often", "don", "find", "nd"}


def test_nearly_every_bigram_has_a_word_that_has_it() -> None:
    dictionary = Dictionary(find_dictionary())
    words = carrier_words(dictionary.entries(), COMMON, TABLE_1, {"fat", "any"})
    if find_dictionary() is None:  # no wheel of pocketsphinx for this Python
        assert words == {}
        return
    assert len(words) > 400
    for pair in (("f", "ah"), ("d", "ih"), ("sh", "aw"), ("bmp", "w")):
        for word in words[pair]:
            phones = [TABLE_1[phone] for phone in dictionary.look_up(word)]
            assert pair in set(pairwise(phones))
