"""A face from a .glb or .gltf with morph targets: all meshes of the scene in one, shapes of the same name together.

Every vertex is placed as the file's rest pose places it (nodes, and joints where a mesh has a skin).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from core_pipeline.faces.face import Face, Floats
from core_pipeline.faces.framing import frame
from core_pipeline.faces.normals import shape_normals
from core_pipeline.faces.rigs import draco
from core_pipeline.faces.rigs.gltf_file import GltfFile, Json
from core_pipeline.faces.rigs.gltf_materials import Materials
from core_pipeline.faces.rigs.gltf_scene import Matrix, Scene
from core_pipeline.faces.rigs.gltf_weights import Expressions, all_of_them, set_shapes, with_shapes
from core_pipeline.faces.rigs.limits import LARGEST, MAX_MORPH_BYTES, MAX_TRIANGLES, MAX_VERTICES
from core_pipeline.faces.rigs.scaffold import LEFT_OUT, is_scaffold
from core_pipeline.faces.rigs.steps import Report, Steps, silent
from core_pipeline.faces.rigs.vrm import expressions
from core_pipeline.faces.texture import Material, Texture
from core_pipeline.files.json_text import shown

MAX_PARTS = 2000
_TRIANGLES, _STRIP, _FAN = 4, 5, 6


def read_glb(path: str | Path) -> Face:
    """The face in a file. UserError when it is damaged, too large, or has no morph targets."""
    return read_rig(Path(path))[0]


def read_rig(
    path: Path, report: Report = silent, expressions_among: Expressions = all_of_them
) -> tuple[Face, list[Path], tuple[str, ...]]:
    """The face in a file, all the files it was read from, and what is odd about it.

    Shapes that the file has set and `expressions_among` all its shapes does not name are part of the neutral face.
    `report` is told after every part and shape. UserError as for `read_glb`.
    """
    gltf = GltfFile(path)
    scene = Scene(gltf)
    planned = _planned(gltf, scene)
    step = Steps(sum(2 + 2 * len(plan.names) for plan in planned), report)
    patches = [_patch(gltf, scene, plan, step) for plan in planned]
    textures = _dress(gltf, patches, planned, step)
    face = _join(gltf, patches, textures, _person(gltf, planned, expressions_among), step)
    return replace(face, expressions=_expressions(gltf, planned, face.shapes)), gltf.files, tuple(gltf.notes)


@dataclass(frozen=True)
class _Plan:
    """One primitive to be read, and where it belongs."""

    node: Json
    matrix: Matrix
    primitive: Json
    names: list[str]
    title: str
    named: bool


def _planned(gltf: GltfFile, scene: Scene) -> list[_Plan]:
    """All primitives of the scene, once it is sure that they fit into memory."""
    plans: list[_Plan] = []
    for node, matrix in scene.meshes():
        plans += _primitives(gltf, node, matrix)
        if len(plans) > MAX_PARTS:
            raise gltf.fail(f"it has more than {MAX_PARTS:,} parts; export the head alone.")
    plans = _without_scaffold(gltf, plans)
    unnamed = list(dict.fromkeys(plan.title for plan in plans if not plan.named))
    if unnamed:
        one = len(unnamed) == 1
        whose = f"Mesh “{unnamed[0]}” does not name its" if one else f"{len(unnamed)} meshes do not name their"
        gltf.note(f"{whose} shapes (targetNames is missing): they are numbered.")
    vertices, corners, shapes = 0, 0, set()
    for plan in plans:
        attributes = gltf.part(plan.primitive, "attributes")
        if "POSITION" not in attributes:
            raise gltf.fail(f"mesh “{plan.title}” has no positions; export the file again.")
        count = gltf.count(attributes["POSITION"])
        if count > MAX_VERTICES:
            raise gltf.fail(f"mesh “{plan.title}” has {count:,} vertices, more than {MAX_VERTICES:,}; reduce the mesh.")
        used = gltf.count(plan.primitive["indices"]) if "indices" in plan.primitive else count
        vertices += min(count, used)  # what no triangle uses is not kept
        corners += used if "indices" in plan.primitive else 0
        shapes |= set(plan.names)
    if not shapes:
        raise gltf.fail("it has no morph targets (blendshapes); export the face with shape keys.")
    if vertices > MAX_VERTICES:
        raise gltf.fail(f"it has {vertices:,} vertices, more than {MAX_VERTICES:,}; reduce the mesh.")
    if corners > 3 * MAX_TRIANGLES:
        raise gltf.fail(f"it has {corners // 3:,} triangles, more than {MAX_TRIANGLES:,}; reduce the mesh.")
    if vertices * len(shapes) * 24 > MAX_MORPH_BYTES:
        raise gltf.fail(f"{vertices:,} vertices × {len(shapes)} shapes need more than 512 MB; reduce the mesh.")
    return plans


def _without_scaffold(gltf: GltfFile, plans: list[_Plan]) -> list[_Plan]:
    """The plans without those of parts that nobody is to see, if any are left then."""

    def names(plan: _Plan) -> str:
        mesh = gltf.item("meshes", plan.node["mesh"])
        material = gltf.item("materials", plan.primitive["material"]) if "material" in plan.primitive else {}
        return f"{plan.title} {mesh.get('name')} {material.get('name')}"

    kept = [plan for plan in plans if not is_scaffold(names(plan))]
    if not any(plan.names for plan in kept) or len(kept) == len(plans):
        return plans
    gltf.note(LEFT_OUT)
    return kept


@dataclass
class _Patch:
    """One primitive, in the scene's space, of `used` alone among its `count` vertices.

    VRM avatars have one set of vertices for all primitives of a mesh. Until it is dressed, its triangles have the
    numbers of the file.
    """

    title: str
    count: int
    used: NDArray[np.uint32]
    positions: Floats
    normals: Floats
    triangles: NDArray[np.uint32]
    deltas: dict[str, Floats] = field(default_factory=dict)
    colours: Floats = field(default_factory=lambda: np.zeros((0, 4), np.float32))
    material: Material | None = None
    texcoords: Floats | None = None


def _primitives(gltf: GltfFile, node: Json, matrix: Matrix) -> list[_Plan]:
    mesh = gltf.item("meshes", node["mesh"])
    title = shown(str(node.get("name") or mesh.get("name") or f"mesh {node['mesh']}"))
    drawn = [
        item for item in gltf.parts(mesh, "primitives") if item.get("mode", _TRIANGLES) in (_TRIANGLES, _STRIP, _FAN)
    ]
    counts = {len(gltf.parts(primitive, "targets")) for primitive in drawn}
    if len(counts) > 1:
        raise gltf.fail(f"the parts of mesh “{title}” have different numbers of morph targets {sorted(counts)}.")
    names, named = _names(gltf, mesh, drawn, title) if drawn else ([], True)
    plans = []
    for number, primitive in enumerate(drawn):
        own = primitive.get("extras")
        part = own.get("part") if isinstance(own, dict) else None
        part = str(part or _called(gltf, primitive, f"{title} {number + 1}" if number else title))
        plans.append(_Plan(node, matrix, primitive, names, part, named))
    return plans


def _called(gltf: GltfFile, primitive: Json, title: str) -> str:
    """The name of a part; a tongue's begins with that, whatever the mesh is called: a cut-away leaves it whole."""
    material = gltf.item("materials", primitive["material"]) if "material" in primitive else {}
    for name in (str(material.get("name", "")), title):
        plain = name.casefold()
        if "tongue" in plain and not any(other in plain for other in ("teeth", "tooth", "gum", "mouth")):
            return title if title.casefold().startswith("tongue") else f"tongue ({title})"
    return title


