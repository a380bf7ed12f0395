"""Ada, made with most care: finer mesh, painted skin, single lashes and brow hairs, hair in layers up to a knot."""

from __future__ import annotations

from math import cos, pi, sin

from core_pipeline.faces.face import Camera
from core_pipeline.faces.sculpt.adult import POSES, REST
from core_pipeline.faces.sculpt.character import (
    Body,
    Brows,
    Character,
    Dentition,
    Ears,
    Eyes,
    Hair,
    Mouth,
    Palette,
    Sheet,
)
from core_pipeline.faces.sculpt.sdf import Blob, Point

CLAY = (
    Blob((0, 0.40, -0.12), (0.73, 0.74, 0.88), 0.1),  # cranium
    Blob((0, -0.24, 0.16), (0.50, 0.51, 0.59), 0.28),  # jaw
    Blob((0.35, -0.06, 0.44), (0.24, 0.18, 0.26), 0.20, mirrored=True),  # cheekbones
    Blob((0.27, -0.32, 0.42), (0.22, 0.22, 0.24), 0.20, mirrored=True),  # cheeks
    Blob((0.19, -0.50, 0.29), (0.20, 0.17, 0.26), 0.26, mirrored=True),  # corners of the jaw
    Blob((0, -0.42, 0.55), (0.27, 0.24, 0.27), 0.20),  # the round under nose and lips
    Blob((0.12, -0.63, 0.44), (0.15, 0.13, 0.19), 0.26, mirrored=True),  # from them to the chin
    Blob((0, -0.705, 0.585), (0.15, 0.13, 0.17), 0.26),  # chin
    Blob((0.26, 0.36, 0.58), (0.23, 0.06, 0.11), 0.14, mirrored=True),  # brow
    Blob((0.31, 0.16, 0.88), (0.17, 0.12, 0.17), 0.12, mirrored=True, carve=True),  # eye sockets
    Blob((0, 0.06, 0.755), (0.052, 0.29, 0.10), 0.17),  # bridge of the nose
    Blob((0, -0.135, 0.895), (0.064, 0.058, 0.080), 0.10),  # tip of the nose
    Blob((0.078, -0.165, 0.82), (0.048, 0.044, 0.066), 0.06, mirrored=True),  # its wings
    Blob((0.040, -0.216, 0.862), (0.024, 0.030, 0.036), 0.025, mirrored=True, carve=True),  # nostrils
    Blob((0, -0.28, 0.86), (0.018, 0.06, 0.05), 0.05, carve=True),  # the groove above the lip
)

KNOT: Point = (0.0, 0.93, -0.80)


def _swept(*roots: Point) -> tuple[tuple[Point, ...], ...]:
    """Strands from the hairline back to the knot, close to the head: right, over the top, and left."""
    right = tuple(_strand(root) for root in roots)
    left = tuple(tuple((-x, y, z) for x, y, z in strand) for strand in right[-2::-1])
    return right + left


def _strand(root: Point) -> tuple[Point, ...]:
    x, y, z = root
    _, ky, kz = KNOT
    points = []
    for t in (0.0, 0.25, 0.5, 0.75, 1.0):
        bulge = 1 + 0.16 * sin(pi * t)
        points.append((bulge * x * (1 - t**1.5), y + (ky - 0.10 - y) * t, z + (kz + 0.16 - z) * t))
    return tuple(points)


def _knot(radius: float, twist: float) -> tuple[tuple[Point, ...], ...]:
    """Strands wound from the back of the knot to its root."""
    x, y, z = KNOT
    strands = []
    for turn in range(9):
        strand = []
        for t in (0.004, 0.2, 0.4, 0.6, 0.8, 0.98):
            around, down = -2 * pi * turn / 8 + twist * t, pi * t
            wide, deep = radius * sin(down) * (1 + 0.04 * sin(3 * around)), 0.82 * radius * cos(down)
            # its axis points back and up
            strand.append(
                (
                    x + wide * cos(around),
                    y + 0.8 * wide * sin(around) + 0.6 * deep,
                    z - 0.8 * deep + 0.6 * wide * sin(around),
                )
            )
        strands.append(tuple(strand))
    return tuple(strands)


