"""Faces into picture files: PNG frames and film strips, without Qt."""

from __future__ import annotations

import io
import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from core_pipeline.faces.face import Face
from core_pipeline.faces.render import FaceRenderer
from core_pipeline.faces.render_context import Platform
from core_pipeline.faces.view import View
from core_pipeline.files.atomic import write_atomically

_qt: object = None


class FaceFrames:
    """Draws one face at pose weights.

    poses  the order of the weights; size  (width, height) in pixels
    """

    def __init__(self, face: Face, poses: tuple[str, ...], size: tuple[int, int]) -> None:
        self._matrix = face.retarget(poses)
        self._renderer = FaceRenderer(face, _platform())
        self._view = View.of(face.camera)
        self._size = size

    def picture(self, weights: NDArray[np.floating]) -> Image.Image:
        """The face at weights (poses,)."""
        amounts = weights.astype(np.float32) @ self._matrix
        pixels = self._renderer.frame(amounts, self._view, self._size, full_quality=True)
        return Image.fromarray(pixels[..., 2::-1].copy())  # BGRA → RGB

    def save(self, weights: NDArray[np.floating], path: Path) -> None:
        """One frame as PNG; UserError when writing fails."""
        _save_png(self.picture(weights), path)

    def save_strip(self, rows: NDArray[np.floating], path: Path) -> None:
        """Frames (n, poses) side by side, six in a row."""
        pictures = [self.picture(row) for row in rows]
        columns = min(6, len(pictures))
        width, height = self._size
        strip = Image.new("RGB", (columns * width, -(-len(pictures) // columns) * height))
        for i, picture in enumerate(pictures):
            strip.paste(picture, (i % columns * width, i // columns * height))
        _save_png(strip, path)


def _platform() -> Platform | None:
    """Where OpenGL comes from: on Linux the renderer finds EGL by itself, elsewhere only Qt can make a context."""
    on_linux = sys.platform.startswith("linux")
    if on_linux:
        return None
    from PySide6.QtGui import QGuiApplication

    from .gl_platform import make_platform

    global _qt  # noqa: PLW0603 - must live as long as the context
    _qt = QGuiApplication.instance() or QGuiApplication(["lipstitch"])
    return make_platform()


def _save_png(picture: Image.Image, path: Path) -> None:
    out = io.BytesIO()
    picture.save(out, "PNG", compress_level=3)
    write_atomically(path, out.getvalue())