def _names(gltf: GltfFile, mesh: Json, drawn: list[Json], title: str) -> tuple[list[str], bool]:
    """One name for each morph target of a mesh, no two alike, and whether they are the file's."""
    targets = gltf.parts(drawn[0], "targets")
    names: object = None
    for holder in (mesh, drawn[0]):
        extras = holder.get("extras")
        names = names or (extras.get("targetNames") if isinstance(extras, dict) else None)
    if not isinstance(names, list):
        names = _scattered_names(gltf, targets)
    named = isinstance(names, list) or not targets
    if not isinstance(names, list):
        names = [f"target {number}" for number in range(len(targets))]
    if len(names) != len(targets):
        raise gltf.fail(
            f"mesh “{title}” has {len(targets)} morph targets but names {len(names)}; export the file again."
        )
    once: dict[str, None] = {}
    for name in map(str, names):
        free, number = name, 2
        while free in once:
            free, number = f"{name} ({number})", number + 1
        if free != name:
            gltf.note(f"Mesh “{title}” has several shapes named “{shown(name)}”: the later ones are numbered.")
        once[free] = None
    return list(once), named


def _scattered_names(gltf: GltfFile, targets: list[Json]) -> list[str] | None:
    """Names that each target has by itself, as older avatars have them, or its accessor; None where any has none."""
    held = [target.get("extras", target.get("extra")) for target in targets]
    names = [holder.get("name") if isinstance(holder, dict) else None for holder in held]
    if not all(names):
        names = [
            gltf.item("accessors", target["POSITION"]).get("name") if "POSITION" in target else None
            for target in targets
        ]
    told = [str(name) for name in names if name]
    return told if len(set(told)) == len(targets) else None


def _expressions(gltf: GltfFile, plans: list[_Plan], shapes: tuple[str, ...]) -> dict[str, Mapping[str, float]]:
    """What a VRM makes of the shapes that were read."""
    names = {plan.node["mesh"]: plan.names for plan in plans}
    made = expressions(gltf, lambda mesh: names.get(mesh, ()))
    return {name: mix for name, mix in made.items() if set(mix) <= set(shapes)}


