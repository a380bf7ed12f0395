"""`lipstitch render --out clip.mp4`: the sentence as a clip with sound, whole or not at all."""

import os
import re
import subprocess
import sys
from pathlib import Path

import imageio_ffmpeg
import numpy as np
import pytest
from PIL import Image

from app import cli
from app.cli import main
from app.command_line.mp4 import Mp4
from core_pipeline.errors import UserError
from core_pipeline.speech.utterance import Audio

FRAME = np.full((64, 64, 4), 200, np.uint8)


def ffmpeg(*arguments: str | Path) -> subprocess.CompletedProcess[bytes]:
    return subprocess.run(
        [imageio_ffmpeg.get_ffmpeg_exe(), "-hide_banner", *arguments], capture_output=True, check=False
    )


def streams_of(clip: Path) -> list[str]:
    """What ffmpeg says of a clip's streams, a line each."""
    return re.findall(r"Stream #0:\d.*?: (\w+: .*)", ffmpeg("-i", clip).stderr.decode())


def frames_of(clip: Path, width: int, height: int) -> np.ndarray:
    """(n, height, width, 3)"""
    done = ffmpeg("-v", "error", "-i", clip, "-f", "rawvideo", "-pix_fmt", "rgb24", "-fps_mode", "passthrough", "-")
    return np.frombuffer(done.stdout, np.uint8).reshape(-1, height, width, 3).astype(int)


def sound_of(clip: Path, rate: int = 22050) -> np.ndarray:
    """The decoded sound (n,) in [-1, 1]."""
    return np.frombuffer(ffmpeg("-v", "error", "-i", clip, "-f", "f32le", "-ar", str(rate), "-").stdout, np.float32)


def lag(sound: np.ndarray, reference: np.ndarray) -> int:
    """By how many samples `sound` comes later."""
    n = 2 ** int(np.ceil(np.log2(len(sound) + len(reference))))
    match = np.fft.irfft(np.fft.rfft(sound, n) * np.conj(np.fft.rfft(reference, n)), n)
    peak = int(match.argmax())
    return peak if peak < n // 2 else peak - n


