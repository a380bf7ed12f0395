"""A character's set stores what differs from its base; the rest comes from there, and only there."""

import json
import os
from pathlib import Path
from typing import Any

import pytest

from app import resources
from core_pipeline.curve_set import Bigram, CurveSet
from core_pipeline.curves import Curve
from core_pipeline.errors import UserError
from core_pipeline.files import curve_set_json
from core_pipeline.files.layers import MAX_LAYERS, built_in, moved_base
from core_pipeline.settings import Settings

F_AH = ("f", "ah")
HILL = Curve.of([(0, 0), (0.5, 0.9), (1, 0)])
LOW = Curve.of([(0, 0), (0.5, 0.1), (1, 0)])


@pytest.fixture(scope="module")
def english() -> CurveSet:
    return curve_set_json.load(resources.english_curves())


@pytest.fixture
def hero(english: CurveSet) -> CurveSet:
    return CurveSet(name="Hero", bigrams={F_AH: Bigram({"open": HILL})}).on_base("english", english)


def write(path: Path, **fields: Any) -> Path:
    path.write_text(json.dumps({"schema": curve_set_json.SCHEMA, **fields}), "utf-8")
    return path


def refusal(path: Path) -> str:
    with pytest.raises(UserError) as caught:
        curve_set_json.load(path)
    assert str(path.name) in str(caught.value)
    return str(caught.value)


def test_the_base_plays_where_the_character_has_nothing(hero: CurveSet, english: CurveSet) -> None:
    assert len(hero.own) == 1
    assert hero.missing() == []
    assert hero.bigrams["ah", "d"] is english.bigrams["ah", "d"]
    assert hero.layer_of(F_AH) == "Hero"
    assert hero.layer_of(("ah", "d")) == "English"
    assert hero.layer_of(("no", "such")) == ""


def test_edits_go_to_the_upper_layer_and_none_brings_the_base_back(hero: CurveSet, english: CurveSet) -> None:
    edited = hero.with_bigram(("ah", "d"), Bigram({"open": LOW}))
    assert set(edited.own) == {F_AH, ("ah", "d")}
    back = edited.with_bigram(("ah", "d"), None).with_bigram(F_AH, None)
    assert back.own == {}
    assert back.bigrams[F_AH] is english.bigrams[F_AH]


def test_only_what_is_its_own_is_written_and_it_reads_the_same(hero: CurveSet, tmp_path: Path) -> None:
    curve_set_json.save(hero, tmp_path / "hero.json")
    top = json.loads((tmp_path / "hero.json").read_text("utf-8"))
    assert top["base"] == "english"
    assert list(top["bigrams"]) == ["f-ah"]
    assert not {"settings", "phoneme_map"} & set(top)
    again = curve_set_json.load(tmp_path / "hero.json")
    assert curve_set_json.dumps(again) == curve_set_json.dumps(hero)
    assert curve_set_json.dumps(again.flattened()) == curve_set_json.dumps(hero.flattened())


def test_a_base_that_changes_shows_through(tmp_path: Path) -> None:
    low = CurveSet(name="Low", bigrams={F_AH: Bigram({"open": LOW}), ("ah", "d"): Bigram({"open": LOW})})
    curve_set_json.save(low.with_settings(Settings.smartbody()), tmp_path / "low.json")
    write(tmp_path / "hero.json", base="low.json", bigrams={"f-ah": {"curves": {"open": [[0, 1]]}}})
    hero = curve_set_json.load(tmp_path / "hero.json")
    assert hero.effective_settings == Settings.smartbody()
    assert hero.settings is None
    curve_set_json.save(low.with_bigram(("ah", "d"), Bigram({"W": HILL})), tmp_path / "low.json")
    hero = curve_set_json.load(tmp_path / "hero.json")
    assert hero.bigrams["ah", "d"].curves["W"].same_as(HILL)
    assert hero.bigrams[F_AH].curves["open"].keys() == [(0, 1)]


def test_three_layers(tmp_path: Path) -> None:
    write(tmp_path / "a.json", name="A", base="English")
    write(tmp_path / "b.json", name="B", base="./a.json", phonemes=["f", "ah", "ü"], bigrams={"f-ü": {}})
    upper = curve_set_json.load(tmp_path / "b.json")
    assert upper.layer_of(("f", "ü")) == "B"
    assert upper.layer_of(F_AH) == "English"
    assert set(upper.bigrams) <= {(a, b) for a in ("f", "ah", "ü", "sil") for b in ("f", "ah", "ü", "sil")}


def test_flattened_it_needs_no_base(hero: CurveSet, tmp_path: Path) -> None:
    text = curve_set_json.dumps(hero.flattened(), minified=True)
    alone = curve_set_json.parse(text.encode(), "set.json").curve_set
    assert alone.base is None
    assert len(alone.bigrams) == len(hero.bigrams)


# ── what is refused ──────────────────────────────────────────────────────────────────────────────


@pytest.mark.parametrize(
    ("base", "told"),
    [
        ("klingon", "no built-in set “klingon”"),
        ("gone.json", "its base “gone.json” is not there"),
        ("folder.json", "is not there"),
        ("pipe.json", "is not there"),
        ("../../../../../etc/passwd", "is not there"),
        ("a\0.json", "is not there"),
        ("x" * 900 + ".json", "is not there"),
        ("bad.json", "its base cannot be used: "),
        ("me.json", "leads back to itself (me.json → me.json)"),
        ("crab", "its base has the pose “mouth open”"),
    ],
)
def test_a_base_that_cannot_be_used_is_named(tmp_path: Path, base: str, told: str) -> None:
    (tmp_path / "folder.json").mkdir()
    (tmp_path / "bad.json").write_text("{")
    if hasattr(os, "mkfifo"):
        os.mkfifo(tmp_path / "pipe.json")
    assert told in refusal(write(tmp_path / "me.json", base=base, poses=["open"]))


def test_a_circle_of_two_is_named(tmp_path: Path) -> None:
    write(tmp_path / "a.json", base="b.json")
    assert "b.json → a.json → b.json" in refusal(write(tmp_path / "b.json", base="a.json"))


def test_too_many_layers_are_refused(tmp_path: Path) -> None:
    write(tmp_path / "0.json")
    for i in range(1, MAX_LAYERS + 2):
        write(tmp_path / f"{i}.json", base=f"{i - 1}.json")
    assert curve_set_json.load(tmp_path / f"{MAX_LAYERS - 1}.json").missing()
    assert "sets stand on each other" in refusal(tmp_path / f"{MAX_LAYERS + 1}.json")


def test_bytes_without_a_folder_have_no_base_beside_them() -> None:
    with pytest.raises(UserError, match="save it first"):
        curve_set_json.parse(json.dumps({"schema": curve_set_json.SCHEMA, "base": "a.json"}).encode(), "set.json")


def test_the_built_in_sets() -> None:
    assert {"english", "crab"} <= set(built_in())


def test_a_base_is_found_from_a_new_place(tmp_path: Path) -> None:
    old, new = tmp_path / "old", tmp_path / "new" / "place"
    assert moved_base("low.json", old, new) == "../../old/low.json"
    assert moved_base("english", old, new) == "english"
    assert moved_base(str(tmp_path / "low.json"), old, new) == str(tmp_path / "low.json")
    assert moved_base(None, old, new) is None
