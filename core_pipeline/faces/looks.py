"""Named looks of the preview and of clips: what stands behind a face, how it is lit, where it is seen from.

All light is fixed to the camera: the face turns, the studio does not.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

Colour = tuple[float, float, float]


@dataclass(frozen=True)
class Background:
    """What is behind the face, and the light that comes with it.

    top, bottom  of a vertical gradient, sRGB in 0…1
    glow         how much lighter a pool behind the head is, 0 for none
    checker      side of a check in parts of the picture's shorter side, between the two colours; 0 for a gradient
    key          linear RGB of the main light; sky and bounce fill from above and below; rim from behind
    """

    top: Colour = (0.205, 0.230, 0.262)
    bottom: Colour = (0.086, 0.094, 0.106)
    glow: float = 0.45
    checker: float = 0.0
    key: Colour = (1.62, 1.42, 1.24)
    sky: Colour = (0.235, 0.275, 0.335)
    bounce: Colour = (0.205, 0.14, 0.11)
    rim: Colour = (2.3, 3.3, 4.9)


@dataclass(frozen=True)
class Light:
    """Where the main light stands, and the one behind: towards them, in the camera's space, of any length."""

    key_from: tuple[float, float, float] = (-0.46, 0.64, 0.62)
    rim_from: tuple[float, float, float] = (0.7276, 0.4366, -0.5292)


@dataclass(frozen=True)
class Look:
    """Behind and before the face."""

    background: Background = Background()
    light: Light = Light()


@dataclass(frozen=True)
class Angle:
    """Where the camera stands, in degrees from the face's own view; `mouth`: near, with the mouth in the middle."""

    yaw: float = 0.0
    pitch: float = 0.0
    mouth: bool = False


def _neutral(top: Colour, bottom: Colour, checker: float = 0.0) -> Background:
    """In white light, which leaves every colour as it is."""
    key, sky, bounce, rim = ((grey, grey, grey) for grey in (1.5, 0.27, 0.16, 0.8))
    return Background(top, bottom, 0.0, checker, key, sky, bounce, rim)


_GREY, _LIGHT, _DARK = (0.36, 0.36, 0.36), (0.46, 0.46, 0.46), (0.34, 0.34, 0.34)
_GREEN = (0.0, 0.694, 0.251)  # of screens for keying

BACKGROUNDS: Mapping[str, Background] = MappingProxyType(
    {
        "studio": Background(),
        "daylight": Background(
            top=(0.52, 0.68, 0.84),
            bottom=(0.80, 0.85, 0.86),
            glow=0.10,
            key=(1.75, 1.62, 1.42),
            sky=(0.36, 0.43, 0.52),
            bounce=(0.26, 0.24, 0.20),
            rim=(1.6, 1.9, 2.3),
        ),
        "night": Background(
            top=(0.045, 0.06, 0.12),
            bottom=(0.015, 0.02, 0.045),
            glow=0.9,
            key=(1.12, 1.24, 1.62),
            sky=(0.10, 0.13, 0.22),
            bounce=(0.13, 0.07, 0.04),
            rim=(3.4, 2.0, 0.9),
        ),
        "grey": _neutral(_GREY, _GREY),
        "checker": _neutral(_LIGHT, _DARK, checker=1 / 16),
        "green": _neutral(_GREEN, _GREEN),
    }
)

LIGHTS: Mapping[str, Light] = MappingProxyType(
    {
        "left": Light(),
        "right": Light((0.46, 0.64, 0.62), (-0.7276, 0.4366, -0.5292)),
        "top": Light((0.0, 0.94, 0.34), (0.5, 0.55, -0.67)),
    }
)

#: Left and right are the picture's: towards "left" the face looks to the left.
ANGLES: Mapping[str, Angle] = MappingProxyType(
    {
        "front": Angle(),
        "left": Angle(38.0),
        "right": Angle(-38.0),
        "profile": Angle(90.0),
        "mouth": Angle(mouth=True),
    }
)

#: Seconds of one turn of the turntable.
TURN_SECONDS = 12.0
