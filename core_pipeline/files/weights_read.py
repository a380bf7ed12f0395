"""Weights files back in: our own JSON, and CSV with a time column and a column per pose."""

from __future__ import annotations

import csv
import io
import math
from pathlib import Path

import msgspec
import numpy as np
from numpy.typing import NDArray

from ..errors import UserError
from ..weights import Weights
from .atomic import read_bytes
from .json_text import decode_json, shown
from .weights_files import SCHEMA

MAX_BYTES = 256 * 2**20
MAX_POSES = 400
#: Weights this far outside 0…1 are rounding and are clipped; further is an error.
SLACK = 0.05


class WeightsRecord(msgspec.Struct):
    """As `weights_files.to_json` writes it."""

    fps: float
    poses: list[str]
    frames: list[list[float]]
    start: float = 0.0


def load(path: Path | str) -> Weights:
    """The weights in a .json or .csv; UserError names file, frame and cure."""
    data = read_bytes(path, MAX_BYTES, "weights")
    return parse_csv(data, str(path)) if Path(path).suffix.lower() == ".csv" else parse_json(data, str(path))


def parse_json(data: bytes, place: str) -> Weights:
    """From bytes of JSON; `place` names the file in messages."""
    top = decode_json(data, place)
    if top.get("schema") != SCHEMA:
        raise UserError(f'{place} holds no weights: it should say "schema": "{SCHEMA}". Choose another file.')
    try:
        record = msgspec.convert(top, WeightsRecord)
    except msgspec.ValidationError as error:
        raise UserError(f"{place}: {str(error)[:200].lower()}. Correct that value.") from error
    for i, row in enumerate(record.frames):
        if len(row) != len(record.poses):
            raise UserError(f"{place}: frame {i} has {len(row)} weights for {len(record.poses)} poses. Bake it again.")
    frames = np.array(record.frames, np.float64).reshape(len(record.frames), len(record.poses))
    return _weights(record.poses, record.fps, record.start, frames, place)


def parse_csv(data: bytes, place: str) -> Weights:
    """From bytes of CSV: `time,open,W,…` and a row a frame; the frames must be evenly spaced."""
    try:
        rows = list(csv.reader(io.StringIO(data.decode("utf-8-sig"), newline="")))
    except (UnicodeDecodeError, csv.Error) as error:
        raise UserError(f"{place} is not a table of weights in UTF-8 ({str(error)[:80]}): export it again.") from error
    rows = [row for row in rows if any(cell.strip() for cell in row)]
    if len(rows) < 2 or not rows[0] or rows[0][0].strip().casefold() != "time":
        raise UserError(f"{place} holds no weights: its first line should be time and the poses, then a line a frame.")
    poses = [cell.strip() for cell in rows[0][1:]]
    values = np.empty((len(rows) - 1, len(poses) + 1))
    for i, row in enumerate(rows[1:]):
        try:
            values[i] = [float(cell) for cell in row]
        except ValueError:
            raise UserError(f"{place}: line {i + 2} is not {len(poses) + 1} numbers. Correct that line.") from None
    steps = np.diff(values[:, 0])
    if steps.size and not (np.isfinite(steps).all() and steps.min() > 0):
        raise UserError(f"{place}: the times do not rise from line to line. Export the weights again.")
    step = float(np.median(steps)) if steps.size else 1 / 60
    if steps.size and np.abs(steps - step).max() > 0.1 * step + 2e-6:
        raise UserError(f"{place}: the frames are not evenly spaced. Export the weights at a fixed rate.")
    fps = steps.size / (values[-1, 0] - values[0, 0]) if steps.size else 60.0
    rounded = round(fps)
    fps = float(rounded) if abs(fps - rounded) < 0.01 else fps
    return _weights(poses, fps, float(values[0, 0]), values[:, 1:], place)


def _weights(poses: list[str], fps: float, start: float, frames: NDArray[np.float64], place: str) -> Weights:
    if not poses or len(poses) > MAX_POSES or len(set(poses)) < len(poses) or not all(poses):
        raise UserError(f"{place}: its poses need different names, 1 to {MAX_POSES} of them. Correct its first line.")
    if not (1 <= fps <= 1000 and math.isfinite(start) and abs(start) <= 1e6):
        raise UserError(f"{place}: {fps:g} frames per second from {start:g} s is not possible. Export it again.")
    if not len(frames):
        raise UserError(f"{place} has no frame: bake it again.")
    odd = ~((frames >= -SLACK) & (frames <= 1 + SLACK))
    if odd.any():
        i, p = np.argwhere(odd)[0]
        raise UserError(
            f"{place}: frame {i}, pose {shown(poses[p])} is {frames[i, p]:g}; weights lie within 0 and 1. Correct it."
        )
    return Weights(tuple(poses), float(fps), float(start), np.clip(frames, 0.0, 1.0).astype(np.float32))
