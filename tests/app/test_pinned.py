"""Pinned sentences: tidy, in order, kept."""

from hypothesis import given
from hypothesis import strategies as st

from app.pinned import LONGEST, MOST, Pinned, _tidy
from app.settings import ViewState


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
