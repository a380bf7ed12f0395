"""The crab's claws, legs, spikes and spots; they stay still in every pose."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from core_pipeline.faces.sculpt.crab_body import Crab, Spot
from core_pipeline.faces.sculpt.horn import Horn, horn
from core_pipeline.faces.sculpt.piece import Piece, fan, grid, linear, mirror, paint
from core_pipeline.faces.sculpt.sdf import Array, Point, Solid, smoothstep

SPOT_RINGS, SPOT_AROUND = 2, 14


def limbs(crab: Crab, clay: Solid) -> list[Piece]:
    """Everything that hangs on the shell, on both sides."""
    tip = crab.tip
    pieces = [_limb(crab, "arm", crab.claw.arm, crab.palette.skin, 1.01)]
    palm = _limb(crab, "claw", crab.claw.palm, tip, 0.82)
    finger = _limb(crab, "finger", crab.claw.finger, tip, 0.72)
    pieces += [_limb(crab, f"leg_{n}", leg, crab.side, 0.55) for n, leg in enumerate(crab.legs, 1)]
    pieces += [_limb(crab, f"spike_{n}", spike, tip, 0.35) for n, spike in enumerate(crab.spikes, 1)]
    pieces += [_spot(crab, clay, n, spot) for n, spot in enumerate(crab.spots, 1)]
    both = [*pieces, *(mirror(piece, piece.name.replace("right", "left")) for piece in pieces)]
    wrist = np.array(crab.claw.arm.points[-1])
    for part in (palm, finger):
        other = replace(part, positions=wrist + crab.left_claw * (part.positions - wrist))
        both += [part, mirror(other, part.name.replace("right", "left"))]
    return both


def _limb(crab: Crab, name: str, shape: Horn, tip: Point, pale_from: float) -> Piece:
    """A horn in the shell's colour that pales towards its tip, and is dark where it leaves the shell."""
    points, triangles, along = horn(shape)
    colours = paint(len(points), crab.palette.skin, 0.5)
    pale = smoothstep(pale_from - 0.12, pale_from + 0.12, along)[:, None]
    colours[:, :3] += pale * (linear(tip) - colours[:, :3])
    colours[:, :3] *= (0.55 + 0.45 * smoothstep(0.0, 0.3, along))[:, None]
    return Piece(f"{name}_right", points, triangles, colours)


def _spot(crab: Crab, clay: Solid, number: int, spot: Spot) -> Piece:
    """A patch that lies on the shell."""
    middle, towards = np.array(crab.middle), np.array(spot.towards)
    hit = clay.cast(middle[None], towards[None] / np.linalg.norm(towards))[0]
    out = clay.gradient(hit[None])[0]
    side = np.cross((0.0, 0.0, 1.0), out)
    side /= np.linalg.norm(side)
    angle = 2 * np.pi * np.arange(SPOT_AROUND) / SPOT_AROUND
    wobble = 1 + 0.10 * np.sin(2 * angle + number) + 0.06 * np.sin(3 * angle + 2 * number)
    rings = [_round(hit, out, side, spot.radius * part * wobble, angle) for part in np.linspace(1, 0.3, SPOT_RINGS)]
    flat = np.concatenate([*rings, hit[None]])
    away = flat - middle
    points = clay.cast(np.broadcast_to(middle, away.shape), away / np.linalg.norm(away, axis=1, keepdims=True))
    points = points + 0.006 * out
    last = (SPOT_RINGS - 1) * SPOT_AROUND + np.arange(SPOT_AROUND)
    triangles = np.concatenate([grid(SPOT_RINGS, SPOT_AROUND, closed=True), fan(last, len(points) - 1)])
    return Piece(f"spot_{number}_right", points, triangles, paint(len(points), crab.spot, 0.5))


def _round(centre: Array, out: Array, side: Array, radius: Array, angle: Array) -> Array:
    up = np.cross(out, side)
    return centre + (radius * np.cos(angle))[:, None] * side + (radius * np.sin(angle))[:, None] * up
