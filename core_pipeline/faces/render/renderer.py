"""The last arrow of the picture: faces at some amounts of their shapes → pixels."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ...errors import UserError
from ..face import Face, Floats
from ..looks import Look
from ..view import View, places
from .blend import Blend
from .context import Context, Platform, process_context

if TYPE_CHECKING:
    from .passes import FaceGL

Pixels = NDArray[np.uint8]


@dataclass(frozen=True, eq=False)
class Figure:
    """One face in a picture, and how it is seen.

    amounts  (k,) amount of each of the face's shapes, finite; copied. ValueError otherwise
    """

    face: Face
    amounts: Floats
    view: View

    def __post_init__(self) -> None:
        amounts = np.array(self.amounts, np.float32)
        if amounts.shape != (len(self.face.shapes),) or not np.isfinite(amounts).all():
            raise ValueError(f"amounts must be {len(self.face.shapes)} finite numbers, not {amounts!r}")
        object.__setattr__(self, "amounts", amounts)


class Renderer:
    """Draws faces into memory. Use one renderer from one thread; several may live in one process.

    OpenGL starts with the first frame, in the thread that asks for it. Without a `platform` the context
    of the process is used (EGL, Linux); a given one is used by this renderer alone and freed by `close`.
    """

    def __init__(self, platform: Platform | None = None) -> None:
        self._platform = platform
        self._context: Context | None = None
        self._gl: FaceGL | None = None
        self._blends: dict[Face, tuple[Blend, float]] = {}  # and the radius of the face

    @property
    def software(self) -> bool:
        """Whether the processor does the drawing; known after the first frame, and True until then."""
        return self._gl is None or self._gl.software

    def draw(
        self, figures: Sequence[Figure], size: tuple[int, int], full_quality: bool = True, look: Look | None = None
    ) -> Pixels:
        """(h, w, 4) uint8 BGRA, top row first. The same array again and again: copy what should last.

        figures       each in its place of `view.places`; the same face may stand in several
        size          (w, h) in pixels
        full_quality  smooth edges, the exact normals of the moved triangles, and their shadow; without, blended
                      normals, a shadow up to two pictures old, and smooth edges only on a graphics card
        Raises UserError when this machine cannot draw.
        """
        try:
            with self._start():
                return self._draw(figures, size, full_quality, look or Look())
        except (UserError, MemoryError):
            raise
        except Exception as error:
            # Whatever a driver comes up with, in whatever class: the editor goes on without a picture.
            raise UserError(_sentence(error, started=self._gl is not None)) from error

    def close(self) -> None:
        """Free what was made, in the thread that drew. The renderer may be used again afterwards."""
        if self._gl is not None and self._context is not None:
            with self._context:
                self._gl.delete()
            self._gl = None
        if self._context is not None and self._platform is not None:
            self._context.delete()
        self._context = None

    def _start(self) -> Context:
        if self._context is None:
            self._context = process_context() if self._platform is None else Context(self._platform)
        return self._context

    def _draw(self, figures: Sequence[Figure], size: tuple[int, int], full_quality: bool, look: Look) -> Pixels:
        if self._gl is None:
            from .passes import FaceGL

            self._gl = FaceGL()
        faces = {figure.face for figure in figures}
        self._gl.forget(but=faces)
        self._blends = {face: kept for face, kept in self._blends.items() if face in faces}
        width, height = (max(int(side), 1) for side in size)
        pixels: Pixels = np.empty((0, 0, 4), np.uint8)
        for band in self._gl.bands((width, height), smooth=full_quality or not self._gl.software):
            self._gl.begin(band)
            for figure, place in zip(figures, places((width, height), len(figures)), strict=False):
                face = figure.face
                if face not in self._blends:
                    self._blends[face] = Blend(face), float(np.linalg.norm(face.positions, axis=1).max(initial=0.0))
                blend, radius = self._blends[face]
                vertices = blend.exact(figure.amounts) if full_quality else blend.mixed(figure.amounts)
                self._gl.add(face, vertices, figure.view.fitted(place[2:]), radius, place, look, full_quality)
            pixels = self._gl.finish(look.background)
        return pixels


class FaceRenderer(Renderer):
    """Draws one face at a time."""

    def __init__(self, face: Face, platform: Platform | None = None) -> None:
        super().__init__(platform)
        self.face = face

    def frame(
        self,
        amounts: Floats,
        view: View,
        size: tuple[int, int],
        full_quality: bool = True,
        look: Look | None = None,
    ) -> Pixels:
        """As `draw`, of the face alone."""
        return self.draw([Figure(self.face, amounts, view)], size, full_quality, look)


def _sentence(error: Exception, started: bool) -> str:
    # PyOpenGL's own errors print the whole call; its description says what is wrong.
    call = getattr(getattr(error, "baseOperation", None), "__name__", "")
    told = getattr(error, "description", None) or (f"{call}: {getattr(error, 'err', '')}" if call else str(error))
    told = told.decode(errors="replace") if isinstance(told, bytes) else str(told)
    reason = " ".join(told.split())[:200] or type(error).__name__
    if started:
        return f"The face cannot be drawn: OpenGL stopped working ({reason}). Try again, or in a smaller window."
    if sys.platform.startswith("linux"):
        cure = "Install the packages libegl1 and libgl1-mesa-dri, or the driver of your graphics card."
    else:
        cure = "Install the current driver of your graphics card."
    return f"The face cannot be drawn: no OpenGL on this machine ({reason}). {cure}"
