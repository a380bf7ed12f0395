"""Hand edits of an utterance: whatever is done, it stays whole."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.errors import UserError
from core_pipeline.phonemes import SILENCE
from core_pipeline.schedule import Schedule
from core_pipeline.speech import edit
from core_pipeline.speech.utterance import Utterance, Word

HELLO = Utterance(
    "hello you",
    Schedule([SILENCE, "h", "ah", "l", "ow", "y", "uw", SILENCE], [0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8]),
    None,
    (Word("hello", 0.1, 0.5), Word("you", 0.5, 0.7)),
)


@given(st.integers(-1, 9), st.floats(-1, 2))
def test_a_boundary_stays_between_its_neighbours_and_takes_its_words_along(boundary, time):
    u = edit.boundary_moved(HELLO, boundary, time)
    assert u.schedule.phones == HELLO.schedule.phones
    assert (np.diff(u.schedule.times) >= edit.SHORTEST - 1e-9).all()
    assert (u.schedule.start, u.schedule.end) == (0, 0.8)
    edges = set(u.schedule.times)
    assert all(w.start in edges and w.end in edges for w in u.words)
    others = [i for i in range(9) if i != boundary]
    assert (u.schedule.times[others] == HELLO.schedule.times[others]).all()


def test_the_ends_do_not_move():
    assert edit.boundary_moved(HELLO, 0, 0.05) is HELLO
    assert edit.boundary_moved(HELLO, 8, 0.75) is HELLO


def test_a_phone_is_renamed_inserted_removed():
    assert edit.renamed(HELLO, 1, "f").schedule.phones[1] == "f"
    after = edit.inserted(HELLO, 1, "y", after=True)
    assert after.schedule.phones[:4] == (SILENCE, "h", "y", "ah")
    assert np.allclose(after.schedule.times[:4], [0, 0.1, 0.15, 0.2])
    before = edit.inserted(HELLO, 1, "y", after=False)
    assert before.schedule.phones[:4] == (SILENCE, "y", "h", "ah")
    gone = edit.removed(HELLO, 2)
    assert gone.schedule.phones[:3] == (SILENCE, "h", "l")
    assert np.allclose(gone.schedule.times[:4], [0, 0.1, 0.3, 0.4])
    assert edit.removed(HELLO, 0).schedule.start == 0
    assert all(u.words == HELLO.words for u in (after, before, gone))


def test_silence_beside_silence_is_one():
    u = edit.renamed(HELLO, 1, SILENCE)
    assert u.schedule.phones[:2] == (SILENCE, "ah")
    assert u.schedule.times[1] == 0.2


def test_what_cannot_be_done_is_one_sentence():
    with pytest.raises(UserError, match="no room"):
        edit.inserted(Utterance("", Schedule(["f"], [0, 0.015])), 0, "d", after=True)
    with pytest.raises(UserError, match="cannot be removed"):
        edit.removed(Utterance("", Schedule(["f"], [0, 1])), 0)


@given(st.lists(st.tuples(st.sampled_from("mria"), st.integers(0, 12), st.floats(0, 0.8)), max_size=12))
def test_any_row_of_edits_leaves_a_whole_utterance(steps):
    u = HELLO
    for what, where, time in steps:
        i = where % len(u.schedule)
        try:
            u = {
                "m": lambda u=u, i=i, t=time: edit.boundary_moved(u, i, t),
                "r": lambda u=u, i=i: edit.renamed(u, i, "f"),
                "i": lambda u=u, i=i: edit.inserted(u, i, SILENCE, after=True),
                "a": lambda u=u, i=i: edit.removed(u, i),
            }[what]()
        except UserError:
            continue
    assert (u.schedule.start, u.schedule.end) == (0, 0.8)
    assert (SILENCE, SILENCE) not in u.schedule.pairs()
    assert all(w.end > w.start for w in u.words)
