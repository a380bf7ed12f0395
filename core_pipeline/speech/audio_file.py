"""Recordings: wav, flac, ogg, mp3, aiff through libsndfile; mp4 and its kin through the extra `av`."""

from __future__ import annotations

from math import gcd
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import UserError
from ..files.atomic import reason
from ..files.json_text import shown
from .utterance import Audio

#: Endings of files that may be recordings.
SOUND_FILES = (
    ".wav",
    ".flac",
    ".ogg",
    ".oga",
    ".opus",
    ".mp3",
    ".aif",
    ".aiff",
    ".au",
    ".w64",
    ".caf",
    ".sph",
    ".nist",
)
VIDEO_FILES = (".mp4", ".m4a", ".mov", ".mkv", ".webm", ".aac", ".avi")
#: Seconds; what is longer must be cut first.
LONGEST = 3600.0
SLOWEST_RATE, FASTEST_RATE = 4000, 384_000
#: Samples per second that are kept at most; nobody hears more.
_KEPT_RATE = 48_000
_BLOCK = 1 << 18


def read_audio(path: Path | str) -> Audio:
    """The recording, mono: several channels are averaged, numbers of any width become float32 in [−1, 1].

    UserError names the file and the cure: unreadable, of another kind, empty, longer than LONGEST.
    """
    path = Path(path)
    _check_file(path)
    blocks, rate = _by_ffmpeg(path) if path.suffix.lower() in VIDEO_FILES else _by_sndfile(path)
    if not blocks or not (samples := np.concatenate(blocks)).size:
        raise UserError(f"{path} holds no sound: choose another recording.")
    del blocks
    np.nan_to_num(samples, copy=False, nan=0.0, posinf=1.0, neginf=-1.0)
    if (peak := float(np.abs(samples).max())) > 1:  # a float file may say so
        samples /= np.float32(peak)
    audio = Audio(samples, rate)
    return resampled(audio, _KEPT_RATE) if rate > _KEPT_RATE else audio


def resampled(audio: Audio, rate: int) -> Audio:
    """The same sound with another rate."""
    if audio.rate == rate:
        return audio
    from scipy.signal import resample_poly

    common = gcd(rate, audio.rate)
    up, down = rate // common, audio.rate // common
    while up > 1000 or down > 4000:  # an odd rate: as near as matters
        up, down = max(1, up // 2), max(1, down // 2)
    samples = resample_poly(audio.samples, up, down).astype(np.float32)
    return Audio(np.clip(samples, -1, 1, out=samples), rate)


def _check_file(path: Path) -> None:
    try:
        if path.is_dir():
            raise UserError(f"{path} is a folder: choose the recording in it.")
        if not path.is_file() and path.exists():
            raise UserError(f"{path} is no file: choose a recording.")
        with path.open("rb") as file:
            if not file.read(1):
                raise UserError(f"{path} is empty: choose another recording.")
    except (OSError, ValueError) as error:
        raise UserError(f"Cannot read {path}: {reason(error)}.") from None


def _by_sndfile(path: Path) -> tuple[list[NDArray[np.float32]], int]:
    try:
        import soundfile
    except (ImportError, OSError) as error:
        raise UserError(f"Recordings need the package soundfile ({error}): install it and try again.") from None
    try:
        with soundfile.SoundFile(path) as file:
            rate, channels = int(file.samplerate), int(file.channels)
            _check_rate(path, rate)
            blocks: list[NDArray[np.float32]] = []
            size, count = max(1, _BLOCK // channels), 0
            while (block := file.read(size, dtype="float32", always_2d=True)).shape[0]:
                with np.errstate(invalid="ignore"):  # ∞ − ∞, in a damaged float file
                    blocks.append(block.mean(axis=1, dtype=np.float64).astype(np.float32))
                count += block.shape[0]
                _check_length(path, count / rate)
    except (soundfile.SoundFileError, RuntimeError, TypeError, ValueError, OSError) as error:
        raise UserError(f"{path} is no recording that can be read ({_short(error)}): {_CURE}.") from None
    return blocks, rate


_CURE = "save it as WAV, FLAC, OGG or MP3"


def _by_ffmpeg(path: Path) -> tuple[list[NDArray[np.float32]], int]:
    try:
        import av
    except ImportError:
        raise UserError(
            f"{path.name} needs the package av, which is not installed: pip install av, or {_CURE}."
        ) from None
    try:
        with av.open(str(path)) as container:
            if not container.streams.audio:
                raise UserError(f"{path} has no sound track: choose another recording.")
            stream: Any = container.streams.audio[0]
            rate = int(stream.rate or 0)
            _check_rate(path, rate)
            floats = av.AudioResampler(format="fltp", rate=rate)
            blocks: list[NDArray[np.float32]] = []
            count = 0
            for frame in container.decode(stream):
                for part in floats.resample(frame):
                    blocks.append(part.to_ndarray().mean(axis=0, dtype=np.float32))
                    count += blocks[-1].size
                _check_length(path, count / rate)
            blocks += [part.to_ndarray().mean(axis=0, dtype=np.float32) for part in floats.resample(None)]
    except (av.FFmpegError, ValueError, OSError) as error:
        raise UserError(f"{path} is no recording that can be read ({_short(error)}): {_CURE}.") from None
    return blocks, rate


def _check_rate(path: Path, rate: int) -> None:
    if not SLOWEST_RATE <= rate <= FASTEST_RATE:
        raise UserError(f"{path} claims {rate} samples per second: {_CURE} with 16000 or 48000.")


def _check_length(path: Path, seconds: float) -> None:
    if seconds > LONGEST:
        raise UserError(f"{path} is longer than {LONGEST / 60:.0f} minutes: cut it into shorter recordings.")


def _short(error: Exception) -> str:
    text = str(error).split(": ", 1)[-1] if "Error opening" in str(error) else str(error)
    return shown(text.strip().rstrip("."), 80) or "damaged"
