"""Three-way merge: both sides' work, per bigram and pose; where they clash nothing is lost and the set stays sound."""

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app import resources
from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.files import curve_set_json
from core_pipeline.files.curve_set_diff import differences, distance, pair_differs
from core_pipeline.files.curve_set_merge import decided, merge, open_conflicts, with_theirs
from core_pipeline.phone_sets import added, removed
from core_pipeline.settings import Settings
from tests.helpers import strategies as ours_

F_AH = ("f", "ah")
ONE, TWO, THREE = (Curve.of([(0, 0), (0.5, v), (1, 0)]) for v in (0.1, 0.5, 0.9))
BASE = CurveSet(
    name="Base",
    bigrams={F_AH: Bigram({"open": ONE, "W": ONE}, status="approved"), ("ah", "d"): Bigram({"open": ONE})},
)


def with_curve(curve_set: CurveSet, pose: str, curve: Curve | None, status: str = "approved") -> CurveSet:
    return curve_set.with_bigram(F_AH, replace(curve_set.bigrams[F_AH].with_curve(pose, curve), status=status))


def same(a: CurveSet, b: CurveSet) -> bool:
    return curve_set_json.dumps(a) == curve_set_json.dumps(b)


@given(ours_.curve_sets(), ours_.curve_sets())
def test_one_sides_changes_are_taken(base: CurveSet, side: CurveSet) -> None:
    for merged in (merge(base, side, base), merge(base, base, side), merge(base, side, side)):
        assert same(merged.curve_set, side)
        assert merged.conflicts == ()


@given(ours_.curve_sets(), ours_.curve_sets(), ours_.curve_sets(), st.sampled_from(["approved", "draft"]))
def test_whatever_is_merged_is_a_sound_set_and_clashes_are_kept(
    base: CurveSet, ours: CurveSet, theirs: CurveSet, status: str
) -> None:
    theirs = replace(theirs, name=status, settings=Settings.smartbody())
    merged = merge(base, ours, theirs)
    text = curve_set_json.dumps(merged.curve_set)
    again = curve_set_json.parse(text.encode(), "set.json")
    assert again.repairs == ()
    assert open_conflicts(again.curve_set) == open_conflicts(merged.curve_set)
    assert len(open_conflicts(merged.curve_set)) == len(merged.conflicts)
    for line in open_conflicts(merged.curve_set):
        pair, _, pose = line.partition(" ")
        first, _, second = pair.partition("-")
        bigram = merged.curve_set.bigrams[first, second]
        mark = bigram.extra["conflicts"][pose]
        other = theirs.bigrams.get((first, second), Bigram()).curves.get(pose)
        assert (mark["theirs"] is None) == (other is None)
        assert bigram.status in ("review", "draft", "suggestion", "empty")


def test_two_poses_of_one_bigram_meet_and_ask_for_a_review() -> None:
    merged = merge(BASE, with_curve(BASE, "open", TWO), with_curve(BASE, "W", None))
    bigram = merged.curve_set.bigrams[F_AH]
    assert bigram.curves == {"open": TWO}
    assert bigram.status == "review"
    assert merged.conflicts == ()


def test_a_clash_keeps_ours_and_stores_theirs_until_it_is_decided() -> None:
    merged = merge(BASE, with_curve(BASE, "open", TWO), with_curve(BASE, "open", THREE))
    assert merged.conflicts == ("f-ah open: both sides changed it",)
    assert open_conflicts(merged.curve_set) == ["f-ah open"]
    bigram = merged.curve_set.bigrams[F_AH]
    assert bigram.curves["open"] is TWO
    assert bigram.extra["conflicts"] == {
        "open": {"base": [[0, 0], [0.5, 0.1], [1, 0]], "theirs": [[0, 0], [0.5, 0.9], [1, 0]]}
    }
    assert decided(bigram, {"W"}) is bigram
    assert "conflicts" not in decided(bigram, {"open"}).extra
    assert "conflicts" not in decided(bigram).extra
    assert decided(Bigram()).extra == {}


def test_the_other_side_can_be_looked_at_and_taken() -> None:
    bigram = merge(BASE, with_curve(BASE, "open", TWO), with_curve(BASE, "open", THREE)).curve_set.bigrams[F_AH]
    theirs = with_theirs(bigram)
    assert theirs.curves["open"].same_as(THREE)
    assert with_theirs(theirs).curves["open"].same_as(TWO)
    assert with_theirs(decided(theirs)) is not theirs
    plain = decided(theirs)
    assert with_theirs(plain) is plain
    for odd in (
        None,
        [],
        {"open": 3},
        {"open": {"theirs": "x"}},
        {"open": {"theirs": [[0]]}},
        {"open": {"theirs": [[2, 2]]}},
    ):
        strange = replace(bigram, extra={"conflicts": odd})
        assert with_theirs(strange) is strange


