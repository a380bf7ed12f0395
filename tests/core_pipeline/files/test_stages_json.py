"""All five stages as JSON: the shape other programs read, and nothing lost on the way."""

import json
from pathlib import Path

import numpy as np
from hypothesis import given

from core_pipeline.curve_set import CurveSet
from core_pipeline.files import stages_json
from core_pipeline.phonemes import pair_name
from core_pipeline.pipeline import STAGES, Settings, run
from core_pipeline.schedule import Schedule
from tests.helpers import stages as small
from tests.helpers import strategies as ours


def test_the_documented_shape(tmp_path: Path) -> None:
    stages = small.sentence("f ah d")
    path = tmp_path / "stages.json"
    stages_json.save(stages, path)
    top = json.loads(path.read_text("utf-8"))
    assert list(top) == ["schema", "poses", "red", "blue", "yellow", "cyan", "magenta"]
    assert top["schema"] == "lipstitch.Stages.1"
    assert top["poses"] == list(stages.poses)
    first = top["red"][0]
    assert list(first) == ["index", "bigram", "pose", "t", "v"]
    assert (first["index"], first["bigram"]) == (0, "f-ah")
    for colour in STAGES:
        assert list(top[colour]) == list(stages.poses)
        assert list(top[colour]["open"]) == ["t", "v"]


@given(ours.schedules(nasty=True), ours.curve_sets(nasty=True), ours.settings())
def test_every_knot_of_every_stage_is_there(schedule: Schedule, curve_set: CurveSet, settings: Settings) -> None:
    stages = run(schedule, curve_set, settings)
    top = json.loads(stages_json.dumps(stages))
    assert len(top["red"]) == len(stages.red)
    for told, curve in zip(top["red"], stages.red, strict=True):
        assert (told["index"], told["bigram"], told["pose"]) == (curve.index, pair_name(curve.bigram), curve.pose)
        np.testing.assert_allclose(told["t"], curve.t, atol=1e-9)
        np.testing.assert_allclose(told["v"], curve.v, atol=1e-9)
    for colour in STAGES:
        for pose, track in stages.stage(colour).items():
            t, v = top[colour][pose]["t"], top[colour][pose]["v"]
            np.testing.assert_allclose(t, track.t, atol=1e-9)
            np.testing.assert_allclose(v, track.v, atol=1e-9)
            assert (np.diff(t) > 0).all(), "times must rise in the file too"
