"""The OpenGL context in which faces are drawn, and who may use it when.

One context serves the whole process (`process_context`). A context belongs to one thread at a time, so
every use takes its lock, makes it current and lets go of it again: the editor's thread and renderers
in other threads take turns. It is never deleted: deleting one EGL context terminates the display under
all others.

Importing this module loads no OpenGL, but settles how it will be loaded.
"""

from __future__ import annotations

import os
import sys
import threading
import types
from typing import Protocol

if sys.platform.startswith("linux"):
    os.environ.setdefault("PYOPENGL_PLATFORM", "egl")  # read once, at the first import of OpenGL
if "pyrender.viewer" not in sys.modules:
    # pyrender's window would load pyglet, tkinter and the X libraries; we only draw into memory.
    _viewer = types.ModuleType("pyrender.viewer")
    _viewer.__dict__["Viewer"] = None
    sys.modules["pyrender.viewer"] = _viewer


class Platform(Protocol):
    """What makes an OpenGL context here: pyrender's own platforms, or the editor's for Windows and macOS."""

    def init_context(self) -> None:
        """Make the context, in the thread that will draw."""

    def make_current(self) -> None:
        """Bind the context to the calling thread."""

    def make_uncurrent(self) -> None:
        """Let go of it, so that another thread may bind it."""

    def delete_context(self) -> None:
        """Free it."""


class Context:
    """A platform's context behind a lock: `with context:` binds it to the calling thread."""

    def __init__(self, platform: Platform) -> None:
        self._platform = platform
        self._lock = threading.RLock()
        self._depth = 0
        self._made = False

    def __enter__(self) -> None:
        self._lock.acquire()
        try:
            if not self._made:
                self._platform.init_context()
                self._made = True
            if self._depth == 0:
                self._platform.make_current()
        except BaseException:
            self._lock.release()
            raise
        self._depth += 1

    def __exit__(self, *_: object) -> None:
        self._depth -= 1
        try:
            if self._depth == 0:
                self._platform.make_uncurrent()
        finally:
            self._lock.release()

    def delete(self) -> None:
        """Free the context; only for one that a single renderer owns."""
        with self._lock:
            if self._made:
                self._platform.delete_context()
                self._made = False


def _egl() -> Platform:
    """The first EGL device that gives an OpenGL 4.1 core context; EGL_DEVICE_ID asks for one by number."""
    from OpenGL import EGL
    from pyrender.platforms import egl

    class Egl(egl.EGLPlatform):  # type: ignore[misc]
        def make_current(self) -> None:
            EGL.eglBindAPI(EGL.EGL_OPENGL_API)  # a setting of the thread, and another thread made the context
            super().make_current()

        def make_uncurrent(self) -> None:  # the original keeps the context bound
            EGL.eglMakeCurrent(self._egl_display, EGL.EGL_NO_SURFACE, EGL.EGL_NO_SURFACE, EGL.EGL_NO_CONTEXT)

        def __del__(self) -> None:  # the original terminates the display
            pass

    wanted = os.environ.get("EGL_DEVICE_ID")
    devices = [egl.get_device_by_index(int(wanted))] if wanted else (egl.query_devices() or [egl.EGLDevice()])
    problem: Exception = RuntimeError("no EGL device")
    for device in devices:
        platform: Platform = Egl(16, 16, device=device)
        try:
            platform.init_context()
        except Exception as error:  # noqa: BLE001  (a device may lack rights, a driver, or OpenGL: the next may not)
            problem = error
        else:
            platform.make_uncurrent()
            return _Made(platform)
    raise problem


class _Made:
    """A platform whose context is there already."""

    def __init__(self, platform: Platform) -> None:
        self.make_current = platform.make_current
        self.make_uncurrent = platform.make_uncurrent

    def init_context(self) -> None:
        pass

    def delete_context(self) -> None:
        pass


_process: Context | None = None
_process_lock = threading.Lock()


def process_context() -> Context:
    """The one context of this process, made at the first call. Raises what EGL raises when there is none."""
    global _process  # noqa: PLW0603
    with _process_lock:
        if _process is None:
            _process = Context(_egl())
        return _process
