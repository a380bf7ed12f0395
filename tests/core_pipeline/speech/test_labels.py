"""Label files become utterances: names of other alphabets, closures, gaps, overlaps, offsets."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.errors import UserError
from core_pipeline.files.labels.label_file import Interval, make
from core_pipeline.phonemes import SILENCE, TABLE_1
from core_pipeline.speech.labels import utterance_of
from core_pipeline.speech.phone_names import ALPHABETS, alphabet_of, translated
from core_pipeline.speech.spans import to_schedule
from core_pipeline.speech.utterance import Audio


def labels(*phones, step=0.1, start=0.0):
    return make("test", [Interval(start + i * step, start + (i + 1) * step, p) for i, p in enumerate(phones)])


@pytest.mark.parametrize(
    ("names", "alphabet", "phones"),
    [
        ("HH AH0 L OW1 sp", "ARPAbet", "h ah l ow sil"),
        ("hh ah l ow sil", "ARPAbet", "h ah l ow sil"),
        ("HH_B AH0_I L_I OW1_E SIL_S", "ARPAbet", "h ah l ow sil"),
        ("tʃ dʒ aj ɔj iː tʰ kʷ ɾ ʉː ɝ", "IPA", "ch jh ay oy iy t k d uw er"),
        ("t͡ʃ d͡ʒ aɪ oʊ ˈæ ɹ ŋ θ ð ʌ", "IPA", "ch jh ay ow ae r ng th dh ah"),
        ("tS dZ { @U 3: T D N S i:", "X-SAMPA", "ch jh ae ow er th dh ng sh iy"),
        ("kg bmp ah", "ARPAbet", "kg bmp ah"),
    ],
)
def test_alphabets_are_recognised(names, alphabet, phones):
    names = names.split()
    assert alphabet_of(names) == alphabet
    found, unknown = translated(names, {})
    assert unknown == []
    assert [p for name in names for p in found[name]] == phones.split()


def test_every_name_of_every_table_leads_to_a_phone_of_table_1():
    for table in ALPHABETS.values():
        assert {p for phones in table.values() for p in phones} <= set(TABLE_1)


@pytest.mark.parametrize(
    "name",
    ["", " ", "sp", "SIL", "sil", "spn", "h#", "pau", "epi", "<eps>", "<p:>", "{B_TRANS}", "[noise]", "#", "_", "H#"],
)
def test_silence_has_many_names(name):
    u = utterance_of(labels("AA1", name, "T")).utterance
    assert u.schedule.phones == ("aa", SILENCE, "t")


def test_closures_join_their_stops_and_stand_alone_as_one():
    u = utterance_of(labels("h#", "tcl", "t", "dcl", "jh", "kcl", "s", "bcl")).utterance
    assert u.schedule.phones == (SILENCE, "t", "jh", "k", "s", "b")
    assert np.allclose(u.schedule.times, [0, 0.1, 0.3, 0.5, 0.6, 0.7, 0.8])


def test_unknown_names_are_listed_and_can_be_assigned():
    first = utterance_of(labels("AA1", "QX", "T", "zork"))
    assert first.unknown == ("QX", "zork")
    assert first.utterance.schedule.phones == ("aa", SILENCE, "t", SILENCE)
    assert "QX, zork" in first.utterance.notes[0]
    second = utterance_of(labels("AA1", "QX", "T", "zork"), assigned={"QX": "b", "zork": "ay er"})
    assert second.unknown == ()
    assert second.utterance.schedule.phones == ("aa", "b", "t", "ay", "er")


def test_the_curve_sets_own_phones_are_known():
    assert utterance_of(labels("ü", "AA1"), known=["ü"]).unknown == ()
    assert utterance_of(labels("AA1", "ü")).unknown == ("ü",)


def test_with_a_recording_it_lasts_as_long_and_without_as_the_labels():
    audio = Audio(np.zeros(16000, np.float32), 16000)
    far = labels("AA1", "T", start=0.5)
    u = utterance_of(far, audio).utterance
    assert (u.schedule.start, u.schedule.end) == (0, 1)
    assert u.schedule.phones == (SILENCE, "aa", "t", SILENCE)
    assert utterance_of(far).utterance.schedule.start == 0.5
    note = utterance_of(labels("AA1", "T", step=2.0), audio).utterance.notes[0]
    assert "the recording 1.0 s" in note


def test_overlaps_are_cut_and_told():
    found = make("test", [Interval(0, 0.3, "AA1"), Interval(0.2, 0.5, "T"), Interval(0.25, 0.28, "S")])
    u = utterance_of(found).utterance
    assert u.schedule.phones == ("aa", "t")
    assert np.allclose(u.schedule.times, [0, 0.2, 0.5])
    assert "overlap" in u.notes[0]


def test_nothing_but_silence_is_refused():
    with pytest.raises(UserError, match="nothing but silence"):
        utterance_of(labels("sil", "sp"))


@given(
    st.lists(
        st.tuples(st.sampled_from(["f", "ah", SILENCE, "d"]), st.floats(-1, 3), st.floats(0, 1)).map(
            lambda x: (x[0], x[1], x[1] + x[2])
        ),
        max_size=12,
    )
)
def test_any_spans_make_a_schedule_that_fills_its_time(spans):
    schedule = to_schedule(spans, 0.0, 2.0)
    assert (schedule.start, schedule.end) == (0, 2)
    assert (SILENCE, SILENCE) not in schedule.pairs()
    assert (np.diff(schedule.times) > 0.001).all()
