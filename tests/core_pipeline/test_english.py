"""How well the English set speaks: fifty sentences of ours, as espeak-ng speaks them, under the preset "Paper"."""

from pathlib import Path

import numpy as np
import pytest

from core_pipeline.curve_set import CurveSet
from core_pipeline.files.curve_set_json import load
from core_pipeline.pipeline import Stages
from core_pipeline.poses import FACEFX, TONGUE
from core_pipeline.settings import Settings
from core_pipeline.speech.espeak import Espeak
from core_pipeline.speech.sentence import clean
from tests.helpers.lip_measures import (
    CLOSURES,
    highest,
    instances,
    longest_hole,
    reached,
    sealed,
    sentences,
    slowed,
    spoken,
    turns,
)

ENGLISH = Path(__file__).parents[2] / "assets" / "curves" / "english.json"


@pytest.fixture(scope="module")
def english() -> CurveSet:
    return load(ENGLISH)


@pytest.fixture(scope="module")
def results(english: CurveSet) -> list[Stages]:
    return spoken(english, [schedule for _, schedule in sentences()], Settings.paper())


def test_the_sentences_say_much(results: list[Stages]) -> None:
    """Fifty different ones with every phone, many pairs, and enough closures for shares to mean something."""
    assert len(results) == len({text for text, _ in sentences()}) == 50
    pairs = {pair for stages in results for pair in stages.schedule.pairs()}
    assert len(pairs) > 200
    assert {phone for pair in pairs for phone in pair} == {*results[0].schedule.phones, *load(ENGLISH).phonemes, "sil"}
    assert min(sum(len(instances(stages, phone)) for stages in results) for phone in CLOSURES) >= 75


def test_no_bigram_is_missing_and_no_phone_unknown(results: list[Stages]) -> None:
    assert [(dict(stages.missing), stages.unknown) for stages in results] == [({}, ())] * 50


@pytest.mark.parametrize("phone", CLOSURES)
def test_lips_get_all_but_there(results: list[Stages], english: CurveSet, phone: str) -> None:
    assert reached(results, english, phone) >= 0.97


@pytest.mark.parametrize("phone", CLOSURES)
def test_lips_are_seen_closed(results: list[Stages], phone: str) -> None:
    """In a frame of 30 a second, without the snapping that baked files get."""
    assert sealed(results, phone) >= 0.90


def test_the_readme_says_what_is_measured(results: list[Stages], english: CurveSet) -> None:
    got = {phone: round(100 * reached(results, english, phone)) for phone in CLOSURES}
    shut = {phone: round(100 * sealed(results, phone)) for phone in CLOSURES}
    readme = (Path(__file__).parents[2] / "README.md").read_text("utf-8")
    assert f"in {got['bmp']} % of all cases, f and v in {got['f']} %" in readme
    assert f"at 30 fps: {shut['bmp']} % and {shut['f']} %" in readme


def test_the_face_never_falls_asleep_within_a_phrase(results: list[Stages]) -> None:
    assert longest_hole(results) <= 0.040


@pytest.mark.parametrize("pose", FACEFX)
def test_nothing_flaps(results: list[Stages], pose: str) -> None:
    assert 0.02 < turns(results, pose) <= 0.75


@pytest.mark.parametrize("pose", [pose for pose in FACEFX if pose not in TONGUE])
def test_the_speed_limit_takes_little(results: list[Stages], pose: str) -> None:
    assert slowed(results, pose) <= 0.15


@pytest.mark.parametrize(
    ("phone", "pose", "least", "most"),
    [
        ("aa", "open", 0.40, 0.65), ("ao", "open", 0.40, 0.60), ("aw", "open", 0.40, 0.60), ("ay", "open", 0.40, 0.60),
        ("ah", "open", 0.25, 0.45), ("eh", "open", 0.25, 0.45), ("d", "open", 0.10, 0.35), ("z", "open", 0.04, 0.25),
        ("w", "W", 0.65, 0.85), ("ow", "W", 0.55, 0.75), ("sh", "ShCh", 0.65, 0.80), ("r", "ShCh", 0.30, 0.50),
        ("ih", "wide", 0.45, 0.65), ("eh", "wide", 0.35, 0.55),
        ("d", "tRoof", 0.45, 0.65), ("l", "tRoof", 0.45, 0.65), ("th", "tTeeth", 0.50, 0.75),
        ("kg", "tBack", 0.45, 0.65),
    ],
)  # fmt: skip
def test_phones_look_like_themselves(results: list[Stages], phone: str, pose: str, least: float, most: float) -> None:
    """The median of a phone's highest weight, after everything the pipeline does to it."""
    tops = [
        highest(stages.magenta[pose], *stages.schedule.times[i : i + 2])
        for stages in results
        for i, name in enumerate(stages.schedule.phones)
        if name == phone
    ]
    assert least <= np.median(tops) <= most


def test_long_vowels_open_beside_closed_lips(results: list[Stages]) -> None:
    """As in "five" and "Bob", where a closure on either side wants the lips."""
    tops = []
    for stages in results:
        phones, times = ("sil", *stages.schedule.phones, "sil"), stages.schedule.times
        for i, (before, vowel, after) in enumerate(zip(phones, phones[1:], phones[2:], strict=False)):
            if vowel in ("aa", "ao", "ow", "aw", "ay") and (before in CLOSURES or after in CLOSURES):
                tops.append(highest(stages.magenta["open"], times[i], times[i + 1]))
    assert len(tops) >= 30
    assert np.percentile(tops, 10) > 0.3
    assert np.median(tops) > 0.4


def test_it_holds_for_what_the_voice_says_today(english: CurveSet) -> None:
    """The stored schedules are the voice's own; these are spoken now."""
    texts = [
        "Bob puts a map into my top pump.",
        "Five heavy vans move off before the fifth.",
        "Maybe a few people came by.",
    ]
    voice = Espeak()
    try:
        results = spoken(english, [voice.speak(clean(text)).schedule for text in texts], Settings.paper())
    finally:
        voice.close()
    assert reached(results, english, "bmp") >= 0.9
    assert reached(results, english, "f") >= 0.9
    assert longest_hole(results) <= 0.040
