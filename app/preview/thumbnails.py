"""Portraits for the face picker: drawn by our renderer in a thread of its own, kept on disk by what is in the files."""

from __future__ import annotations

import hashlib
import queue
import threading
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import numpy as np
from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QImage

from core_pipeline import faces
from core_pipeline.errors import UserError
from core_pipeline.faces.render.renderer import Figure, Renderer
from core_pipeline.faces.rigs import rig_cache
from core_pipeline.faces.view import View
from core_pipeline.files.atomic import write_atomically

from ..rigs import open_rig
from .gl_platform import make_platform
from .png import png

#: Pixels: sharp on a screen of double density.
SIDE = 192
#: Portraits kept; the ones used longest ago go first.
KEPT = 200
_CHUNK = 1 << 20


class Thumbnails(QObject):
    """ready(str, QImage): the portrait of the face at this path. One that cannot be read or drawn gets none."""

    ready = Signal(str, QImage)

    def __init__(self, folder: Path | None = None, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._folder = folder if folder is not None else rig_cache.user_cache().with_name("portraits")
        self._platform = make_platform()
        self._wishes: queue.SimpleQueue[Path | None] = queue.SimpleQueue()
        self._known: dict[Path, tuple[float, QImage]] = {}  # with the time of change
        self._thread: threading.Thread | None = None
        self._stopping = False

    def ask(self, path: Path) -> None:
        """Wish for a portrait; `ready` follows, at once when this face has been asked for before."""
        known = self._known.get(path)
        if known is not None and known[0] == _changed(path):
            self.ready.emit(str(path), known[1])
            return
        if self._thread is None:
            self._stopping = False
            self._thread = threading.Thread(target=self._work, name="portraits")
            self._thread.start()
        self._wishes.put(path)

    def stop(self) -> None:
        """End the thread and wait for it."""
        if self._thread is not None:
            self._stopping = True
            self._wishes.put(None)
            self._thread.join()
            self._thread = None

    def _work(self) -> None:
        renderer = Renderer(self._platform)
        while (path := self._wishes.get()) is not None and not self._stopping:
            try:
                changed = _changed(path)
                image = self._portrait(path, renderer)
            except (UserError, OSError, MemoryError):
                continue  # told where the face is opened
            self._known[path] = changed, image
            self.ready.emit(str(path), image)
        renderer.close()

    def _portrait(self, path: Path, renderer: Renderer) -> QImage:
        kept = self._folder / f"{_fingerprint(path)}.png"
        image = QImage(str(kept)) if kept.is_file() else QImage()
        if image.size().width() == SIDE:
            kept.touch()
            return image
        face = open_rig(path, cancelled=lambda: self._stopping).face
        figure = Figure(face, np.zeros(len(face.shapes), np.float32), View.on(face))
        pixels = renderer.draw([figure], (SIDE, SIDE))
        image = QImage(pixels.data, SIDE, SIDE, 4 * SIDE, QImage.Format.Format_RGB32).copy()
        self._keep(image, kept)
        return image

    def _keep(self, image: QImage, kept: Path) -> None:
        """A cache that cannot be written is no reason to fail."""
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
            write_atomically(kept, png(image))
            old = sorted(self._folder.glob("*.png"), key=lambda path: path.stat().st_mtime_ns, reverse=True)[KEPT:]
            for path in old:
                path.unlink()
        except (OSError, UserError):
            return


def _changed(path: Path) -> float:
    """When the newest of a face's files changed; 0 for none."""
    return max((file.stat().st_mtime for file in _files(path)), default=0.0)


def _files(path: Path) -> Iterator[Path]:
    """What a face's look comes from: its file, with what lies beside a .gltf; or the models of a folder."""
    if path.is_dir():
        yield from sorted(file for file in path.iterdir() if file.suffix.lower() in (".obj", ".mtl", ".glb", ".json"))
    elif path.suffix.lower() == ".gltf":
        yield from (path, *sorted(path.parent.glob("*.bin")))
    elif path.is_file():
        yield path


@cache
def _looks() -> bytes:
    """Of what reads and draws faces: another renderer makes other portraits of the same files."""
    digest, ours = hashlib.sha256(), Path(faces.__file__).parent
    for file in sorted((*ours.glob("*.py"), *ours.glob("r*/*.py"), *ours.glob("render/shaders/*"), Path(__file__))):
        digest.update(file.read_bytes())
    return digest.digest()


def _fingerprint(path: Path) -> str:
    """The same for the same contents, wherever they are. OSError when a file cannot be read."""
    digest = hashlib.sha256(_looks())
    for file in _files(path):
        digest.update(file.name.encode(errors="surrogateescape") if path.is_dir() else b"")
        with file.open("rb") as stream:
            while chunk := stream.read(_CHUNK):
                digest.update(chunk)
    return digest.hexdigest()[:32]
