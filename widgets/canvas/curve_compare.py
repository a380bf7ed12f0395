"""The canvas and other versions of its curves: the ghost, swapping with it, sliding towards it."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QWidget

from core_pipeline.curves import Curve

from .blend_bar import BlendBar
from .curve_controller import Edit
from .curve_pointer import CurvePointer
from .curve_scene import Refusal
from .curve_versions import CurveVersions


class CurveCompare(CurvePointer):
    """Curves under the hand beside a version from before, in grey."""

    def __init__(self, parent: QWidget | None = None) -> None:
        self._versions = CurveVersions()
        super().__init__(parent)
        self.blend_bar = BlendBar(self)
        self.blend_bar.moved.connect(self._blend)
        self.blend_bar.target_picked.connect(self._retarget)
        self.blend_bar.kept.connect(self._keep_blend)
        self.blend_bar.taken_back.connect(self._stop)

    def set_curves(self, curves: Mapping[str, Curve]) -> None:
        """The curves of the open bigram, pose → curve."""
        self._control.set_curves(curves)
        self._show_ghost()
        self._tell()

    def set_ghost(self, curves: Mapping[str, Curve] | None) -> None:
        """The version from before, drawn in grey, to swap with and to slide to; None for none."""
        self._versions.set_snapshot(curves)
        self._show_ghost()

    def set_blend_target(self, name: str, curves: Mapping[str, Curve] | None) -> None:
        """One more version to slide to, such as a suggestion or a neighbour, under a name to show; None: no more."""
        self._versions.set_other(name, curves)

    def set_neighbours(self, neighbours: Mapping[str, Mapping[str, Curve]]) -> None:
        """Bigrams that are like the open one, to slide to and to duplicate from: name to show → curves."""
        self._versions.set_neighbours(neighbours)

    def swap(self) -> None:
        """Wishes the version from before; once more: the one from now again."""

        def swapped() -> Edit | None:
            now = dict(self._control.curves)
            edit = self._control.swap(self._versions.other(now))
            if edit is not None:
                self._versions.keep(now, self._control.curves)
            return edit

        self._do(swapped)

    def slide(self) -> None:
        """Opens the slider between now and another version; once more: the next of them."""
        if self._control.blending:
            self.blend_bar.step_target(1)
        elif not self.busy:
            self._blend_towards(self._versions.names(self._control.curves)[0])

    def duplicate(self) -> None:
        """Opens the slider all the way at the most similar bigram's curves; once more: at the next similar one."""
        if self._control.blending:
            self.blend_bar.step_target(1)
            return
        if self.busy:
            return
        neighbours = self._versions.neighbours(self._control.curves)
        if neighbours:
            self._blend_towards(neighbours[0], 1.0)
        else:
            self._control.refusal = Refusal.NO_NEIGHBOUR, ""
            self._tell()

    def _retarget(self, name: str) -> None:
        self._blend_towards(name, self.blend_bar.share_value)

    def _blend_towards(self, name: str, share: float = 0.0) -> None:
        self._stop()
        control, versions = self._control, self._versions
        versions.towards = name
        if control.begin_blend(versions.target(name, control.curves)):
            self.blend_bar.begin(versions.names(control.curves), name, share)
            self._blend(share)
        self._tell()

    def _blend(self, share: float) -> None:
        changed = self._control.blend(share)
        if changed:
            self._previewed = True
            self.preview_changed.emit(dict(changed))
            self._tell()

    def _keep_blend(self) -> None:
        if self._control.blending:
            self._keep()

    def _finish(self, edit: Edit | None) -> None:
        had_keyboard = self.blend_bar.slider.hasFocus()
        self.blend_bar.hide()
        super()._finish(edit)
        if had_keyboard:
            self.setFocus()

    def _show_ghost(self) -> None:
        if not self.busy:
            self._item.ghost = self._versions.other(self._control.curves)
            self._item.update()

    def resizeEvent(self, ev: QResizeEvent) -> None:
        """Keeps the slider at the foot."""
        super().resizeEvent(ev)
        if hasattr(self, "blend_bar"):  # the plot sizes itself while it is made
            self.blend_bar.adjustSize()
            width = min(self.width() - 80, 460)
            height = self.blend_bar.height()
            self.blend_bar.setGeometry((self.width() - width) // 2, self.height() - height - 4, width, height)
