"""Weights for other programs: the shapes they read, the numbers the pipeline made."""

import csv
import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given

from core_pipeline import weights
from core_pipeline.curve_set import CurveSet
from core_pipeline.errors import UserError
from core_pipeline.files import weights_files
from core_pipeline.pipeline import Settings, run
from core_pipeline.schedule import Schedule
from tests.helpers import strategies as ours


def baked(fps: float = 60.0) -> weights.Weights:
    frames = np.array([[0.0, 1.0], [0.123456, 1 / 3]], np.float32)
    return weights.Weights(("open", "lips, shut"), fps, -0.25, frames)


def test_json_has_the_documented_shape() -> None:
    top = json.loads(weights_files.to_json(baked()))
    assert list(top) == ["schema", "fps", "start", "poses", "frames"]
    assert top == {
        "schema": "lipstitch.Weights.1",
        "fps": 60,
        "start": -0.25,
        "poses": ["open", "lips, shut"],
        "frames": [[0.0, 1.0], [0.12346, 0.33333]],
    }


def test_an_odd_frame_rate_is_kept() -> None:
    assert json.loads(weights_files.to_json(baked(29.97)))["fps"] == 29.97


def test_csv_has_a_header_and_times_in_seconds() -> None:
    rows = list(csv.reader(weights_files.to_csv(baked()).splitlines()))
    assert rows[0] == ["time", "open", "lips, shut"]
    assert [[float(x) for x in row] for row in rows[1:]] == [[-0.25, 0.0, 1.0], [-0.233333, 0.12346, 0.33333]]


@given(ours.schedules(), ours.curve_sets(), ours.settings())
def test_both_formats_hold_what_was_baked(schedule: Schedule, curve_set: CurveSet, settings: Settings) -> None:
    made = weights.bake(run(schedule, curve_set, settings).magenta, settings.spline, 30)
    from_json = np.array(json.loads(weights_files.to_json(made))["frames"])
    rows = list(csv.reader(weights_files.to_csv(made).splitlines()))
    from_csv = np.array(rows[1:], float)
    np.testing.assert_allclose(from_json, made.frames, atol=6e-6)
    np.testing.assert_array_equal(from_csv[:, 1:], from_json)
    np.testing.assert_allclose(from_csv[:, 0], made.start + np.arange(len(made.frames)) / 30, atol=1e-6)
    assert from_json.min() >= 0
    assert from_json.max() <= 1


def test_the_ending_decides_the_format(tmp_path: Path) -> None:
    weights_files.save(baked(), tmp_path / "w.JSON")
    weights_files.save(baked(), tmp_path / "w.csv")
    assert (tmp_path / "w.JSON").read_text() == weights_files.to_json(baked())
    assert (tmp_path / "w.csv").read_text() == weights_files.to_csv(baked())


@pytest.mark.parametrize("name", ["w.txt", "w", ".json", "w.json.gz"])
def test_another_ending_is_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(UserError, match=r"name the file \.json or \.csv"):
        weights_files.save(baked(), tmp_path / name)
    assert not list(tmp_path.iterdir())
