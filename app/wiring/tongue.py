"""A pose of the tongue that is picked for editing is shown at once, with the mouth a little open: else it hides."""

from __future__ import annotations

from PySide6.QtCore import QObject

from core_pipeline.poses import of_tongue, shown_alone

from .parts import Parts


class Tongue(QObject):
    """Joins the places where a pose is picked and the preview."""

    def __init__(self, parts: Parts, parent: QObject) -> None:
        super().__init__(parent)
        self._preview = parts.preview
        self._session = parts.session
        self._shown = False
        window = parts.window
        for picked in (window.canvas.active_changed, window.pose_list.pose_picked, window.stage_panel.pose_activated):
            picked.connect(self._picked)

    def _picked(self, pose: str) -> None:
        if self._preview.player.playing or self._preview.bigram_player.playing:
            return
        if of_tongue(pose):
            self._preview.show_pose(shown_alone(pose, self._session.poses))
        elif self._shown:
            self._preview.show_pose({})
        self._shown = of_tongue(pose)
