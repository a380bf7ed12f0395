"""Toon: a friendly cartoon boy, the face everyone sees first."""

from __future__ import annotations

from core_pipeline.faces.face import Camera
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
    MouthPose,
    Palette,
    TongueBend,
)
from core_pipeline.faces.sculpt.sdf import Blob

CLAY = (
    Blob((0, 0.36, -0.08), (0.90, 0.84, 0.92), 0.1),  # cranium
    Blob((0, -0.34, 0.14), (0.66, 0.56, 0.66), 0.30),  # jaw
    Blob((0.36, -0.22, 0.42), (0.38, 0.33, 0.38), 0.22, mirrored=True),  # cheeks
    Blob((0, -0.42, 0.52), (0.40, 0.30, 0.36), 0.22),  # the round under nose and lips
    Blob((0, -0.79, 0.57), (0.22, 0.14, 0.19), 0.24),  # chin
    Blob((0, 0.10, 0.84), (0.085, 0.24, 0.11), 0.16),  # bridge of the nose
    Blob((0, -0.09, 0.965), (0.115, 0.098, 0.12), 0.09),  # tip of the nose
    Blob((0.085, -0.115, 0.93), (0.058, 0.05, 0.065), 0.05, mirrored=True),  # its wings
    Blob((0.32, 0.54, 0.62), (0.30, 0.09, 0.14), 0.18, mirrored=True),  # brow
)

REST = TongueBend(((-0.30, -0.68), (-0.02, -0.58), (-0.07, -0.36), (-0.085, -0.24)))

POSES = {
    "open": MouthPose(
        jaw=25, drop_lower=0.045, raise_upper=0.025, width=-0.10, corners=-0.03, flat=1.0,
        tongue=TongueBend(((-0.30, -0.68), (-0.02, -0.56), (-0.05, -0.36), (-0.065, -0.25))),
    ),
    "W": MouthPose(
        rounded=1.0, hole=(0.058, 0.058), ring=0.082, forward=0.115,
        upper_teeth=(0.11, -0.07), lower_teeth=(-0.08, -0.07),
        tongue=TongueBend(((-0.34, -0.70), (-0.16, -0.66), (-0.20, -0.52), (-0.20, -0.42))),
    ),
    "ShCh": MouthPose(
        width=-0.30, forward=0.10, raise_upper=0.055, drop_lower=0.065, roll_upper=16, roll_lower=20, thick=0.10,
        corners=-0.03, corner_forward=0.04, upper_teeth=(0.0, 0.02),
        lower_teeth=(0.012, 0.02), flat=1.0,
    ),
    "PBM": MouthPose(
        width=0.03, roll_upper=-18, roll_lower=-26, thick=-0.36, forward=-0.008, slide=0.065, raise_upper=-0.002,
        drop_lower=-0.002, lower_teeth=(0.0, -0.03),
    ),
    "FV": MouthPose(
        jaw=3.5, width=0.03, raise_upper=0.06, flat=0.6, tuck=(0.045, 0.10), roll_lower=-34, thick=-0.08, corners=-0.01,
        lower_teeth=(-0.04, -0.13),
    ),
    "wide": MouthPose(
        width=0.21, raise_upper=0.05, drop_lower=0.035, corners=0.045, forward=-0.02, thick=-0.10, cheeks=0.05,
        flat=0.7,
    ),
    "tBack": MouthPose(flat=0.6, tongue=TongueBend(((-0.30, -0.70), (0.20, -0.70), (0.02, -0.42), (-0.10, -0.36)))),
    "tRoof": MouthPose(
        flat=0.6, tongue=TongueBend(((-0.30, -0.66), (-0.02, -0.60), (-0.06, -0.34), (0.15, -0.20)), 0.75)
    ),
    "tTeeth": MouthPose(
        flat=0.9, tongue=TongueBend(((-0.28, -0.66), (0.06, -0.50), (0.03, -0.24), (0.012, -0.012)), 0.9)
    ),
}  # fmt: skip

HAIR = Hair(
    hairline=(
        (0, 77),
        (25, 76),
        (48, 80),
        (62, 92),
        (72, 108),
        (80, 110),
        (90, 88),
        (104, 86),
        (116, 108),
        (140, 118),
        (180, 118),
    ),
    front=0.13,
    top=0.14,
    quiff=0.10,
    locks=(
        Lock(((-38, 40, 0.06), (-45, 56, 0.13), (-56, 74, 0.12), (-66, 92, 0.03)), 0.14, 0.07),
        Lock(((-34, 36, 0.08), (-30, 56, 0.17), (-14, 76, 0.16), (10, 88, 0.06)), 0.16, 0.075),
        Lock(((-30, 30, 0.10), (-16, 48, 0.20), (8, 68, 0.19), (34, 84, 0.06)), 0.17, 0.08),
        Lock(((-26, 26, 0.10), (6, 42, 0.19), (34, 60, 0.17), (58, 82, 0.06)), 0.17, 0.08),
        Lock(((-10, 22, 0.09), (28, 36, 0.16), (56, 54, 0.14), (74, 84, 0.04)), 0.15, 0.07),
    ),
)

TOON = Character(
    name="toon",
    title="Toon",
    clay=CLAY,
    poses=POSES,
    hair=HAIR,
    rest_tongue=REST,
    mouth=Mouth(smile=0.085, upper=0.052, lower=0.072, upper_depth=0.036, lower_depth=0.042, lap=0.055),
    teeth=Dentition(half_width=0.325, behind_lips=0.085, sink=0.085),
    eyes=Eyes(radius=0.285, upper=0.61, lower=0.56, iris=33, pupil=17),
    body=Body(middle=-0.20),
    ears=Ears(centre=(0.95, 0.02, -0.06)),
    brows=Brows(
        line=((0.12, 0.40, 0.030), (0.22, 0.44, 0.044), (0.34, 0.45, 0.042), (0.46, 0.415, 0.032), (0.55, 0.36, 0.010)),
    ),
    palette=Palette(lip=(0.84, 0.47, 0.42)),
    camera=Camera(target=(0.0, -0.02, 0.0), distance=7.2, yaw=0.0, pitch=0.0, fov=24.0),
)
