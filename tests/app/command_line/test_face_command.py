"""`lipstitch face` and `render --face`: any rig from the command line."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from app.cli import main
from app.resources import english_curves, face_folder
from tests.helpers.rigs import NAMES, as_glb, as_objs, head

ARKIT = ["jawOpen", *(name for name in NAMES["arkit52"] if name != "jawOpen")]


@pytest.fixture(autouse=True)
def own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    for name in ("XDG_CACHE_HOME", "LOCALAPPDATA", "HOME"):
        monkeypatch.setenv(name, str(tmp_path / "cache"))
    return tmp_path / "cache"


@pytest.mark.parametrize("kind", [as_glb, as_objs])
def test_a_face_is_told(kind, tmp_path, own_cache, capsys):
    path = kind(head(ARKIT), tmp_path / "head.glb")
    for _ in range(2):  # the second time from the cache
        assert main(["face", str(path)]) == 0
        out = capsys.readouterr().out.splitlines()
        assert out[0].endswith(": 231 vertices, 400 triangles.")
        assert out[1].startswith("52 shapes: ")
        assert "Poses by ARKit-52:" in out
        assert "  W = 1 mouthPucker + 0.1 jawOpen + 0.15 mouthFunnel" in out
        assert out[-1] == "Not available on this face: tBack, tRoof."
    assert len(list(own_cache.rglob("*.npz"))) == 1


def test_what_is_no_face_is_refused_in_a_sentence(tmp_path, capsys):
    (tmp_path / "face.fbx").write_text("")
    assert main(["face", str(tmp_path / "face.fbx")]) == 2
    error = capsys.readouterr().err
    assert error.startswith("lipstitch: ")
    assert "export it as .glb" in error
    assert len(error.splitlines()) == 1


def test_the_poses_of_another_curve_set(capsys):
    crab, curves = face_folder("crab"), english_curves().with_name("crab.json")
    assert main(["face", str(crab), "--curves", str(curves)]) == 0
    assert "  mouth open = 1 mouth open" in capsys.readouterr().out.splitlines()


def test_a_rig_speaks(tmp_path, capsys):
    path = as_glb(head(ARKIT), tmp_path / "head.glb")
    out = tmp_path / "frames"
    assert main(["render", "Wow.", "--face", str(path), "--out", str(out), "--size", "64x64", "--fps", "8"]) == 0
    assert "Not available on this face: tBack, tRoof." in capsys.readouterr().err
    pictures = [np.asarray(Image.open(file)).astype(int) for file in sorted(out.glob("*.png"))]
    assert len(pictures) > 3
    assert max(np.abs(picture - pictures[0]).max() for picture in pictures) > 10, "it never moved"
    assert main(["render", "Wow.", "--face", str(tmp_path / "no.glb"), "--out", str(tmp_path / "none")]) == 2
    assert not (tmp_path / "none").exists()


def test_a_new_curve_set_over_the_rigs_own_poses(tmp_path, capsys):
    path, out = as_glb(head(["beak open", "beak shut", "blink"]), tmp_path / "bird.glb"), tmp_path / "bird.json"
    assert main(["face", str(path), "--new-set", str(out)]) == 0
    assert capsys.readouterr().out.splitlines()[-1] == f"An empty curve set over 2 poses in {out}."
    assert main(["check", str(out)]) == 0
    assert main(["face", str(path), "--curves", str(out)]) == 0
    assert "  beak shut = 1 beak shut" in capsys.readouterr().out.splitlines()
    kept = out.read_bytes()
    for name, why in (("bird.json", "already there"), ("bird.toml", "name the curve set .json")):
        assert main(["face", str(path), "--new-set", str(tmp_path / name)]) == 2
        assert why in capsys.readouterr().err
    assert out.read_bytes() == kept
