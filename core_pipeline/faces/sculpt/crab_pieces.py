"""A whole crab: shell, mouth, eyes on stalks and limbs."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from core_pipeline.faces.sculpt.crab_body import Crab
from core_pipeline.faces.sculpt.crab_eyes import stalk_eyes
from core_pipeline.faces.sculpt.crab_limbs import limbs
from core_pipeline.faces.sculpt.crab_shell import Shell
from core_pipeline.faces.sculpt.mouth import Lips
from core_pipeline.faces.sculpt.piece import Piece
from core_pipeline.faces.sculpt.sdf import Solid
from core_pipeline.faces.sculpt.teeth import teeth
from core_pipeline.faces.sculpt.tongue import tongue

# a mouth wider than a head's has a wider tongue
TONGUE = np.array([1.35, 1.0, 1.0])


def crab_pieces(crab: Crab) -> list[Piece]:
    """Everything the crab is made of."""
    clay = Solid(crab.clay)
    lips = Lips(crab, clay)
    licker = tongue(crab, lips.centre)
    broad = {name: points * TONGUE for name, points in licker.poses.items()}
    return [
        Shell(crab, clay, lips).piece(),
        *teeth(crab, lips.centre),
        replace(licker, positions=licker.positions * TONGUE, poses=broad),
        *stalk_eyes(crab),
        *limbs(crab, clay),
    ]
