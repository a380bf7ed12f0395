"""Phone sets are data: what is split looks as before, what is removed is kept, and the preview counts it."""

import pytest

from app import resources
from core_pipeline import pipeline
from core_pipeline.curve_set import CurveSet
from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json
from core_pipeline.phone_sets import added, change_of, removed, renamed
from core_pipeline.schedule import Schedule

SPEECH = Schedule(["sil", "b", "ae", "m", "b", "uw", "sil"], [0, 0.1, 0.2, 0.35, 0.45, 0.55, 0.7, 0.9])


@pytest.fixture(scope="module")
def english() -> CurveSet:
    return curve_set_json.load(resources.english_curves())


def final(curve_set: CurveSet) -> dict[str, list[float]]:
    stages = pipeline.run(SPEECH, curve_set)
    return {pose: stages.magenta[pose].v.tolist() for pose in curve_set.poses}


def test_b_split_from_m_speaks_as_before(english: CurveSet) -> None:
    split = added(english, "b", like="bmp", spoken=["b"])
    assert len(split.phonemes) == 22
    assert split.missing() == []
    assert pipeline.run(SPEECH, split).schedule.phones.count("b") == 2
    assert final(split) == final(english)
    assert all(split.bigrams[pair] is bigram for pair, bigram in english.bigrams.items())
    change = change_of(english, split)
    assert change.added == ("b",)
    assert len([pair for pair in change.copied if "sil" not in pair]) == 43
    assert change.spoken == (("b", "bmp", "b"),)
    assert change.blank == change.aside == change.gone == ()
    assert split.bigrams["b", "ah"].source == "copy of bmp-ah"
    assert split.bigrams["b", "b"].source == "copy of bmp-bmp"


def test_a_new_phoneme_brings_43_empty_bigrams(english: CurveSet) -> None:
    more = added(english, "ü")
    assert len(more.missing()) == 43
    change = change_of(english, more)
    assert len(change.blank) == 43
    assert change.copied == change.returned == ()


def test_what_is_removed_is_kept_and_comes_back(english: CurveSet) -> None:
    less = removed(english, "aw", "ao")
    assert len(less.phonemes) == 20
    assert less.missing() == []
    assert less.phoneme_map["aw"] == "ao"
    assert len(less.aside) == 43
    assert {pair: b for pair, b in less.bigrams.items() if "aw" in pair} == {}
    change = change_of(english, less)
    assert change.gone == ("aw",)
    assert len(change.aside) == 43
    assert change.spoken == (("aw", "aw", "ao"),)
    again = curve_set_json.parse(curve_set_json.dumps(less).encode(), "set.json").curve_set
    back = added(again, "aw", like="ah", spoken=["aw"])
    assert len(change_of(again, back).returned) == 43
    assert back.aside == {}
    for pair, bigram in english.bigrams.items():
        assert all(back.bigrams[pair].curves[pose].same_as(curve) for pose, curve in bigram.curves.items())


def test_a_renamed_phoneme_keeps_everything(english: CurveSet) -> None:
    new = renamed(english, "bmp", "lips")
    assert new.missing() == []
    assert new.bigrams["lips", "lips"] is english.bigrams["bmp", "bmp"]
    assert new.phoneme_map["m"] == "lips"
    assert final(new) == final(english)
    assert renamed(new, "lips", "bmp").bigrams == english.bigrams
    change = change_of(english, new)
    assert (change.added, change.gone) == (("lips",), ("bmp",))
    assert len(change.moved) == 43
    assert change.copied == change.blank == change.aside == ()


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("", "short one"), ("a-b", "short one"), ("a\n", "short one"), (" b", "short one"), ("x" * 61, "short one"),
        ("sil", "means silence"), ("ah", "a phoneme ah already"),
    ],
)  # fmt: skip
def test_a_name_that_will_not_do_is_refused(english: CurveSet, name: str, told: str) -> None:
    for act in (lambda: added(english, name), lambda: renamed(english, "bmp", name)):
        with pytest.raises(UserError, match=told):
            act()


def test_unknown_phonemes_are_refused(english: CurveSet) -> None:
    for act in (
        lambda: added(english, "q", like="nothing"),
        lambda: removed(english, "nothing", "ah"),
        lambda: removed(english, "ah", "nothing"),
        lambda: renamed(english, "nothing", "q"),
    ):
        with pytest.raises(UserError, match="is no phoneme of this set"):
            act()
    with pytest.raises(UserError, match="stand in for itself"):
        removed(english, "ah", "ah")
