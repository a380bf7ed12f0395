"""How the open face makes each pose: which of its shapes, how much of each, beside our own face doing the same."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from PySide6.QtCore import QSignalBlocker, QSize, Qt, Signal
from PySide6.QtGui import QHideEvent, QImage, QPixmap
from PySide6.QtWidgets import (
    QFrame,
    QHBoxLayout,
    QLabel,
    QListWidget,
    QListWidgetItem,
    QScrollArea,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from core_pipeline.poses import MEANING

from .. import theme
from ..elided_label import ElidedLabel
from ..settings.row_table import pose_box
from ..wrapped_label import WrappedLabel
from .mix_table import MixTable

_Role = Qt.ItemDataRole
_ROW = 20
_LIST_WIDTH = 112
#: Side of the reference picture, in pixels of the widget.
REFERENCE = 92


class MappingPanel(QWidget):
    """Choose a pose on the left, mix it from shapes on the right.

    pose_shown(pose)        the face should hold this pose alone; "": it need not any more
    pose_picked(pose)       another pose is being looked at
    mix_changed(pose, mix)  shape → amount, at every step of a slide
    settled()               a slide has ended
    preset_chosen(name)     all poses as a naming convention makes them
    save_wanted(), revert_wanted()
    """

    pose_shown = Signal(str)
    pose_picked = Signal(str)
    mix_changed = Signal(str, object)
    settled = Signal()
    preset_chosen = Signal(str)
    save_wanted = Signal()
    revert_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._title = ""
        self._shapes: tuple[str, ...] = ()
        self._mixes: dict[str, dict[str, float]] = {}
        self._presets: tuple[tuple[str, str], ...] = ()
        self._notes: tuple[str, ...] = ()
        self._editable = True
        self._make_fields()
        self._lay_out()
        self.set_rig("", (), (), {}, (), "")

    # ── values come down ─────────────────────────────────────────────────────────────────────────

    def set_rig(
        self,
        title: str,
        shapes: tuple[str, ...],
        poses: tuple[str, ...],
        mixes: Mapping[str, Mapping[str, float]],
        presets: Sequence[tuple[str, str]],
        preset: str,
        notes: Sequence[str] = (),
        *,
        editable: bool = True,
    ) -> None:
        """Show how a face makes `poses`; the pose looked at stays when it is one of them. Emits nothing.

        mixes    pose → {shape: amount}; poses without one are not available
        presets  (name, title) of the naming conventions on offer; `preset` is the one in use, "" for none
        notes    one sentence each
        """
        pose = self.pose
        self._shapes, self._editable = tuple(shapes), editable
        self._mixes = {name: dict(mixes.get(name, {})) for name in poses}
        self._title = title or self.tr("No face is open")
        self._show_presets(tuple(presets), preset)
        self._notes = tuple(notes)
        with QSignalBlocker(self.poses):
            self.poses.clear()
            for name in poses:
                item = QListWidgetItem(name)
                item.setSizeHint(QSize(60, _ROW))
                self.poses.addItem(item)
            self.poses.setCurrentRow(poses.index(pose) if pose in poses else 0)
        self._show_available()
        self._show_pose()
        self.set_changed(False)

    def set_changed(self, changed: bool) -> None:
        """Whether there is something to save or to take back."""
        self.save.setEnabled(changed and self._editable)
        self.revert.setEnabled(changed and self._editable)

    def set_held(self, held: bool) -> None:
        """Whether the face holds the pose now."""
        self.hold.setChecked(held)

    def set_reference(self, image: QImage, title: str) -> None:
        """Our own face in the pose looked at; a null image: there is none to show."""
        self._reference.setVisible(not image.isNull())
        if not image.isNull():
            picture = QPixmap.fromImage(image)
            picture.setDevicePixelRatio(image.width() / REFERENCE)
            self._reference.setPixmap(picture)
            self._reference.setToolTip(title)
            self._reference.setAccessibleName(title)

    @property
    def pose(self) -> str:
        """The pose looked at; "" when there is none."""
        item = self.poses.currentItem()
        return item.text() if item is not None else ""

    # ── building ─────────────────────────────────────────────────────────────────────────────────

    def _make_fields(self) -> None:
        self.preset = pose_box()
        self.preset.setAccessibleName(self.tr("Naming convention"))
        self.preset.setToolTip(self.tr("Make every pose as this naming convention does"))
        self.preset.activated.connect(self._choose_preset)
        self.save = self._button("content-save-outline", self.tr("Save"))
        self.save.setToolTip(self.tr("Keep this mapping in a file beside the face"))
        self.save.clicked.connect(self.save_wanted)
        self.revert = self._button("undo-variant", self.tr("Revert"))
        self.revert.setToolTip(self.tr("Back to how it was opened or last saved"))
        self.revert.clicked.connect(self.revert_wanted)
        self.poses = QListWidget()
        self.poses.setAccessibleName(self.tr("Poses of the face"))
        self.poses.setAccessibleDescription(self.tr("Up and down pick the pose whose mix is shown"))
        self.poses.setFixedWidth(_LIST_WIDTH)
        self.poses.setTextElideMode(Qt.TextElideMode.ElideMiddle)
        self.poses.setIconSize(QSize(14, 14))
        self.poses.setUniformItemSizes(True)
        self.poses.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.poses.setStyleSheet(
            f"QListWidget{{border:1px solid {theme.BORDER.name()};border-radius:4px;outline:0}}"
            f"QListWidget:focus{{border-color:{theme.ACCENT.name()}}}"
            f"QListWidget::item:selected{{background:{theme.CHECKED.name()};color:{theme.BRIGHT.name()}}}"
        )
        self.poses.currentRowChanged.connect(self._pick)
        self.poses.itemClicked.connect(lambda _: self.pose_shown.emit(self.pose))
        self.hold = QToolButton()
        self.hold.setCheckable(True)
        self.hold.setIcon(theme.icon("eye-outline"))
        self.hold.setText(self.tr("On the face"))
        self.hold.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.hold.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.hold.setAccessibleName(self.tr("Hold this pose on the face"))
        self.hold.setToolTip(self.tr("The face in the preview holds this pose alone"))
        self.hold.clicked.connect(lambda on: self.pose_shown.emit(self.pose if on else ""))
        self._name = QLabel()
        self._name.setFont(theme.font(bold=True))
        self._meaning = self._text(theme.MUTED.name())
        self._missing = self._text(theme.WEAK.name())
        self._reference = QLabel()
        self._reference.setFixedSize(REFERENCE, REFERENCE)
        self._reference.hide()
        self._note = ElidedLabel()
        self.mix = MixTable()
        self.mix.edited.connect(self._edited)
        self.mix.settled.connect(self.settled)

    def _lay_out(self) -> None:
        line = QHBoxLayout()
        line.setSpacing(4)
        line.addWidget(self.preset, 1)
        line.addWidget(self.save)
        line.addWidget(self.revert)

        words = QVBoxLayout()
        words.setSpacing(3)
        words.addWidget(self._name)
        words.addWidget(self._meaning)
        words.addWidget(self._missing)
        words.addStretch(1)
        words.addWidget(self.hold, 0, Qt.AlignmentFlag.AlignLeft)
        about = QHBoxLayout()
        about.setSpacing(8)
        about.addWidget(self._reference, 0, Qt.AlignmentFlag.AlignTop)
        about.addLayout(words, 1)

        inner = QWidget()
        rows = QVBoxLayout(inner)
        rows.setContentsMargins(0, 0, 4, 0)
        rows.addWidget(self.mix)
        self._scroll = QScrollArea()
        self._scroll.setWidget(inner)
        self._scroll.setWidgetResizable(True)
        self._scroll.setFrameShape(QFrame.Shape.NoFrame)
        self._scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self._scroll.setFocusPolicy(Qt.FocusPolicy.NoFocus)

        right = QVBoxLayout()
        right.setSpacing(6)
        right.addLayout(about)
        right.addWidget(self._scroll, 1)
        body = QHBoxLayout()
        body.setSpacing(8)
        body.addWidget(self.poses)
        body.addLayout(right, 1)

        outer = QVBoxLayout(self)
        outer.setContentsMargins(8, 6, 6, 5)
        outer.setSpacing(6)
        outer.addLayout(line)
        outer.addLayout(body, 1)
        outer.addWidget(self._note)
        self.setMinimumSize(330, 250)

    @staticmethod
    def _button(icon: str, text: str) -> QToolButton:
        button = QToolButton()
        button.setIcon(theme.icon(icon))
        button.setText(text)
        button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        button.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        button.setAccessibleName(text)
        return button

    @staticmethod
    def _text(colour: str) -> WrappedLabel:
        label = WrappedLabel()
        label.setStyleSheet(f"color:{colour}")
        return label

    # ── showing ──────────────────────────────────────────────────────────────────────────────────

    def _show_presets(self, presets: tuple[tuple[str, str], ...], current: str) -> None:
        if presets != self._presets or not self.preset.count():
            self._presets = presets
            self.preset.clear()
            for name, title in presets:
                self.preset.addItem(title, name)
            self.preset.addItem(self.tr("Own mix"), "")
            # shown where no convention is in use; a flag of 0 keeps it from being chosen
            self.preset.setItemData(len(presets), 0, _Role.UserRole - 1)
        at = self.preset.findData(current)
        self.preset.setCurrentIndex(at if at >= 0 else len(presets))
        self.preset.setEnabled(self._editable and bool(presets))

    def _available(self, pose: str) -> bool:
        return any(self._mixes.get(pose, {}).values())

    def _show_available(self) -> None:
        gone = [pose for pose in self._mixes if not self._available(pose)]
        told = [self.tr("Not available on this face: {0}.").format(", ".join(gone))] if gone else []
        notes = [*told, *self._notes]
        self._note.set_text(" · ".join([self._title, *notes]))
        self._note.setToolTip("\n".join([self._title, *notes]))
        for row in range(self.poses.count()):
            item = self.poses.item(row)
            pose = item.text()
            there = self._available(pose)
            colour = theme.pose_colour(pose, row)
            item.setForeground(theme.TEXT if there else theme.FAINT)
            item.setIcon(theme.icon("square-rounded" if there else "square-rounded-outline", colour))
            missing = self.tr("{0}: not available on this face").format(pose)
            item.setToolTip(MEANING.get(pose, pose) if there else missing)
            item.setData(_Role.AccessibleTextRole, pose if there else missing)

    def _show_missing(self) -> None:
        pose = self.pose
        gone = bool(pose) and not self._available(pose)
        self._missing.set_text(self.tr("Not available on this face") if gone else "")
        self._missing.setVisible(gone)

    def _show_pose(self) -> None:
        pose = self.pose
        self._name.setText(pose)
        self._meaning.set_text(MEANING.get(pose, ""))
        self._meaning.setVisible(pose in MEANING)
        self.hold.setEnabled(bool(pose))
        self.mix.setEnabled(bool(pose))
        self.mix.set_mix(self._mixes.get(pose, {}), self._shapes, editable=self._editable)
        self._show_missing()

    # ── wishes go up ─────────────────────────────────────────────────────────────────────────────

    def _pick(self, row: int) -> None:
        if row >= 0:
            self._show_pose()
            self.pose_picked.emit(self.pose)
            self.pose_shown.emit(self.pose)

    def _edited(self, mix: dict[str, float]) -> None:
        self._mixes[self.pose] = mix
        self._show_presets(self._presets, "")
        self._show_available()
        self._show_missing()
        self.mix_changed.emit(self.pose, dict(mix))

    def _choose_preset(self, at: int) -> None:
        self.preset_chosen.emit(self.preset.itemData(at))

    def hideEvent(self, event: QHideEvent) -> None:
        """Out of sight, the panel needs no pose on the face."""
        super().hideEvent(event)
        self.pose_shown.emit("")
