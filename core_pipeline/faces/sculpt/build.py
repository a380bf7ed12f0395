"""Sculpting a whole face: the pieces put together, and every pose minus the neutral one."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from core_pipeline.faces.face import Face
from core_pipeline.faces.normals import VertexNormals, seam_groups
from core_pipeline.faces.sculpt.character import Character
from core_pipeline.faces.sculpt.eyes import eyes
from core_pipeline.faces.sculpt.hair import hair
from core_pipeline.faces.sculpt.lids import LID
from core_pipeline.faces.sculpt.mouth import Lips
from core_pipeline.faces.sculpt.piece import Piece
from core_pipeline.faces.sculpt.sdf import Blob, Solid
from core_pipeline.faces.sculpt.skin import Skin
from core_pipeline.faces.sculpt.teeth import teeth
from core_pipeline.faces.sculpt.tongue import tongue
from core_pipeline.faces.sculpt.trimmings import body, brows, ears

IDLE = ("blink", "browUp")


def sculpt(character: Character) -> Face:
    """The character as a face: its poses in their order, then blink and browUp. The same numbers every time."""
    return assemble(character, pieces(character))


def pieces(character: Character) -> list[Piece]:
    """Everything the face is made of."""
    ball = character.eyes.radius * LID
    clay = Solid((*character.clay, Blob(character.eyes.centre, (ball, ball, ball), 0.13, mirrored=True)))
    lips = Lips(character, clay)
    scalp = Solid(character.clay)
    return [
        Skin(character, clay, lips).piece(),
        *teeth(character, lips.centre),
        tongue(character, lips.centre),
        *eyes(character),
        *brows(character, scalp),
        hair(character, scalp),
        *ears(character),
        *body(character),
    ]


def assemble(character: Character, made: list[Piece]) -> Face:
    """One mesh of many pieces."""
    shapes = (*character.poses, *IDLE)
    positions = np.concatenate([piece.positions for piece in made]).astype(np.float32)
    colours = np.concatenate([piece.colours for piece in made]).astype(np.float32)
    deltas = np.stack([_delta(made, shape) for shape in shapes]).astype(np.float32)
    deltas[np.abs(deltas) < 1e-7] = 0
    triangles, parts = _triangles_and_parts(made)
    normals = VertexNormals(triangles, seam_groups(positions))
    rest = normals.of(positions)
    normal_deltas = np.stack([normals.of(positions + delta) - rest for delta in deltas])
    return Face(
        name=character.name,
        title=character.title,
        positions=positions,
        normals=rest,
        triangles=triangles,
        colours=np.clip(colours, 0, 1),
        shapes=shapes,
        deltas=deltas,
        normal_deltas=normal_deltas,
        pose_map=character.pose_map,
        parts=parts,
        camera=character.camera,
    )


def _delta(made: list[Piece], shape: str) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    return np.concatenate([piece.poses.get(shape, piece.positions) - piece.positions for piece in made])


def _triangles_and_parts(
    made: list[Piece],
) -> tuple[np.ndarray[tuple[int, ...], np.dtype[np.uint32]], Mapping[str, tuple[int, int]]]:
    triangles, parts = [], {}
    vertices = faces = 0
    for piece in made:
        triangles.append(piece.triangles + vertices)
        ranges = piece.ranges or {piece.name: (0, len(piece.triangles))}
        parts.update({name: (faces + first, count) for name, (first, count) in ranges.items()})
        vertices += len(piece.positions)
        faces += len(piece.triangles)
    return np.concatenate(triangles).astype(np.uint32), parts
