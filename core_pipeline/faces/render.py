"""The last arrow of the picture: a face at some amounts of its shapes → pixels."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..errors import UserError
from .blend import Blend
from .face import Face, Floats
from .render_context import Context, Platform, process_context
from .view import Background, View

if TYPE_CHECKING:
    from .render_gl import FaceGL

_SAMPLES = 4

Pixels = NDArray[np.uint8]


class FaceRenderer:
    """Draws a face into memory. Use one renderer from one thread; several may live in one process.

    OpenGL starts with the first frame, in the thread that asks for it. Without a `platform` the context
    of the process is used (EGL, Linux); a given one is used by this renderer alone and freed by `close`.
    """

    def __init__(self, face: Face, platform: Platform | None = None) -> None:
        self._platform = platform
        self._context: Context | None = None
        self._gl: FaceGL | None = None
        self.set_face(face)

    @property
    def face(self) -> Face:
        """The face that is drawn."""
        return self._face

    @property
    def software(self) -> bool:
        """Whether the processor does the drawing; known after the first frame, and True until then."""
        return self._gl is None or self._gl.software

    def set_face(self, face: Face) -> None:
        """Draw another face from the next frame on."""
        self._face = face
        self._blend = Blend(face)
        self._radius = float(np.linalg.norm(face.positions, axis=1).max(initial=0.0))
        self._sent = False

    def frame(
        self,
        amounts: Floats,
        view: View,
        size: tuple[int, int],
        full_quality: bool = True,
        background: Background | None = None,
    ) -> Pixels:
        """(h, w, 4) uint8 BGRA, top row first. The same array again and again: copy what should last.

        amounts       (k,) amount of each of the face's shapes, finite; ValueError otherwise
        size          (w, h) in pixels
        full_quality  smooth edges and the exact normals of the moved triangles; without, blended normals,
                      and smooth edges only on a graphics card
        Raises UserError when this machine cannot draw.
        """
        amounts = np.asarray(amounts, np.float32)
        if amounts.shape != (len(self._face.shapes),) or not np.isfinite(amounts).all():
            raise ValueError(f"amounts must be {len(self._face.shapes)} finite numbers, not {amounts!r}")
        background = background or Background()
        vertices = self._blend.exact(amounts) if full_quality else self._blend.mixed(amounts)
        try:
            with self._start():
                return self._draw(vertices, view, size, full_quality, background)
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

    def _draw(
        self, vertices: Floats, view: View, size: tuple[int, int], full_quality: bool, background: Background
    ) -> Pixels:
        if self._gl is None:
            from .render_gl import FaceGL

            self._gl = FaceGL(self._face)
        elif not self._sent:
            self._gl.set_face(self._face)
        self._sent = True
        return self._gl.draw(
            vertices,
            view,
            self._radius,
            size,
            _SAMPLES if full_quality or not self._gl.software else 0,
            background,
        )


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
