"""A face from a .glb or .gltf with morph targets: all meshes of the scene in one, shapes of the same name together.

Every vertex is placed as the file's rest pose places it (nodes, and joints where a mesh has a skin).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core_pipeline.faces.face import Camera, Face, Floats
from core_pipeline.faces.gltf_file import LARGEST, GltfFile, Json
from core_pipeline.faces.normals import VertexNormals, seam_groups

MAX_VERTICES = 2_000_000
MAX_MORPH_BYTES = 2**30
_TRIANGLES, _STRIP, _FAN = 4, 5, 6

Matrix = NDArray[np.floating[Any]]


def read_glb(path: str | Path) -> Face:
    """The face in a file. UserError when it is damaged, too large, or has no morph targets."""
    gltf = GltfFile(Path(path))
    patches = [
        _patch(gltf, node, matrix, primitive, names, title)
        for node, matrix in _placed_meshes(gltf)
        for primitive, names, title in _primitives(gltf, node)
    ]
    if not any(patch.deltas for patch in patches):
        raise gltf.fail("it has no morph targets (blendshapes); export the face with shape keys.")
    return _join(gltf, patches)


@dataclass
class _Patch:
    """One primitive, in the scene's space."""

    title: str
    positions: Floats
    triangles: NDArray[np.uint32]
    colours: Floats
    normals: Floats | None = None
    deltas: dict[str, Floats] = field(default_factory=dict)


def _placed_meshes(gltf: GltfFile) -> Iterator[tuple[Json, Matrix]]:
    """Every node of the scene that has a mesh, with its matrix; all meshes when the file has no nodes."""
    nodes = gltf.items("nodes")
    if not nodes:
        yield from (({"mesh": index}, np.eye(4)) for index in range(len(gltf.items("meshes"))))
        return
    for index, matrix in _world(gltf).items():
        if "mesh" in nodes[index]:
            yield nodes[index], matrix


def _world(gltf: GltfFile) -> dict[int, Matrix]:
    """Node → matrix, for the nodes of the scene."""
    children = {child for node in gltf.items("nodes") for child in gltf.numbers(node, "children")}
    roots = [index for index in range(len(gltf.items("nodes"))) if index not in children]
    if gltf.items("scenes"):
        roots = gltf.numbers(gltf.item("scenes", gltf.json.get("scene", 0)), "nodes")
    placed: dict[int, Matrix] = {}
    waiting: list[tuple[int, Matrix]] = [(root, np.eye(4)) for root in roots]
    while waiting:
        index, above = waiting.pop(0)
        node = gltf.item("nodes", index)
        if index in placed:
            raise gltf.fail(f"node {index} is in the scene twice; export the file again.")
        placed[index] = above @ _local(gltf, node)
        if np.abs(placed[index]).max() > LARGEST:
            raise gltf.fail(f"node {index} stands {np.abs(placed[index]).max():.0e} away; export the file again.")
        waiting += [(child, placed[index]) for child in gltf.numbers(node, "children")]
    return placed


