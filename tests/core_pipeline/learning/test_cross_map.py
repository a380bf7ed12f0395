"""Captures become poses: a retarget preset read backwards."""

from pathlib import Path

import numpy as np
import pytest

from core_pipeline.errors import UserError
from core_pipeline.faces.mapping_json import load_presets
from core_pipeline.learning import gltf_animation
from core_pipeline.learning.capture import Capture
from core_pipeline.learning.capture_csv import parse
from core_pipeline.learning.cross_map import clip_of
from core_pipeline.schedule import Schedule
from tests.helpers.captures import ARKIT, live_link
from tests.helpers.gltf import Gltf, tetrahedron

ROOT = Path(__file__).resolve().parents[3]
PRESETS = load_presets(ROOT / "assets" / "retarget")
ARKIT_PRESET = next(preset for preset in PRESETS if preset.name == "arkit52")
POSES = ("open", "W", "ShCh", "PBM", "FV", "wide", "tBack", "tRoof", "tTeeth")
SCHEDULE = Schedule(["sil", "aa", "b", "sil"], [0, 1, 1.5, 2, 3])


def acted(weights: dict[str, np.ndarray], rest: float = 0.0) -> dict[str, np.ndarray]:
    """ARKit channels of an actor who does exactly these poses, with a face that never rests at 0."""
    frames = len(next(iter(weights.values())))
    channels = {name: np.full(frames, rest) for name in ARKIT[:52]}
    for pose, weight in weights.items():
        for shape, amount in ARKIT_PRESET.poses[pose].items():
            channels[shape[0].upper() + shape[1:]] += amount * weight
    return channels


def bump(start: float, end: float, frames: int = 181) -> np.ndarray:
    t = np.arange(frames) / 60
    return np.where((t > start) & (t < end), np.sin(np.pi * np.clip((t - start) / (end - start), 0, 1)) ** 2, 0.0)


@pytest.mark.parametrize("rest", [0.0, 0.04])
def test_acted_poses_are_found(rest):
    """Whatever the face does at rest is taken off first: it is seen in the silences."""
    truth = {"open": 0.8 * bump(1.0, 1.6), "PBM": bump(1.5, 2.0), "wide": 0.3 * bump(1.0, 1.4)}
    data, _ = live_link(3, 60, channels=acted(truth, rest))
    clip = clip_of("take", parse(data, "take.csv"), SCHEDULE, POSES, PRESETS)
    for p, pose in enumerate(POSES):
        assert clip.weights.frames[:, p] == pytest.approx(truth.get(pose, np.zeros(181)), abs=0.02)
    assert clip.residual < 0.02
    assert any("tBack, tRoof cannot be seen" in note for note in clip.notes)


def test_what_the_poses_cannot_do_is_told():
    data, _ = live_link(3, 60, channels={"MouthFrownLeft": bump(1, 2), "MouthClose": bump(1, 2)})
    clip = clip_of("take", parse(data, "take.csv"), SCHEDULE, POSES, PRESETS)
    assert clip.residual > 0.5
    assert any("explain only" in note for note in clip.notes)


def test_without_silence_the_low_values_are_rest():
    truth = {"open": bump(0.5, 2.5)}
    data, _ = live_link(3, 60, channels=acted(truth, 0.05))
    clip = clip_of("take", parse(data, "t"), Schedule(["aa", "b"], [0, 1, 3]), POSES, PRESETS)
    assert clip.weights.frames[:, 0] == pytest.approx(truth["open"], abs=0.03)


def test_lost_frames_stay_unknown():
    data, _ = live_link(3, 60, lost=range(60, 80))
    clip = clip_of("take", parse(data, "t"), SCHEDULE, POSES, PRESETS)
    assert not clip.known[61:79].any()


def test_channels_nobody_knows_are_refused():
    capture = Capture(("brow", "tail"), 60.0, 0.0, np.zeros((10, 2)), np.ones(10, bool))
    with pytest.raises(UserError, match=r"brow, tail.*Retarget presets know ARKit"):
        clip_of("take", capture, SCHEDULE, POSES, PRESETS)


def animated(values: np.ndarray, times: np.ndarray, kind: str = "LINEAR") -> Gltf:
    gltf = tetrahedron()
    gltf.mesh()["extras"] = {"targetNames": ["open"]}
    sampler = {
        "input": gltf.accessor(times.astype(np.float32)[:, None]),
        "output": gltf.accessor(values.astype(np.float32).reshape(-1, 1)),
        "interpolation": kind,
    }
    channel = {"sampler": 0, "target": {"node": 0, "path": "weights"}}
    gltf.json["animations"] = [{"samplers": [sampler], "channels": [channel]}]
    return gltf


@pytest.fixture
def load(tmp_path):
    def load(gltf: Gltf) -> Capture:
        path = tmp_path / "face.glb"
        path.write_bytes(gltf.glb())
        return gltf_animation.load(path)

    return load


class TestAnimatedGltf:
    def test_straight_lines(self, load):
        capture = load(animated(np.array([0, 1, 0.5]), np.array([0, 0.5, 1.0])))
        assert (capture.channels, capture.fps, len(capture.values)) == (("open",), 60.0, 61)
        assert capture.values[15, 0] == pytest.approx(0.5)
        clip = clip_of("face", capture, Schedule(["aa"], [0, 1]), ("open",), PRESETS)
        assert clip.weights.frames[30, 0] == pytest.approx(1.0)

    def test_steps(self, load):
        capture = load(animated(np.array([0, 1, 0.5]), np.array([0, 0.51, 1.0]), "STEP"))
        assert capture.values[[30, 31, 59], 0] == pytest.approx([0, 1, 1])

    def test_splines(self, load):
        """In-tangent, value, out-tangent of each key: a smooth step here."""
        keys = np.array([[0, 0, 0], [0, 1, 0]], float)
        capture = load(animated(keys, np.array([0.0, 1.0]), "CUBICSPLINE"))
        t = np.arange(61) / 60
        assert capture.values[:, 0] == pytest.approx(3 * t**2 - 2 * t**3, abs=0.01)

    @pytest.mark.parametrize(
        "spoil",
        [
            lambda g: g.json.pop("animations"),
            lambda g: g.json["animations"][0]["channels"][0]["target"].update(path="rotation"),
            lambda g: g.json["animations"][0]["channels"][0].update(sampler=7),
            lambda g: g.json["animations"][0]["channels"][0]["target"].update(node=9),
            lambda g: g.mesh()["extras"].update(targetNames=["a", "b"]),
            lambda g: g.mesh()["extras"].update(targetNames=None),
            lambda g: g.json["animations"][0]["samplers"][0].update(input=0),
            lambda g: g.json["animations"][0]["samplers"][0].update(interpolation="CUBICSPLINE"),
            lambda g: g.json.update(animations=[3]),
        ],
    )
    def test_what_is_damaged_is_refused(self, load, spoil):
        gltf = animated(np.array([0, 1, 0.5]), np.array([0, 0.5, 1.0]))
        spoil(gltf)
        with pytest.raises(UserError, match=r"^face.glb: "):
            load(gltf)
