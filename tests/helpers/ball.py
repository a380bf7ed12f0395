"""A small face to draw in tests: a ball with two shapes, `tall` and `wide`."""

import numpy as np

from core_pipeline.faces.face import Camera, Face


def ball(rings: int = 24, *, name: str = "ball", colour=(0.68, 0.36, 0.24, 0.3)) -> Face:
    """A unit ball of 4·rings² triangles, with a doubled seam at the back as exporters leave it."""
    down, around = np.meshgrid(
        np.linspace(0, np.pi, rings + 1), np.linspace(0, 2 * np.pi, 2 * rings + 1), indexing="ij"
    )
    points = np.stack([-np.sin(down) * np.sin(around), np.cos(down), -np.sin(down) * np.cos(around)], -1)
    points[:, -1] = points[:, 0]
    points[(0, -1), :] = ((((0.0, 1.0, 0.0),)), (((0.0, -1.0, 0.0),)))
    positions = points.reshape(-1, 3).astype(np.float32)
    corner = np.arange(positions.shape[0]).reshape(rings + 1, -1)
    a, b, c, d = (part.reshape(-1) for part in (corner[:-1, :-1], corner[:-1, 1:], corner[1:, :-1], corner[1:, 1:]))
    triangles = np.concatenate([np.stack([a, c, b], 1), np.stack([b, c, d], 1)]).astype(np.uint32)
    deltas = np.stack([positions * (0, 0.4, 0), positions * (0.4, 0, 0)]).astype(np.float32)
    scaled = np.stack([positions / (1, 1.4, 1), positions / (1.4, 1, 1)])
    normals = scaled / np.linalg.norm(scaled, axis=2, keepdims=True)
    return Face(
        name=name,
        title=name.title(),
        positions=positions,
        normals=positions.copy(),
        triangles=triangles,
        colours=np.tile(np.array(colour, np.float32), (len(positions), 1)),
        shapes=("tall", "wide"),
        deltas=deltas,
        normal_deltas=(normals - positions).astype(np.float32),
        camera=Camera(distance=6.0),
    )