def _local(gltf: GltfFile, node: Json) -> Matrix:
    if "matrix" in node:
        return _numbers(gltf, node["matrix"], 16).reshape(4, 4).T
    x, y, z, w = _numbers(gltf, node.get("rotation", (0, 0, 0, 1)), 4)
    length = np.sqrt(x * x + y * y + z * z + w * w) or 1.0
    x, y, z, w = (float(part / length) for part in (x, y, z, w))
    local = np.eye(4)
    local[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    local[:3, :3] *= _numbers(gltf, node.get("scale", (1, 1, 1)), 3)
    local[:3, 3] = _numbers(gltf, node.get("translation", (0, 0, 0)), 3)
    return local


def _numbers(gltf: GltfFile, values: object, count: int) -> Matrix:
    try:
        numbers = np.asarray(values, float)
    except (TypeError, ValueError):
        numbers = np.array(np.nan)
    if numbers.shape != (count,) or not (np.abs(numbers) <= LARGEST).all():
        raise gltf.fail(f"a transform or colour is not {count} sensible numbers; export the file again.")
    return numbers


def _primitives(gltf: GltfFile, node: Json) -> Iterator[tuple[Json, list[str], str]]:
    mesh = gltf.item("meshes", node["mesh"])
    title = str(node.get("name") or mesh.get("name") or f"mesh {node['mesh']}")
    drawn = [
        item for item in gltf.parts(mesh, "primitives") if item.get("mode", _TRIANGLES) in (_TRIANGLES, _STRIP, _FAN)
    ]
    counts = {len(gltf.parts(primitive, "targets")) for primitive in drawn}
    if len(counts) > 1:
        raise gltf.fail(f"the parts of mesh “{title}” have different numbers of morph targets {sorted(counts)}.")
    count = counts.pop() if counts else 0
    extras = mesh.get("extras")
    names = extras.get("targetNames") if isinstance(extras, dict) else None
    if not isinstance(names, list):
        names = [f"target {number}" for number in range(count)]
    if len(names) != count:
        raise gltf.fail(f"mesh “{title}” has {count} morph targets but names {len(names)}; export the file again.")
    for number, primitive in enumerate(drawn):
        own = primitive.get("extras")
        part = own.get("part") if isinstance(own, dict) else None
        yield primitive, [str(name) for name in names], str(part or (f"{title} {number + 1}" if number else title))


def _patch(gltf: GltfFile, node: Json, matrix: Matrix, primitive: Json, names: list[str], title: str) -> _Patch:
    attributes, targets = gltf.part(primitive, "attributes"), gltf.parts(primitive, "targets")
    if "POSITION" not in attributes:
        raise gltf.fail(f"mesh “{title}” has no positions; export the file again.")
    count = gltf.count(attributes["POSITION"])
    if count > MAX_VERTICES:
        raise gltf.fail(f"mesh “{title}” has {count:,} vertices, more than {MAX_VERTICES:,}; reduce it.")
    if count * len(targets) * 24 > MAX_MORPH_BYTES:
        raise gltf.fail(f"{count:,} vertices × {len(targets)} morph targets need more than 1 GB; reduce the mesh.")
    _same_counts(gltf, title, count, attributes, targets)
    place = _placement(gltf, node, matrix, attributes, count)
    positions = gltf.read(attributes["POSITION"], "VEC3").astype(np.float32)
    triangles = _triangles(gltf, primitive, count, title)
    if np.linalg.det(matrix[:3, :3]) < 0:
        triangles = triangles[:, ::-1]
    patch = _Patch(title, _move(place, positions, 1), triangles, _colours(gltf, primitive, count))
    if "NORMAL" in attributes:
        normals = gltf.read(attributes["NORMAL"], "VEC3").astype(np.float32)
        patch.normals = _unit(_move(np.linalg.pinv(place[..., :3, :3]).swapaxes(-1, -2), normals, 0))
    for name, target in zip(names, targets, strict=True):
        if "POSITION" in target:
            delta = _move(place, gltf.read(target["POSITION"], "VEC3").astype(np.float32), 0)
            patch.deltas[name] = patch.deltas[name] + delta if name in patch.deltas else delta
    return patch


def _same_counts(gltf: GltfFile, title: str, count: int, attributes: Json, targets: list[Json]) -> None:
    for what in (attributes, *targets):
        for key, index in what.items():
            if gltf.count(index) != count:
                raise gltf.fail(f"mesh “{title}” has {count:,} vertices but {gltf.count(index):,} values of {key}.")


def _placement(gltf: GltfFile, node: Json, matrix: Matrix, attributes: Json, count: int) -> Matrix:
    """(4, 4), or (n, 4, 4) for a mesh that hangs on joints: its own node's place does not count then."""
    if "skin" not in node or not {"JOINTS_0", "WEIGHTS_0"} <= set(attributes):
        return matrix
    skin = gltf.item("skins", node["skin"])
    joints = gltf.numbers(skin, "joints")
    world = _world(gltf)
    moved = np.array([world.get(joint, np.eye(4)) for joint in joints]).reshape(-1, 4, 4)
    if "inverseBindMatrices" in skin:
        inverse = gltf.read(skin["inverseBindMatrices"], "MAT4").reshape(-1, 4, 4).swapaxes(1, 2)
        if len(inverse) < len(joints):
            raise gltf.fail(f"a skin has {len(joints)} joints but {len(inverse)} bind matrices; export the file again.")
        moved = moved @ inverse[: len(joints)]
    which = gltf.read(attributes["JOINTS_0"], "VEC4").astype(np.int64)
    weights = gltf.read(attributes["WEIGHTS_0"], "VEC4").astype(np.float32)
    if count and which.max() >= len(joints):
        raise gltf.fail(f"a vertex hangs on joint {which.max()} of {len(joints)}; export the file again.")
    total = weights.sum(1, keepdims=True)
    weights = np.where(total > 0, weights / np.where(total > 0, total, 1), (1.0, 0, 0, 0))
    blended = np.zeros((count, 4, 4), np.float32)
    for slot in range(4):
        blended += weights[:, slot, None, None] * moved[which[:, slot]].astype(np.float32)
    return blended


def _move(place: Matrix, vectors: Floats, w: int) -> Floats:
    turned = np.einsum("...ij,...j->...i", place[..., :3, :3], vectors)
    moved: Floats = (turned + w * place[..., :3, 3] if w else turned).astype(np.float32)
    return moved


def _unit(vectors: Floats) -> Floats:
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    good = np.abs(length - 1) < 1e-5  # left alone, so that reading and writing changes nothing
    scaled = np.where(length > 0, vectors / np.where(length > 0, length, 1), (0.0, 0.0, 1.0))
    unit: Floats = np.where(good, vectors, scaled).astype(np.float32)
    return unit


def _triangles(gltf: GltfFile, primitive: Json, count: int, title: str) -> NDArray[np.uint32]:
    if "indices" in primitive:
        flat = gltf.read(primitive["indices"], "SCALAR")[:, 0].astype(np.int64)
    else:
        flat = np.arange(count, dtype=np.int64)
    if len(flat) and not 0 <= flat.min() <= flat.max() < count:
        raise gltf.fail(f"mesh “{title}” uses vertex {flat.max():,} but has {count:,}; the file is damaged.")
    mode = primitive.get("mode", _TRIANGLES)
    if mode == _TRIANGLES:
        if len(flat) % 3:
            raise gltf.fail(f"mesh “{title}” has {len(flat):,} indices, not a multiple of 3; the file is damaged.")
        corners = flat.reshape(-1, 3)
    elif mode == _STRIP:
        corners = np.stack([flat[:-2], flat[1:-1], flat[2:]], -1)
        corners[1::2] = corners[1::2][:, [1, 0, 2]]
    else:
        corners = np.stack([np.full(max(len(flat) - 2, 0), flat[:1].sum()), flat[1:-1], flat[2:]], -1)
    return corners.astype(np.uint32)


def _colours(gltf: GltfFile, primitive: Json, count: int) -> Floats:
    """Vertex colours × the material's colour; the gloss is our own fourth colour, else what the roughness leaves."""
    material = gltf.item("materials", primitive["material"]) if "material" in primitive else {}
    surface = gltf.part(material, "pbrMetallicRoughness")
    base = _numbers(gltf, surface.get("baseColorFactor", (1, 1, 1, 1)), 4)
    colours = np.ones((count, 4), np.float32)
    colours[:, 3] = 1 - np.clip(_numbers(gltf, [surface.get("roughnessFactor", 0.6)], 1)[0], 0, 1)
    index: Any = gltf.part(primitive, "attributes").get("COLOR_0")
    if index is not None:
        kind = "VEC4" if gltf.item("accessors", index).get("type") == "VEC4" else "VEC3"
        own = gltf.read(index, kind).astype(np.float32)
        colours[:, :3] = own[:, :3]
        if kind == "VEC4" and primitive.get("extras") == {"glossInAlpha": True}:
            colours[:, 3] = own[:, 3]
    colours[:, :3] *= base[:3]
    return np.clip(colours, 0, 1)


def _join(gltf: GltfFile, patches: list[_Patch]) -> Face:
    sizes = [len(patch.positions) for patch in patches]
    shapes = tuple(dict.fromkeys(name for patch in patches for name in patch.deltas))
    if sum(sizes) * len(shapes) * 24 > MAX_MORPH_BYTES:
        raise gltf.fail(f"{sum(sizes):,} vertices × {len(shapes)} shapes need more than 1 GB; reduce the mesh.")
    first = np.concatenate([[0], np.cumsum(sizes)]).astype(np.uint32)
    triangles = np.concatenate([patch.triangles + start for patch, start in zip(patches, first, strict=False)])
    far = max(
        (float(np.abs(a).max(initial=0)) for p in patches for a in (p.positions, *p.deltas.values())), default=0.0
    )
    if far > LARGEST:
        raise gltf.fail(f"a vertex stands {far:.0e} away; export the file in metres or centimetres.")
    if not len(triangles):
        raise gltf.fail("its meshes have no triangles; export the face as a mesh.")
    positions = np.concatenate([patch.positions for patch in patches])
    deltas = np.zeros((len(shapes), len(positions), 3), np.float32)
    for patch, start in zip(patches, first, strict=False):
        for name, delta in patch.deltas.items():
            deltas[shapes.index(name), start : start + len(delta)] = delta
    normals, normal_deltas = _light(patches, positions, triangles, deltas)
    return Face(
        name=gltf.path.stem,
        title=gltf.path.stem,
        positions=positions,
        normals=normals,
        triangles=triangles,
        colours=np.concatenate([patch.colours for patch in patches]),
        shapes=shapes,
        deltas=deltas,
        normal_deltas=normal_deltas,
        parts=_parts(patches),
        camera=frame(positions),
    )


def _light(
    patches: list[_Patch], positions: Floats, triangles: NDArray[np.uint32], deltas: Floats
) -> tuple[Floats, Floats]:
    """Normals as the file gives them (else from the triangles), and how they turn in every shape."""
    given = [patch.normals if patch.normals is not None else np.zeros_like(patch.positions) for patch in patches]
    stored = np.concatenate(given)
    computed = VertexNormals(triangles, seam_groups(positions, stored))
    rest = computed.of(positions)
    turned = np.zeros_like(deltas)
    for shape, delta in enumerate(deltas):
        if delta.any():
            turned[shape] = computed.of(positions + delta) - rest
    return np.where(stored.any(axis=1, keepdims=True), stored, rest), turned


def _parts(patches: list[_Patch]) -> dict[str, tuple[int, int]]:
    parts: dict[str, tuple[int, int]] = {}
    first = 0
    for patch in patches:
        title, number = patch.title, 2
        while title in parts:
            title, number = f"{patch.title} ({number})", number + 1
        parts[title] = (first, len(patch.triangles))
        first += len(patch.triangles)
    return parts


def frame(positions: Floats) -> Camera:
    """A camera that shows all of a mesh from the front."""
    low, high = positions.min(0).astype(float), positions.max(0).astype(float)
    x, y, z = ((low + high) / 2).tolist()
    size = float((high - low).max()) or 1.0
    return Camera(target=(x, y, z), distance=0.6 * size / np.tan(np.radians(12.0)), fov=24.0)
