"""Where OpenGL comes from: EGL on Linux, an offscreen surface of Qt's on Windows and macOS."""

from __future__ import annotations

import sys

from PySide6.QtGui import QOffscreenSurface, QOpenGLContext, QSurfaceFormat


class QtPlatform:
    """An OpenGL 4.1 core context of Qt's. Construct in the GUI thread; all methods belong to the drawing thread.

    Some systems can only make a surface in the GUI thread; the context must be made where it is used.
    """

    def __init__(self) -> None:
        self._format = QSurfaceFormat()
        self._format.setVersion(4, 1)
        self._format.setProfile(QSurfaceFormat.OpenGLContextProfile.CoreProfile)
        self._format.setDepthBufferSize(24)
        self._surface = QOffscreenSurface()
        self._surface.setFormat(self._format)
        self._surface.create()
        self._context: QOpenGLContext | None = None

    def init_context(self) -> None:
        """Make the context; RuntimeError when there is none to be had."""
        if not self._surface.isValid():
            raise RuntimeError("Qt can make no offscreen surface")
        context = QOpenGLContext()
        context.setFormat(self._format)
        if not context.create():
            raise RuntimeError("Qt can make no OpenGL context")
        version = context.format().version()
        if version < (3, 3):
            raise RuntimeError(f"OpenGL {version[0]}.{version[1]}, but 3.3 is needed")
        self._context = context

    def make_current(self) -> None:
        """Bind it to the calling thread; RuntimeError when it was lost."""
        if self._context is None or not self._context.makeCurrent(self._surface):
            raise RuntimeError("Qt's OpenGL context was lost")

    def make_uncurrent(self) -> None:
        """Let go of it."""
        if self._context is not None:
            self._context.doneCurrent()

    def delete_context(self) -> None:
        """Free it."""
        self.make_uncurrent()
        self._context = None


def make_platform() -> QtPlatform | None:
    """What to hand to a `FaceRenderer` here; None on Linux, where it finds EGL itself. In the GUI thread."""
    return None if sys.platform.startswith("linux") else QtPlatform()
