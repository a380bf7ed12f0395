"""Magenta: no pose moves faster than l_max (section 3.2.3, figure 10).

    cyan  __/‾|___        magenta  __/\\___       min over s of l(s) + l_max·|t − s|

The largest function under the cyan one whose slope is nowhere above l_max in size: at every moment the
lowest of all cones that stand on the curve. The lowest cone from the left is a running minimum of
l − l_max·t, the one from the right of l + l_max·t. Nothing is raised, so the constraints still hold.
"""

from __future__ import annotations

import numpy as np

from .tracks import NEAR, Tracks, inserted, minimal


def limit_speed(tracks: Tracks, speed: float) -> Tracks:
    """Largest tracks under `tracks` whose slope nowhere exceeds `speed`.

    speed  weight per second, > 0 (ValueError otherwise)
    """
    if not speed > 0:
        raise ValueError("the speed limit must be above 0")
    x, v = tracks.x, tracks.v
    if x.size < 3:
        return tracks
    lift = speed * x
    left = v - lift
    np.minimum.accumulate(left, out=left)
    left += lift  # the lowest cone from the left at each knot
    right = v + lift
    np.minimum.accumulate(right[::-1], out=right[::-1])
    right -= lift
    low = np.minimum(left, right)
    np.minimum(low, v, out=low)
    cut = v - low > 1e-12
    i = (cut[1:] | cut[:-1]).nonzero()[0]  # segments in which the curve is not its own limit
    if not i.size:
        return tracks

    # Within a segment: up along the left cone, perhaps a stretch of the curve, up to the right cone.
    width = x[i + 1] - x[i]
    slope = (v[i + 1] - v[i]) / width
    up, down = np.minimum(left[i], v[i]), np.minimum(right[i + 1], v[i + 1])
    never = 1e-300
    reach = np.maximum(v[i] - up, 1e-290) / np.maximum(speed - slope, never)  # left cone meets the curve
    leave = np.maximum(v[i + 1] - down, 1e-290) / np.maximum(speed + slope, never)  # curve meets the right cone
    touches = reach + leave < width
    meet = np.where(touches, reach, (down - up + speed * width) / (2 * speed))  # else the cones meet each other
    last = width - leave
    inside = np.column_stack(((meet > NEAR) & (meet < width - NEAR), touches & (leave > NEAR) & (last > meet + NEAR)))
    more_x = np.column_stack((x[i] + meet, x[i] + last))[inside]  # row by row, hence in order
    more_v = np.column_stack((up + speed * meet, down + speed * leave))[inside]
    x, v = inserted(x, low, np.column_stack((i, i))[inside], more_x, more_v)
    return tracks.with_knots(*minimal(x, np.clip(v, 0.0, 1.0)))
