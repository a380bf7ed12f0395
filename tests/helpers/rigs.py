"""Small rigs of every kind, as users bring them: one head, with whatever shapes, unit and direction a test asks for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from core_pipeline.faces.face import Face
from core_pipeline.faces.mapping_json import load_presets
from core_pipeline.faces.rigs.glb_write import write_glb
from tests.helpers.ball import ball

PRESETS = load_presets(Path(__file__).resolve().parents[2] / "assets" / "retarget")

Z_UP = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]], np.float32)
BACKWARDS = np.diag(np.array([-1, 1, -1], np.float32))

NAMES = {preset.name: sorted(preset.names) for preset in PRESETS}


def head(shapes: Sequence[str] = ("jawOpen", "mouthPucker"), rings: int = 10) -> Face:
    """An egg, higher than wide; its first shape drops the chin and takes it back, the others push out the mouth."""
    egg = ball(rings, name="head")
    positions = egg.positions * np.float32([0.8, 1.15, 0.9])
    low = np.clip(-positions[:, 1] - 0.1, 0, 1) * (positions[:, 2] > 0)
    mouth = np.exp(-8 * ((positions - np.float32([0, -0.5, 0.8])) ** 2).sum(1))
    deltas = np.stack(
        [
            low[:, None] * np.float32([0, -0.3, -0.2])
            if not row
            else mouth[:, None] * np.float32([0, 0.01 * row, 0.15])
            for row in range(len(shapes))
        ]
    ).astype(np.float32)
    return replace(
        egg, positions=positions, shapes=tuple(shapes), deltas=deltas, normal_deltas=np.zeros_like(deltas)
    )  # fmt: skip


def moved(face: Face, turn: np.ndarray, scale: float = 1.0, shift: Sequence[float] = (0, 0, 0)) -> Face:
    """The same rig in another unit, place and direction."""
    return replace(
        face,
        positions=(face.positions @ turn.T * scale + np.float32(shift)).astype(np.float32),
        normals=(face.normals @ turn.T).astype(np.float32),
        deltas=(face.deltas @ turn.T * scale).astype(np.float32),
    )


def as_glb(face: Face, path: Path) -> Path:
    write_glb(face, path)
    return path


def obj_text(positions: np.ndarray, triangles: np.ndarray) -> str:
    lines = [f"v {x:.6f} {y:.6f} {z:.6f}" for x, y, z in positions.tolist()]
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in triangles.tolist()]
    return "\n".join(lines) + "\n"


def as_objs(face: Face, folder: Path) -> Path:
    folder.mkdir(exist_ok=True)
    (folder / "neutral.obj").write_text(obj_text(face.positions, face.triangles))
    for shape, delta in zip(face.shapes, face.deltas, strict=True):
        (folder / f"{shape}.obj").write_text(obj_text(face.positions + delta, face.triangles))
    return folder
