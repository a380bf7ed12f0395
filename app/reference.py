"""Our own face in the pose that a user's face is being taught: drawn small, when another one is asked for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QImage

from core_pipeline.errors import UserError
from core_pipeline.faces import face_folder
from core_pipeline.faces.face import Camera, Face
from core_pipeline.faces.view import View

from . import resources
from .render_worker import RenderWorker

#: So much of the face's own distance lets the mouth fill a small picture.
_NEAR = 0.48


class Reference(QObject):
    """picture(QImage, title): the pose asked for; a null image when none of our faces can make it."""

    picture = Signal(QImage, str)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._faces: list[Face] = []
        self._title = ""
        self._asked = 0  # the number of the latest wish: a picture of an earlier one may come after it
        self._worker = RenderWorker(self)
        self._worker.frame.connect(self._frame)
        self._worker.failed.connect(lambda _: self.picture.emit(QImage(), ""))
        self._shown: Face | None = None

    def ask(self, pose: str, weights: Mapping[str, float], size: int) -> None:
        """Draw `pose` by pose → weight as a square of `size` pixels; `picture` follows."""
        face = next((face for face in self._ours() if face.mix(pose)), None)
        self._asked += 1
        if face is None:
            self.picture.emit(QImage(), "")
            return
        self._title = self.tr("{0} on our face {1}").format(pose, face.title)
        if face is not self._shown:
            self._shown = face
            self._worker.set_face(face)
        if not self._worker.isRunning():
            self._worker.start()
        amounts = np.array(list(weights.values()), np.float32) @ face.retarget(tuple(weights))
        self._worker.request(amounts, View.of(_mouth_camera(face)), (size, size), float(self._asked))

    def stop(self) -> None:
        """Stop drawing; waits for the thread."""
        self._worker.stop()

    def _ours(self) -> list[Face]:
        if not self._faces:
            try:
                self._faces = [face_folder.load(folder) for folder in resources.characters()]
            except UserError:
                return []  # said where a face is opened; here the picture is just not there
        return self._faces

    def _frame(self, image: QImage, number: float, _milliseconds: float) -> None:
        if number == self._asked:
            self.picture.emit(image, self._title)


def _mouth_camera(face: Face) -> Camera:
    """Nearer than usual, with the mouth in the middle."""
    if "lips" not in face.parts:
        return face.camera
    first, count = face.parts["lips"]
    lips = face.positions[face.triangles[first : first + count]].reshape(-1, 3)
    x, y, _ = lips.mean(axis=0).tolist()
    camera = face.camera
    return replace(camera, target=(x, y, camera.target[2]), distance=_NEAR * camera.distance)
