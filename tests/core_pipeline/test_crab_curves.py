"""How well the crab speaks with its own poses: the sentences of the English set, under the settings of its own set."""

from pathlib import Path

import numpy as np
import pytest

from core_pipeline.curve_set import CurveSet
from core_pipeline.faces.face_folder import load as load_face
from core_pipeline.files.curve_set_json import dumps, load
from core_pipeline.phone_parts import Recipe, bigram_of, curve_set_of, read_recipe
from core_pipeline.phonemes import COMMON, SILENCE
from core_pipeline.pipeline import Stages
from core_pipeline.poses import FACEFX
from core_pipeline.settings import Settings
from core_pipeline.weights import bake, sample
from tests.helpers.lip_measures import highest, instances, longest_hole, sentences, slowed, spoken, turns
from tests.helpers.zbuffer import seen

RECIPE = Path(__file__).parents[2] / "assets" / "curves" / "crab.toml"
FACE = load_face("assets/faces/crab")
POSES = tuple(shape for shape in FACE.shapes if shape not in ("blink", "browUp"))
TONGUE = ("tongue up", "tongue out", "tongue back")
MOUTH = (0.0, -0.29, 0.75)
#: Phone → pose → (least, most) that make its closure, as tests/core_pipeline/faces/test_crab.py sees it on the face.
CLOSED = {
    "bmp": {
        "lips shut": (0.65, 1), "mouth open": (0, 0), "bare teeth": (0, 0.35), "mouth OO": (0, 0.27),
        **dict.fromkeys(TONGUE, (0, 0)),
    },
    "f": {"lips shut": (0.30, 0.45), "bare teeth": (0.5, 0.7), "mouth open": (0, 0.05)},
}  # fmt: skip


@pytest.fixture(scope="module")
def recipe() -> Recipe:
    return read_recipe(RECIPE)


@pytest.fixture(scope="module")
def crab() -> CurveSet:
    return load(RECIPE.with_suffix(".json"))


@pytest.fixture(scope="module")
def results(crab: CurveSet) -> list[Stages]:
    return spoken(crab, [schedule for _, schedule in sentences()], crab.effective_settings)


def test_the_shipped_set_is_what_the_recipe_makes(recipe: Recipe) -> None:
    assert RECIPE.with_suffix(".json").read_bytes() == dumps(curve_set_of(recipe)).encode()


def test_its_poses_are_those_of_the_crab_and_nothing_names_others(crab: CurveSet) -> None:
    assert crab.poses == POSES
    assert not {*crab.poses} & {*FACEFX}
    settings = crab.settings
    assert settings is not None
    named = {pose for constraint in settings.constraints for pose in (constraint.a, constraint.b)}
    assert {*settings.windows, *settings.priorities, *named} <= {*POSES}
    assert {pose for pose, _ in settings.clashes.items()} == named - {"lips shut"}


def test_all_pairs_are_there_and_every_phone_does_something(recipe: Recipe, crab: CurveSet) -> None:
    assert len(crab.bigrams) == 441 + 42
    assert crab.missing() == []
    assert tuple(recipe.phones) == COMMON
    for phone in COMMON:
        assert not bigram_of(recipe, (phone, phone)).is_empty, phone
        assert not bigram_of(recipe, (SILENCE, phone)).is_empty, phone


def test_every_pose_is_used(crab: CurveSet) -> None:
    assert {pose for bigram in crab.bigrams.values() for pose in bigram.curves} == {*POSES}


def test_no_bigram_is_missing_and_no_phone_unknown(results: list[Stages]) -> None:
    assert [(dict(stages.missing), stages.unknown) for stages in results] == [({}, ())] * 50


@pytest.mark.parametrize("phone", CLOSED)
def test_closures_are_reached(results: list[Stages], recipe: Recipe, phone: str) -> None:
    for pose, strength in recipe.phones[phone].items():
        tops = [highest(s.magenta[pose], start, end) for s in results for start, end in instances(s, phone)]
        assert len(tops) >= 75
        assert np.mean(np.array(tops) >= 0.9 * strength) >= 0.97, pose


@pytest.mark.parametrize("phone", CLOSED)
def test_closures_are_seen(results: list[Stages], phone: str) -> None:
    """In a frame of 30 a second, without the snapping that baked files get, with no other pose in the way."""
    hits = []
    for stages in results:
        weights = bake(stages.magenta, "pchip", 30, snap=False)
        frames = dict(zip(weights.poses, weights.frames.T, strict=True))
        times = weights.start + np.arange(len(weights.frames)) / 30
        closed = np.ones(len(times), bool)
        for pose, (least, most) in CLOSED[phone].items():
            closed &= (frames[pose] >= least - 1e-3) & (frames[pose] <= most + 1e-3)
        hits += [bool(closed[(times >= start) & (times <= end)].any()) for start, end in instances(stages, phone)]
    assert np.mean(hits) >= 0.90


def test_on_the_face_itself_no_gap_is_left(results: list[Stages], crab: CurveSet) -> None:
    """Every p, b and m of the first two sentences, at the moment its lips press most."""
    matrix = FACE.retarget(crab.poses)
    count = 0
    for stages in results[:2]:
        lips = stages.magenta["lips shut"]
        for start, end in instances(stages, "bmp"):
            times = np.linspace(start, end, 40)
            amounts = sample(stages.magenta, "pchip", times[[lips.at(times).argmax()]])[0] @ matrix
            parts = seen(FACE, dict(zip(FACE.shapes, amounts.tolist(), strict=True)), MOUTH, half=0.75)
            assert sum(parts[part] for part in ("mouth", "teeth_upper", "teeth_lower", "tongue")) <= 2
            count += 1
    assert count >= 10


def test_the_face_never_falls_asleep_within_a_phrase(results: list[Stages]) -> None:
    assert longest_hole(results) <= 0.040


@pytest.mark.parametrize("pose", POSES)
def test_nothing_flaps_and_the_speed_limit_takes_little(results: list[Stages], pose: str) -> None:
    assert 0.02 < turns(results, pose) <= 0.75
    assert slowed(results, pose) <= 0.15


@pytest.mark.parametrize(
    ("phone", "pose", "least", "most"),
    [
        ("aa", "mouth open", 0.45, 0.70), ("ao", "mouth open", 0.40, 0.60), ("ah", "mouth open", 0.30, 0.50),
        ("w", "mouth OO", 0.70, 0.90), ("ow", "mouth OO", 0.55, 0.80), ("sh", "mouth OO", 0.40, 0.60),
        ("sh", "bare teeth", 0.62, 0.85), ("z", "bare teeth", 0.50, 0.70), ("z", "mouth open", 0.00, 0.20),
        ("ih", "smile", 0.40, 0.60), ("aa", "frown", 0.08, 0.20), ("l", "tongue up", 0.50, 0.70),
        ("d", "tongue up", 0.40, 0.60), ("th", "tongue out", 0.55, 0.75), ("kg", "tongue back", 0.42, 0.62),
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


def test_under_settings_for_other_poses_the_lips_would_not_seal(crab: CurveSet) -> None:
    """Why the set brings its own constraints: those of the paper name poses the crab does not have."""
    schedules = [schedule for _, schedule in sentences()][:10]

    def gape(settings: Settings) -> float:
        return max(
            float(np.minimum(s.magenta["lips shut"].v, s.magenta["mouth open"].at(s.magenta["lips shut"].t)).max())
            for s in spoken(crab, schedules, settings)
        )

    assert gape(crab.effective_settings) <= 0.22
    assert gape(Settings.paper()) > 0.35
