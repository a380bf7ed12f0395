"""A face's poses one by one, as the sheets show them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from core_pipeline.faces.face import Face
from core_pipeline.poses import MEANING, TONGUE_OPEN, of_tongue

Pose = tuple[str, str, Mapping[str, float]]  # name, what is said beside it, shape → amount


def poses_of(face: Face, poses: Sequence[str], *, idle: bool) -> list[Pose]:
    """What is shown, in order: the neutral face, the poses of a set, and with `idle` the shapes that are in no pose."""
    jaw = next((pose for pose in poses if "open" in pose.casefold()), None)
    found: list[Pose] = [("neutral", "", {})]
    for pose in poses:
        mix, note = face.mix(pose), MEANING.get(pose, "")
        if not mix:
            note = "not available on this face"
        elif jaw is not None and of_tongue(pose):
            opened = {shape: TONGUE_OPEN * amount for shape, amount in face.mix(jaw).items()}
            mix = {shape: opened.get(shape, 0) + mix.get(shape, 0) for shape in (*opened, *mix)}
            note = f"{note}; " * bool(note) + f"with {jaw} {TONGUE_OPEN:g}"
        found.append((pose, note, mix))
    if idle:
        used = {shape for pose in poses for shape in face.mix(pose)}
        found += [(shape, "", {shape: 1.0}) for shape in face.shapes if shape not in used]
    return found
