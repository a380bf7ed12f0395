"""Crab: a chatty crab from the rock pool, with a pose set of its own (section 5.3, figure 13)."""

from __future__ import annotations

from core_pipeline.faces.face import Camera
from core_pipeline.faces.sculpt.character import Dentition, Eyes, Mouth, MouthPose, Palette, TongueBend
from core_pipeline.faces.sculpt.crab_body import Claw, Crab, Spot, Stalks
from core_pipeline.faces.sculpt.horn import Horn
from core_pipeline.faces.sculpt.sdf import Blob

CLAY = (
    Blob((0, -0.16, 0.06), (0.86, 0.56, 0.70), 0.1),  # body
    Blob((0, -0.38, 0.34), (0.54, 0.30, 0.44), 0.25),  # jaw
    Blob((0, 0.18, -0.02), (1.10, 0.34, 0.84), 0.10),  # carapace
    Blob((0, 0.34, -0.04), (0.78, 0.34, 0.62), 0.20),  # its dome
)

REST = TongueBend(((-0.30, -0.68), (-0.04, -0.58), (-0.08, -0.36), (-0.09, -0.22)))

POSES = {
    "mouth open": MouthPose(
        jaw=25, drop_lower=0.05, raise_upper=0.03, width=-0.10, corners=-0.03, flat=1.0,
        tongue=TongueBend(((-0.30, -0.68), (-0.04, -0.56), (-0.06, -0.36), (-0.07, -0.24))),
    ),
    "mouth OO": MouthPose(
        rounded=1.0, hole=(0.11, 0.115), ring=0.10, forward=0.14,
        upper_teeth=(0.13, -0.15), lower_teeth=(-0.15, -0.14),
        tongue=TongueBend(((-0.36, -0.72), (-0.20, -0.68), (-0.24, -0.54), (-0.24, -0.44))),
    ),
    "bare teeth": MouthPose(
        width=0.10, raise_upper=0.105, drop_lower=0.084, roll_upper=8, roll_lower=8, thick=-0.12, corners=0.015,
        flat=1.0, upper_teeth=(-0.012, 0.025), lower_teeth=(0.055, 0.015),
    ),
    "smile": MouthPose(
        width=0.16, corners=0.105, raise_upper=-0.035, drop_lower=0.035, thick=-0.10, cheeks=0.06, forward=-0.01
    ),
    "frown": MouthPose(
        width=-0.06, corners=-0.17, raise_upper=0.03, drop_lower=-0.03, thick=0.10, thick_lower=0.1, forward=0.03,
    ),
    "lips shut": MouthPose(
        width=0.02, roll_upper=-18, roll_lower=-26, thick=-0.36, forward=-0.012, slide=0.09, lower_teeth=(0.0, -0.03),
        raise_upper=-0.002, drop_lower=-0.002,
    ),
    "tongue up": MouthPose(
        jaw=9, drop_lower=0.02, raise_upper=0.02, flat=1.0,
        tongue=TongueBend(((-0.30, -0.66), (-0.02, -0.60), (-0.06, -0.32), (0.17, -0.19)), 0.8),
    ),
    "tongue out": MouthPose(
        jaw=11, drop_lower=0.03, flat=1.0,
        tongue=TongueBend(((-0.26, -0.66), (0.10, -0.46), (0.10, -0.10), (-0.02, 0.12)), 1.0),
    ),
    "tongue back": MouthPose(
        jaw=9, drop_lower=0.02, raise_upper=0.02, flat=1.0,
        tongue=TongueBend(((-0.30, -0.72), (0.26, -0.72), (0.06, -0.44), (-0.10, -0.36))),
    ),
}  # fmt: skip

