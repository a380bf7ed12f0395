"""Eyes on stalks: balls between an upper and a lower visor, which close in a blink; stalks stretch in browUp."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from core_pipeline.faces.sculpt.crab_body import Crab
from core_pipeline.faces.sculpt.eyes import eyes
from core_pipeline.faces.sculpt.horn import Horn, horn
from core_pipeline.faces.sculpt.piece import Piece, grid, linear, mirror, paint
from core_pipeline.faces.sculpt.sdf import Array, smoothstep

COLUMNS = 17
# along the visor from its edge to behind the ball: (share of the way, radius over the ball's)
SECTION = np.array(
    [(0.03, 0.97), (0.0, 1.02), (0.0, 1.07), (0.03, 1.10), (0.10, 1.10)]
    + [(share, 1.10 - 0.03 * share) for share in (0.21, 0.33, 0.46, 0.6, 0.8, 1.0)]
)
BACK = 183.0
CLEAR = 1.04
OVERLAP = 1.5


def stalk_eyes(crab: Crab) -> list[Piece]:
    """Balls, glints, visors and stalks of both eyes."""
    lift = np.array([0, crab.stalks.lift[0], 0])
    balls = [replace(piece, poses={"browUp": piece.positions + lift}) for piece in eyes(crab, lids=False)]
    pieces = [_visor(crab, "lid_upper", upper=True), _visor(crab, "lid_lower", upper=False), _stalk(crab)]
    return [*balls, *pieces, *(mirror(piece, piece.name.replace("right", "left")) for piece in pieces)]


def _visor(crab: Crab, name: str, *, upper: bool) -> Piece:
    stalks = crab.stalks
    edge = stalks.upper if upper else stalks.lower
    wider = stalks.lift[1] if upper else 0.0
    rest = _turned(crab, edge, edge)
    up = np.array([0, stalks.lift[0], 0])
    shut = stalks.shut - OVERLAP if upper else stalks.shut + OVERLAP
    poses = {"blink": _turned(crab, edge, shut), "browUp": _turned(crab, edge, edge + wider) + up}
    for pose, moves in stalks.narrow.items():
        poses[pose] = _turned(crab, edge, edge + moves[0 if upper else 1])
    triangles = grid(len(SECTION), COLUMNS, closed=False)
    colours = paint(len(rest), crab.palette.lid, 0.5)
    rim = np.repeat(smoothstep(0.06, 0.02, SECTION[:, 0]), COLUMNS)[:, None]
    colours[:, :3] += rim * (0.6 * linear(crab.palette.lid) - colours[:, :3])
    return Piece(f"{name}_right", rest, triangles if upper else triangles[:, ::-1], colours, poses)


def _turned(crab: Crab, edge: float, shown: float) -> Array:
    """A visor whose edge at rest is at `edge` degrees, turned so that it is at `shown`."""
    stalks, ball = crab.stalks, crab.eyes
    back = BACK if edge > 0 else -BACK
    side = np.radians(np.linspace(-89.8, 89.8, COLUMNS))[None]
    share, radius = SECTION[:, :1], SECTION[:, 1:]
    turned = (shown - edge) * (1 - share)
    height = np.radians(edge + (back - edge) * share + turned)
    # half way the straight line of a blendshape cuts inside the ball: a turned visor stands out to make up for it
    way = np.sqrt(np.sin(side) ** 2 + np.cos(side) ** 2 * np.cos(np.radians(turned / 2)) ** 2)
    out = np.maximum(1, 2 * CLEAR / (1.07 * way) - 1)
    local = np.stack([np.sin(side) + 0 * height, np.cos(side) * np.sin(height), np.cos(side) * np.cos(height)], -1)
    local = (local * (radius * out)[..., None]).reshape(-1, 3)
    a, b = np.radians(stalks.tilt), np.radians(stalks.yaw)
    x, y = local[:, 0] * np.cos(a) + local[:, 1] * np.sin(a), local[:, 1] * np.cos(a) - local[:, 0] * np.sin(a)
    x, z = x * np.cos(b) + local[:, 2] * np.sin(b), local[:, 2] * np.cos(b) - x * np.sin(b)
    placed: Array = np.array(ball.centre) + ball.radius * np.stack([x, y, z], -1)
    return placed


def _stalk(crab: Crab) -> Piece:
    stalks, ball = crab.stalks, np.array(crab.eyes.centre)
    foot, top = np.array(stalks.foot), ball - (0, 0.55 * crab.eyes.radius, 0.25 * crab.eyes.radius)
    middle = (foot + top) / 2 + (-0.02, 0.0, 0.03)
    wide, narrow = stalks.girth
    line = tuple((float(x), float(y), float(z)) for x, y, z in (foot, middle, top))
    girth = ((0.0, 1.5 * wide), (0.16, 1.12 * wide), (0.5, narrow), (1.0, 1.5 * narrow))
    points, triangles, along = horn(Horn(line, girth, rows=9, sides=12))
    stretched = points + np.outer(along, (0, stalks.lift[0], 0))
    colours = paint(len(points), crab.palette.skin, 0.5)
    colours[:, :3] *= (0.6 + 0.4 * smoothstep(0.0, 0.3, along) * smoothstep(1.0, 0.8, along))[:, None]
    return Piece("stalk_right", points, triangles, colours, {"browUp": stretched})