HAIR = Hair(
    hairline=(
        (0, 69), (25, 70), (45, 73), (60, 84), (72, 93), (82, 94), (92, 92), (104, 96), (118, 106), (140, 114), (180,
        116),
    ),
    front=0.03, top=0.05, back=0.05, quiff=0.0, resolution=(56, 9), gloss=0.36,
    sheets=(
        Sheet(  # all of it, combed back
            guides=_swept(
                (0.0, -0.32, -0.72), (0.30, -0.30, -0.70), (0.56, -0.18, -0.50), (0.72, 0.10, -0.26),
                (0.72, 0.32, 0.06), (0.66, 0.46, 0.34), (0.52, 0.74, 0.46), (0.28, 0.88, 0.56), (0.0, 0.91, 0.58),
            ),
            thickness=0.07, height=0.03, clumps=36, ragged=0.0, columns=145, rows=12, edge=0.0,
            relief=0.42, streaks=0.16, mirrored=False,
        ),
        Sheet(  # a wave over the brow to the left
            guides=(
                ((0.18, 1.06, 0.28), (-0.02, 1.14, 0.34), (-0.38, 1.04, 0.28), (-0.70, 0.76, 0.10),
                 (-0.76, 0.58, -0.18), (-0.60, 0.62, -0.50)),
                ((0.20, 0.98, 0.42), (0.00, 1.08, 0.50), (-0.38, 0.96, 0.46), (-0.68, 0.64, 0.26),
                 (-0.78, 0.42, -0.06), (-0.66, 0.46, -0.40)),
                ((0.20, 0.90, 0.54), (0.02, 0.98, 0.64), (-0.34, 0.86, 0.60), (-0.62, 0.52, 0.40),
                 (-0.74, 0.28, 0.06), (-0.70, 0.30, -0.30)),
            ),
            thickness=0.075, height=0.06, clumps=8, ragged=0.05, columns=33, rows=15, relief=0.45,
            streaks=0.14, mirrored=False,
        ),
        Sheet(  # and a smaller one to the right
            guides=(
                ((0.52, 0.62, -0.40), (0.68, 0.70, -0.20), (0.62, 0.88, 0.10), (0.44, 1.02, 0.26), (0.20, 1.08, 0.30)),
                ((0.66, 0.36, -0.30), (0.76, 0.50, -0.02), (0.66, 0.72, 0.26), (0.46, 0.92, 0.40), (0.20, 1.00, 0.42)),
                ((0.72, 0.24, -0.16), (0.76, 0.36, 0.10), (0.64, 0.58, 0.40), (0.46, 0.80, 0.52), (0.22, 0.91, 0.54)),
            ),
            thickness=0.07, height=0.07, clumps=6, ragged=0.0, columns=25, rows=14, relief=0.45,
            streaks=0.14, mirrored=False,
        ),
        Sheet(  # a fringe that falls from the parting over the left temple
            guides=(
                ((0.16, 0.98, 0.44), (-0.10, 0.95, 0.64), (-0.38, 0.76, 0.66), (-0.60, 0.46, 0.52),
                 (-0.69, 0.16, 0.40)),
                ((0.18, 0.93, 0.50), (-0.06, 0.88, 0.71), (-0.33, 0.66, 0.72), (-0.56, 0.36, 0.57),
                 (-0.68, 0.06, 0.44)),
                ((0.19, 0.88, 0.55), (-0.01, 0.80, 0.76), (-0.27, 0.56, 0.77), (-0.50, 0.26, 0.62),
                 (-0.66, -0.02, 0.47)),
            ),
            thickness=0.05, height=0.045, clumps=3, ragged=0.18, columns=19, rows=16, mirrored=False,
        ),
        Sheet(  # the knot
            guides=_knot(0.36, 2.6), thickness=0.09, height=-1.0, clumps=12, ragged=0.0, columns=49, rows=14,
            edge=0.0, relief=0.45, streaks=0.14, mirrored=False,
        ),
        Sheet(  # loose strands before the ears, from under the hair
            guides=(
                ((0.60, 0.66, 0.27), (0.65, 0.40, 0.38), (0.695, 0.12, 0.42), (0.64, -0.20, 0.45), (0.63, -0.56, 0.40)),
                ((0.62, 0.66, 0.21), (0.68, 0.40, 0.33), (0.735, 0.12, 0.38), (0.69, -0.20, 0.42), (0.65, -0.60, 0.40)),
                ((0.64, 0.66, 0.15), (0.69, 0.40, 0.26), (0.735, 0.12, 0.32), (0.67, -0.20, 0.37), (0.63, -0.58, 0.38)),
            ),
            thickness=0.05, height=-1.0, clumps=2, ragged=0.06, columns=11, rows=18, wave=0.03, waves=1.7,
        ),
    ),
)  # fmt: skip

ADA = Character(
    name="ada",
    title="Ada",
    clay=CLAY,
    poses=POSES,
    hair=HAIR,
    rest_tongue=REST,
    mouth=Mouth(
        height=-0.44, half_width=0.25, smile=0.044, upper=0.048, lower=0.066, upper_depth=0.026, lower_depth=0.034,
        lap=0.03, bow=1.5, rim=0.015, taper=1.2, hinge=(0.0, -0.12, -0.08), bag=(0.32, 0.20, 0.55),
    ),
    teeth=Dentition(half_width=0.245, depth=0.36, behind_lips=0.08, edge=-0.022, upper_height=0.115, lower_height=0.10),
    eyes=Eyes(
        centre=(0.295, 0.165, 0.53), radius=0.225, half_width=0.87, upper=0.42, lower=0.31, slant=0.06, yaw=10,
        skew=(-0.06, 0.12), spread=1.2, ease=1.0, shut=0.16, iris=29, pupil=12, iris_colour=(0.36, 0.24, 0.12),
        crease=1.0, lashes=36, lash_length=0.18, streaks=0.12,
    ),
    brows=Brows(
        line=((0.10, 0.282, 0.022), (0.19, 0.308, 0.030), (0.30, 0.330, 0.027), (0.40, 0.316, 0.019), (0.49, 0.258,
        0.007)),
        lift=0.06, hairs=150,
    ),
    ears=Ears(centre=(0.715, 0.02, -0.06), size=(0.115, 0.185), stand_off=22),
    body=Body(neck=0.27, middle=-0.22, collar=-1.28),
    palette=Palette(
        skin=(0.82, 0.60, 0.47), blush=(0.82, 0.40, 0.32), lip=(0.68, 0.33, 0.31), lid=(0.66, 0.43, 0.34),
        inner_lip=(0.50, 0.20, 0.19), hair=(0.10, 0.055, 0.035), hair_light=(0.37, 0.21, 0.12), brow=(0.19, 0.12,
        0.075),
        lash=(0.03, 0.02, 0.02), shirt=(0.50, 0.13, 0.17), shirt_trim=(0.50, 0.13, 0.17), variation=1.0,
    ),
    camera=Camera(target=(0.0, 0.02, 0.0), distance=6.9, yaw=0.0, pitch=0.0, fov=24.0),
    middle=(0.0, -0.34, 0.0),
    nose=(0.0, -0.14, 0.90),
    nostrils=(0.048, -0.196, 0.868),
    lip_columns=96,
    density=1.85,
    sky=0.85,
)  # fmt: skip
