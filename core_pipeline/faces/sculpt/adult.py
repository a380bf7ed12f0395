"""What our adult characters share: how their mouths make the poses, before each of them makes it in their own way."""

from __future__ import annotations

from core_pipeline.faces.sculpt.character import MouthPose, TongueBend

REST = TongueBend(((-0.25, -0.60), (-0.02, -0.50), (-0.06, -0.31), (-0.072, -0.215)))

POSES = {
    "open": MouthPose(
        jaw=21, drop_lower=0.035, raise_upper=0.018, width=-0.10, corners=-0.025, flat=1.0,
        tongue=TongueBend(((-0.25, -0.60), (-0.02, -0.49), (-0.045, -0.31), (-0.055, -0.22))),
    ),
    "W": MouthPose(
        rounded=1.0, hole=(0.045, 0.045), ring=0.066, forward=0.085,
        upper_teeth=(0.09, -0.06), lower_teeth=(-0.065, -0.06),
        tongue=TongueBend(((-0.28, -0.62), (-0.14, -0.58), (-0.17, -0.46), (-0.17, -0.37))),
    ),
    "ShCh": MouthPose(
        width=-0.28, forward=0.075, raise_upper=0.042, drop_lower=0.05, roll_upper=16, roll_lower=20, thick=0.10,
        corners=-0.02, corner_forward=0.03, upper_teeth=(0.0, 0.015), lower_teeth=(0.010, 0.015), flat=1.0,
    ),
    "PBM": MouthPose(
        width=0.03, roll_upper=-18, roll_lower=-26, thick=-0.36, forward=-0.006, slide=0.05, raise_upper=-0.002,
        drop_lower=-0.002, lower_teeth=(0.0, -0.03),
    ),
    "FV": MouthPose(
        jaw=3.0, width=0.03, raise_upper=0.045, flat=0.6, tuck=(0.036, 0.08), roll_lower=-34, thick=-0.08,
        corners=-0.008, lower_teeth=(-0.03, -0.11),
    ),
    "wide": MouthPose(
        width=0.20, raise_upper=0.038, drop_lower=0.026, corners=0.035, forward=-0.015, thick=-0.10, cheeks=0.035,
        flat=0.7,
    ),
    "tBack": MouthPose(flat=0.6, tongue=TongueBend(((-0.25, -0.60), (0.16, -0.60), (0.02, -0.36), (-0.08, -0.31)))),
    "tRoof": MouthPose(
        flat=0.6, tongue=TongueBend(((-0.25, -0.57), (-0.02, -0.52), (-0.05, -0.30), (0.12, -0.175)), 0.75)
    ),
    "tTeeth": MouthPose(
        flat=0.9, tongue=TongueBend(((-0.23, -0.57), (0.05, -0.43), (0.025, -0.21), (0.010, -0.012)), 0.9)
    ),
}  # fmt: skip
