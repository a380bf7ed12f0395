"""Weights files read back: what was written, and nothing that is not weights."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core_pipeline.errors import UserError
from core_pipeline.files import weights_files, weights_read
from core_pipeline.weights import Weights
from tests.helpers.refusals import told


@pytest.mark.parametrize("ending", [".json", ".csv"])
@pytest.mark.parametrize("fps", [24.0, 29.97, 30.0, 60.0, 120.0])
def test_round_trip(tmp_path, ending, fps):
    frames = np.random.default_rng(1).random((40, 3)).astype(np.float32)
    path = tmp_path / f"w{ending}"
    weights_files.save(Weights(("open", "W", "ü"), fps, 0.25, frames), path)
    read = weights_read.load(path)
    assert read.poses == ("open", "W", "ü")
    assert read.fps == pytest.approx(fps, rel=1e-4)
    assert read.start == 0.25
    assert read.frames == pytest.approx(frames, abs=1e-5)


HEAD = b'{"schema": "lipstitch.Weights.1", "fps": 60, "poses": ["a"], "frames": '


@pytest.mark.parametrize(
    ("name", "data", "sentence"),
    [
        ("w.json", b"{}", "holds no weights"),
        ("w.json", HEAD + b"[[0.1, 0.2]]}", "frame 0 has 2 weights for 1 poses"),
        ("w.json", HEAD + b"[[1.5]]}", "frame 0, pose a is 1.5"),
        ("w.json", HEAD + b"[]}", "has no frame"),
        ("w.json", HEAD + b'[["x"]]}', "expected `float`"),
        ("w.json", HEAD.replace(b"60", b"0") + b"[[0]]}", "0 frames per second"),
        ("w.json", HEAD.replace(b'["a"]', b'["a","a"]') + b"[[0, 0]]}", "different names"),
        ("w.csv", b"", "holds no weights"),
        ("w.csv", b"open,W\n0,1\n", "holds no weights"),
        ("w.csv", b"time,open\n0,x\n", "line 2 is not 2 numbers"),
        ("w.csv", b"time,open\n0,0.1\n0,0.2\n", "do not rise"),
        ("w.csv", b"time,open\n0,0.1\n0.1,0.2\n0.5,0.2\n", "not evenly spaced"),
        ("w.csv", b"time,open\n0,nan\n", "is nan"),
        ("w.csv", b"\xff\x00\xff", "not a table"),
    ],
)
def test_what_is_wrong_is_said(tmp_path, name, data, sentence):
    path = tmp_path / name
    path.write_bytes(data)
    with pytest.raises(UserError, match=sentence) as refused:
        weights_read.load(path)
    assert "\n" not in str(refused.value)


@given(st.binary(max_size=200))
def test_no_bytes_are_a_traceback(data):
    for parse in (weights_read.parse_csv, weights_read.parse_json):
        assert (told(lambda parse=parse: parse(data, "x")) or "x").startswith("x")
