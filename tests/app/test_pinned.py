"""Pinned sentences: tidy, in order, kept."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.pinned import BIGGEST, LONGEST, MOST, Pinned, _tidy, read_lines
from app.settings import ViewState
from core_pipeline.errors import UserError


def test_they_are_kept_in_the_users_order(tmp_path, qtbot):
    pinned = Pinned(ViewState(tmp_path))
    with qtbot.waitSignal(pinned.changed):
        assert pinned.add(["Fat cats.", "  Blue\tshoes. ", "", "Fat cats."]) == 2
    pinned.set(reversed(pinned.texts))
    pinned._state.write()
    assert Pinned(ViewState(tmp_path)).texts == ("Blue shoes.", "Fat cats.")
    assert "Fat cats." in pinned
    pinned.remove("Fat cats.")
    assert pinned.texts == ("Blue shoes.",)


def test_the_same_list_again_is_no_news(tmp_path, qtbot):
    pinned = Pinned(ViewState(tmp_path))
    pinned.add(["One.", "Two."])
    with qtbot.assertNotEmitted(pinned.changed):
        pinned.set(["One.", " Two. "])
        pinned.remove("Three.")


def test_round_and_round(tmp_path):
    pinned = Pinned(ViewState(tmp_path))
    assert pinned.after("One.") == ""
    pinned.add(["One.", "Two.", "Three."])
    assert [pinned.after(text) for text in ("One.", "Three.", "elsewhere")] == ["Two.", "One.", "One."]
    assert [pinned.after(text, -1) for text in ("One.", "elsewhere")] == ["Three.", "Three."]


@given(st.lists(st.text(max_size=30), max_size=20))
def test_any_lines_give_sentences(lines):
    tidy = _tidy(lines)
    assert _tidy(tidy) == tidy
    assert len(set(tidy)) == len(tidy)
    assert all(text and text == " ".join(text.split()) for text in tidy)


def test_no_file_is_too_much(tmp_path):
    pinned = Pinned(ViewState(tmp_path))
    pinned.add([f"{i} {'x' * 1000}" for i in range(1000)])
    assert len(pinned.texts) == MOST
    assert max(map(len, pinned.texts)) == LONGEST


def test_who_has_never_pinned_finds_some_and_who_unpinned_all_finds_none(tmp_path):
    pinned = Pinned(ViewState(tmp_path), ["One.", "Two."])
    assert pinned.texts == ("One.", "Two.")
    pinned.set([])
    pinned._state.write()
    assert Pinned(ViewState(tmp_path), ["One.", "Two."]).texts == ()


def test_a_file_of_lines(tmp_path):
    path = tmp_path / "lines.txt"
    path.write_bytes("\ufeffFat cats.\r\n\r\n  Größe.  \n".encode())
    assert read_lines(path) == ["Fat cats.", "  Größe.  "]


@pytest.mark.parametrize(
    ("data", "told"),
    [
        (b"", "no line of text"),
        (b"\n \n", "no line of text"),
        (b"\xff\xfe\x00", "UTF-8"),
        (b"a\0b", "no line of text"),
        (b"x" * (BIGGEST + 1), "million bytes"),
    ],
    ids=["empty", "blank", "utf-16", "binary", "huge"],
)
def test_what_is_no_file_of_lines_is_said_in_one_sentence(tmp_path, data, told):
    path = tmp_path / "lines.txt"
    path.write_bytes(data)
    with pytest.raises(UserError, match=told) as error:
        read_lines(path)
    assert "lines.txt" in str(error.value)


def test_a_folder_or_nothing_is_said(tmp_path):
    for path in (tmp_path, tmp_path / "gone.txt"):
        with pytest.raises(UserError, match="Cannot read"):
            read_lines(path)