def left_over(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


# ── what it writes ───────────────────────────────────────────────────────────────────────────────


def test_a_clip_shows_the_same_frames_as_the_folder_and_sounds_the_same(tmp_path, capsys):
    clip, folder = tmp_path / "Clip.MP4", tmp_path / "frames"
    options = ["--face", "ada", "--size", "128x96", "--fps", "12"]
    assert main(["render", "Wow, papa!", "--out", str(folder), *options]) == 0
    clip.write_text("an older clip")
    assert main(["render", "Wow, papa!", "--out", str(clip), *options]) == 0
    pictures = np.stack([np.asarray(Image.open(file)) for file in sorted(folder.glob("*.png"))]).astype(int)
    assert capsys.readouterr().out.splitlines()[1] == f"{len(pictures)} frames at 12 per second in {clip}"
    video, audio = streams_of(clip)
    assert video.startswith("Video: h264 ")
    assert "yuv420p(tv, bt709, progressive), 128x96, " in video
    assert "12 fps" in video
    assert audio.startswith("Audio: aac ")
    frames = frames_of(clip, 128, 96)
    assert frames.shape == pictures.shape
    difference = frames - pictures
    assert np.abs(difference).mean() < 4
    assert np.abs(difference.mean((0, 1, 2))).max() < 2.5, "the colours are those of the frames"
    moved = np.ptp(pictures, axis=0).max(axis=-1) > 90
    assert moved.any()
    assert np.ptp(frames, axis=0).max(axis=-1)[moved].min() > 30, "and what moves there moves here"
    with (folder / "sound.wav").open("rb") as file:
        expected = np.frombuffer(file.read()[44:], "<i2") / 32768
    sound = sound_of(clip)
    assert len(sound) / 22050 == pytest.approx(len(expected) / 22050, abs=0.06)
    assert abs(lag(sound, expected)) < 0.02 * 22050, "the sound begins with the picture"
    assert left_over(tmp_path) == ["Clip.MP4", "frames"]


def test_odd_sizes_are_made_even_and_the_crab_speaks_with_its_own_curves(tmp_path, capsys):
    clip = tmp_path / "clip.mp4"
    assert main(["render", "Wow.", "--out", str(clip), "--face", "crab", "--size", "75x65", "--fps", "8"]) == 0
    assert capsys.readouterr().err == "lipstitch: a clip's width and height are even: it is 76x66.\n"
    assert "76x66, " in streams_of(clip)[0]
    assert np.ptp(frames_of(clip, 76, 66), axis=0).max() > 90, "it never moved"


def test_other_curves_may_be_named_for_a_character_with_its_own(tmp_path, capsys):
    english = Path("assets/curves/english.json").resolve()
    options = ["--face", "crab", "--curves", str(english), "--size", "64x64", "--fps", "1"]
    assert main(["render", "Hi.", "--out", str(tmp_path / "clip.mp4"), *options]) == 0
    assert "Not available on this face: open, W" in capsys.readouterr().err


def pictures_of(tmp_path: Path, *options: str, size: str = "192x64") -> np.ndarray:
    """(n, h, w, 3) of the frames of a short word."""
    folder = tmp_path / "-".join(option.strip("-") for option in ("frames", *options))
    assert main(["render", "Papa!", "--out", str(folder), "--size", size, "--fps", "6", *options]) == 0
    return np.stack([np.asarray(Image.open(file)) for file in sorted(folder.glob("*.png"))]).astype(int)


def test_faces_side_by_side_say_the_same_each_as_it_can(tmp_path, capsys):
    cast = ["--face", "toon", "--face", "man", "--face", "crab"]
    together = pictures_of(tmp_path, *cast, "--still")
    assert "each speaks with its own curves (english.json, crab.json)" in capsys.readouterr().err
    thirds = [together[:, :, 64 * i : 64 * (i + 1)] for i in range(3)]
    for third in thirds:
        assert np.ptp(third, axis=0).max() > 60, "each of them speaks"
    assert np.abs(thirds[0] - thirds[1]).mean() > 5, "and they are not the same"
    blinking = pictures_of(tmp_path, *cast)
    assert blinking.shape == together.shape


def test_a_face_that_cannot_make_the_poses_named_says_so_by_name(tmp_path, capsys):
    options = ["--face", "toon", "--face", "crab", "--curves", str(Path("assets/curves/english.json").resolve())]
    frames = pictures_of(tmp_path, *options, "--still")
    assert "Crab: Not available on this face: open, W" in capsys.readouterr().err
    assert np.ptp(frames[:, :, :96], axis=0).max() > 60
    assert np.ptp(frames[:, :, 96:], axis=0).max() == 0


def test_four_faces_are_refused(tmp_path, capsys):
    out = str(tmp_path / "clip.mp4")
    assert main(["render", "Hi.", "--out", out, *["--face", "toon"] * 4]) == 2
    assert "4 faces do not fit side by side: name --face 3 times at most." in capsys.readouterr().err


def test_looks_and_cameras_may_be_named(tmp_path):
    green = pictures_of(tmp_path, "--background", "green", size="64x64")
    assert (green[:, 0, 0] == (0, 177, 64)).all()
    seen = {
        option: pictures_of(tmp_path, *option, "--still", size="64x64")[0]
        for option in ((), ("--light", "right"), ("--camera", "profile"), ("--background", "night"))
    }
    first = seen.pop(())
    for option, picture in seen.items():
        assert np.abs(picture - first).mean() > 3, option


def test_on_the_turntable_the_face_turns_by_the_clips_time(tmp_path):
    turning = pictures_of(tmp_path, "--turntable", "--still", size="64x64")
    standing = pictures_of(tmp_path, "--still", size="64x64")
    apart = np.abs(turning - standing).mean(axis=(1, 2, 3))
    assert apart[0] == 0
    assert apart[-1] > 2


def test_without_sound_the_clip_is_silent(tmp_path):
    clip = tmp_path / "clip.mp4"
    with Mp4(clip, (64, 64), 29.97, None) as writing:
        for _ in range(30):
            writing.add(FRAME)
    (video,) = streams_of(clip)
    assert "29.97 fps" in video
    frames = frames_of(clip, 64, 64)
    assert len(frames) == 30
    assert np.abs(frames - 200).max() <= 2


# ── what it cannot do ────────────────────────────────────────────────────────────────────────────


@pytest.mark.parametrize(
    ("out", "told"),
    [
        ("clip.mov", "name a clip .mp4, or name a folder"),
        ("nowhere/clip.mp4", "Cannot write {}: there is no such file or folder"),
        ("file/clip.mp4", "Cannot write {}: "),
        ("folder.mp4", "Cannot write {}: it is a folder"),
    ],
)
def test_a_place_that_cannot_be_written_is_said(tmp_path, out, told, capsys):
    (tmp_path / "file").write_text("mine")
    (tmp_path / "folder.mp4").mkdir()
    assert main(["render", "Hi.", "--out", str(tmp_path / out), "--size", "64x64", "--fps", "1"]) == 2
    err = capsys.readouterr().err
    assert told.format(tmp_path / out) in err
    assert err.count("\n") == 1
    assert left_over(tmp_path) == ["file", "folder.mp4"]


def test_a_face_that_is_not_there_is_said(tmp_path, capsys):
    assert main(["render", "Hi.", "--out", str(tmp_path / "clip.mp4"), "--face", "adda"]) == 2
    assert "There is no face “adda”: name toon, ada, crab, man, woman, or a file" in capsys.readouterr().err


def write(clip: Path) -> None:
    with Mp4(clip, (64, 64), 25, Audio(np.zeros(2000, np.float32), 8000)) as writing:
        for _ in range(100):
            writing.add(FRAME)


def why_not(clip: Path) -> str:
    """Why a clip cannot be written."""
    with pytest.raises(UserError) as failed:
        write(clip)
    return str(failed.value)


def test_without_ffmpeg_it_is_said_what_to_install(tmp_path, monkeypatch):
    clip = tmp_path / "clip.mp4"
    monkeypatch.setenv("IMAGEIO_FFMPEG_EXE", str(tmp_path / "gone"))
    assert re.fullmatch(r"ffmpeg cannot be started \(.*gone\): there is no such file.*\.", why_not(clip))
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    assert "install the package imageio-ffmpeg" in why_not(clip)
    assert left_over(tmp_path) == []


@pytest.mark.skipif(os.name != "posix", reason="the programs that stand in for a broken ffmpeg are shell scripts")
@pytest.mark.parametrize(
    ("does", "told"),
    [
        ("echo clip.mp4: No space left on device >&2; exit 1", "ffmpeg said “clip.mp4: No space left on device”"),
        ("exit 7", "ffmpeg ended with code 7"),
        ("cat > /dev/null; exit 3", "ffmpeg ended with code 3"),
        ("cat > /dev/null", "there is no such file"),
    ],
)
def test_when_ffmpeg_fails_the_old_clip_stays_and_nothing_is_left(tmp_path, does, told, monkeypatch):
    program, clip = tmp_path / "ffmpeg", tmp_path / "clip.mp4"
    program.write_text(f"#!/bin/sh\n{does}\n")
    program.chmod(0o755)
    clip.write_text("an older clip")
    monkeypatch.setenv("IMAGEIO_FFMPEG_EXE", str(program))
    sentence = why_not(clip)
    assert sentence.startswith(f"Cannot write {clip}: ")
    assert told in sentence
    assert clip.read_text() == "an older clip"
    assert left_over(tmp_path) == ["clip.mp4", "ffmpeg"]


def test_a_clip_given_up_leaves_nothing(tmp_path):
    def give_up() -> None:
        with Mp4(tmp_path / "clip.mp4", (64, 64), 25, None) as writing:
            writing.add(FRAME)
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        give_up()
    assert left_over(tmp_path) == []


# ── what it loads ────────────────────────────────────────────────────────────────────────────────


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="elsewhere only Qt can make an OpenGL context")
def test_clips_and_sheets_need_no_qt(tmp_path):
    code = """
import sys
class NoQt:
    def find_spec(self, name, path=None, target=None):
        assert name.partition(".")[0] not in ("PySide6", "shiboken6", "pyqtgraph", "qtawesome"), name
sys.meta_path.insert(0, NoQt())
from app.cli import main
heavy = {"numpy", "PIL", "OpenGL", "imageio_ffmpeg"} & set(sys.modules)
assert main(["render", "Hi.", "--out", "clip.mp4", "--size", "64x64", "--fps", "2"]) == 0
assert main(["contact-sheet", "toon", "--out", "sheet.png", "--size", "64x64"]) == 0
assert not heavy, f"the command line starts slowly with {heavy}"
"""
    environment = {**os.environ, "PYTHONPATH": str(Path(cli.__file__).parents[1])}
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, env=environment, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert left_over(tmp_path) == ["clip.mp4", "sheet.png"]
