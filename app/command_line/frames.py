"""Faces into picture files: PNG frames and film strips, without Qt."""

from __future__ import annotations

import io
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from core_pipeline.faces import idle
from core_pipeline.faces.face import Face
from core_pipeline.faces.looks import TURN_SECONDS, Angle, Look
from core_pipeline.faces.render.context import Platform
from core_pipeline.faces.render.renderer import Figure, Pixels, Renderer
from core_pipeline.faces.view import View
from core_pipeline.files.atomic import write_atomically

_qt: object = None

Row = NDArray[np.floating]


class GroupFrames:
    """Draws one or several faces side by side at pose weights.

    cast   each face, and the order of its weights
    size   (width, height) in pixels
    angle  None: the faces' own cameras
    """

    def __init__(
        self,
        cast: Sequence[tuple[Face, tuple[str, ...]]],
        size: tuple[int, int],
        look: Look | None = None,
        angle: Angle | None = None,
    ) -> None:
        self.size = size
        self.look = look or Look()
        self.views = [View.on(face, angle) for face, _ in cast]
        self._cast = [(face, face.retarget(poses)) for face, poses in cast]
        self._renderer = Renderer(_platform())

    def pixels(self, weights: Sequence[Row], life: float | None = None, turned: float | None = None) -> Pixels:
        """The faces at weights (poses,) each, (h, w, 4) BGRA; drawn over by the next call.

        life    seconds at which each lives a life of its own, to blink
        turned  seconds on the turntable
        """
        figures = []
        for number, ((face, matrix), view, row) in enumerate(zip(self._cast, self.views, weights, strict=True)):
            amounts = row.astype(np.float32) @ matrix
            if life is not None:
                idle.enliven(amounts, face, life + number * idle.APART, speaking=True)
            seen = view if turned is None else view.turned(360.0 * turned / TURN_SECONDS)
            figures.append(Figure(face, amounts, seen))
        return self._renderer.draw(figures, self.size, look=self.look)

    def picture(self, weights: Sequence[Row], life: float | None = None, turned: float | None = None) -> Image.Image:
        """The same as a picture of its own memory."""
        return Image.fromarray(self.pixels(weights, life, turned)[..., 2::-1].copy())  # BGRA → RGB


class FaceFrames:
    """Draws one face at pose weights, from wherever it is asked to; as `GroupFrames` otherwise."""

    def __init__(self, face: Face, poses: tuple[str, ...], size: tuple[int, int], look: Look | None = None) -> None:
        self._group = GroupFrames([(face, poses)], size, look)
        self.view = self._group.views[0]

    @property
    def size(self) -> tuple[int, int]:
        """(width, height) in pixels."""
        return self._group.size

    def pixels(self, weights: Row, view: View | None = None, life: float | None = None) -> Pixels:
        """The face at weights (poses,), from its own camera unless another view is given."""
        self._group.views[0] = view or self.view
        return self._group.pixels([weights], life)

    def picture(self, weights: Row, view: View | None = None) -> Image.Image:
        """The same as a picture of its own memory."""
        return Image.fromarray(self.pixels(weights, view)[..., 2::-1].copy())  # BGRA → RGB

    def save_strip(self, rows: Row, path: Path) -> None:
        """Frames (n, poses) side by side, six in a row."""
        pictures = [self.picture(row) for row in rows]
        columns = min(6, len(pictures))
        width, height = self.size
        strip = Image.new("RGB", (columns * width, -(-len(pictures) // columns) * height))
        for i, picture in enumerate(pictures):
            strip.paste(picture, (i % columns * width, i // columns * height))
        save_png(strip, path)


def _platform() -> Platform | None:
    """Where OpenGL comes from: on Linux the renderer finds EGL by itself, elsewhere only Qt can make a context."""
    on_linux = sys.platform.startswith("linux")
    if on_linux:
        return None
    from PySide6.QtGui import QGuiApplication

    from ..preview.gl_platform import make_platform

    global _qt  # noqa: PLW0603 - must live as long as the context
    _qt = QGuiApplication.instance() or QGuiApplication(["lipstitch"])
    return make_platform()


def save_png(picture: Image.Image, path: Path) -> None:
    """Write a picture; UserError when that fails."""
    out = io.BytesIO()
    picture.save(out, "PNG", compress_level=3)
    write_atomically(path, out.getvalue())
