"""Colours for faces without pictures: what the names of their parts suggest.

Teeth and eyes in the colour of skin could not be read, and the clear shells before an eye would hide it.
"""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

from core_pipeline.faces.face import Floats

Colour = tuple[float, float, float, float]

#: Linear RGB and gloss.
SKIN: Colour = (0.62, 0.42, 0.34, 0.35)
_CLEAR: Colour = (0.0, 0.0, 0.0, -1.0)

#: Words in the names of parts and materials, most telling first; a rig's own names, in English as they all are.
_BY_NAME: tuple[tuple[tuple[str, ...], Colour], ...] = (
    (("occlusion", "lacrimal", "tear", "cornea", "lens", "fluid", "eyeblend", "eye_blend", "wetness"), _CLEAR),
    (("teeth", "tooth"), (0.80, 0.76, 0.66, 0.6)),
    (("gum", "tongue", "mouthsocket", "mouth_socket", "mouthbag"), (0.45, 0.13, 0.12, 0.5)),
    (("pupil",), (0.01, 0.01, 0.01, 0.9)),
    (("iris",), (0.10, 0.16, 0.22, 0.8)),
    (("lash", "brow", "hair", "beard"), (0.06, 0.04, 0.03, 0.3)),
    (("sclera", "eyeball", "eyewhite"), (0.82, 0.80, 0.78, 0.8)),
    (("eyeleft", "eyeright", "lefteye", "righteye"), (0.82, 0.80, 0.78, 0.8)),
)
#: A part called an eye and nothing more, of whatever side: "helper-l-eye", "CC_Base_Eye", "Eye_L"; not a lid.
_EYE = re.compile(r"(?<![^\W_])eyes?(?=$|\s|[_.-](?:l|r|left|right|\d+)(?![^\W_]))")


def named_colour(name: str) -> Colour | None:
    """What a part's name suggests; None when it suggests nothing. Fourth place below 0: not to be seen."""
    plain = name.casefold()
    told = next((colour for words, colour in _BY_NAME if any(word in plain for word in words)), None)
    return told or (_BY_NAME[-1][1] if _EYE.search(plain) else None)


def linear(colours: NDArray[np.float64]) -> Floats:
    """sRGB, from 0 to 1 or to 255, as linear RGB."""
    unit = np.clip(colours / (255 if colours.max(initial=0) > 1 else 1), 0, 1)
    rgb: Floats = np.where(unit <= 0.04045, unit / 12.92, ((unit + 0.055) / 1.055) ** 2.4).astype(np.float32)
    return rgb
