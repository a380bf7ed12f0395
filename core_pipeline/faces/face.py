"""A face: a neutral mesh and what each blendshape adds to it (section 3.1.2, figure 4)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from .texture import Material, Texture

Floats = NDArray[np.float32]


@dataclass(frozen=True)
class Camera:
    """Where to look from at rest: turns about `target` at `distance`; degrees, and the mesh's own unit."""

    target: tuple[float, float, float] = (0.0, 0.0, 0.0)
    distance: float = 5.0
    yaw: float = 0.0
    pitch: float = 0.0
    fov: float = 24.0


@dataclass(frozen=True, eq=False)
class Face:
    """A triangle mesh with blendshapes; +y up, +z to the front. Read-only.

    positions      (n, 3) neutral
    normals        (n, 3) of unit length
    triangles      (m, 3) uint32
    colours        (n, 4) linear RGB and, in the fourth place, how glossy the surface is (0…1)
    shapes         names of the k blendshapes
    deltas         (k, n, 3) added to the positions at weight 1
    normal_deltas  (k, n, 3) added to the normals at weight 1
    pose_map       pose → {shape: amount}; empty for a face whose shapes are the poses
    expressions    what the rig's author made of its shapes (VRM), expression → {shape: amount}
    parts          name → (first triangle, number of triangles), so that checks can tell teeth from skin
    closed         the parts that show no inner side to someone in front
    textures       the pictures that lie on it, for the parts in `materials`
    materials      name of a part → what lies on it; the others show their vertices' colours
    texcoords      (n, 2) where a vertex lies in its picture, +v down; None for a face without pictures
    Raises ValueError when a name is no part's, or a material has no picture.
    """

    name: str
    title: str
    positions: Floats
    normals: Floats
    triangles: NDArray[np.uint32]
    colours: Floats
    shapes: tuple[str, ...]
    deltas: Floats
    normal_deltas: Floats
    pose_map: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    expressions: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    parts: Mapping[str, tuple[int, int]] = field(default_factory=dict)
    closed: frozenset[str] = frozenset()
    camera: Camera = Camera()
    textures: tuple[Texture, ...] = ()
    materials: Mapping[str, Material] = field(default_factory=dict)
    texcoords: Floats | None = None

    def __post_init__(self) -> None:
        strange = (self.closed | set(self.materials)) - set(self.parts)
        if strange:
            raise ValueError(f"no parts of this face: {sorted(strange)}")
        if self.materials and self.texcoords is None:
            raise ValueError("a face with pictures needs texcoords")
        if not all(0 <= material.texture < len(self.textures) for material in self.materials.values()):
            raise ValueError(f"a material's picture is none of the {len(self.textures)}")

    def mix(self, pose: str) -> Mapping[str, float]:
        """The shapes that make up a pose, shape → amount; empty when this face cannot make it."""
        if pose in self.pose_map:
            return self.pose_map[pose]
        return {pose: 1.0} if pose in self.shapes else {}

    def retarget(self, poses: tuple[str, ...]) -> Floats:
        """(poses, shapes) matrix: weights (f, poses) @ matrix gives shape amounts (f, shapes)."""
        matrix = np.zeros((len(poses), len(self.shapes)), np.float32)
        for row, pose in enumerate(poses):
            for shape, amount in self.mix(pose).items():
                if shape in self.shapes:
                    matrix[row, self.shapes.index(shape)] = amount
        return matrix

    def deform(self, amounts: Floats) -> Floats:
        """Positions (n, 3) at shape amounts (k,)."""
        moved: Floats = self.positions + np.tensordot(amounts.astype(np.float32), self.deltas, 1)
        return moved
