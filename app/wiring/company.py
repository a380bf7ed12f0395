"""Who stands beside the first face: other characters saying the same sentence, or the same one saying it otherwise."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from core_pipeline.faces.open_face import Opened
from widgets.preview.name_tag import Tag

from ..preview.cast import MOST, Actor, Source
from ..preview.faces import Faces
from .parts import Parts


class _Guest(QObject):
    """A face beside the first, with a reader of its own."""

    def __init__(self, path: Path, parent: QObject) -> None:
        super().__init__(parent)
        self.reader = Faces(self)
        self.reader.path = path
        self.opened: Opened | None = None

    @property
    def path(self) -> Path:
        """Where it is, or will be read from."""
        return self.reader.path


class Company(QObject):
    """Keeps the preview's actors: the first face, rivals of it, and guests; never more than fit.

    changed()      other faces are in the picture
    asked()        somebody else is wished for
    arrived(Path)  a guest's face has been read
    failed(str)    why it has not; a guest without a face leaves
    reading(str)   how far it is, when that takes a while
    """

    changed = Signal()
    asked = Signal()
    arrived = Signal(Path)
    failed = Signal(str)
    reading = Signal(str)

    def __init__(self, parts: Parts, parent: QObject) -> None:
        super().__init__(parent)
        self._window = parts.window
        self._preview = parts.preview
        self._poses: tuple[str, ...] = ()
        self._first: Opened | None = None
        self._guests: list[_Guest] = []
        self._rivals: tuple[tuple[str, Source], ...] = ()
        self._own_title = ""

    @property
    def paths(self) -> list[Path]:
        """The guests' faces, from left to right."""
        return [guest.path for guest in self._guests]

    @property
    def full(self) -> bool:
        """Whether no other face fits."""
        return 1 + len(self._rivals) + len(self._guests) >= MOST

    @property
    def compares(self) -> bool:
        """Whether the first face is shown more than once."""
        return bool(self._rivals)

    def set_first(self, opened: Opened) -> None:
        """The face that the editor is about."""
        self._first = opened
        self._show()

    def set_poses(self, poses: tuple[str, ...]) -> None:
        """The pose set of the curves; all guests are matched to it."""
        self._poses = poses
        for guest in self._guests:
            guest.reader.open(guest.path, poses)

    def add(self, path: Path) -> None:
        """One more face, as soon as it has been read; nothing happens when there are three."""
        if not self.full:
            guest = _Guest(path, self)
            guest.reader.opened.connect(lambda opened: self._arrived(guest, opened))
            guest.reader.failed.connect(lambda reason: self._failed(guest, reason))
            guest.reader.reading.connect(self.reading)
            self._guests.append(guest)
            self.asked.emit()
            guest.reader.open(path, self._poses)

    def change(self, index: int, path: Path) -> None:
        """Another face in the place of a guest (0 is the first guest)."""
        guest = self._guests[index]
        self.asked.emit()
        guest.reader.open(path, self._poses)

    @property
    def reads(self) -> bool:
        """Whether a guest's face is being read."""
        return any(guest.reader.reads for guest in self._guests)

    def cancel(self) -> None:
        """Read no further: guests keep the faces they have, those without leave."""
        for guest in list(self._guests):
            guest.reader.cancel()
            if guest.opened is None and not guest.reader.reads:
                self.remove(self._guests.index(guest))

    def remove(self, index: int) -> Path:
        """Send a guest away; where its face was."""
        guest = self._guests.pop(index)
        guest.reader.close()
        guest.deleteLater()
        self._show()
        return guest.path

    def compare(self, rivals: Sequence[tuple[str, Source]], own_title: str = "") -> None:
        """Show the first face again beside itself, once for each (title, source); () ends that.

        Guests that no longer fit wait outside. `own_title` is what the first face is called meanwhile.
        """
        self._rivals, self._own_title = tuple(rivals)[: MOST - 1], own_title if rivals else ""
        self._show()

    def close(self) -> None:
        """End what is being read."""
        for guest in self._guests:
            guest.reader.close()

    # ── what is shown ────────────────────────────────────────────────────────────────────────────

    def show_tags(self) -> None:
        """Say under each face what it is called and what it cannot do."""
        tags = []
        for actor, view in zip(self._preview.actors, self._preview.views, strict=True):
            poses = actor.source.poses if actor.source is not None else self._poses
            lacking = [pose for pose in poses if not actor.face.mix(pose)]
            mute = bool(poses) and len(lacking) == len(poses)
            note = self.tr("Not available on this face: {0}").format(", ".join(lacking)) if lacking else ""
            tags.append(Tag(actor.name, note, mute, view.cutaway))
        self._window.face_view.set_tags(tags)
        self._window.preview_panel.set_full(self.full)

    def guest_at(self, place: int) -> int | None:
        """Which guest stands at a place of the picture; None for the first face and its rivals."""
        index = place - 1 - len(self._rivals)
        shown = [number for number, guest in enumerate(self._guests) if guest.opened is not None]
        return shown[index] if 0 <= index < len(shown) else None

    def _show(self) -> None:
        if self._first is None:
            return
        # What the mapping panel made of the first face's poses stays.
        now = self._preview.face
        same = now is not None and now.positions is self._first.face.positions
        face = now if same and now is not None else self._first.face
        actors = [Actor(face, None, self._own_title)]
        actors += [Actor(face, source, title) for title, source in self._rivals]
        actors += [Actor(guest.opened.face) for guest in self._guests if guest.opened is not None]
        self._preview.set_actors(actors[:MOST])
        self.show_tags()
        self.changed.emit()

    def _arrived(self, guest: _Guest, opened: Opened) -> None:
        guest.opened = opened
        self._show()
        if opened.notes:
            self._window.hint_label.setText(f"{opened.face.title}: {opened.notes[0]}")
        self.arrived.emit(guest.path)

    def _failed(self, guest: _Guest, reason: str) -> None:
        if guest.opened is None and guest in self._guests:
            self.remove(self._guests.index(guest))
        self.changed.emit()
        self.failed.emit(reason)
