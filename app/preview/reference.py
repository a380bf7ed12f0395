"""Our own face in the pose that a user's face is being taught: drawn small, when another one is asked for."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QImage

from core_pipeline.errors import UserError
from core_pipeline.faces import face_folder
from core_pipeline.faces.face import Face
from core_pipeline.faces.looks import ANGLES
from core_pipeline.faces.render.renderer import Figure
from core_pipeline.faces.view import View

from .. import resources
from .render_worker import RenderWorker


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

    def ask(self, pose: str, weights: Mapping[str, float], size: int) -> None:
        """Draw `pose` by pose → weight as a square of `size` pixels; `picture` follows."""
        face = next((face for face in self._ours() if face.mix(pose)), None)
        self._asked += 1
        if face is None:
            self.picture.emit(QImage(), "")
            return
        self._title = self.tr("{0} on our face {1}").format(pose, face.title)
        if not self._worker.isRunning():
            self._worker.start()
        amounts = np.array(list(weights.values()), np.float32) @ face.retarget(tuple(weights))
        figure = Figure(face, amounts, View.on(face, ANGLES["mouth"]))
        self._worker.request([figure], (size, size), float(self._asked))

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
