"""The face picker brought to life: our characters and the user's last rigs, with portraits as they are drawn."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject, QPoint, QRect
from PySide6.QtWidgets import QWidget

from widgets.preview.face_picker import Choice

from .. import resources
from ..preview.thumbnails import Thumbnails
from .character import Character
from .parts import Parts

#: Rigs remembered.
RECENT = 8


class FacePicking(QObject):
    """Joins the picker, the portraits and the faces in the picture."""

    def __init__(self, parts: Parts, character: Character, parent: QObject) -> None:
        super().__init__(parent)
        self._window = parts.window
        self._state = parts.state
        self._faces = parts.faces
        self._character = character
        self._picker = parts.window.face_picker
        self._place: int | None = 0  # of the face to change; None: one more
        self._thumbnails = Thumbnails(parent=self)
        self._thumbnails.ready.connect(self._picker.set_picture)
        actions = self._window.actions_
        actions.pick_face.triggered.connect(lambda _=False: self.change(0))
        actions.add_face.triggered.connect(lambda _=False: self.add())
        self._window.face_view.face_wanted.connect(self.change)
        self._window.preview_panel.add_wanted.connect(self.add)
        self._picker.picked.connect(lambda key: self._take(Path(key)))
        self._picker.file_wanted.connect(lambda: self._take(character.ask_file()))
        self._picker.folder_wanted.connect(lambda: self._take(character.ask_folder()))
        self._picker.forgotten.connect(self._forget)
        self._faces.opened.connect(lambda _: self._remember(self._faces.path))
        character.company.arrived.connect(self._remember)

    def change(self, place: int) -> None:
        """Choose another face for a place of the picture."""
        self._place = place
        guest = self._character.company.guest_at(place)
        current = self._faces.path if guest is None else self._character.company.paths[guest]
        tags = self._window.face_view.name_tags
        self._open(self.tr("Choose a face"), str(current), tags[place] if place < len(tags) else self._window.face_view)

    def add(self) -> None:
        """Choose a face to stand beside those that are there."""
        if self._character.company.full:
            self._window.hint_label.setText(self.tr("Three faces are as many as fit; remove one first."))
            return
        self._place = None
        self._open(self.tr("Add a face beside"), "", self._window.preview_panel.add)

    def close(self) -> None:
        """Stop drawing portraits."""
        self._thumbnails.stop()

    def _open(self, title: str, current: str, widget: QWidget) -> None:
        beside = QRect(widget.mapToGlobal(QPoint(0, 0)), widget.size())
        ours = [Choice(str(folder), folder.name.capitalize()) for folder in resources.characters()]
        rigs = [Choice(str(path), path.stem, str(path), listed=True) for path in self._recent()]
        self._picker.open(title, [*ours, *rigs], current, beside)
        for key in self._picker.keys:
            self._thumbnails.ask(Path(key))

    def _recent(self) -> list[Path]:
        """The user's last rigs that are still there, the latest first."""
        return [Path(name) for name in self._state.texts("recent faces") if Path(name).exists()][:RECENT]

    def _take(self, path: Path | None) -> None:
        if path is None:
            return
        if self._place is None:
            self._character.company.add(path)
        else:
            self._character.put(self._place, path)

    def _forget(self, key: str) -> None:
        self._state.put("recent faces", [name for name in self._state.texts("recent faces") if name != key])

    def _remember(self, path: Path) -> None:
        """A rig that was opened comes first; our own characters are always there."""
        if path in resources.characters() or not path.exists():
            return
        others = [name for name in self._state.texts("recent faces") if name != str(path)]
        self._state.put("recent faces", [str(path), *others][:RECENT])
