"""Pictures that lie on a face: what a user's rig brings. Our own faces carry their colours in their vertices."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

Wrap = Literal["repeat", "clamp", "mirror"]


@dataclass(frozen=True, eq=False)
class Texture:
    """A picture, and how it goes on beyond its edges.

    picture  (h, w, 4) uint8 sRGB and alpha, top row first
    wrap     across and down
    """

    picture: NDArray[np.uint8]
    wrap: tuple[Wrap, Wrap] = ("repeat", "repeat")

    def __post_init__(self) -> None:
        if (
            self.picture.ndim != 3
            or self.picture.shape[2] != 4
            or self.picture.dtype != np.uint8
            or not self.picture.size
        ):
            raise ValueError(f"a picture is (h, w, 4) uint8, not {self.picture.shape} {self.picture.dtype}")


@dataclass(frozen=True)
class Material:
    """What lies on one part of a face; its colours multiply the vertices'.

    texture  number of the picture in `Face.textures`
    cutoff   alpha below which nothing is there (0…1), 0 for an opaque part
    soft     alpha is how much is there (lashes, hair cards): edges fade instead of being cut
    """

    texture: int
    cutoff: float = 0.0
    soft: bool = False
