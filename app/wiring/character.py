"""The face in the preview: chosen, opened, turned, and what is said about it."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject, QTimer, Signal
from PySide6.QtGui import QActionGroup
from PySide6.QtWidgets import QFileDialog

from core_pipeline.errors import UserError
from core_pipeline.faces.looks import ANGLES
from core_pipeline.faces.open_face import Opened
from core_pipeline.faces.pose_set import new_curve_set

from .. import resources
from .parts import Parts

CAPTION_MS = 500
RIGS = "Faces (*.glb *.gltf *.vrm)"


class Character(QObject):
    """Joins the face view, the renderer and the reader of faces.

    set_wanted(CurveSet)  the user wants to draw curves for the face's own poses
    """

    set_wanted = Signal(object)

    def __init__(self, parts: Parts, parent: QObject) -> None:
        super().__init__(parent)
        self._window = parts.window
        self._preview = parts.preview
        self._faces = parts.faces
        self._state = parts.state
        self._poses: tuple[str, ...] = ()
        self._others: list[Path] = []  # to try, when the present face can make none of a new set's poses
        self._caption = QTimer(self)
        self._caption.setInterval(CAPTION_MS)
        self._caption.timeout.connect(self._show_caption)
        self._caption.start()
        self._group: QActionGroup = self._window.actions_.characters_menu.choice()
        self._connect()
        self._menu()

    def _connect(self) -> None:
        view, preview = self._window.face_view, self._preview
        self._faces.opened.connect(self._opened)
        self._faces.failed.connect(self._failed)
        preview.frame_ready.connect(view.set_frame)
        preview.failed.connect(lambda reason: view.set_message(reason, retry=True))
        view.orbited.connect(preview.orbit)
        view.panned.connect(preview.pan)
        view.zoomed.connect(preview.zoom)
        view.reset_wanted.connect(lambda: preview.set_angle(ANGLES["front"]))
        view.cutaway_wanted.connect(lambda on: preview.cut_away(0, on))
        view.cutaway_wanted.connect(view.set_cutaway)
        self._window.actions_.lively.toggled.connect(preview.set_lively)
        view.retry_wanted.connect(preview.worker.retry)
        view.resized.connect(preview.resize)

    def _menu(self) -> None:
        actions, menu = self._window.actions_, self._window.actions_.characters_menu
        for folder in resources.characters():
            action = menu.add(f"character.{folder.name}", folder.name.capitalize(), checked=False)
            action.setActionGroup(self._group)
            action.setData(str(folder))
            action.triggered.connect(lambda _=False, folder=folder: self.open(folder))
        actions.new_set_for_face.triggered.connect(self._new_set)
        actions.open_face.triggered.connect(self._ask_file)
        actions.open_face_folder.triggered.connect(self._ask_folder)

    def set_poses(self, poses: tuple[str, ...]) -> None:
        """The pose set of the curves; the face is matched to it."""
        if poses != self._poses:
            self._poses = poses
            self._others = [folder for folder in resources.characters() if folder != self._faces.path]
            self.open(self._faces.path, keep=True)

    def open(self, path: Path, *, keep: bool = False) -> None:
        """Show another face as soon as it has been read; `keep`: look for one that can make the set's poses."""
        if not keep:
            self._others = []
        self._faces.open(path, self._poses)
        for action in self._group.actions():
            action.setChecked(action.data() == str(path))

    def restore(self) -> None:
        """Last time's face, if it is still there."""
        self._window.actions_.lively.setChecked(self._state.flag("lively", True))
        path = Path(self._state.text("face") or resources.face_folder())
        if path.exists() and path != self._faces.path:
            self.open(path)

    def remember(self) -> None:
        """Keep this time's face, and stop what this object runs."""
        self._state.put("face", str(self._faces.path))
        self._state.put("lively", self._window.actions_.lively.isChecked())
        self._caption.stop()

    def _new_set(self) -> None:
        face = self._preview.face
        try:
            if face is not None:
                self.set_wanted.emit(new_curve_set(face))
        except UserError as error:
            self._window.hint_label.setText(str(error))

    def _ask_file(self) -> None:
        name, _ = QFileDialog.getOpenFileName(self._window, self.tr("Open a face"), self._state.text("faces"), RIGS)
        self._take(name)

    def _ask_folder(self) -> None:
        self._take(QFileDialog.getExistingDirectory(self._window, self.tr("Open a folder of .obj poses")))

    def _take(self, name: str) -> None:
        if name:
            self._state.put("faces", str(Path(name).parent))
            self.open(Path(name))

    def _opened(self, opened: Opened) -> None:
        if not opened.retarget.poses and self._others:
            self.open(self._others.pop(0), keep=True)  # perhaps another of ours can make these poses
            return
        self._others = []
        self._preview.set_face(opened.face)
        self._window.face_view.set_cutaway(False)
        self._window.face_view.setToolTip("\n".join(opened.notes))
        if opened.notes:
            self._window.hint_label.setText(opened.notes[0])

    def _failed(self, reason: str) -> None:
        if self._preview.face is None:
            self._window.face_view.set_message(reason)
        self._window.hint_label.setText(reason)

    def _show_caption(self) -> None:
        face, ms = self._preview.face, self._preview.milliseconds
        if face is not None and ms:
            width, height = self._preview.frame_size
            self._window.face_view.set_caption(f"{face.title} · {width} × {height} · {ms:.0f} ms")
