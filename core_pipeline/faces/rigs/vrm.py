"""What a VRM avatar calls its expressions, and which morph targets make each, whatever these are named.

VRM 1.0 (VRMC_vrm) binds targets of nodes with weights up to 1; VRM 0 (VRM) binds targets of meshes with weights up
to 100. Both from their published schemas.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from core_pipeline.faces.rigs.gltf_file import GltfFile, Json

#: More than any avatar has.
_MOST = 1000

#: Number of a mesh → the names of its shapes.
Names = Callable[[int], Sequence[str]]


def expressions(gltf: GltfFile, names: Names) -> Mapping[str, Mapping[str, float]]:
    """Expression → {shape: amount}; empty for what is no VRM. UserError when the description is damaged."""
    about = gltf.part(gltf.json, "extensions")
    found = _vrm1(gltf, gltf.part(about, "VRMC_vrm")) if "VRMC_vrm" in about else _vrm0(gltf, gltf.part(about, "VRM"))
    made: dict[str, dict[str, float]] = {}
    for name, binds in found[:_MOST]:
        mix: dict[str, float] = {}
        for mesh, target, amount in binds[:_MOST]:
            shapes = names(mesh)
            if target < len(shapes):
                mix[shapes[target]] = amount
        if mix:
            made.setdefault(name, mix)
    return made


Bind = tuple[int, int, float]


def _vrm1(gltf: GltfFile, vrm: Json) -> list[tuple[str, list[Bind]]]:
    every = gltf.part(vrm, "expressions")
    found = []
    for kind in ("preset", "custom"):
        group = gltf.part(every, kind)
        for name in group:
            binds = []
            for bind in gltf.parts(gltf.part(group, name), "morphTargetBinds"):
                node = gltf.item("nodes", bind.get("node"))
                if "mesh" in node:
                    binds.append(_bind(gltf, {"mesh": node["mesh"], **bind}, 1.0))
            found.append((name, binds))
    return found


def _vrm0(gltf: GltfFile, vrm: Json) -> list[tuple[str, list[Bind]]]:
    found = []
    for group in gltf.parts(gltf.part(vrm, "blendShapeMaster"), "blendShapeGroups"):
        preset = str(group.get("presetName") or "unknown")
        name = preset if preset != "unknown" else str(group.get("name") or "")
        found.append((name, [_bind(gltf, bind, 100.0) for bind in gltf.parts(group, "binds")]))
    return found


def _bind(gltf: GltfFile, bind: Json, full: float) -> Bind:
    amount = float(gltf.floats([bind.get("weight", full)], 1)[0]) / full
    return gltf.whole(bind, "mesh"), gltf.whole(bind, "index"), min(max(amount, 0.0), 1.0)
