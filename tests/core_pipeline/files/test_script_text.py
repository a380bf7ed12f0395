"""A text becomes sentences: none lost, none too long to speak, wrapped lines joined."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.errors import UserError
from core_pipeline.files.script_text import sentences_of
from core_pipeline.speech.sentence import LONGEST


def sentences(text: str, encoding: str = "utf-8") -> list[str]:
    return sentences_of(text.encode(encoding), "script.txt")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("Fat cats often find fish", ["Fat cats often find fish"]),
        ("One line\nAnother line", ["One line", "Another line"]),
        ("A line that was wrapped by\nan editor. And more.", ["A line that was wrapped by an editor.", "And more."]),
        ("He said no.\nhe meant yes", ["He said no.", "he meant yes"]),
        ("# title\n\n  Yes!  \r\n“Really?” She nodded.", ["Yes!", "“Really?”", "She nodded."]),
        ("Wait… What?! 3 times.", ["Wait…", "What?!", "3 times."]),
        ("...\n—\nok", ["ok"]),
        ("first\n# remark\nsecond", ["first", "second"]),
    ],
)
def test_sentences_are_found(text: str, expected: list[str]) -> None:
    assert sentences(text) == expected


def test_any_encoding_an_editor_may_have_saved() -> None:
    assert sentences("Größe", "utf-8-sig") == sentences("Größe", "utf-16") == ["Größe"]


def test_a_text_without_a_full_stop_comes_in_pieces() -> None:
    words = "word " * 3000
    pieces = sentences(words)
    assert max(map(len, pieces)) <= LONGEST
    assert " ".join(pieces).split() == words.split()
    assert [len(piece) for piece in sentences("x" * 12_000)] == [LONGEST, LONGEST, 2000]


@given(st.text(st.sampled_from("ab AB.!?…\"”)\n\r\t#1'"), max_size=80))
def test_no_letter_is_lost_and_none_is_new(text: str) -> None:
    kept = "".join(line for line in text.splitlines(keepends=True) if not line.strip().startswith("#"))
    wanted = [c for c in kept if c.isalnum()]
    try:
        found = sentences(text)
    except UserError:
        assert not wanted
        return
    assert [c for sentence in found for c in sentence if c.isalnum()] == wanted
    assert all(any(c.isalnum() for c in sentence) for sentence in found)
