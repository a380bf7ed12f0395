"""Sculpting a whole face: the pieces put together, and every pose minus the neutral one."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from core_pipeline.faces.face import Face
from core_pipeline.faces.normals import VertexNormals, seam_groups
from core_pipeline.faces.sculpt.character import Character
from core_pipeline.faces.sculpt.crab_body import Crab
from core_pipeline.faces.sculpt.crab_pieces import crab_pieces
from core_pipeline.faces.sculpt.eyes import eyes
from core_pipeline.faces.sculpt.hair import hair
from core_pipeline.faces.sculpt.hidden import never_seen
from core_pipeline.faces.sculpt.lashes import lashes
from core_pipeline.faces.sculpt.lids import LID
from core_pipeline.faces.sculpt.mouth import Lips
from core_pipeline.faces.sculpt.piece import Piece
from core_pipeline.faces.sculpt.sdf import Array, Blob, Solid, smoothstep
from core_pipeline.faces.sculpt.skin import Skin
from core_pipeline.faces.sculpt.sky import sky
from core_pipeline.faces.sculpt.teeth import teeth
from core_pipeline.faces.sculpt.tongue import tongue
from core_pipeline.faces.sculpt.trimmings import body, brows, ears

#: What a cut-away shows, though nothing else may; the skin gives its head a shape inside.
INNARDS = ("skin", "mouth", "lips", "teeth", "gums", "tongue", "eye", "glint")
UNSHADED = ("mouth", "lips", "teeth", "gums", "tongue", "eye", "glint", "lid", "lash")
#: What shows no inner side to the front: bodies, tubes whose open ends lie within others, and lashes of two sides.
CLOSED: tuple[str, ...] = (*INNARDS, "lid", "lash", "brow", "hair", "ear", "neck", "collar", "shirt")
CLOSED += ("arm", "leg", "claw", "finger", "spike", "spot", "stalk")
#: How parts hide each other, from the front: what is drawn behind something drawn before costs no shading.
FRONT_FIRST: tuple[str, ...] = ("lash", "brow", "ear", "claw", "finger", "arm", "spike", "spot", "lid", "hair", "skin")
FRONT_FIRST += ("leg", "collar", "shirt", "neck", "lips", "glint", "eye", "stalk", "teeth", "gums", "tongue", "mouth")
LAST = "hair_back"
#: What moves less in every pose, in head radii, stands still for whoever looks.
STILL = 1e-3
FLESH = np.array([0.8, 1.1, 1.2])  # shade on skin is warm
Colours = NDArray[np.float32]
IDLE = ("blink", "browUp")


def sculpt(character: Character) -> Face:
    """The character as a face: its poses in their order, then blink and browUp. The same numbers every time."""
    return assemble(character, pieces(character))


def pieces(character: Character) -> list[Piece]:
    """Everything the face is made of."""
    if isinstance(character, Crab):
        return crab_pieces(character)
    ball = character.eyes.radius * LID
    clay = Solid((*character.clay, Blob(character.eyes.centre, (ball, ball, ball), 0.13, mirrored=True)))
    lips = Lips(character, clay)
    scalp = Solid(character.clay)
    return [
        Skin(character, clay, lips).piece(),
        *teeth(character, lips.centre),
        tongue(character, lips.centre),
        *eyes(character),
        *lashes(character),
        *brows(character, scalp),
        hair(character, scalp),
        *ears(character),
        *body(character, scalp),
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
    if character.sky:
        colours = _shaded(
            character, colours, sky(positions.astype(float), rest.astype(float), triangles), triangles, parts
        )
    normal_deltas = np.stack([normals.of(positions + delta) - rest for delta in deltas])
    kept = _worth_keeping(positions, triangles, deltas, parts)
    used, corners = np.unique(triangles[kept], return_inverse=True)
    return Face(
        name=character.name,
        title=character.title,
        positions=positions[used],
        normals=rest[used],
        triangles=corners.reshape(-1, 3).astype(np.uint32),
        colours=np.clip(colours[used], 0, 1),
        shapes=shapes,
        deltas=deltas[:, used],
        normal_deltas=normal_deltas[:, used],
        pose_map=character.pose_map,
        parts=_parts_of(kept, parts),
        closed=frozenset(name for name in parts if name.startswith(CLOSED)),
        camera=character.camera,
    )


def _worth_keeping(
    positions: Colours, triangles: NDArray[np.uint32], deltas: Colours, parts: Mapping[str, tuple[int, int]]
) -> NDArray[np.bool_]:
    """(m,) bool: what moves, what can be seen from outside at rest or in a wild mixture of poses, and the innards."""
    moves = np.abs(deltas).max(axis=(0, 2)) > STILL
    still: NDArray[np.bool_] = np.logical_not(moves[triangles].any(axis=1))
    for name, (first, count) in parts.items():
        if name.startswith(INNARDS):
            still[first : first + count] = False
    # the first pose is the open mouth
    stirred = positions + deltas[0] + deltas[-len(IDLE) :].sum(axis=0)
    return ~never_seen([positions.astype(float), stirred.astype(float)], triangles, still)


def _parts_of(kept: NDArray[np.bool_], parts: Mapping[str, tuple[int, int]]) -> dict[str, tuple[int, int]]:
    """Where the parts are once only the `kept` triangles are left."""
    before = np.append(0, np.cumsum(kept))
    ends = {name: (before[first], before[first + count]) for name, (first, count) in parts.items()}
    return {name: (int(first), int(end - first)) for name, (first, end) in ends.items()}


def _shaded(
    character: Character,
    colours: Colours,
    free: Array,
    triangles: NDArray[np.uint32],
    parts: Mapping[str, tuple[int, int]],
) -> Colours:
    """Colours under the hair's and the brows' shade; what moves into the light (mouth, eyes, lids) keeps its own."""
    outside = np.ones(len(colours), bool)
    for name, (first, count) in parts.items():
        if name.startswith(UNSHADED):
            outside[triangles[first : first + count]] = False
    dark = (1 - character.sky * (1 - smoothstep(0.0, 0.85, free)))[:, None] ** FLESH
    shaded = colours.copy()
    shaded[outside, :3] *= dark[outside].astype(np.float32)
    return shaded


def _delta(made: list[Piece], shape: str) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    return np.concatenate([piece.poses.get(shape, piece.positions) - piece.positions for piece in made])


def _triangles_and_parts(made: list[Piece]) -> tuple[NDArray[np.uint32], Mapping[str, tuple[int, int]]]:
    triangles = {}
    vertices = 0
    for piece in made:
        ranges = piece.ranges or {piece.name: (0, len(piece.triangles))}
        for name, (first, count) in ranges.items():
            triangles[name] = piece.triangles[first : first + count] + vertices
        vertices += len(piece.positions)
    names = sorted(triangles, key=_place)
    starts = np.cumsum([0] + [len(triangles[name]) for name in names])
    parts = {name: (int(start), len(triangles[name])) for name, start in zip(names, starts, strict=False)}
    return np.concatenate([triangles[name] for name in names]).astype(np.uint32), parts


def _place(name: str) -> int:
    """Of a part, in the order of drawing."""
    return len(FRONT_FIRST) if name == LAST else [name.startswith(part) for part in FRONT_FIRST].index(True)