CLAW = Claw(
    arm=Horn(
        ((0.80, -0.20, 0.10), (1.14, -0.42, 0.30), (1.22, -0.20, 0.56), (1.12, 0.0, 0.58)),
        ((0.0, 0.15), (0.35, 0.12), (0.7, 0.13), (0.9, 0.09), (1.0, 0.06)),
        reference=(0.0, 0.0, 1.0),
        rows=11,
    ),
    palm=Horn(
        ((1.11, -0.04, 0.58), (1.16, 0.14, 0.60), (1.46, 0.30, 0.62), (1.30, 0.62, 0.64), (1.08, 0.66, 0.64)),
        ((0.0, 0.05), (0.08, 0.12), (0.32, 0.205), (0.6, 0.13), (0.85, 0.07), (1.0, 0.012)),
        flat=0.8,
        rows=16,
        sides=14,
    ),
    finger=Horn(
        ((1.12, 0.24, 0.60), (0.88, 0.30, 0.62), (0.86, 0.56, 0.64), (1.10, 0.62, 0.65)),
        ((0.0, 0.06), (0.15, 0.10), (0.5, 0.085), (0.85, 0.045), (1.0, 0.01)),
        flat=0.85,
        rows=13,
        sides=12,
    ),
)


def _leg(forward: float, out: float, low: float) -> Horn:
    return Horn(
        (
            (0.64, -0.36, forward),
            (0.64 + 0.58 * out, -0.10, 1.4 * forward - 0.02),
            (0.46 + 1.25 * out, -0.42, 1.6 * forward),
            (0.46 + 0.98 * out, low - 0.04, 1.8 * forward),
            (0.46 + 0.86 * out, low, 1.9 * forward),
        ),
        ((0.0, 0.09), (0.3, 0.095), (0.52, 0.10), (0.75, 0.055), (1.0, 0.012)),
        rows=13,
        sides=8,
    )


def _spike(x: float, y: float, z: float) -> Horn:
    return Horn(
        ((0.94 * x, y, 0.94 * z), (1.085 * x, y + 0.05, 1.085 * z)),
        ((0.0, 0.07), (0.5, 0.05), (1.0, 0.008)),
        reference=(0.0, 1.0, 0.0),
        rows=5,
        sides=10,
    )


CRAB = Crab(
    name="crab",
    title="Crab",
    clay=CLAY,
    poses=POSES,
    rest_tongue=REST,
    mouth=Mouth(
        height=-0.275, half_width=0.46, smile=0.07, upper=0.05, lower=0.062, upper_depth=0.036, lower_depth=0.042,
        lap=0.055, bow=0.0, hinge=(0.0, 0.0, -0.05), bag=(0.58, 0.32, 0.62), inset=1.0,
    ),
    teeth=Dentition(
        half_width=0.46, depth=0.46, behind_lips=0.085, upper_height=0.185, lower_height=0.16, edge=-0.02,
        bite=0.042, per_side=4
    ),
    eyes=Eyes(
        centre=(0.34, 0.98, 0.30), radius=0.27, yaw=8, gaze=(3, -2), iris=36, pupil=20, iris_colour=(0.20, 0.56, 0.42)
    ),
    stalks=Stalks(
        foot=(0.30, 0.50, 0.22), narrow={"smile": (-3.0, 14.0), "frown": (-16.0, 3.0), "bare teeth": (-2.0, 6.0)}
    ),
    claw=CLAW,
    left_claw=0.86,
    legs=(_leg(0.12, 0.68, -1.08), _leg(-0.06, 0.84, -1.04), _leg(-0.26, 0.98, -0.98)),
    spikes=(_spike(0.66, 0.14, 0.66), _spike(0.90, 0.15, 0.44), _spike(1.04, 0.16, 0.20), _spike(1.08, 0.17, -0.08)),
    spots=(
        Spot((0.16, 0.50, 0.50), 0.055), Spot((0.62, 0.50, 0.40), 0.075), Spot((0.50, 0.50, 0.62), 0.04),
        Spot((0.78, 0.34, 0.45), 0.035), Spot((0.36, 0.60, -0.3), 0.09), Spot((0.75, 0.45, -0.1), 0.06),
    ),
    middle=(0.0, -0.04, 0.0),
    brim=0.03,
    sky=0.5,
    palette=Palette(
        skin=(0.87, 0.25, 0.12), blush=(0.95, 0.42, 0.34), lid=(0.80, 0.22, 0.11), lip=(0.90, 0.40, 0.29),
        inner_lip=(0.45, 0.12, 0.12), gums=(0.74, 0.30, 0.32), tongue=(0.90, 0.42, 0.46),
    ),
    camera=Camera(target=(0.0, 0.10, 0.1), distance=7.9, pitch=4.0),
)  # fmt: skip
