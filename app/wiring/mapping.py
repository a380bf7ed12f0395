"""The mapping panel brought to life: what makes each pose of the open face, tried live, kept beside the rig."""

from __future__ import annotations

from collections.abc import Mapping as ReadOnly
from functools import partial
from pathlib import Path

from PySide6.QtCore import QObject
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QMessageBox

from core_pipeline.errors import UserError
from core_pipeline.faces import retarget
from core_pipeline.faces.mapping_json import load_presets, save_mapping
from core_pipeline.faces.open_face import Opened
from core_pipeline.faces.retarget import OWN_NAMES, Mix, Preset
from core_pipeline.poses import shown_alone
from widgets.preview.mapping_panel import REFERENCE

from .. import resources
from ..commands import Change, MappingOfFace
from ..preview.reference import Reference
from .parts import Parts

#: The panel says this itself, and of the present mixes.
_MISSING = "Not available on this face"

Mixes = dict[str, dict[str, float]]


class Mapping(QObject):
    """Joins the mapping panel, the preview and the file beside the rig.

    What was changed and not saved is kept for each face until the program ends, so that another look at
    another face loses nothing; closing the window asks. Every change is a step of the document's undo stack.
    """

    def __init__(self, parts: Parts, parent: QObject) -> None:
        super().__init__(parent)
        self._window = parts.window
        self._panel = parts.window.mapping_panel
        self._preview = parts.preview
        self._session = parts.session
        self._faces = parts.faces
        self._document = parts.document
        self._presets: dict[str, Preset] = {}
        self._path = Path()
        self._opened: Opened | None = None
        self._saved: Mixes = {}  # as opened, or as last saved
        self._mixes: Mixes = {}
        self._begun_with = self._saved_with = ""  # the preset they come from
        self._unsaved: dict[Path, tuple[str, Mixes]] = {}
        self._saved_of: dict[Path, Mixes] = {}  # of every face that was opened
        self._slide: Change | None = None  # the newest step, while its slide lasts
        self._by_hand = False  # a change of the panel's own is being taken in
        self._reference = Reference(self)
        self._connect()

    def _connect(self) -> None:
        panel = self._panel
        self._faces.opened.connect(self._show_face)
        self._reference.picture.connect(panel.set_reference)
        self._preview.pose_held.connect(panel.set_held)
        self._window.mapping_dock.visibilityChanged.connect(self._seen)
        panel.pose_picked.connect(lambda _: self._refer())
        panel.settled.connect(self._settle)
        panel.pose_shown.connect(lambda pose: self._preview.show_pose(self._alone(pose)))
        panel.mix_changed.connect(self._change)
        panel.preset_chosen.connect(self._choose_preset)
        panel.save_wanted.connect(self.save)
        panel.revert_wanted.connect(self._revert)

    def close(self) -> None:
        """Stop what this object runs."""
        self._reference.stop()

    def may_close(self) -> bool:
        """Whether the window may close: asks what to do with mappings that are not saved."""
        if not self._unsaved:
            return True
        names = ", ".join(path.name for path in self._unsaved)
        buttons = QMessageBox.StandardButton
        answer = QMessageBox.question(
            self._window,
            self.tr("Unsaved face mapping"),
            self.tr("The mapping of {0} has been changed. Save it?").format(names),
            buttons.Save | buttons.Discard | buttons.Cancel,
        )
        if answer == buttons.Save:
            return all(self._write(path, *kept) for path, kept in list(self._unsaved.items()))
        return bool(answer == buttons.Discard)

    def save(self) -> bool:
        """Keep the mapping beside the rig; whether that could be done."""
        if not self._write(self._path, self._begun_with, self._mixes):
            return False
        self._saved, self._saved_with = _copied(self._mixes), self._begun_with
        self._saved_of[self._path] = self._saved
        self._apply()
        return True

    # ── the open face ────────────────────────────────────────────────────────────────────────────

    @property
    def _poses(self) -> tuple[str, ...]:
        return self._session.curve_set.poses

    @property
    def _editable(self) -> bool:
        """Our own characters come with their poses."""
        return self._path not in resources.characters()

    def _show_face(self, opened: Opened) -> None:
        if self._preview.face is not opened.face:
            return  # passed over for one that can make the poses
        self._path, self._opened = self._faces.path, opened
        self._saved, self._saved_with = _copied(opened.retarget.poses), opened.retarget.preset
        self._saved_of[self._path] = self._saved
        self._settle()
        preset, mixes = self._unsaved.get(self._path, (opened.retarget.preset, {}))
        self._begun_with = preset
        self._mixes = {**_copied(self._saved), **_copied(mixes)}
        self._show()
        if mixes:
            self._apply()
        self._refer()

    def _show(self) -> None:
        if self._opened is None:
            return
        face, rig, used = self._opened.face, self._opened.retarget, self._used
        known = [note for note in self._opened.notes if not note.startswith(_MISSING)]
        self._panel.set_rig(
            self._path.name if self._editable else face.title,
            face.shapes,
            self._poses,
            self._mixes,
            self._offered(used),
            used,
            known if self._begun_with == rig.preset else [note for note in known if note not in rig.notes],
            editable=self._editable,
        )
        self._panel.set_changed(self._changed)

    def _offered(self, used: str) -> list[tuple[str, str]]:
        """(name, title) of the naming conventions that make any pose of this face, and of the one in use."""
        if not self._editable:
            return [(OWN_NAMES, self.tr("Its own poses"))]
        text, count = self.tr("{0} · {1} of {2}"), len(self._poses)
        made = [(preset, len(self._by(preset))) for preset in self._known_presets().values()]
        return [(p.name, text.format(p.title, n, count)) for p, n in made if n or p.name == used]

    @property
    def _used(self) -> str:
        """The preset that makes exactly the present mixes; "" when none does."""
        if not self._editable:
            return OWN_NAMES
        preset = self._known_presets().get(self._begun_with)
        now = {pose: mix for pose, mix in _plain(self._mixes).items() if pose in self._poses}
        return preset.name if preset is not None and _plain(self._by(preset)) == now else ""

    def _by(self, preset: Preset) -> ReadOnly[str, Mix]:
        """The poses of the open face as a preset makes them."""
        if self._opened is None:
            return {}
        face = self._opened.face
        return retarget.apply(preset, face.shapes, self._poses, face.expressions).poses

    def _known_presets(self) -> dict[str, Preset]:
        if not self._presets:
            try:
                shipped = load_presets(resources.retarget_presets())
            except UserError as error:
                self._window.hint_label.setText(str(error))
                return {}
            own = Preset(OWN_NAMES, self.tr("Its own pose names"), {})
            self._presets = {preset.name: preset for preset in (*shipped, own)}
        return self._presets

    # ── wishes ───────────────────────────────────────────────────────────────────────────────────

    def _change(self, pose: str, mix: Mix) -> None:
        mixes = {**self._mixes, pose: dict(mix)}
        slide, stack = self._slide, self._document.undo_stack
        self._by_hand = True  # the panel shows it already
        if slide is not None and stack.command(stack.index() - 1) is slide:
            slide.after = MappingOfFace(self._begun_with, mixes)  # all of a slide is one undo step
            self._put(self._path, slide.after)
        else:
            self._push(self._begun_with, mixes, self.tr("Mix {0}").format(pose))
        self._by_hand = False
        if not (self._preview.player.playing or self._preview.bigram_player.playing):
            self._preview.show_pose(self._alone(pose))

    def _seen(self, seen: bool) -> None:
        """Behind another tab Qt does not count the panel as hidden, but no face needs to hold a pose for it."""
        if not seen:
            self._preview.show_pose({})
        self._refer()

    def _settle(self) -> None:
        """The next change is another step."""
        self._slide = None

    def _choose_preset(self, name: str) -> None:
        made = self._by(self._known_presets()[name])
        mixes = {**self._mixes, **{pose: dict(made.get(pose, {})) for pose in self._poses}}
        self._push(name, mixes, self.tr("Choose a preset for the face"))

    def _revert(self) -> None:
        self._push(self._saved_with, self._saved, self.tr("Revert the face mapping"))

    def _push(self, preset: str, mixes: ReadOnly[str, Mix], label: str) -> None:
        before = MappingOfFace(self._begun_with, _copied(self._mixes))
        put = partial(self._put, self._path)
        step = Change(put, before, MappingOfFace(preset, _copied(mixes)), label)
        self._document.push_aside(step)
        self._slide = step if self._by_hand else None

    def _put(self, face: Path, mapping: MappingOfFace) -> None:
        """Give a face these mixes, whether it is the open one or not."""
        mixes = _copied(mapping.mixes)
        if face == self._path:
            self._begun_with, self._mixes = mapping.preset, mixes
            self._apply()
            if not self._by_hand:
                self._settle()
                self._show()
        elif _plain(mixes) != _plain(self._saved_of.get(face, {})):
            self._unsaved[face] = (mapping.preset, mixes)
        else:
            self._unsaved.pop(face, None)

    def _apply(self) -> None:
        """Draw with the present mixes, and remember what is not saved."""
        self._preview.set_pose_map(_copied(self._mixes))
        if self._changed:
            self._unsaved[self._path] = (self._begun_with, _copied(self._mixes))
        else:
            self._unsaved.pop(self._path, None)
        self._panel.set_changed(self._changed)

    @property
    def _changed(self) -> bool:
        return _plain(self._mixes) != _plain(self._saved)

    def _write(self, path: Path, preset: str, mixes: Mixes) -> bool:
        hint = self._window.hint_label
        try:
            written = save_mapping(path, preset, _plain(mixes))
        except UserError as error:
            hint.setText(str(error))
            self._window.face_view.notice.warn(str(error))  # the work is not kept: that must be seen
            return False
        hint.setText(self.tr("Saved {0}").format(written))
        self._unsaved.pop(path, None)
        return True

    def _alone(self, pose: str) -> dict[str, float]:
        """Weights that show one pose; none for no pose."""
        return shown_alone(pose, self._poses) if pose else {}

    def _refer(self) -> None:
        """Our own face beside a user's: not where ours is the one that is open."""
        pose = self._panel.pose
        if pose and self._editable and self._panel.isVisible():
            size = round(REFERENCE * self._panel.devicePixelRatioF())
            self._reference.ask(pose, self._alone(pose), size)
        else:
            self._panel.set_reference(QImage(), "")


def _copied(mixes: ReadOnly[str, Mix]) -> Mixes:
    return {pose: dict(mix) for pose, mix in mixes.items()}


def _plain(mixes: ReadOnly[str, Mix]) -> Mixes:
    """Without shapes that do nothing, and poses that nothing makes."""
    kept = {pose: {shape: amount for shape, amount in mix.items() if amount} for pose, mix in mixes.items()}
    return {pose: mix for pose, mix in kept.items() if mix}
