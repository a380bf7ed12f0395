"""Faces into picture files: PNG frames and film strips, without Qt."""

from __future__ import annotations

import io
import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from core_pipeline.faces.face import Face
from core_pipeline.faces.idle import enliven
from core_pipeline.faces.render import FaceRenderer, Pixels
from core_pipeline.faces.render_context import Platform
from core_pipeline.faces.view import View
from core_pipeline.files.atomic import write_atomically

_qt: object = None


class FaceFrames:
    """Draws one face at pose weights.

    poses  the order of the weights
    size   (width, height) in pixels
    view   the face's own camera
    """

    def __init__(self, face: Face, poses: tuple[str, ...], size: tuple[int, int]) -> None:
        self.size = size
        self.view = View.on(face)
        self._shapes = face.shapes
        self._matrix = face.retarget(poses)
        self._renderer = FaceRenderer(face, _platform())

    def pixels(self, weights: NDArray[np.floating], view: View | None = None, life: float | None = None) -> Pixels:
        """The face at weights (poses,), (h, w, 4) BGRA; drawn over by the next call. `life`: seconds, to blink."""
        amounts = weights.astype(np.float32) @ self._matrix
        if life is not None:
            enliven(amounts, self._shapes, life, speaking=True)
        return self._renderer.frame(amounts, view or self.view, self.size, full_quality=True)

    def picture(
        self, weights: NDArray[np.floating], view: View | None = None, life: float | None = None
    ) -> Image.Image:
        """The face at weights (poses,), from its own camera unless another view is given."""
        return Image.fromarray(self.pixels(weights, view, life)[..., 2::-1].copy())  # BGRA → RGB

    def save_strip(self, rows: NDArray[np.floating], path: Path) -> None:
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

    from ..gl_platform import make_platform

    global _qt  # noqa: PLW0603 - must live as long as the context
    _qt = QGuiApplication.instance() or QGuiApplication(["lipstitch"])
    return make_platform()


def save_png(picture: Image.Image, path: Path) -> None:
    """Write a picture; UserError when that fails."""
    out = io.BytesIO()
    picture.save(out, "PNG", compress_level=3)
    write_atomically(path, out.getvalue())
