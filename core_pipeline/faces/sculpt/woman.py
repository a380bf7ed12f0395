"""Woman: fair, green-eyed, with auburn hair to her shoulders."""

from __future__ import annotations

from core_pipeline.faces.face import Camera
from core_pipeline.faces.sculpt.adult import POSES, REST
from core_pipeline.faces.sculpt.character import (
    Body,
    Brows,
    Character,
    Dentition,
    Eyes,
    Hair,
    Mouth,
    Palette,
    Sheet,
)
from core_pipeline.faces.sculpt.sdf import Blob, Point

CLAY = (
    Blob((0, 0.40, -0.12), (0.74, 0.74, 0.88), 0.1),  # cranium
    Blob((0, -0.24, 0.16), (0.54, 0.53, 0.60), 0.28),  # jaw
    Blob((0.34, -0.07, 0.44), (0.24, 0.19, 0.26), 0.20, mirrored=True),  # cheekbones
    Blob((0.29, -0.30, 0.43), (0.24, 0.23, 0.25), 0.20, mirrored=True),  # cheeks
    Blob((0.21, -0.50, 0.30), (0.20, 0.18, 0.26), 0.26, mirrored=True),  # corners of the jaw
    Blob((0, -0.42, 0.55), (0.27, 0.24, 0.26), 0.20),  # the round under nose and lips
    Blob((0.12, -0.63, 0.44), (0.15, 0.13, 0.19), 0.24, mirrored=True),  # from them to the chin
    Blob((0, -0.69, 0.585), (0.16, 0.13, 0.17), 0.24),  # chin
    Blob((0.26, 0.37, 0.58), (0.22, 0.06, 0.10), 0.14, mirrored=True),  # brow
    Blob((0.32, 0.16, 0.885), (0.15, 0.115, 0.155), 0.13, mirrored=True, carve=True),  # eye sockets
    Blob((0, 0.08, 0.73), (0.056, 0.27, 0.10), 0.17),  # bridge of the nose
    Blob((0, -0.105, 0.885), (0.066, 0.058, 0.075), 0.09),  # tip of the nose
    Blob((0.068, -0.145, 0.81), (0.044, 0.042, 0.062), 0.07, mirrored=True),  # its wings
    Blob((0, -0.28, 0.86), (0.018, 0.06, 0.05), 0.05, carve=True),  # the groove above the lip
)


def _around(*right: tuple[Point, ...]) -> tuple[tuple[Point, ...], ...]:
    """Strands from the right of the face round the back, the last of those given, to its left."""
    return right + tuple(tuple((-x, y, z) for x, y, z in strand) for strand in right[-2::-1])


HAIR = Hair(
    hairline=((0, 72), (30, 73), (55, 82), (75, 104), (100, 118), (140, 130), (180, 134)),
    front=0.035, top=0.035, back=0.04, quiff=0.0, resolution=(32, 7),
    sheets=(
        Sheet(  # from the parting down, all round the head
            guides=_around(
                ((-0.02, 0.90, 0.56), (0.34, 0.84, 0.57), (0.64, 0.42, 0.46), (0.62, -0.10, 0.42),
                 (0.70, -0.62, 0.36), (0.50, -1.10, 0.44)),
                ((-0.02, 1.12, 0.24), (0.42, 1.04, 0.26), (0.80, 0.50, 0.16), (0.78, -0.15, 0.10),
                 (0.86, -0.72, 0.12), (0.68, -1.25, 0.22)),
                ((-0.02, 1.20, -0.20), (0.44, 1.08, -0.22), (0.84, 0.50, -0.32), (0.84, -0.20, -0.36),
                 (0.86, -0.80, -0.32), (0.70, -1.32, -0.18)),
                ((-0.03, 1.06, -0.62), (0.32, 0.98, -0.74), (0.58, 0.45, -0.94), (0.60, -0.25, -0.90),
                 (0.60, -0.85, -0.78), (0.48, -1.36, -0.56)),
                ((0.00, 0.96, -0.80), (0.00, 0.76, -1.00), (0.00, 0.30, -1.14), (0.00, -0.25, -1.10),
                 (0.00, -0.85, -0.98), (0.00, -1.38, -0.76)),
            ),
            thickness=0.10, clumps=19, columns=58, rows=13, edge=0.05, relief=0.42, streaks=0.16,
            wave=0.045, mirrored=False,
        ),
        Sheet(  # curtains of a fringe, from the parting to the temples
            guides=(
                ((0.00, 0.89, 0.57), (0.20, 0.80, 0.71), (0.42, 0.52, 0.70), (0.59, 0.14, 0.59), (0.65, -0.24, 0.50)),
                ((0.01, 0.95, 0.52), (0.25, 0.87, 0.64), (0.50, 0.60, 0.62), (0.645, 0.22, 0.51), (0.69, -0.16, 0.44)),
                ((0.02, 1.01, 0.45), (0.30, 0.94, 0.53), (0.59, 0.68, 0.49), (0.70, 0.30, 0.41), (0.73, -0.06, 0.37)),
            ),
            thickness=0.06, height=0.04, clumps=3, ragged=0.17, columns=10, rows=10,
        ),
    ),
)  # fmt: skip

WOMAN = Character(
    name="woman",
    title="Woman",
    clay=CLAY,
    poses=POSES,
    hair=HAIR,
    rest_tongue=REST,
    mouth=Mouth(
        height=-0.44, half_width=0.255, smile=0.052, upper=0.048, lower=0.067, upper_depth=0.025, lower_depth=0.032,
        lap=0.03, bow=1.5, rim=0.015, taper=1.25, hinge=(0.0, -0.12, -0.08), bag=(0.32, 0.20, 0.55),
    ),
    teeth=Dentition(half_width=0.245, depth=0.36, behind_lips=0.08, edge=-0.022, upper_height=0.115, lower_height=0.10),
    eyes=Eyes(
        centre=(0.30, 0.165, 0.50), radius=0.235, half_width=0.86, upper=0.43, lower=0.31, slant=0.03, yaw=10,
        skew=(-0.06, 0.12), iris=31, pupil=13, spread=1.0, ease=1.0, shut=0.16, iris_colour=(0.30, 0.46, 0.24),
        crease=0.8, lashes=22, lash_length=0.19,
    ),
    brows=Brows(
        line=((0.12, 0.272, 0.018), (0.20, 0.300, 0.025), (0.31, 0.322, 0.023),
              (0.42, 0.300, 0.016), (0.51, 0.240, 0.006)),
        lift=0.06,
    ),
    ears=None,
    body=Body(neck=0.27, middle=-0.20, collar=-1.26),
    palette=Palette(
        skin=(0.95, 0.76, 0.66), lip=(0.82, 0.44, 0.42), lid=(0.86, 0.60, 0.52), hair=(0.25, 0.085, 0.04),
        hair_light=(0.52, 0.20, 0.085), brow=(0.38, 0.19, 0.11), lash=(0.10, 0.05, 0.04), shirt=(0.30, 0.34, 0.55),
        shirt_trim=(0.30, 0.34, 0.55),
    ),
    camera=Camera(target=(0.0, -0.05, 0.0), distance=6.9, yaw=0.0, pitch=0.0, fov=24.0),
    middle=(0.0, -0.34, 0.0),
    nose=(0.0, -0.12, 0.89),
    nostrils=(0.042, -0.188, 0.865),
    lip_columns=64,
    density=1.06,
    sky=0.75,
)  # fmt: skip
