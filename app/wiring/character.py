"""The face in the preview: chosen, opened, turned, and what is said about it."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject, QTimer, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QFileDialog

from core_pipeline.errors import UserError
from core_pipeline.faces.open_face import Opened
from core_pipeline.faces.pose_set import new_curve_set

from .. import resources
from .company import Company
from .parts import Parts

CAPTION_MS = 500
RIGS = "Faces (*.glb *.gltf *.vrm)"


class Character(QObject):
    """Joins the face view, the renderer and the reader of faces.

    asked()               another face is wished for
    set_wanted(CurveSet)  the user wants to draw curves for the face's own poses
    """

    asked = Signal()

    set_wanted = Signal(object)

    def __init__(self, parts: Parts, parent: QObject) -> None:
        super().__init__(parent)
        self._window = parts.window
        self._preview = parts.preview
        self._faces = parts.faces
        self._state = parts.state
        self.company = Company(parts, self)
        self._poses: tuple[str, ...] = ()
        self._wished = Path()  # the face that was asked for last
        self._others: list[Path] = []  # to try, when the present face can make none of a new set's poses
        self._caption = QTimer(self)
        self._caption.setInterval(CAPTION_MS)
        self._caption.timeout.connect(self._show_caption)
        self._caption.start()
        self._ours: list[QAction] = []
        self._connect()
        self._menu()

    def _connect(self) -> None:
        view, preview = self._window.face_view, self._preview
        self._faces.opened.connect(self._opened)
        self._faces.failed.connect(lambda _: self._stay())
        preview.frame_ready.connect(view.set_frame)
        preview.failed.connect(lambda reason: view.set_message(reason, retry=True))
        view.orbited.connect(preview.orbit)
        view.panned.connect(preview.pan)
        view.zoomed.connect(preview.zoom)
        view.cutaway_wanted.connect(self._cut_away)
        view.away_wanted.connect(self.send_away)
        self.company.changed.connect(self._mark)
        view.retry_wanted.connect(preview.worker.retry)
        view.resized.connect(preview.resize)

    def _menu(self) -> None:
        actions, menu = self._window.actions_, self._window.actions_.characters_menu
        for folder in resources.characters():
            action = menu.add(f"character.{folder.name}", folder.name.capitalize(), checked=False)
            action.setData(str(folder))
            action.triggered.connect(lambda _=False, folder=folder: self.open(folder))
            self._ours.append(action)
        actions.open_face.triggered.connect(lambda _=False: self._take(self.ask_file(), 0))
        actions.open_face_folder.triggered.connect(lambda _=False: self._take(self.ask_folder(), 0))
        actions.new_set_for_face.triggered.connect(self._new_set)

    def set_poses(self, poses: tuple[str, ...]) -> None:
        """The pose set of the curves; the face is matched to it."""
        if poses != self._poses:
            self._poses = poses
            self.company.set_poses(poses)
            self._others = [folder for folder in resources.characters() if folder != self._faces.path]
            self.open(self._faces.path, keep=True)

    def open(self, path: Path, *, keep: bool = False) -> None:
        """Show another face as soon as it has been read; `keep`: look for one that can make the set's poses."""
        if not keep:
            self._others = []
            self.asked.emit()
        self._wished = path
        self._faces.open(path, self._poses)
        self._mark()

    def cancel(self) -> None:
        """Read no further; the faces that are there stay."""
        self.company.cancel()
        self._faces.cancel()
        self._stay()

    @property
    def paths(self) -> list[Path]:
        """Where the faces in the picture are, the first and its guests."""
        return [self._faces.path, *self.company.paths]

    def put(self, place: int, path: Path) -> None:
        """Another face at a place of the picture, counted from the left."""
        guest = self.company.guest_at(place)
        if guest is None:
            self.open(path)
        else:
            self.company.change(guest, path)

    def send_away(self, place: int) -> None:
        """One face less; when it was the first, its neighbour becomes the first. A rival's leaving ends comparing."""
        guest = self.company.guest_at(place)
        if guest is None and self.company.compares:
            self.company.compare(())
        elif guest is not None:
            self.company.remove(guest)
        elif self.company.paths:
            self.open(self.company.remove(0))

    def restore(self) -> None:
        """Last time's faces, those that are still there."""
        path = Path(self._state.text("face") or resources.face_folder())
        if path.exists() and path != self._faces.path:
            self.open(path)
        for name in self._state.texts("faces beside"):
            if Path(name).exists():
                self.company.add(Path(name))

    def remember(self) -> None:
        """Keep this time's faces, and stop what this object runs."""
        self._state.put("face", str(self._faces.path))
        self._state.put("faces beside", [str(path) for path in self.company.paths])
        self._caption.stop()
        self.company.close()

    def _new_set(self) -> None:
        face = self._preview.face
        try:
            if face is not None:
                self.set_wanted.emit(new_curve_set(face))
        except UserError as error:
            self._window.hint_label.setText(str(error))

    def ask_file(self) -> Path | None:
        """Let the user choose a face's file; None when nothing was chosen."""
        name, _ = QFileDialog.getOpenFileName(self._window, self.tr("Open a face"), self._state.text("faces"), RIGS)
        return self._remembered(name)

    def ask_folder(self) -> Path | None:
        """The same for a folder of poses."""
        return self._remembered(
            QFileDialog.getExistingDirectory(
                self._window, self.tr("Open a folder of .obj poses"), self._state.text("faces")
            )
        )

    def _remembered(self, name: str) -> Path | None:
        if name:
            self._state.put("faces", str(Path(name).parent))
        return Path(name) if name else None

    def _take(self, path: Path | None, place: int) -> None:
        if path is not None:
            self.put(place, path)

    def _opened(self, opened: Opened) -> None:
        if not opened.retarget.poses and self._others:
            self.open(self._others.pop(0), keep=True)  # perhaps another of ours can make these poses
            return
        self._others = []
        self.company.set_first(opened)
        if opened.notes:
            self._window.hint_label.setText(opened.notes[0])

    def _stay(self) -> None:
        """What was asked for does not come: the face before stays; where there is none yet, the first of ours comes."""
        self._mark()
        usual = resources.face_folder()
        if self._preview.face is None and self._wished != usual:
            self.open(usual, keep=True)

    def _cut_away(self, place: int, on: bool) -> None:
        self._preview.cut_away(place, on)
        self.company.show_tags()

    def _mark(self) -> None:
        """Check those of ours that are in the picture."""
        shown = {str(path) for path in self.paths}
        for action in self._ours:
            action.setChecked(action.data() in shown)

    def _show_caption(self) -> None:
        ms = self._preview.milliseconds
        if self._preview.face is not None and ms:
            width, height = self._preview.frame_size
            self._window.preview_panel.set_caption(f"{width} × {height} · {ms:.0f} ms")
