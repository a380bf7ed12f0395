"""Toon: a friendly cartoon boy, the face everyone sees first."""

from __future__ import annotations

from core_pipeline.faces.face import Camera
from core_pipeline.faces.sculpt.character import Character, Hair, Lock, MouthPose, TongueBend
from core_pipeline.faces.sculpt.sdf import Blob

CLAY = (
    Blob((0, 0.36, -0.08), (0.90, 0.84, 0.92), 0.1),  # cranium
    Blob((0, -0.34, 0.14), (0.66, 0.56, 0.66), 0.30),  # jaw
    Blob((0.36, -0.22, 0.42), (0.38, 0.33, 0.38), 0.22, mirrored=True),  # cheeks
    Blob((0, -0.42, 0.52), (0.40, 0.30, 0.36), 0.22),  # the round under nose and lips
    Blob((0, -0.80, 0.52), (0.22, 0.14, 0.19), 0.24),  # chin
    Blob((0, 0.10, 0.84), (0.085, 0.24, 0.11), 0.16),  # bridge of the nose
    Blob((0, -0.09, 0.965), (0.115, 0.098, 0.12), 0.09),  # tip of the nose
    Blob((0.085, -0.115, 0.93), (0.058, 0.05, 0.065), 0.05, mirrored=True),  # its wings
    Blob((0.32, 0.54, 0.62), (0.30, 0.09, 0.14), 0.18, mirrored=True),  # brow
)

REST = TongueBend(((-0.30, -0.68), (-0.02, -0.58), (-0.07, -0.36), (-0.085, -0.24)))

POSES = {
    "open": MouthPose(
        jaw=25, drop_lower=0.02, raise_upper=0.025, width=-0.10, corners=-0.03,
        tongue=TongueBend(((-0.30, -0.68), (-0.02, -0.56), (-0.05, -0.36), (-0.065, -0.25))),
    ),
    "W": MouthPose(
        jaw=3, rounded=1.0, hole=(0.058, 0.060), ring=0.085, forward=0.15,
        upper_teeth=(0.10, -0.07), lower_teeth=(-0.05, -0.07),
        tongue=TongueBend(((-0.34, -0.70), (-0.16, -0.66), (-0.20, -0.52), (-0.20, -0.42))),
    ),
    "ShCh": MouthPose(
        width=-0.30, forward=0.10, raise_upper=0.065, drop_lower=0.075, roll_upper=16, roll_lower=20, thick=0.10,
        corners=-0.03, corner_forward=0.04,
    ),
    "PBM": MouthPose(width=0.03, roll_upper=-24, roll_lower=-24, thick=-0.36, forward=-0.008, slide=0.03),
    "FV": MouthPose(
        jaw=3.5, width=0.03, raise_upper=0.06, tuck=(0.05, 0.13), roll_lower=-34, thick=-0.08, corners=-0.01,
        lower_teeth=(-0.04, -0.13),
    ),
    "wide": MouthPose(
        width=0.21, raise_upper=0.05, drop_lower=0.035, corners=0.045, forward=-0.02, thick=-0.10, cheeks=0.05,
    ),
    "tBack": MouthPose(tongue=TongueBend(((-0.30, -0.70), (0.20, -0.70), (0.02, -0.42), (-0.10, -0.36)))),
    "tRoof": MouthPose(tongue=TongueBend(((-0.30, -0.66), (-0.02, -0.60), (-0.02, -0.36), (0.13, -0.24)), 0.9)),
    "tTeeth": MouthPose(tongue=TongueBend(((-0.28, -0.66), (0.06, -0.50), (0.03, -0.24), (0.02, -0.045)), 0.9)),
}  # fmt: skip

HAIR = Hair(
    hairline=((0, 62), (25, 60), (48, 66), (62, 84), (72, 104), (80, 106), (90, 84), (104, 84), (116, 104), (140, 112), (180, 112)),
    locks=(
        Lock(((-30, 20, 0.10), (-12, 40, 0.30), (8, 52, 0.36), (24, 60, 0.26)), 0.13, 0.06),
        Lock(((-50, 24, 0.10), (-38, 44, 0.24), (-20, 58, 0.26), (-4, 68, 0.15)), 0.12, 0.055),
        Lock(((0, 18, 0.12), (14, 38, 0.28), (30, 50, 0.28), (46, 62, 0.17)), 0.12, 0.055),
    ),
)

TOON = Character(
    name="toon",
    title="Toon",
    clay=CLAY,
    poses=POSES,
    hair=HAIR,
    rest_tongue=REST,
    camera=Camera(target=(0.0, -0.02, 0.0), distance=7.2, yaw=0.0, pitch=0.0, fov=24.0),
)