def test_what_one_deletes_and_the_other_changes_is_kept() -> None:
    gone, changed = BASE.with_bigram(F_AH, None), with_curve(BASE, "open", THREE)
    assert merge(BASE, changed, gone).curve_set.bigrams[F_AH].curves["open"] is THREE
    marked = merge(BASE, gone, changed)
    assert marked.curve_set.bigrams[F_AH].extra["conflicts"]["open"]["theirs"] == [[0, 0], [0.5, 0.9], [1, 0]]
    assert F_AH not in merge(BASE, gone, BASE).curve_set.bigrams


def test_notes_are_joined_and_the_lower_status_wins() -> None:
    def noted(note: str, status: str) -> CurveSet:
        return BASE.with_bigram(F_AH, replace(BASE.bigrams[F_AH], note=note, status=status))

    bigram = merge(BASE, noted("lips", "draft"), noted("jaw", "review")).curve_set.bigrams[F_AH]
    assert bigram.note == "lips / jaw"
    assert bigram.status == "draft"


def test_settings_merge_one_by_one() -> None:
    paper = Settings.paper()
    base, ours, theirs = (
        BASE.with_settings(s) for s in (paper, replace(paper, window=0.2), replace(paper, speed_limit=9.0))
    )
    merged = merge(base, ours, theirs)
    assert merged.curve_set.settings == replace(paper, window=0.2, speed_limit=9.0)
    clash = merge(base, theirs, base.with_settings(replace(paper, speed_limit=8.0)))
    assert clash.conflicts == ("the set's settings l_max: 9 (ours) or 8 (theirs)",)
    assert open_conflicts(clash.curve_set) == ["the set's settings l_max"]


def test_a_phone_that_one_side_removes_takes_nothing_of_the_other_with_it() -> None:
    less, more = removed(BASE, "f", "z"), added(with_curve(BASE, "open", THREE), "b", like="f")
    for merged in (merge(BASE, less, more), merge(BASE, more, less)):
        assert "f" not in merged.curve_set.phonemes
        assert "b" in merged.curve_set.phonemes
        assert merged.curve_set.aside[F_AH].curves["open"] is THREE
        assert merged.curve_set.bigrams["b", "ah"].curves["open"] is THREE
        curve_set_json.parse(curve_set_json.dumps(merged.curve_set).encode(), "set.json")


def test_layered_sets_merge_their_own_layer() -> None:
    english = curve_set_json.load(resources.english_curves())
    base = CurveSet(name="Hero").on_base("english", english)
    ours, theirs = (base.with_bigram(p, Bigram({"open": ONE})) for p in (F_AH, ("ah", "d")))
    merged = merge(base, ours, theirs).curve_set
    assert set(merged.own) == {F_AH, ("ah", "d")}
    assert merged.below is english
    assert merged.base == "english"


# ── differences ──────────────────────────────────────────────────────────────────────────────────


@given(ours_.curve_sets(nasty=True))
def test_a_set_does_not_differ_from_itself(curve_set: CurveSet) -> None:
    again = replace(curve_set, bigrams={p: replace(b) for p, b in curve_set.bigrams.items()})
    assert differences(curve_set, again) == []


def test_every_difference_has_its_line() -> None:
    other = with_curve(with_curve(BASE, "open", THREE), "W", None, "draft").with_bigram(("ah", "d"), None)
    other = replace(added(other, "b"), name="Other", settings=Settings.smartbody(), extra={"x": 1})
    lines = differences(BASE, other)
    assert "name: Base → Other" in lines
    assert "phonemes: b only in the second" in lines
    assert "settings speed_limit: 15.0 → 6.0" in lines
    assert "field x: none → 1" in lines
    assert "f-ah: status approved → draft" in lines
    assert "f-ah open: differs by up to 0.8 (3 keys)" in lines
    assert "f-ah W: only in the first" in lines
    assert "ah-d: only in the first (open)" in lines


@pytest.mark.parametrize(("a", "b", "far"), [(ONE, THREE, 0.8), (None, TWO, 0.5), (TWO, TWO, 0), (None, None, 0)])
def test_the_distance_of_curves(a: Curve | None, b: Curve | None, far: float) -> None:
    assert distance(a, b) == distance(b, a) == pytest.approx(far)
    assert pair_differs(BASE, with_curve(BASE, "open", b), F_AH) == pytest.approx(distance(ONE, b))
