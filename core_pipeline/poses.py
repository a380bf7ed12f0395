"""Viseme poses: the FaceFX set of figure 4, six for the lips and three for the tongue.

The paper's text says "5 face shapes" and its figure shows 6; we keep the 6. Any other pose set works:
a curve set names its own.
"""

from collections.abc import Iterable, Mapping
from types import MappingProxyType

FACEFX: tuple[str, ...] = ("open", "W", "ShCh", "PBM", "FV", "wide", "tBack", "tRoof", "tTeeth")

TONGUE = frozenset({"tBack", "tRoof", "tTeeth"})
#: How far the mouth opens to show a pose of the tongue, which closed lips would hide.
TONGUE_OPEN = 0.3

#: What each pose means, for tooltips.
MEANING: Mapping[str, str] = MappingProxyType(
    {
        "open": "jaw wide, corners drop slightly",
        "W": "lips rounded as for a whistle",
        "ShCh": "teeth just touch, lips pursed, teeth shown",
        "PBM": "lips sealed",
        "FV": "lower lip behind the upper teeth",
        "wide": "corners out, upper lip a little up",
        "tBack": "tongue raised at the back",
        "tRoof": "tongue tip on the roof of the mouth",
        "tTeeth": "tongue between the teeth",
    }
)


def of_tongue(pose: str) -> bool:
    """Whether a pose moves the tongue: one of ours, or one that says so."""
    return pose in TONGUE or "tongue" in pose.casefold()


def shown_alone(pose: str, poses: Iterable[str]) -> dict[str, float]:
    """Weights that show one pose of a set, pose → weight; for the tongue the mouth opens a little."""
    jaw = next((other for other in poses if "open" in other.casefold()), None)
    return {pose: 1.0, jaw: TONGUE_OPEN} if jaw is not None and of_tongue(pose) else {pose: 1.0}
