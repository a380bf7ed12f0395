"""What no one outside ever sees, and need not be there: a scalp under hair, a neck inside a collar.

What a cut-away shows in its place, from within, is the inner side of what is left.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

import numpy as np
from numpy.typing import NDArray

from core_pipeline.faces.sculpt.raster import directions, fragments, looking_along, nearest
from core_pipeline.faces.sculpt.sdf import Array

DIRECTIONS = 80
SIZE = 280
TOUCHING = 1e-3  # so near to what lies before it, a triangle is seen with it


def never_seen(stages: Sequence[Array], triangles: NDArray[np.integer], asked: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(m,) bool: the triangle cannot be seen from anywhere outside, nor can its neighbours.

    stages  positions (n, 3) in a few poses, as different as may be
    asked   (m,) bool: none of the others is called hidden
    """
    seen = ~asked
    for positions, direction in product(stages, directions(DIRECTIONS, 2, 0.321)):
        points = looking_along(positions, direction, SIZE)
        which, pixel, near = fragments(points[triangles], SIZE)
        seen[which[near > nearest(pixel, near, SIZE)[pixel] - TOUCHING]] = True
    # pictures of finitely many pixels miss slivers: what touches a triangle that is seen stays
    kept = np.zeros(len(stages[0]), bool)
    kept[triangles[seen]] = True
    hidden: NDArray[np.bool_] = ~kept[triangles].any(axis=1)
    return hidden
