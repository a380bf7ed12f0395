"""Weights for other programs: JSON with one frame a line, or CSV with a column per pose."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path

from ..errors import UserError
from ..weights import Weights
from .atomic import write_atomically

SCHEMA = "lipstitch.Weights.1"


def save(weights: Weights, path: Path | str) -> None:
    """Write `.json` or `.csv` atomically; UserError for any other ending or when writing fails."""
    ending = Path(path).suffix.lower()
    writers = {".json": to_json, ".csv": to_csv}
    if ending not in writers:
        raise UserError(f"Cannot tell the format of {path}: name the file .json or .csv.")
    write_atomically(path, writers[ending](weights))


def to_json(weights: Weights) -> str:
    """{"schema": …, "fps": 60, "start": 0.0, "poses": […], "frames": [[…], …]}, five decimals."""
    rows = ",\n".join("    " + json.dumps(row) for row in _rounded(weights))
    fps = int(weights.fps) if weights.fps == int(weights.fps) else weights.fps
    return (
        f'{{\n  "schema": "{SCHEMA}",\n  "fps": {json.dumps(fps)},\n  "start": {json.dumps(round(weights.start, 6))},\n'
        f'  "poses": {json.dumps(list(weights.poses), ensure_ascii=False)},\n  "frames": [\n{rows}\n  ]\n}}\n'
    )


def to_csv(weights: Weights) -> str:
    """Header `time,open,W,…`, then a row per frame; time in seconds."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["time", *weights.poses])
    for i, row in enumerate(_rounded(weights)):
        writer.writerow([round(weights.start + i / weights.fps, 6), *row])
    return out.getvalue()


def _rounded(weights: Weights) -> list[list[float]]:
    """Five decimals are far below anything one sees, and keep the file readable."""
    return [[round(float(x), 5) for x in row] for row in weights.frames.tolist()]
