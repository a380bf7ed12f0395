"""The thread that draws the face, so that the window never waits for pixels: latest wish wins."""

from __future__ import annotations

import threading
import time
from dataclasses import dataclass, replace

import numpy as np
from PySide6.QtCore import QCoreApplication, QObject, QThread, Signal
from PySide6.QtGui import QImage

from core_pipeline.errors import UserError
from core_pipeline.faces.face import Face, Floats
from core_pipeline.faces.render import FaceRenderer
from core_pipeline.faces.render_context import Platform
from core_pipeline.faces.view import Background, View

from .gl_platform import make_platform

#: A picture that has not changed for this long is drawn again in full quality.
SETTLE_SECONDS = 0.12


@dataclass(frozen=True, eq=False)
class _Wish:
    face: Face
    amounts: Floats
    view: View
    size: tuple[int, int]
    time: float
    background: Background
    full_quality: bool = False


class RenderWorker(QThread):
    """Draws wishes in its own thread. All methods may be called from any thread; construct in the GUI thread.

    While wishes keep coming they are drawn fast, and one that comes before the last was begun replaces
    it. When none came for 120 ms, the last is drawn again with smooth edges and exact normals.
    """

    frame = Signal(QImage, float, float)
    """A picture of its own memory, the media time of its wish, and the milliseconds that drawing took."""

    failed = Signal(str)
    """One sentence: why nothing can be drawn. Wishes are kept, but not drawn, until `retry`."""

    def __init__(self, parent: QObject | None = None, platform: Platform | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("face renderer")
        self._platform = platform if platform is not None else make_platform()
        self._changed = threading.Condition()  # guards everything below
        self._face: Face | None = None
        self._background = Background()
        self._wish: _Wish | None = None
        self._last: _Wish | None = None
        self._settle_at = 0.0  # when to draw `_last` again, on the monotonic clock
        self._broken = False
        self._stopping = False
        self._dropped = 0
        app = QCoreApplication.instance()
        if app is not None:
            app.aboutToQuit.connect(self.stop)  # Qt aborts when a running thread is destroyed

    @property
    def dropped(self) -> int:
        """How many wishes were replaced before they were drawn."""
        with self._changed:
            return self._dropped

    def set_face(self, face: Face) -> None:
        """The face that the next wishes are about. What was wished for the face before is forgotten."""
        with self._changed:
            self._face = face
            self._wish = self._last = None

    def set_background(self, background: Background) -> None:
        """What is behind the face from the next wish on."""
        with self._changed:
            self._background = background

    def request(self, amounts: Floats, view: View, size: tuple[int, int], time: float) -> None:
        """Wish for a frame: amounts (k,) of the face's shapes, size (w, h) in device pixels, media time in seconds.

        Without a face nothing happens. ValueError when `amounts` is not for this face.
        """
        with self._changed:
            if self._face is None:
                return
            amounts = np.array(amounts, np.float32)
            if amounts.shape != (len(self._face.shapes),):
                raise ValueError(f"{len(self._face.shapes)} amounts are needed, not {amounts.shape}")
            self._dropped += self._wish is not None
            self._wish = _Wish(self._face, amounts, view, size, time, self._background)
            self._changed.notify()

    def retry(self) -> None:
        """Try once more after `failed`."""
        with self._changed:
            self._broken = False
            self._changed.notify()

    def stop(self) -> None:
        """End the thread and wait for it. It may be started again."""
        with self._changed:
            self._stopping = True
            self._changed.notify()
        self.wait()
        with self._changed:
            self._stopping = False

    def run(self) -> None:
        """What the thread does; call `start`."""
        renderer: FaceRenderer | None = None
        while (wish := self._next()) is not None:
            began = time.perf_counter()
            try:
                if renderer is None:
                    renderer = FaceRenderer(wish.face, self._platform)
                elif renderer.face is not wish.face:
                    renderer.set_face(wish.face)
                pixels = renderer.frame(wish.amounts, wish.view, wish.size, wish.full_quality, wish.background)
            except UserError as error:
                renderer = None
                self._fail(wish)
                self.failed.emit(str(error))
                continue
            height, width = pixels.shape[:2]
            image = QImage(pixels.data, width, height, 4 * width, QImage.Format.Format_RGB32).copy()
            self.frame.emit(image, wish.time, 1e3 * (time.perf_counter() - began))
        if renderer is not None:
            renderer.close()

    def _next(self) -> _Wish | None:
        """Wait for what to draw next; None to stop."""
        with self._changed:
            while not self._stopping:
                wait: float | None = None
                if not self._broken:
                    if self._wish is not None:
                        self._last, self._wish = self._wish, None
                        self._settle_at = time.monotonic() + SETTLE_SECONDS
                        return self._last
                    if self._last is not None:
                        wait = self._settle_at - time.monotonic()
                        if wait <= 0.0:
                            settled, self._last = self._last, None
                            return replace(settled, full_quality=True)
                self._changed.wait(wait)
            return None

    def _fail(self, wish: _Wish) -> None:
        with self._changed:
            self._broken = True
            if self._wish is None and self._face is wish.face:
                self._wish = wish  # what `retry` draws
            self._last = None
