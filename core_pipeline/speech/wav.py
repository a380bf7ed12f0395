"""Mono WAV files: the sound of an utterance on disk."""

from __future__ import annotations

import io
import wave
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import UserError
from ..files.atomic import open_to_read, write_atomically
from .utterance import Audio


def write_wav(path: Path | str, audio: Audio) -> None:
    """16-bit mono, written atomically; samples beyond [−1, 1] are clipped. UserError when that fails."""
    out = io.BytesIO()
    with wave.open(out, "wb") as wav:
        wav.setnchannels(1)
        wav.setsampwidth(2)
        wav.setframerate(audio.rate)
        wav.writeframes(to_int16(audio.samples).tobytes())
    write_atomically(path, out.getvalue())


def read_wav(path: Path | str) -> Audio:
    """Integer PCM of 8, 16, 24 or 32 bits; several channels are averaged. UserError names file and cure."""
    try:
        with open_to_read(Path(path)) as file, wave.open(file, "rb") as wav:
            channels, width, rate = wav.getnchannels(), wav.getsampwidth(), wav.getframerate()
            data = wav.readframes(wav.getnframes())
    except OSError as error:
        raise UserError(f"{path} cannot be read: {error.strerror}. Check the name and its rights.") from None
    except (wave.Error, EOFError) as error:
        problem = str(error) or "it ends too early"
        raise UserError(f"{path} is no WAV file of integer samples ({problem}): save it as 16-bit PCM.") from None
    if rate <= 0 or not 1 <= width <= 4:
        raise UserError(f"{path} claims {rate} samples per second of {8 * width} bits: save it as 16-bit PCM.")
    samples = _to_float(data[: len(data) - len(data) % (width * channels)], width)
    return Audio(np.ascontiguousarray(samples.reshape(-1, channels).mean(axis=1, dtype=np.float32)), rate)


def to_int16(samples: NDArray[np.float32]) -> NDArray[np.int16]:
    """[−1, 1] → [−32768, 32767], rounded and clipped; little endian. The inverse of dividing by 32768."""
    scaled: NDArray[np.float32] = np.clip(np.rint(samples * np.float32(32768)), -32768, 32767)
    return scaled.astype("<i2")


def _to_float(data: bytes, width: int) -> NDArray[np.float32]:
    if width == 1:  # the only unsigned one
        return (np.frombuffer(data, np.uint8).astype(np.float32) - np.float32(128)) / np.float32(128)
    if width == 3:  # as the upper three bytes of four
        wide = np.zeros((len(data) // 3, 4), np.uint8)
        wide[:, 1:] = np.frombuffer(data, np.uint8).reshape(-1, 3)
        return (wide.view("<i4")[:, 0] / 2**31).astype(np.float32)
    return (np.frombuffer(data, f"<i{width}") / 2.0 ** (8 * width - 1)).astype(np.float32)