def _patch(gltf: GltfFile, scene: Scene, plan: _Plan, step: Steps) -> _Patch:
    """A primitive where the scene puts it; not dressed yet."""
    primitive, title = plan.primitive, plan.title
    attributes, targets = gltf.part(primitive, "attributes"), gltf.parts(primitive, "targets")
    count = gltf.count(attributes["POSITION"])
    _same_counts(gltf, title, count, attributes, targets)
    draco.unpack(gltf, primitive)
    place = scene.placement(plan.node, plan.matrix, attributes, count)
    positions = gltf.read(attributes["POSITION"], "VEC3").astype(np.float32)
    triangles = _triangles(gltf, primitive, count, title)
    if count and np.median(np.linalg.det(place[..., :3, :3])) < 0:
        triangles = triangles[:, ::-1]
    positions, normals = _move(place, positions, 1), np.zeros_like(positions)
    if "NORMAL" in attributes:
        normals = gltf.read(attributes["NORMAL"], "VEC3").astype(np.float32)
        normals = _unit(_move(np.linalg.pinv(place[..., :3, :3]).swapaxes(-1, -2), normals, 0))
    used = np.unique(triangles)
    patch = _Patch(title, count, used, _only(used, positions), _only(used, normals), triangles)
    for name, target in zip(plan.names, targets, strict=True):
        if "POSITION" in target:
            patch.deltas[name] = _only(used, _move(place, gltf.read(target["POSITION"], "VEC3").astype(np.float32), 0))
        step()
    step()
    return patch


def _dress(gltf: GltfFile, patches: list[_Patch], plans: list[_Plan], step: Steps) -> tuple[Texture, ...]:
    """Give every patch its colours, and what lies on it; all that lies on them."""
    materials = Materials(gltf)
    # what moves first: should the pictures be too many, those of the face stay largest
    for patch, plan in sorted(zip(patches, plans, strict=True), key=lambda both: not both[0].deltas):
        surface = materials.of(plan.primitive, plan.title, patch.count, patch.triangles)
        number = np.zeros(patch.count, np.uint32)
        number[patch.used] = np.arange(len(patch.used), dtype=np.uint32)
        patch.triangles = number[patch.triangles[surface.shown]]
        patch.colours, patch.material = _only(patch.used, surface.colours), surface.material
        patch.texcoords = None if surface.texcoords is None else _only(patch.used, surface.texcoords)
        step()
    return materials.album.textures()


def _only(used: NDArray[np.uint32], values: Floats) -> Floats:
    """The values of those vertices; themselves when they are all."""
    return values if len(used) == len(values) else values[used]


def _same_counts(gltf: GltfFile, title: str, count: int, attributes: Json, targets: list[Json]) -> None:
    for what in (attributes, *targets):
        for key, index in what.items():
            if key in ("extra", "extras"):  # not in the standard; older avatars name their targets there
                continue
            if gltf.count(index) != count:
                raise gltf.fail(f"mesh “{title}” has {count:,} vertices but {gltf.count(index):,} values of {key}.")


def _move(place: Matrix, vectors: Floats, w: int) -> Floats:
    turn = place[..., :3, :3]
    turned = vectors @ turn.T if place.ndim == 2 else np.einsum("nij,nj->ni", turn, vectors)
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


def _person(gltf: GltfFile, plans: list[_Plan], expressions_among: Expressions) -> dict[str, float]:
    """What of the shapes is of the person: how much of it stands in the neutral face."""
    names = tuple(dict.fromkeys(name for plan in plans for name in plan.names))
    spoken = {shape for mix in _expressions(gltf, plans, names).values() for shape in mix}
    return set_shapes(gltf, [(plan.node, plan.names) for plan in plans], {*expressions_among(names), *spoken})


def _join(
    gltf: GltfFile, patches: list[_Patch], textures: tuple[Texture, ...], person: Mapping[str, float], step: Steps
) -> Face:
    sizes = [len(patch.positions) for patch in patches]
    shapes = tuple(dict.fromkeys(name for patch in patches for name in patch.deltas))
    if not shapes:
        raise gltf.fail("its morph targets move nothing; export the face with shape keys.")
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
    parts = _parts(patches)
    stored = np.concatenate([patch.normals for patch in patches])
    positions, stored = with_shapes(person, shapes, deltas, positions, triangles, stored)
    normals, normal_deltas = shape_normals(positions, triangles, deltas, stored, step)
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
        parts=parts,
        camera=frame(positions),
        textures=textures,
        materials={name: p.material for name, p in zip(parts, patches, strict=True) if p.material is not None},
        texcoords=_texcoords(patches) if textures else None,
    )


def _texcoords(patches: list[_Patch]) -> Floats:
    """(n, 2), zero where no picture lies."""
    plain = (np.zeros((len(p.positions), 2), np.float32) if p.texcoords is None else p.texcoords for p in patches)
    return np.concatenate(list(plain))


def _parts(patches: list[_Patch]) -> dict[str, tuple[int, int]]:
    """One part for each patch, in their order."""
    parts: dict[str, tuple[int, int]] = {}
    first = 0
    for patch in patches:
        title, number = patch.title, 2
        while title in parts:
            title, number = f"{patch.title} ({number})", number + 1
        parts[title] = (first, len(patch.triangles))
        first += len(patch.triangles)
    return parts
