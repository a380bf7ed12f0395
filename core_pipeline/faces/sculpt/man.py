"""Man: brown skin, a broad jaw with a shadow of beard, short black hair."""

from __future__ import annotations

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
    Lock,
    Mouth,
    Palette,
)
from core_pipeline.faces.sculpt.sdf import Blob

CLAY = (
    Blob((0, 0.38, -0.12), (0.76, 0.74, 0.90), 0.1),  # cranium
    Blob((0, -0.30, 0.16), (0.58, 0.58, 0.62), 0.28),  # jaw
    Blob((0.35, -0.08, 0.44), (0.25, 0.19, 0.26), 0.18, mirrored=True),  # cheekbones
    Blob((0.30, -0.36, 0.38), (0.22, 0.22, 0.24), 0.20, mirrored=True),  # cheeks
    Blob((0.31, -0.58, 0.20), (0.22, 0.19, 0.30), 0.28, mirrored=True),  # corners of the jaw
    Blob((0, -0.46, 0.56), (0.30, 0.26, 0.27), 0.20),  # the round under nose and lips
    Blob((0.10, -0.79, 0.54), (0.18, 0.16, 0.20), 0.30, mirrored=True),  # chin
    Blob((0.24, 0.34, 0.63), (0.26, 0.065, 0.12), 0.13, mirrored=True),  # brow
    Blob((0.31, 0.16, 0.89), (0.17, 0.11, 0.16), 0.12, mirrored=True, carve=True),  # eye sockets
    Blob((0, 0.07, 0.785), (0.062, 0.30, 0.115), 0.17),  # bridge of the nose
    Blob((0, -0.15, 0.93), (0.080, 0.070, 0.085), 0.11),  # tip of the nose
    Blob((0.105, -0.185, 0.84), (0.062, 0.056, 0.075), 0.06, mirrored=True),  # its wings
    Blob((0, -0.31, 0.88), (0.022, 0.06, 0.05), 0.05, carve=True),  # the groove above the lip
)

HAIR = Hair(
    hairline=(
        (0, 83), (24, 81), (38, 78), (50, 82), (60, 94), (68, 110), (76, 114), (84, 94), (94, 86), (108, 90),
        (118, 110), (140, 118), (180, 120),
    ),
    crown=(0.0, 0.84, -0.40), front=0.09, top=0.11, back=0.04, quiff=0.07, clumps=17, twist=0.8, gloss=0.22,
    locks=(
        Lock(((-34, 44, 0.06), (-30, 58, 0.12), (-22, 70, 0.12), (-12, 79, 0.05)), 0.10, 0.05),
        Lock(((-14, 40, 0.07), (-10, 55, 0.13), (0, 69, 0.13), (12, 78, 0.05)), 0.11, 0.055),
        Lock(((8, 40, 0.07), (12, 54, 0.13), (22, 68, 0.12), (34, 76, 0.05)), 0.11, 0.055),
    ),
)  # fmt: skip

MAN = Character(
    name="man",
    title="Man",
    clay=CLAY,
    poses=POSES,
    hair=HAIR,
    rest_tongue=REST,
    mouth=Mouth(
        height=-0.48, half_width=0.27, smile=0.042, upper=0.038, lower=0.055, upper_depth=0.022, lower_depth=0.030,
        lap=0.03, bow=1.0, rim=0.013, taper=1.2, hinge=(0.0, -0.14, -0.08), bag=(0.33, 0.21, 0.56),
    ),
    teeth=Dentition(half_width=0.255, depth=0.37, behind_lips=0.08, edge=-0.022, upper_height=0.12, lower_height=0.105),
    eyes=Eyes(
        centre=(0.295, 0.16, 0.545), radius=0.20, half_width=0.88, upper=0.40, lower=0.28, slant=0.03, yaw=10,
        skew=(-0.04, 0.10), spread=1.2, ease=1.0, shut=0.16, iris=28, pupil=11.5, iris_colour=(0.40, 0.24, 0.11),
        lash=0.85, crease=0.55,
    ),
    brows=Brows(
        line=((0.10, 0.222, 0.018), (0.18, 0.243, 0.031), (0.30, 0.272, 0.033), (0.41, 0.262, 0.024), (0.50, 0.195,
        0.008)),
        lift=0.06,
    ),
    ears=Ears(centre=(0.745, 0.02, -0.06), size=(0.13, 0.20), stand_off=24),
    body=Body(neck=0.38, middle=-0.24, collar=-1.24),
    palette=Palette(
        skin=(0.66, 0.45, 0.33), blush=(0.66, 0.32, 0.24), lip=(0.55, 0.31, 0.26), lid=(0.52, 0.33, 0.25),
        inner_lip=(0.45, 0.18, 0.17), hair=(0.045, 0.035, 0.035), hair_light=(0.20, 0.15, 0.12), brow=(0.07, 0.05,
        0.045),
        lash=(0.05, 0.03, 0.03), shirt=(0.72, 0.68, 0.60), shirt_trim=(0.72, 0.68, 0.60), gums=(0.66, 0.32, 0.32),
        stubble=0.38, variation=0.6,
    ),
    camera=Camera(target=(0.0, -0.06, 0.0), distance=7.4, yaw=0.0, pitch=0.0, fov=24.0),
    middle=(0.0, -0.36, 0.0),
    nose=(0.0, -0.16, 0.94),
    nostrils=(0.062, -0.240, 0.895),
    lip_columns=64,
    density=1.3,
    sky=0.75,
)  # fmt: skip
