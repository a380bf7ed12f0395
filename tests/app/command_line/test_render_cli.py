"""`lipstitch render`: a short word becomes PNG frames on which the mouth moves, and its sound."""

import os
import wave
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from app import cli


def test_a_word_becomes_frames_on_which_the_mouth_moves(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "new" / "frames"
    assert cli.main(["render", "Papa!", "--out", str(out), "--size", "64x64", "--fps", "12"]) == 0
    files = sorted(out.glob("*.png"))
    assert [file.name for file in files] == [f"frame_{i:05d}.png" for i in range(len(files))]
    assert capsys.readouterr().out == f"{len(files)} frames at 12 per second in {out}\n"
    with wave.open(str(out / "sound.wav")) as sound:
        seconds = sound.getnframes() / sound.getframerate()
    assert len(files) == pytest.approx(12 * seconds + 1, abs=4)
    frames = []
    for file in files:
        with Image.open(file) as picture:
            assert picture.size == (64, 64)
            assert picture.mode == "RGB"
            frames.append(np.asarray(picture, float))
    moved = np.ptp(np.stack(frames), axis=0).max(axis=-1)  # how much each pixel changes over time
    assert moved[32:].max() > 60, "the mouth moves"
    assert (moved[:16] < 10).all(), "the forehead does not"
    assert np.ptp(frames[0], axis=(0, 1)).min() > 60, "there is a face"


@pytest.mark.skipif(os.name != "posix", reason="a folder nobody may write to, on POSIX systems")
@pytest.mark.parametrize("place", ["file/frames", "file"])
def test_a_folder_that_cannot_be_made_is_said(tmp_path: Path, place: str, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "file").write_text("mine")
    assert cli.main(["render", "Hi.", "--out", str(tmp_path / place), "--size", "64x64"]) == 2
    err = capsys.readouterr().err
    assert err.startswith(f"lipstitch: Cannot make the folder {tmp_path / place}: ")
    assert err.count("\n") == 1
    assert (tmp_path / "file").read_text() == "mine"
