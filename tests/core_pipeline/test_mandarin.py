"""Mandarin is English and one phoneme more (section 5.4): 43 new bigrams over the English set."""

from pathlib import Path

import numpy as np
import pytest

from core_pipeline import pipeline
from core_pipeline.curve_set import CurveSet
from core_pipeline.errors import UserError
from core_pipeline.files.curve_set_json import dumps, load
from core_pipeline.phone_parts import curve_set_of
from core_pipeline.phone_recipe import read_recipe
from core_pipeline.schedule import Schedule

CURVES = Path(__file__).parents[2] / "assets" / "curves"


@pytest.fixture(scope="module")
def mandarin() -> CurveSet:
    return load(CURVES / "mandarin.json")


def test_the_shipped_set_is_what_the_recipe_makes() -> None:
    made = dumps(curve_set_of(read_recipe(CURVES / "mandarin.toml")))
    assert (CURVES / "mandarin.json").read_text("utf-8") == made


def test_it_adds_43_bigrams_and_takes_the_rest_from_english(mandarin: CurveSet) -> None:
    english = load(CURVES / "english.json")
    assert len([pair for pair in mandarin.own if "sil" not in pair]) == 43
    assert len(mandarin.own) == 45
    assert all("ü" in pair for pair in mandarin.own)
    assert mandarin.missing() == []
    assert len(mandarin.phonemes) == 22
    assert mandarin.layer_of(("f", "ah")) == "English"
    for pair, bigram in english.bigrams.items():
        assert all(mandarin.bigrams[pair].curves[pose].same_as(curve) for pose, curve in bigram.curves.items())


def test_the_lips_round_for_it(mandarin: CurveSet) -> None:
    """nü ren: rounder than the vowel after it, and never wide."""
    stages = pipeline.run(Schedule(["d", "ü", "r", "eh", "d"], [0, 0.08, 0.25, 0.33, 0.45, 0.52]), mandarin)
    at = {pose: stages.magenta[pose].at(np.array([0.16, 0.39])) for pose in ("W", "wide")}
    assert at["W"][0] > 0.6 > at["W"][1]
    assert at["wide"][0] < 0.2 < at["wide"][1]


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ('base = "mandarin"\n', "cannot be its base"),
        ('base = "me"\n', "cannot be its base"),
        ('base = "../english"\n', "must be the name of a recipe"),
        ("base = 3\n", "must be the name of a recipe"),
        ('base = "klingon"\n', "klingon.toml cannot be read"),
        ('base = "english"\nname = "X"\nlanguage = "x"\nphonemes = ["ö"]\n', "has no row for ö"),
        ('base = "english"\nname = "X"\nlanguage = "x"\nphonemes = "ö"\n', "is not a recipe"),
    ],
)
def test_a_base_that_will_not_do_is_refused(tmp_path: Path, text: str, told: str) -> None:
    for name in ("english", "mandarin"):
        (tmp_path / f"{name}.toml").write_bytes((CURVES / f"{name}.toml").read_bytes())
    (tmp_path / "me.toml").write_text(text, "utf-8")
    with pytest.raises(UserError, match=told):
        read_recipe(tmp_path / "me.toml")
