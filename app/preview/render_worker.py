"""The thread that draws the faces, so that the window never waits for pixels: latest wish wins."""

from __future__ import annotations

import threading
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace

from PySide6.QtCore import QCoreApplication, QObject, QThread, Signal
from PySide6.QtGui import QImage

from core_pipeline.errors import UserError
from core_pipeline.faces.looks import Look
from core_pipeline.faces.render.context import Platform
from core_pipeline.faces.render.renderer import Figure, Renderer

from .gl_platform import make_platform
from .pace import Pace

#: A picture that has not changed for this long is drawn again in full quality.
SETTLE_SECONDS = 0.09


@dataclass(frozen=True, eq=False)
class _Wish:
    figures: tuple[Figure, ...]
    size: tuple[int, int]
    time: float
    look: Look
    full_quality: bool = False


class RenderWorker(QThread):
    """Draws wishes in its own thread. All methods may be called from any thread; construct in the GUI thread.

    While wishes keep coming they are drawn fast, in a smaller picture where that takes too long, and one that
    comes before the last was begun replaces it. When none came for 90 ms, the last is drawn again in its full
    size with smooth edges and exact normals.
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

    def request(self, figures: Sequence[Figure], size: tuple[int, int], time: float, look: Look | None = None) -> None:
        """Wish for a picture of these faces: size (w, h) in device pixels, media time in seconds."""
        with self._changed:
            self._dropped += self._wish is not None
            self._wish = _Wish(tuple(figures), size, time, look or Look())
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
        renderer: Renderer | None = None
        pace = Pace()
        while (wish := self._next()) is not None:
            began = time.perf_counter()
            try:
                renderer = renderer or Renderer(self._platform)
                size = wish.size if wish.full_quality else pace.size(wish.size, _drawn(wish))
                pixels = renderer.draw(wish.figures, size, wish.full_quality, wish.look)
            except UserError as error:
                renderer = None
                self._fail(wish)
                self.failed.emit(str(error))
                continue
            height, width = pixels.shape[:2]
            image = QImage(pixels.data, width, height, 4 * width, QImage.Format.Format_RGB32).copy()
            took = time.perf_counter() - began
            if not wish.full_quality:
                pace.took(took)
            self.frame.emit(image, wish.time, 1e3 * took)
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
            if self._wish is None:
                self._wish = wish  # what `retry` draws
            self._last = None


def _drawn(wish: _Wish) -> tuple[object, ...]:
    """What makes a picture quick or slow to draw."""
    return (wish.size, *(figure.face for figure in wish.figures))
