"""Magenta: no pose moves faster than l_max (section 3.2.3, figure 10).

    cyan  __/‾|___        magenta  __/\\___       min over s of l(s) + l_max·|t − s|

The largest function under the cyan one whose slope is nowhere above l_max in size: at every moment the
lowest of all cones that stand on the curve. The lowest cone from the left is a running minimum of
l − l_max·t, the one from the right of l + l_max·t. Nothing is raised, so the constraints still hold.
"""

from __future__ import annotations

import numpy as np

from .tracks import NEAR, Tracks, minimal, pick


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
    left = np.minimum.accumulate(v - lift) + lift  # the lowest cone from the left at each knot
    right = np.minimum.accumulate((v + lift)[::-1])[::-1] - lift
    low = np.minimum(np.minimum(left, right), v)
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

    xs, vs, keep = np.empty((x.size, 3)), np.empty((x.size, 3)), np.zeros((x.size, 3), bool)
    xs[:, 0], vs[:, 0], keep[:, 0] = x, low, True
    xs[i, 1], vs[i, 1] = x[i] + meet, up + speed * meet
    keep[i, 1] = (meet > NEAR) & (meet < width - NEAR)
    xs[i, 2], vs[i, 2] = x[i] + last, down + speed * leave
    keep[i, 2] = touches & (leave > NEAR) & (last > meet + NEAR)
    x, v = pick(keep.ravel(), xs.ravel(), vs.ravel())
    return tracks.with_knots(*minimal(x, np.clip(v, 0.0, 1.0)))
