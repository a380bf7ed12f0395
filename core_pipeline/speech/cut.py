"""Where a long recording may be cut, and whether anything is said in it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..errors import UserError

#: Seconds over which loudness is measured.
STEP = 0.02
#: Loudness (root mean square) below which all is silence: −60 dB.
SILENT = 0.001


def loudness(sound: NDArray[np.float32], rate: int) -> NDArray[np.float64]:
    """Root mean square of each STEP seconds; at least one value."""
    size = round(STEP * rate)
    whole = sound.size // size * size
    if not whole:
        return np.array([float(np.sqrt(np.mean(np.square(sound, dtype=np.float64))))]) if sound.size else np.zeros(1)
    squares = np.square(sound[:whole].reshape(-1, size), dtype=np.float64)
    means: NDArray[np.float64] = np.sqrt(squares.mean(axis=1))
    return means


def speech_level(levels: NDArray[np.float64]) -> float:
    """The loudness above which a step counts as speech: a little above the quiet parts, well below the loud ones."""
    quiet, loud = np.percentile(levels, (10, 95))
    return max(SILENT, min(float(loud) / 4, 4 * float(quiet) + float(loud) / 20))


def refuse_silence(sound: NDArray[np.float32], rate: int) -> None:
    """UserError when nothing in the recording is loud enough to be speech."""
    if loudness(sound, rate).max() < SILENT:
        raise UserError("The recording is silent: check the microphone, or choose another recording.")


def quietest(levels: NDArray[np.float64], first: float, last: float) -> float:
    """The second between the two at which it is quietest for a tenth of a second."""
    a, b = round(first / STEP), min(round(last / STEP), levels.size)
    if b - a < 6:
        return last
    smooth = np.convolve(levels[a:b], np.ones(5), "valid")
    return float((a + int(np.argmin(smooth)) + 2.5) * STEP)
