"""Hair: a lattice from the hairline to the crown, thick and combed into clumps, and single locks on top of it."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import PchipInterpolator

from core_pipeline.faces.sculpt.character import Character, Lock
from core_pipeline.faces.sculpt.hair_sheet import sheet
from core_pipeline.faces.sculpt.piece import Piece, Triangles, fan, grid, linear
from core_pipeline.faces.sculpt.sdf import Array, Solid, smoothstep

LOCK_ROWS, LOCK_SIDES = 12, 8
# hair is drawn from front to back in slices so thick; what lies behind a multiple of them, after the face
SLICE, BEHIND = 0.1, 0.0


class Scalp:
    """Places on the head by azimuth (degrees from the front, + to the right) and angle from the crown."""

    def __init__(self, character: Character, clay: Solid) -> None:
        self.character, self.clay = character, clay
        self.middle = np.array([0.0, 0.28, -0.08])
        up = np.array(character.hair.crown) - self.middle
        up /= np.linalg.norm(up)
        self._axes = np.array([(1.0, 0.0, 0.0), up, np.cross((1.0, 0.0, 0.0), up)])

    def place(self, azimuth: Array, angle: Array) -> tuple[Array, Array]:
        """Points (…, 3) on the scalp and outward directions there."""
        a, b = np.radians(azimuth), np.radians(angle)
        local = np.stack([np.sin(b) * np.sin(a), np.cos(b), np.sin(b) * np.cos(a)], -1)
        directions = local @ self._axes
        points = self.clay.cast(np.broadcast_to(self.middle, directions.shape), directions)
        return points, self.clay.gradient(points)


def hair(character: Character, clay: Solid) -> Piece:
    """The whole of the hair; it stays still in every pose."""
    scalp = Scalp(character, clay)
    parts = [_cap(character, scalp), *(_lock(lock, scalp) for lock in character.hair.locks)]
    for layer in character.hair.sheets:
        parts += sheet(layer, clay)
    triangles, first = [], 0
    for points, part_triangles, _ in parts:
        triangles.append(part_triangles + first)
        first += len(points)
    positions = np.concatenate([points for points, _, _ in parts])
    light = np.concatenate([tint for _, _, tint in parts])[:, None]
    palette = character.palette
    tone = linear(palette.hair) + light * (linear(palette.hair_light) - linear(palette.hair))
    # what lies deep down is dull
    colours = np.column_stack([np.clip(tone, 0, 1), character.hair.gloss * smoothstep(0.0, 0.25, light)])
    ordered, front = _front_first(positions, np.concatenate(triangles))
    ranges = {"hair": (0, front), "hair_back": (front, len(ordered) - front)}
    return Piece("hair", positions, ordered, colours, ranges=ranges)


def _front_first(positions: Array, triangles: Triangles) -> tuple[Triangles, int]:
    """The triangles by slices of the head from front to back, and how many of them lie before its sides."""
    depth = positions[triangles, 2].mean(axis=1)
    order = np.argsort(np.ceil(-depth / SLICE), kind="stable")
    return triangles[order], int((depth > BEHIND).sum())


def _cap(character: Character, scalp: Scalp) -> tuple[Array, Triangles, Array]:
    style = character.hair
    columns, rows = style.resolution
    azimuth = np.linspace(-180, 180, columns, endpoint=False)
    known = np.array(style.hairline)
    line = PchipInterpolator(known[:, 0], known[:, 1])(np.abs(azimuth))
    # rows bunch at the hairline, where the hair's rounded edge is
    t = np.linspace(0, 1, rows) ** 1.5
    angle = line[None] * (1 - 0.985 * t[:, None])
    around = azimuth[None] + 0 * angle
    points, out = scalp.place(around, angle)
    points[np.abs(points[..., 0]) < 1e-9, 0] = 0.0
    share = t[:, None] + 0 * around
    ahead = smoothstep(75, 10, np.abs(around))
    behind = smoothstep(100, 160, np.abs(around))
    full = style.front * ahead + style.back * (1 - ahead) * (1 - 0.3 * behind)
    high = full + (style.top - full) * smoothstep(0.25, 0.9, share)
    edge = np.sqrt(np.clip(1 - (1 - np.clip(share / 0.16, 0, 1)) ** 2, 0, 1))
    phase = np.radians(around + 60 * style.twist * share) * style.clumps + 0.8 * np.sin(np.radians(around) * 3)
    ridge = np.abs(np.sin(phase / 2))
    groove = (1 - ridge) ** 2 * smoothstep(1.0, 0.75, share)
    height = high * edge * (1 - 0.38 * groove) - 0.035 * (1 - edge)
    points = points + out * height[..., None]
    swell = style.quiff * ahead * np.exp(-(((share - 0.28) / 0.26) ** 2)) * edge
    points = points + swell[..., None] * np.array([0.10, 0.85, 0.45])
    light = 0.15 + 0.75 * ridge * smoothstep(0, 0.3, share) - 0.35 * smoothstep(0.2, 0.0, share)
    flat = np.concatenate([points.reshape(-1, 3), points[-1].mean(0)[None]])
    last = (rows - 1) * columns + np.arange(columns)
    triangles = np.concatenate([grid(rows, columns, closed=True), fan(last, len(flat) - 1)])
    return flat, triangles, np.append(np.clip(light, 0, 1).ravel(), 0.5)


def _lock(lock: Lock, scalp: Scalp) -> tuple[Array, Triangles, Array]:
    """A tapered strand along a smooth path over the head."""
    known = np.array(lock.path)
    knots = np.linspace(0, 1, len(known))
    u = np.linspace(0, 1, LOCK_ROWS)
    azimuth, angle, height = (PchipInterpolator(knots, known[:, i])(u) for i in range(3))
    points, out = scalp.place(azimuth, angle)
    path = points + out * height[:, None]
    ahead = np.gradient(path, axis=0)
    ahead /= np.linalg.norm(ahead, axis=1, keepdims=True)
    across = np.cross(out, ahead)
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    normal = np.cross(ahead, across)
    taper = np.sqrt(np.clip(1 - ((u - 0.35) / np.where(u < 0.35, 0.42, 0.65)) ** 2, 0.0, 1))
    taper[-1] = 0.01
    turn = 2 * np.pi * np.arange(LOCK_SIDES) / LOCK_SIDES
    ring = across[:, None] * (np.cos(turn) * (lock.width * taper)[:, None])[..., None]
    ring = ring + normal[:, None] * (np.sin(turn) * (lock.thickness * taper)[:, None])[..., None]
    light = 0.35 + 0.45 * np.clip(np.sin(turn), 0, 1) + 0.25 * u[:, None] - 0.4 * np.clip(-np.sin(turn), 0, 1)
    return (path[:, None] + ring).reshape(-1, 3), grid(LOCK_ROWS, LOCK_SIDES, closed=True), np.clip(light, 0, 1).ravel()
