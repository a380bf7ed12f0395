"""The two clips of a trial: pictures and sound, read on a thread."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QObject

from core_pipeline.errors import UserError
from core_pipeline.files.study_json import clip_path
from core_pipeline.speech.utterance import Audio
from core_pipeline.study import LEFT, RIGHT

from .latest import Latest

#: Bytes of one clip's pictures.
MOST = 400 * 2**20
#: Samples of its sound per second.
RATE = 24_000
_PPM = re.compile(rb"P6\s(\d+)\s(\d+)\s255\s")


@dataclass(frozen=True, eq=False)
class Film:
    """frames (n, h, w, 3) uint8 RGB, fps, and the sound if there is any."""

    frames: NDArray[np.uint8]
    fps: float
    audio: Audio | None

    @property
    def duration(self) -> float:
        """Seconds."""
        return len(self.frames) / self.fps


@dataclass(frozen=True, eq=False)
class Pair:
    """Both clips of a trial, by side."""

    trial: int
    films: dict[str, Film]


class PairReader(Latest):
    """`request((folder, trial))` is answered with a Pair."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__("pair reader", self._read, parent)

    def _read(self, wish: tuple[Path, int], _is_old: Callable[[], bool]) -> Pair:
        folder, trial = wish
        return Pair(trial, {side: read_film(clip_path(folder, trial, side)) for side in (LEFT, RIGHT)})


def read_film(path: Path) -> Film:
    """A clip; UserError when it is missing, damaged or too large."""
    import imageio_ffmpeg  # type: ignore[import-untyped]

    if not path.is_file():
        raise UserError(f"{path} is missing: make the study again, it goes on where it stopped.")
    ffmpeg = imageio_ffmpeg.get_ffmpeg_exe()
    # Pictures with a header each; `-fs` ends a film that would fill the memory.
    pictures = _run(ffmpeg, path, "-fs", str(MOST), "-f", "image2pipe", "-c:v", "ppm")
    rate = re.search(rb"(\d+(?:\.\d+)?) fps", pictures.stderr)
    frames = _frames(pictures.stdout)
    if rate is None or not frames or float(rate[1]) < 1:
        raise UserError(f"{path} is no clip that can be shown: make the study again.")
    if sum(frame.nbytes for frame in frames) > 0.98 * MOST:
        raise UserError(f"{path} is too long to be compared: make a study of shorter sentences.")
    sound = _run(ffmpeg, path, "-t", "600", "-f", "s16le", "-ac", "1", "-ar", str(RATE)).stdout
    samples = np.frombuffer(sound[: len(sound) // 2 * 2], np.int16).astype(np.float32) / np.float32(32768)
    return Film(np.stack(frames), float(rate[1]), Audio(samples, RATE) if samples.size else None)


def _run(ffmpeg: str, path: Path, *output: str) -> subprocess.CompletedProcess[bytes]:
    command = [ffmpeg, "-hide_banner", "-nostdin", "-i", str(path), *output, "-"]
    return subprocess.run(command, capture_output=True, check=False, stdin=subprocess.DEVNULL)


def _frames(data: bytes) -> list[NDArray[np.uint8]]:
    """The pictures of a row of PPM files, all of one size; a cut one at the end is left out."""
    frames: list[NDArray[np.uint8]] = []
    at = 0
    while (head := _PPM.match(data, at)) is not None:
        width, height = int(head[1]), int(head[2])
        size = 3 * width * height
        if head.end() + size > len(data):
            break
        frame = np.frombuffer(data, np.uint8, size, head.end()).reshape(height, width, 3)
        if frames and frame.shape != frames[0].shape:
            break
        frames.append(frame)
        at = head.end() + size
    return frames
