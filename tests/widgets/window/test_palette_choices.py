"""Which choices a few letters find, and in which order."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from widgets.window.fuzzy import fit
from widgets.window.palette_choices import MOST, Choice, ranked

COMMANDS = [
    Choice("open", "Open", "File"),
    Choice("weights", "Export Weights", "File"),
    Choice("curves", "Export Curve Set", "File"),
    Choice("slide", "Slide to another version", "Canvas"),
    Choice("statistics", "Corpus Statistics", "Tools"),
    Choice("layout", "Reset Layout", "View"),
    Choice("opening", "The Version at Opening", "Tools → Compare With"),
    Choice("redo", "Redo", "Edit", enabled=False),
]
PHONES = ("ah", "aa", "f", "t", "th", "h")
PAIRS = [Choice(f"{a}-{b}", f"{a} – {b}", "Bigram", name=f"{a} {b}") for a in PHONES for b in PHONES]


def ids(query, choices=(*COMMANDS, *PAIRS), recent=(), found=()):
    return [offer.choice.id for offer in ranked(query, choices, recent, found)]


@given(st.text(max_size=12), st.text(max_size=40))
def test_what_fits_is_a_subsequence_and_its_places_say_where(query, text):
    found = fit(query, text)
    letters = [c.casefold()[:1] for c in query if not c.isspace()]
    if found is None:
        rest = iter([c.casefold()[:1] for c in text])
        assert not all(letter in rest for letter in letters)
    else:
        assert [text[i].casefold()[:1] for i in found.places] == letters
        assert list(found.places) == sorted(set(found.places))


@given(st.text(st.characters(categories=["L"]), min_size=1, max_size=20))
def test_a_title_typed_whole_is_first(title):
    others = [f"{title} and more", "-".join(title), " ".join(title.upper()) + "!"]
    assert ids(title, [Choice(other, other) for other in (*others, title)])[0] == title


@pytest.mark.parametrize(
    ("query", "first"),
    [
        ("exw", "weights"),
        ("stat", "statistics"),
        ("stav", "slide"),
        ("expcur", "curves"),
        ("RESET", "layout"),
        ("view lay", "layout"),
        ("compare", "opening"),
        ("f ah", "f-ah"),
        ("F-AH", "f-ah"),
        ("fah", "f-ah"),
        ("t h", "t-h"),
        ("th", "t-h"),
        ("thh", "th-h"),
        ("th h", "th-h"),
    ],
)
def test_letters_find(query, first):
    assert ids(query)[0] == first


def test_the_first_phone_alone_finds_its_row():
    assert set(ids("th", PAIRS)) == {f"th-{b}" for b in PHONES} | {"t-h"}
    assert set(ids("f a", PAIRS)) == {"f-ah", "f-aa"}


def test_a_phone_typed_whole_comes_before_letters_scattered_over_a_title():
    blind, ship = Choice("blind", "Blind Comparison", "Tools"), Choice("shortcuts", "Show Shortcuts", "Help")
    row = [Choice(f"{a}-ah", f"{a} – ah", "Bigram", name=f"{a} ah") for a in ("bmp", "sh", "b")]
    assert ids("bmp", [blind, *row]) == ["bmp-ah", "blind"]
    assert ids("sh", [*row, ship]) == ["shortcuts", "sh-ah"]  # it begins so
    assert ids("b", [*row, blind])[0] == "blind"


def test_a_groups_name_comes_before_the_bigrams_of_that_word():
    word = [Choice("f-ah", "f – ah", "in “compare”")]
    assert ids("compare", found=word)[:2] == ["opening", "f-ah"]
    assert ids("comp", found=word)[:2] == ["opening", "f-ah"]


def test_without_a_query_the_recent_come_first_and_bigrams_only_when_recent():
    others = ["open", "weights", "curves", "slide", "statistics", "opening", "redo"]
    assert ids("", recent=["layout", "f-ah", "gone"]) == ["layout", "f-ah", *others]


def test_of_two_that_fit_alike_the_recent_one_is_first():
    assert ids("export")[:2] == ["weights", "curves"]
    assert ids("export", recent=["curves"])[:2] == ["curves", "weights"]


def test_what_cannot_be_done_now_comes_last():
    assert ids("re")[0] == "layout"
    assert "redo" in ids("re")


def test_a_sentence_is_found_by_pieces_of_it():
    shoes = [Choice("shoes", "My mother bought five blue shoes.", prose=True)]
    assert ids("fish", shoes) == []
    assert ids("blue moth", shoes) == ["shoes"]
    assert ranked("Blue", shoes, ())[0].places == (22, 23, 24, 25)


def test_what_others_found_stands_behind_what_fits_well_and_is_listed_once():
    word = [Choice("f-ah", "f – ah", "in “fat”")]
    assert ids("exw", found=word)[:2] == ["weights", "f-ah"]
    assert ids("fat", found=word).count("f-ah") == 1


def test_no_more_than_anybody_scrolls():
    many = [Choice(str(i), f"Number {i}") for i in range(1000)]
    assert len(ranked("number", many, ())) == MOST
