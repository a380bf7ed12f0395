"""A pose set of a rig's own: every shape that speaks becomes a pose, as on the paper's crab (section 5.3, figure 1).

What a pose does is guessed from its name, and constraints and priorities follow: lips that shut win over a mouth
that opens, corners cannot be out and in. A name that tells nothing is never constrained.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from core_pipeline.curve_set import CurveSet
from core_pipeline.errors import UserError
from core_pipeline.faces.face import Face
from core_pipeline.faces.retarget import normalised
from core_pipeline.settings import Constraint, Settings

#: More would be no set an animator could draw 441 bigrams with.
MAX_POSES = 100
#: Smoothing window, seconds, of what must not melt together: two closures stay two.
CLOSURE_WINDOW = 0.10

#: What moves beside speech: lids, gaze, brows, nose, ears, hair; and what shapes a head for good.
_SILENT = re.compile(
    r"(eye|lid|blink|wink|brow|gaze|look|pupil|iris|nose|sneer|ear[lr]?$|hair|cheeksquint|identity|neutral|basis)"
)
#: Role → how its poses are named, the most telling first.
_ROLES: tuple[tuple[str, re.Pattern[str]], ...] = (
    ("tongue", re.compile(r"(tongue|^t(back|roof|teeth)$|^visemet?h$|^visemedd$|^visemenn$)")),
    ("shut", re.compile(r"(shut|close|seal|press|^pbm$|^mbp$|^bmp$|pp$|explosive|together)")),
    ("bite", re.compile(r"(^fv$|ff$|bite|dental|lowerroll|rolllower)")),
    ("round", re.compile(r"(oo$|^w$|^uw?$|^oh?$|^ou$|whistle|pucker|round|purse|funnel|narrow|viseme[ou]$|tight)")),
    ("spread", re.compile(r"(wide|smile|stretch|grin|^ee$|^ih?$|visemei$)")),
    ("frown", re.compile(r"(frown|sad|depress)")),
    ("teeth", re.compile(r"(teeth|^shch$|^ch$|visemech$|affricate|sneer)")),
    ("open", re.compile(r"(open|jawdrop|^aa?$|^ah$|visemeaa$|mth_?a$)")),
)
#: From the one that gives way first to the one that always stays; between two of a role neither gives way.
_PRIORITY = ("tongue", "frown", "open", "spread", "teeth", "round", "bite", "shut")
_LIMITS: tuple[tuple[str, str, float], ...] = (
    ("open", "shut", 0.5),
    ("open", "bite", 0.5),
    ("tongue", "shut", 0.5),
    ("spread", "round", 0.7),
    ("frown", "spread", 0.5),
)


def role_of(pose: str) -> str:
    """What a pose does, one of tongue, frown, open, spread, teeth, round, bite, shut; empty when its name is silent."""
    name = normalised(pose)
    return next((role for role, pattern in _ROLES if pattern.search(name)), "")


def poses_of(face: Face) -> tuple[str, ...]:
    """The shapes that speak, in the rig's order, those of the tongue last. UserError when there are none."""
    speaking = [
        shape
        for shape, delta in zip(face.shapes, face.deltas, strict=True)
        if not _SILENT.search(normalised(shape)) and delta.any()
    ]
    if not speaking:
        raise UserError(f"{face.title}: none of its {len(face.shapes)} shapes moves the mouth; choose another rig.")
    if len(speaking) > MAX_POSES:
        raise UserError(f"{face.title}: {len(speaking)} shapes are more poses than a set may have ({MAX_POSES}).")
    return tuple(sorted(speaking, key=lambda shape: role_of(shape) == "tongue"))


def settings_for(poses: Sequence[str]) -> Settings:
    """Constraints, priorities and windows for poses as their names suggest; everything else as in the paper."""
    by_role: dict[str, list[str]] = {role: [] for role in _PRIORITY}
    for pose in poses:
        if role := role_of(pose):
            by_role[role].append(pose)
    constraints = tuple(
        Constraint(one, other, limit) for a, b, limit in _LIMITS for one in by_role[a] for other in by_role[b]
    )
    bound = {pose for constraint in constraints for pose in (constraint.a, constraint.b)}
    return Settings(
        windows={pose: CLOSURE_WINDOW for role in ("bite", "shut") for pose in by_role[role]},
        constraints=constraints,
        priorities=tuple(pose for role in _PRIORITY for pose in by_role[role] if pose in bound),
    )


def new_curve_set(face: Face) -> CurveSet:
    """An empty curve set over the face's own poses. UserError when it has none."""
    poses = poses_of(face)
    return CurveSet(name=face.title, poses=poses, settings=settings_for(poses))
