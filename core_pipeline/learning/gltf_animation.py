"""Morph-weight animations of a glTF file as a capture: the shapes are its channels."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..faces.rigs.gltf_file import GltfFile
from .capture import Capture

Array = NDArray[np.float64]

#: Frames a second at which the animation is read.
FPS = 60.0
LONGEST = 3600.0


def load(path: Path) -> Capture:
    """The file's morph weights from the first to the last key of all of them; UserError when it animates none.

    Of several meshes with the same shapes (a face and its lashes), each shape is taken where it moves most.
    """
    file = GltfFile(path)
    tracks: dict[str, tuple[Array, Array]] = {}
    notes: list[str] = []
    animations = [animation for animation in file.items("animations") if _morphs(file, animation)]
    if not animations:
        raise file.fail("no morph target is animated in it; export the face with its shape-key animation.")
    if len(animations) > 1:
        notes.append(f"It has {len(animations)} animations; the first is taken.")
    for channel in _morphs(file, animations[0]):
        _read_channel(file, animations[0], channel, tracks)
    start = min(float(times[0]) for times, _ in tracks.values())
    end = max(float(times[-1]) for times, _ in tracks.values())
    if end - start > LONGEST:
        raise file.fail(f"its animation lasts {end - start:,.0f} s; cut it into shorter ones.")
    grid = start + np.arange(round((end - start) * FPS) + 1) / FPS
    values = np.stack([np.interp(grid, times, heights) for times, heights in tracks.values()], axis=1)
    return Capture(tuple(tracks), FPS, start, values, np.ones(grid.size, bool), tuple(notes))


def _morphs(file: GltfFile, animation: dict[str, Any]) -> list[dict[str, Any]]:
    channels = file.parts(animation, "channels")
    return [channel for channel in channels if file.part(channel, "target").get("path") == "weights"]


def _read_channel(
    file: GltfFile, animation: dict[str, Any], channel: dict[str, Any], tracks: dict[str, tuple[Array, Array]]
) -> None:
    node = file.item("nodes", file.part(channel, "target").get("node"))
    names = _names(file, file.item("meshes", node.get("mesh")))
    samplers, number = file.parts(animation, "samplers"), channel.get("sampler")
    if type(number) is not int or not 0 <= number < len(samplers):
        raise file.fail("an animation channel has no sampler; export the file again.")
    sampler = samplers[number]
    times = file.read(sampler.get("input"), "SCALAR")[:, 0].astype(np.float64)
    values = file.read(sampler.get("output"), "SCALAR")[:, 0].astype(np.float64)
    kind = sampler.get("interpolation", "LINEAR")
    per_key = 3 if kind == "CUBICSPLINE" else 1
    if not times.size or values.size != times.size * per_key * len(names) or (np.diff(times) <= 0).any():
        raise file.fail("an animation has other than one weight a shape and key; export the file again.")
    table = values.reshape(times.size, per_key, len(names))
    for i, name in enumerate(names):
        at, heights = _fine(times, table[:, :, i], str(kind))
        if name not in tracks or np.ptp(heights) > np.ptp(tracks[name][1]):
            tracks[name] = at, heights


def _names(file: GltfFile, mesh: dict[str, Any]) -> list[str]:
    names = file.part(mesh, "extras").get("targetNames")
    primitives = file.parts(mesh, "primitives")
    count = len(file.parts(primitives[0], "targets")) if primitives else 0
    if not isinstance(names, list) or len(names) != count or not all(isinstance(n, str) and n for n in names):
        raise file.fail("its shapes have no names (extras.targetNames); export the file with names.")
    return names


def _fine(times: Array, keys: Array, kind: str) -> tuple[Array, Array]:
    """Points that straight lines may join: (times, heights). keys (n, 1), or (n, 3) as CUBICSPLINE has them."""
    if kind == "STEP":
        before = np.nextafter(times[1:], -np.inf)
        return np.insert(times, np.arange(1, times.size), before), np.repeat(keys[:, 0], 2)[:-1]
    if kind != "CUBICSPLINE" or times.size < 2:
        return times, keys[:, -1] if keys.shape[1] == 1 else keys[:, 1]
    h = np.diff(times)[:, None]
    s = np.arange(16) / 16
    v0, v1, d0, d1 = keys[:-1, 1, None], keys[1:, 1, None], h * keys[:-1, 2, None], h * keys[1:, 0, None]
    rise = v1 - v0
    heights = v0 + s * (d0 + s * (3 * rise - 2 * d0 - d1 + s * (d0 + d1 - 2 * rise)))
    at = times[:-1, None] + s * h
    return np.append(at.ravel(), times[-1]), np.append(heights.ravel(), keys[-1, 1])
