"""Viseme poses: the FaceFX set of figure 4, six for the lips and three for the tongue.

The paper's text says "5 face shapes" and its figure shows 6; we keep the 6. Any other pose set works:
a curve set names its own.
"""

from collections.abc import Mapping
from types import MappingProxyType

FACEFX: tuple[str, ...] = ("open", "W", "ShCh", "PBM", "FV", "wide", "tBack", "tRoof", "tTeeth")

TONGUE = frozenset({"tBack", "tRoof", "tTeeth"})

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
