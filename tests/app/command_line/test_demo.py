"""Where no window can be shown, starting the editor does its main job on files and says so in two lines."""

import json
import os
import subprocess
import sys
import wave
from pathlib import Path

import pytest
from PIL import Image

from app import cli, resources

ROOT = Path(cli.__file__).parents[1]


def start(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """`python -m app` where there is no display."""
    environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM")}
    return subprocess.run(
        [sys.executable, "-m", "app", *arguments],
        cwd=folder, env={**environment, "PYTHONPATH": str(ROOT)}, capture_output=True, text=True, check=False,
    )  # fmt: skip


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="other systems always have a display")
def test_without_a_display_the_demo_sentence_is_spoken_into_files(tmp_path: Path) -> None:
    done = start(tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    said, how = done.stdout.splitlines()
    assert resources.DEMO_SENTENCE in said
    assert "lipstitch-out/" in said
    assert "xvfb-run python3 run.py" in how
    out = tmp_path / "lipstitch-out"
    names = {"window.png", "weights.json", "stages.json", "face.png", "sound.wav"}
    assert {path.name for path in out.iterdir()} == names
    assert all(name in said for name in names)
    with Image.open(out / "window.png") as window, Image.open(out / "face.png") as strip:
        assert window.size == (1600, 1000)
        assert strip.size == (6 * 256, 2 * 256)
    weights = json.loads((out / "weights.json").read_text("utf-8"))
    assert max(map(max, weights["frames"])) > 0.7
    assert json.loads((out / "stages.json").read_text("utf-8"))["schema"] == "lipstitch.Stages.1"
    with wave.open(str(out / "sound.wav")) as sound:
        assert sound.getnframes() > sound.getframerate()


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="other systems always have a display")
def test_a_place_where_nothing_can_be_written_is_said(tmp_path: Path) -> None:
    (tmp_path / "lipstitch-out").write_text("mine")
    done = start(tmp_path)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("lipstitch: Cannot make the folder lipstitch-out: ")
    assert done.stderr.count("\n") == 1
    assert (tmp_path / "lipstitch-out").read_text() == "mine"
