"""`lipstitch screenshot`: the real window off screen, with the sentence's stages and a face in it."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from app import cli
from widgets import theme

ROOT = Path(cli.__file__).parents[1]


def drawn(picture: np.ndarray, stage: str, tolerance: int = 24) -> int:
    """How many pixels have the colour of a stage, or nearly."""
    value = theme.STAGE_STYLES[stage].colour.getRgb()[:3]
    return int((np.abs(picture - value).max(axis=-1) <= tolerance).sum())


def test_the_window_is_drawn_in_mid_sentence(tmp_path: Path) -> None:
    out = tmp_path / "window.png"
    environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM")}
    command = [sys.executable, "-m", "app", "screenshot", "Fat cats.", "--out", str(out), "--size", "1200x800"]
    done = subprocess.run(
        command, env={**environment, "PYTHONPATH": str(ROOT)}, capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    with Image.open(out) as image:
        assert image.size == (1200, 800)
        picture = np.asarray(image.convert("RGB"), int)
    lower, right = picture[400:], picture[:400, 800:]
    assert drawn(lower, "magenta") > 300, "the last stage is drawn"
    assert drawn(lower, "red") > 50, "the bigrams' own curves are drawn"
    red, green, blue = right[..., 0], right[..., 1], right[..., 2]
    skin = (red > 150) & (red > green + 25) & (green > blue + 5)
    assert skin.sum() > 3000, "there is a face in the preview"


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (["--size", "10x10"], "'10x10' is not a size such as 1600x1000 (64 to 8192 each)"),
        (["--curves", "missing.json"], "Cannot read missing.json"),
    ],
)
def test_what_cannot_be_drawn_is_said(options: list[str], told: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["screenshot", "Hi.", "--out", "w.png", *options]) == 2
    err = capsys.readouterr().err
    assert told in err
    assert err.count("\n") == 1
