"""What is said over the picture while a face is read, and when it cannot be: with a way out of either."""

from __future__ import annotations

from PySide6.QtCore import QObject

from core_pipeline.faces.open_face import Opened

from .. import resources
from .character import Character
from .parts import Parts


class FaceNews(QObject):
    """Joins the readers of faces and the notice in the preview; the status bar says the same."""

    def __init__(self, parts: Parts, character: Character, parent: QObject) -> None:
        super().__init__(parent)
        self._window = parts.window
        self._preview = parts.preview
        self._faces = parts.faces
        self._character = character
        self._notice = parts.window.face_view.notice
        self._offers = False  # the mapping of a face that can make no pose
        for asks, reads in ((character, self._faces), (character.company, character.company)):
            asks.asked.connect(self._notice.hide)
            reads.reading.connect(self._tell)
            reads.failed.connect(self._warn)
        self._faces.opened.connect(self._opened)
        character.company.arrived.connect(lambda _: self._done())
        self._notice.wanted.connect(self._help)

    @property
    def _reads(self) -> bool:
        return self._faces.reads or self._character.company.reads

    def _tell(self, sentence: str) -> None:
        if not self._reads:
            return  # it was on its way when the reading was cancelled
        self._notice.tell(sentence, self.tr("Cancel"))
        self._window.hint_label.setText(sentence)

    def _warn(self, sentence: str) -> None:
        self._offers = False
        self._notice.warn(sentence)
        self._window.hint_label.setText(sentence)

    def _opened(self, opened: Opened) -> None:
        if self._offers:
            self._offers = False
            self._notice.hide()
        self._done()
        shown = self._preview.face is not None and self._preview.face.positions is opened.face.positions
        if shown and not opened.retarget.poses and self._faces.path not in resources.characters():
            self._offers = True
            self._notice.warn(opened.notes[0], self.tr("Face Mapping"))

    def _done(self) -> None:
        """What was said of the reading is over, once nothing more is read."""
        if not (self._notice.warns or self._reads):
            self._notice.hide()

    def _help(self) -> None:
        if self._offers:
            self._offers = False
            self._notice.hide()
            self._window.mapping_dock.show()
            self._window.mapping_dock.raise_()
        else:
            self._character.cancel()
            self._notice.hide()
            self._window.hint_label.setText(self.tr("Opening was cancelled."))
