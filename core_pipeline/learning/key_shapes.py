"""Key lip shapes for captured points: markers, landmarks or vertices (Chen et al., appendix A).

`key_shapes.csv` in the corpus's folder says what each pose does to the points, in the takes' own columns and units:

    pose,lip_upper_x,lip_upper_y,…
    neutral,0.0,12.1,…
    open,0.1,13.0,…

The rows are picked from the capture by hand, as the paper's artist picks them; "neutral" is the face at rest.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import UserError
from ..files.atomic import read_bytes
from ..files.json_text import shown
from ..schedule import Schedule
from ..weights import Weights
from .capture import Capture
from .corpus import Clip
from .frame_fit import pose_weights, unexplained

Array = NDArray[np.float64]

NAME = "key_shapes.csv"
NEUTRAL = "neutral"
MAX_BYTES = 64 * 2**20


@dataclass(frozen=True, eq=False)
class KeyShapes:
    """columns (d names), neutral (d,), shapes (poses, d) in the order of `poses`."""

    columns: tuple[str, ...]
    neutral: Array
    poses: tuple[str, ...]
    shapes: Array

    def fits(self, header: Sequence[str]) -> bool:
        """Whether a take has all the columns."""
        return set(self.columns) <= set(header)

    def clip_of(self, name: str, capture: Capture, schedule: Schedule, poses: Sequence[str]) -> Clip:
        """Points with their phones as a clip over `poses`; UserError when no key shape is one of them."""
        wanted = [pose for pose in poses if pose in self.poses]
        if not wanted:
            raise UserError(f"{NAME} has none of the poses {', '.join(poses[:9])}: name its rows after them.")
        at = [capture.channels.index(column) for column in self.columns]
        basis = (self.shapes[[self.poses.index(pose) for pose in wanted]] - self.neutral).T
        offsets = capture.values[:, at] - self.neutral
        found = pose_weights(basis, offsets, upper=1.0)
        weights = np.zeros((len(found), len(poses)), np.float32)
        weights[:, [poses.index(pose) for pose in wanted]] = found
        seen = capture.seen
        blind = tuple(pose for pose in poses if pose not in wanted)
        notes = [*capture.notes, *([f"{', '.join(blind)} has no key shape and stays at rest."] if blind else [])]
        made = Weights(tuple(poses), capture.fps, capture.start, weights)
        return Clip(name, schedule, made, seen, unexplained(basis, offsets[seen], found[seen]), blind, tuple(notes))


def load(path: Path) -> KeyShapes:
    """The key shapes in a file; UserError names line and cure."""
    place = str(path)
    try:
        text = read_bytes(path, MAX_BYTES, "table of key shapes").decode("utf-8-sig")
        rows = [row for row in csv.reader(io.StringIO(text, newline="")) if any(cell.strip() for cell in row)]
    except (UnicodeDecodeError, csv.Error) as error:
        raise UserError(f"{place} is not a table in UTF-8 ({str(error)[:80]}): save it as CSV again.") from error
    if len(rows) < 3 or len(rows[0]) < 2:
        raise UserError(f"{place} needs a first line of column names, a row neutral, and a row for each pose.")
    columns = [cell.strip() for cell in rows[0][1:]]
    if len(set(columns)) < len(columns):
        raise UserError(f"{place} names a column twice: correct its first line.")
    shapes: dict[str, Array] = {}
    for line, row in enumerate(rows[1:], 2):
        pose = row[0].strip()
        try:
            values = np.array([float(cell) for cell in row[1:]])
        except ValueError:
            values = np.zeros(0)
        if pose in shapes or values.size != len(columns) or not np.isfinite(values).all():
            raise UserError(
                f"{place}: row {line} ({shown(pose)}) is not one pose with {len(columns)} numbers. Correct it."
            )
        shapes[pose] = values
    neutral = shapes.pop(NEUTRAL, None)
    if neutral is None:
        raise UserError(f"{place} has no row {NEUTRAL}: add the face at rest.")
    return KeyShapes(tuple(columns), neutral, tuple(shapes), np.array(list(shapes.values())))
